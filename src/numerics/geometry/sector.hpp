// SPDX-License-Identifier: Apache-2.0
/// A sector about an upright axis that stands for a whole circle: what is in it is there once more in each of its
/// copies, turned about the axis. What leaves through one of its faces comes in through the other.
#pragma once

#include <numbers>
#include <vector>

#include "base/tensor.hpp"
#include "base/vector.hpp"

namespace talus {

class Sector {
 public:
  static constexpr int min_copies = 4, max_copies = 72;
  static constexpr double max_angle = 2 * std::numbers::pi / min_copies, min_angle = 2 * std::numbers::pi / max_copies;

  /// From the direction of x on, counterclockwise as seen from above. \param axis a position on it, m; \param copies
  /// that make up the circle, itself counted \throws std::invalid_argument for fewer or more copies than those
  Sector(const Vector3& axis, int copies);

  int copies() const { return static_cast<int>(turns_.size()); }
  const Vector3& axis() const { return axis_; }  ///< a position on it, m

  /// The turn by so many angles of the sector, any whole number; multiples of a quarter of a circle are exact.
  const Tensor3<>& turn(int angles) const;
  /// A position turned about the axis.
  Vector3 turned(const Vector3& x, int angles) const { return axis_ + turn(angles) * (x - axis_); }

  /// In which copy a position is, 0 to copies() - 1; 0: in the sector itself. A face belongs to the copy that begins
  /// with it, the axis to the sector.
  int copy_at(const Vector3& x) const;
  /// How far a position is from the sector, m; 0 within.
  double distance(const Vector3& x) const;
  /// How far a position is from the axis, m.
  double radius(const Vector3& x) const;

  /// The sum over all copies of a vector of the sector: what is across the axis adds up to nothing.
  Vector3 of_all(const Vector3& v) const { return {0, 0, copies() * v.z}; }

 private:
  Vector3 axis_;
  std::vector<Tensor3<>> turns_;
};

}  // namespace talus

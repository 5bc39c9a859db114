// SPDX-License-Identifier: Apache-2.0
/// A straight wall without thickness between two positions of the x-z plane, through the whole depth: the plate under a
/// bed, a wall of a wedge hopper, a chute, a partition. It has openings along its length; a gate is one that is closed
/// at first.
///
/// The rule for the intersection of a line with a wall is the same for all directions; for walls along the axes it is
/// computed from the coordinates themselves, which is exact and fast.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "base/vector.hpp"

namespace talus {

/// Position of a point along a segment in the x-z plane, as a fraction of its length.
constexpr double share_of_segment(const Vector3& x, const Vector3& from, const Vector3& to) {
  const double dx = to.x - from.x, dz = to.z - from.z;
  return (dx * (x.x - from.x) + dz * (x.z - from.z)) / (dx * dx + dz * dz);
}

/// Its distance from that line, m.
double distance_to_segment(const Vector3& x, const Vector3& from, const Vector3& to);

class Wall {
 public:
  struct Opening {
    double begin = 0,
           end = 0;          ///< along the wall, from its first end, m; one that ends beyond the wall has no rim there
    bool shut = false;       ///< a gate that is still there: solid
    double opens_after = 0;  ///< from the opening of the gate of the case, s
  };

  /// \param from, to m; y has no meaning
  /// \throws std::invalid_argument for a wall without length
  Wall(std::string name, const Vector3& from, const Vector3& to, std::vector<Opening> openings = {});

  const std::string& name() const { return name_; }
  const Vector3& from() const { return from_; }
  const Vector3& to() const { return to_; }
  const std::vector<Opening>& openings() const { return openings_; }
  double length() const { return length_; }                ///< m
  const Vector3& direction() const { return direction_; }  ///< unit, from the first end to the second
  const Vector3& normal() const { return normal_; }        ///< unit
  /// The axis of its normal, -1 for a wall at an angle.
  int axis() const { return axis_; }

  /// Signed distance from the plane of the wall, positive on the side of its normal, m.
  double above(const Vector3& x) const { return dot(normal_, x - from_); }
  /// Whether a position lies on the side of the normal. The plane itself belongs to that side.
  bool is_above(const Vector3& x) const {
    if (axis_ >= 0) return normal_[axis_] > 0 ? x[axis_] >= from_[axis_] : x[axis_] <= from_[axis_];
    return cross(x) >= 0;
  }
  /// Distance from the wall including its openings, m.
  double distance(const Vector3& x) const;

  /// Whether it is solid there: at a position beside it, the nearest position of its plane counts. Ends and rims belong
  /// to the wall; neighbours overlap by rounding.
  bool is_solid(const Vector3& x) const {
    const double s = place_along(x), slack = 1e-9 * length_;
    if (!(s >= -slack && s <= length_ + slack) || is_gone_) return false;
    return std::none_of(openings_.begin(), openings_.end(),
                        [&](const Opening& o) { return !o.shut && s > o.begin && s < o.end; });
  }

  /// Intersection of the line from a to b, which lie on different sides, with the plane of the wall.
  double share_to_plane(const Vector3& a, const Vector3& b) const {
    if (axis_ >= 0) return (from_[axis_] - a[axis_]) / (b[axis_] - a[axis_]);
    const double at_a = cross(a);
    return at_a / (at_a - cross(b));
  }

  /// The fraction of the line from a to b at which it crosses the solid wall; nothing if it does not.
  std::optional<double> intersection(const Vector3& a, const Vector3& b) const {
    if (is_above(a) == is_above(b)) return std::nullopt;
    const double t = share_to_plane(a, b);
    if (!is_solid(a + t * (b - a))) return std::nullopt;
    return t;
  }

  /// Whether nothing of it is left: one open opening from end to end.
  bool is_gone() const { return is_gone_; }

  /// Whether a gate is still shut that open_gates(time) would open.
  bool has_gates_due(double time) const;
  /// Opens the gates whose time has come, for good. \param time from the opening of the gate of the case, s
  void open_gates(double time);

 private:
  /// Above 0 on the side of the normal.
  double cross(const Vector3& x) const {
    return (to_.x - from_.x) * (x.z - from_.z) - (to_.z - from_.z) * (x.x - from_.x);
  }
  void note_if_gone();
  /// From the first end, m.
  double place_along(const Vector3& x) const {
    return axis_ >= 0 ? direction_[2 - axis_] * (x[2 - axis_] - from_[2 - axis_])
                      : share_of_segment(x, from_, to_) * length_;
  }

  std::string name_;
  Vector3 from_, to_;
  std::vector<Opening> openings_;
  double length_;
  Vector3 direction_, normal_;
  int axis_ = -1;
  bool is_gone_ = false;
};

}  // namespace talus

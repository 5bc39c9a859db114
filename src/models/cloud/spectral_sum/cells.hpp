// SPDX-License-Identifier: Apache-2.0
/// Spheres sorted into square cells on a lattice that is fixed in space.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "base/vector.hpp"

namespace talus::cloud {

/// A rectangle of cells over the spheres. Columns lie along the shorter side, rows along the longer one.
struct Lattice {
  std::array<double Vector3::*, 2> axis = {&Vector3::x, &Vector3::y};  ///< across a row's cells, and from row to row
  double per_length = 0;                                               ///< cells a metre
  std::array<double, 2> origin = {};  ///< number of the first cell along each axis: a whole number
  std::size_t columns = 0, rows = 0;

  /// Where a place in the rectangle is along an axis, in cells from the first: at least 0.
  double cells_along(std::size_t k, const Vector3& x) const { return x.*axis[k] * per_length - origin[k]; }
};

/// What places extend over.
struct Extent {
  std::array<double, 2> least = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  std::array<double, 2> most = {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  bool finite = true;
};
Extent extent_of(ThreadTeam& team, std::span<const Vector3> position, std::array<double Vector3::*, 2> axis);

/// \param extent of at least one place, finite; \param cell m
Lattice lattice_over(const Extent& extent, std::array<double Vector3::*, 2> axis, double cell);

/// The spheres in the order of their cells, row by row; within a cell in the order in which they were given.
class Cells {
 public:
  /// \param order the spheres, in which they are gone through
  void sort(ThreadTeam& team, const Lattice& lattice, std::span<const Vector3> position,
            std::span<const std::uint32_t> order);

  const Lattice& lattice() const { return lattice_; }
  std::span<const std::uint32_t> sphere() const { return sphere_; }
  /// The first place of a cell in the order; that of the cell after the last of a row is the row's end.
  std::size_t first(std::size_t row, std::size_t column) const { return first_[row * (lattice_.columns + 1) + column]; }

 private:
  Lattice lattice_;
  std::vector<std::uint32_t> row_, by_row_, sphere_, counts_, first_;
};

}  // namespace talus::cloud

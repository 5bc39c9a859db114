// SPDX-License-Identifier: Apache-2.0
/// Spheres sorted into square or cubic cells on a lattice that is fixed in space.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "base/vector.hpp"

namespace talus::cloud {

/// The axes along which spheres move: two or three of them, then whichever is left over.
using Axes = std::array<double Vector3::*, 3>;

/// A box of cells over the spheres: cells of a row follow each other along its shortest side, rows of a layer along the
/// next, layers along the longest. In a plane there is one layer.
struct Lattice {
  Axes axis = {&Vector3::x, &Vector3::y, &Vector3::z};  ///< across a row's cells, from row to row, from layer to layer
  double per_length = 0;                                ///< cells a metre
  std::array<double, 3> origin = {};                    ///< number of the first cell along each axis: a whole number
  std::array<std::size_t, 3> count = {1, 1, 1};         ///< of cells along each axis

  std::size_t columns() const { return count[0]; }
  std::size_t rows() const { return count[1]; }  ///< of a layer
  std::size_t layers() const { return count[2]; }
  std::size_t all_rows() const { return count[1] * count[2]; }

  /// Where a position in the box is along an axis, in cells from the first: at least 0.
  double cells_along(std::size_t k, const Vector3& x) const { return x.*axis[k] * per_length - origin[k]; }
};

/// What positions extend over.
struct Extent {
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  std::array<double, 3> least = {infinite, infinite, infinite}, most = {-infinite, -infinite, -infinite};
  bool finite = true;
};
/// \param dimensions along the first so many axes, 2 or 3; along another they are taken to be at 0
Extent extent_of(ThreadTeam& team, std::span<const Vector3> position, const Axes& axis, std::size_t dimensions);

/// \param extent of at least one position, finite; \param cell m
Lattice lattice_over(const Extent& extent, const Axes& axis, std::size_t dimensions, double cell);

/// The spheres in the order of their cells, row by row and layer by layer; within a cell in the order in which they
/// were given.
class Cells {
 public:
  /// \param order the spheres, in which they are gone through
  void sort(ThreadTeam& team, const Lattice& lattice, std::span<const Vector3> position,
            std::span<const std::uint32_t> order);

  const Lattice& lattice() const { return lattice_; }
  std::span<const std::uint32_t> sphere() const { return sphere_; }
  /// The first position of a cell in the order; that of the cell after the last of a row is the row's end.
  /// \param row counted through all layers
  std::size_t first(std::size_t row, std::size_t column) const {
    return first_[row * (lattice_.columns() + 1) + column];
  }

 private:
  Lattice lattice_;
  std::vector<std::uint32_t> row_, by_row_, sphere_, counts_, first_;
};

}  // namespace talus::cloud

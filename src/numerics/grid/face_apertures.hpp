// SPDX-License-Identifier: Apache-2.0
/// Where a fluid can pass on a grid: the boundaries of the box, the walls within it, and which neighbouring velocities
/// see each other.
///
/// Velocities stand on faces (Harlow & Welch 1965). The neighbour of a face along another axis is hidden where a wall
/// or the box comes between; a rough wall then holds the velocity at the wall's, half a cell away. At a wall's rim,
/// where it covers one of two cells, it counts as one. A wall closes the faces of which it stands between the
/// two cells' centres: the faces that it lies on, or a staircase, through which nothing passes; cells that it cuts
/// count as whole ones.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "numerics/geometry/wall.hpp"
#include "numerics/grid/grid.hpp"
#include "numerics/surface/surface.hpp"

namespace talus {

// A field of a grid that hardly varies, as its distinct rows along x: most rows of what walls and boundaries leave
// open are alike, so that a loop over rows finds them in the nearest cache.

class DistinctRows {
 public:
  DistinctRows() = default;
  DistinctRows(const Grid& grid, const CellField& field);

  /// The row of the field with this number (Grid::row), from the first cell on; readable from the first to the last
  /// ghost.
  const double* at(std::size_t row) const { return numbers_.data() + start_[row]; }
  /// Whether the row, ghosts included, is zero.
  bool is_zero(std::size_t row) const { return start_[row] == zero_; }
  std::size_t count() const { return numbers_.size() / length_; }

 private:
  std::size_t length_ = 1;
  std::vector<double> numbers_;
  std::vector<std::size_t> start_;                   // of each row, in `numbers_`, past the ghosts
  std::size_t zero_ = static_cast<std::size_t>(-1);  // start of the row of zeros
};

enum class FlowBoundary {
  no_slip,    ///< a wall that holds the fluid
  free_slip,  ///< a wall without friction, or a plane of symmetry
  periodic,
  open,  ///< to a given pressure: the static one of a fluid that leaves, the total one of a fluid that enters from rest
  inflow  ///< a no-slip wall through which fluid comes in at a given velocity, which its user adds
};

struct FlowBoundaries {
  std::array<FlowBoundary, 6> kind{};      ///< by face_number
  std::array<double, 6> pressure{};        ///< beyond an open face, Pa, against any reference
  std::array<Vector3, 6> wall_velocity{};  ///< of a wall along itself, of an inflow across, m/s

  bool is_periodic(int axis) const { return kind[static_cast<std::size_t>(2 * axis)] == FlowBoundary::periodic; }
  bool is_open(int axis, int side) const {
    return kind[static_cast<std::size_t>(2 * axis + side)] == FlowBoundary::open;
  }
};

struct FaceApertures {
  Grid grid;
  FlowBoundaries boundaries;

  FaceField open;  ///< 1: the fluid passes the face; 0: closed
  /// 1 where the velocities along an axis of a face and of the face before it along a second axis are mutually visible.
  std::array<FaceField, 3> link;  ///< [axis][second axis]
  /// 1 where the two faces before and the two from there on are all mutually visible: wide stencils.
  std::array<FaceField, 3> wide;
  FaceField wall;   ///< sum of 2/width^2 over the rough walls beside a face, 1/m^2
  FaceField drive;  ///< sum of 2/width^2 times the velocity of those walls, 1/(m s)
  CellField inner;  ///< 1: a cell without a face open to outside the grid

  /// The same fields row by row.
  struct Rows {
    std::array<DistinctRows, 3> open, wall, drive;
    std::array<std::array<DistinctRows, 3>, 3> link, wide;
    DistinctRows inner;
  };
  Rows rows;

  /// \param surface walls of any shape, open patches left out: what it encloses on the grid is tight
  /// \throws std::invalid_argument for a periodic face without its opposite
  FaceApertures(const Grid& grid, const FlowBoundaries& boundaries, const std::vector<Wall>& walls,
                const Surface& surface = Surface::none());

  /// Faces of an axis along a second one: one more than cells along the axis itself, unless it is periodic.
  int faces(int axis, int along) const {
    return grid.count[static_cast<std::size_t>(along)] + (axis == along && !boundaries.is_periodic(axis));
  }
  std::array<int, 3> faces(int axis) const { return {faces(axis, 0), faces(axis, 1), faces(axis, 2)}; }
  bool is_end(int axis, int index) const {
    return !boundaries.is_periodic(axis) && (index == 0 || index == grid.count[static_cast<std::size_t>(axis)]);
  }
  /// Repeats the ends of a periodic axis in the ghosts.
  void wrap(CellField& field) const;
};

}  // namespace talus

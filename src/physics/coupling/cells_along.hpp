// SPDX-License-Identifier: Apache-2.0
/// The cells within reach of a particle along one axis of a grid, and which cell of the box each stands for: those
/// beyond a face for their mirror images, those beyond a periodic face for their copies. Cells that are much longer
/// along this axis than along the others count as several in a row, so that the kernel is summed over them.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "numerics/geometry/box.hpp"
#include "numerics/grid/grid.hpp"

namespace talus::coupling {

struct CellsAlong {
  int from = 0;                   ///< the first one, or the first part of one
  std::vector<float> square;      ///< of each one's distance over h; then far ones, to a whole vector
  std::vector<std::size_t> slot;  ///< in `cell`, of the one within the box that it stands for or is a part of
  std::vector<int> cell;          ///< each once, from the lowest to the highest; then `left` for all beyond open faces
  bool is_plain = false;          ///< each stands for itself

  static constexpr int left = -1;

  /// How many parts a cell has along an axis, each about as long as the cell is wide.
  static int parts(const Grid& grid, int axis);

  /// \param is_mirrored neither end of the box is open or periodic \param x of the particle, m \param reach m
  /// \param per_width 1/h, 1/m
  void find(const Grid& grid, const Box& box, int axis, bool is_mirrored, double x, double reach, double per_width);
  /// The slot of the cell whose centre is at x, if it is one of these. \pre cells have no parts
  std::optional<std::size_t> slot_at(const Grid& grid, int axis, double x) const;

 private:
  void fold_at_mirrors(int to, int count);
  void fold_at_any(const Box& box, int axis, int to, int count);
  void sort();
  void join_parts(int parts);
};

}  // namespace talus::coupling

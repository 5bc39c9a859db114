// SPDX-License-Identifier: Apache-2.0
/// Which cells the coarse cells of a multigrid join where closed faces stand between them.
///
/// Cells are joined in pairs along each axis. Where closed faces separate the cells of one coarse cell, it keeps its
/// largest connected part; each other part goes to the coarse cell of a neighbour it is open to. So no coarse cell
/// joins what a wall parts, and no coarse face leads through a wall. Compare aggregates by strength of connection:
/// Trottenberg, Oosterlee & Schueller 2001, Multigrid, A.9.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "numerics/grid/checkerboard.hpp"

namespace talus {

/// What differs from cells joined in pairs; all lists are empty where no wall parts a coarse cell.
struct Aggregates {
  /// A cell of the fine grid: run and index in it.
  struct Cell {
    std::uint32_t row;
    std::uint16_t colour, m;
  };
  /// A low face of the fine grid.
  struct Face {
    std::uint32_t axis, index;
  };
  /// Lists of what each of some coarse cells consists of, by row of the coarse grid.
  template <class Part>
  struct Lists {
    std::vector<std::uint32_t> of_row;             ///< first list of each row, and the number of lists
    std::vector<std::uint32_t> index;              ///< of the coarse cell of each list, in the board's order
    std::vector<std::array<std::uint32_t, 3>> at;  ///< the coarse cell (I, J, K) of each list
    std::vector<std::uint32_t> begin;              ///< first part of each list, and the number of parts
    std::vector<Part> parts;
  };
  /// A red cell that is not joined with its neighbours: where its correction comes from, and where it would.
  struct Moved {
    std::uint32_t index, coarse, coarse_neighbour;  ///< in the order of the boards; `coarse` may be outside the grid
  };

  Lists<Cell> cells;
  std::array<Lists<Face>, 3> faces;         ///< of low faces of coarse cells, by axis
  std::vector<std::uint32_t> moved_of_row;  ///< first of `moved` of each row of the fine grid, and their number
  std::vector<Moved> moved;

  bool empty() const { return cells.index.empty(); }
};

/// \param low conductances of low faces by axis, in the order of the fine board, ghosts filled; only whether they are
///        positive counts
/// \param factor cells that are joined along each axis, 1 or 2
Aggregates find_aggregates(const Checkerboard& fine, const std::array<const float*, 3>& low, const Checkerboard& coarse,
                           const std::array<int, 3>& factor);

}  // namespace talus

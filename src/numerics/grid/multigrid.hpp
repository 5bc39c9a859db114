// SPDX-License-Identifier: Apache-2.0
/// One multigrid V-cycle for a seven-point Poisson matrix, as a preconditioner: symmetric, in single precision, the
/// results are bitwise identical for any number of threads and processes.
///
/// Cells are joined in pairs along every axis, but for those that walls part (Aggregates); the conductances of joined
/// faces are added and divided by the larger distance of the centres. Prolongation is constant, restriction sums the
/// residuals. One red-black Gauss-Seidel sweep
/// before the coarse grid, one black-red sweep after it. Compare Trottenberg, Oosterlee & Schueller 2001, Multigrid,
/// 4.3 and 8.7.
///
/// Several processes share the rows of fine levels, and all compute those of coarse ones. A process knows the source of
/// a level so far around its own rows that it sweeps without messages: one brings the source, and one the values of the
/// next coarser level.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "numerics/grid/aggregates.hpp"
#include "numerics/grid/checkerboard.hpp"
#include "ranks/halo.hpp"
#include "ranks/slabs.hpp"

namespace talus {

class Multigrid {
 public:
  /// Conductances, in the order of the checkerboard, ghosts filled.
  template <class Number>
  struct Matrix {
    std::array<std::vector<Number>, 3> low;  ///< through the low face of every cell, by axis, to its neighbour
    std::vector<Number> outside;             ///< of every cell to outside the grid
    std::vector<Number> diagonal;            ///< sum over the six faces; 0: a cell without open faces

    explicit Matrix(std::size_t size) : low{zeros(size), zeros(size), zeros(size)} {
      outside = zeros(size), diagonal = zeros(size);
    }

   private:
    static std::vector<Number> zeros(std::size_t size) { return std::vector<Number>(size, 0); }
  };

  /// \param slabs of the finest grid; \param ranks outlive this
  /// \param least_cells of a coarser level that the processes share
  Multigrid(const Checkerboard& finest, const Slabs& slabs, const Ranks& ranks, std::size_t least_cells);

  // Calls together, of several processes.

  /// Sets the matrix of the finest grid, times `scale`, which keeps single precision within its range, and computes
  /// those of the coarser ones.
  /// \param walls_changed whether other faces are closed than at the last call
  /// \param finest of the own rows, of all where walls have changed
  void set_matrix(ThreadTeam& team, const Matrix<double>& finest, double scale, bool walls_changed);
  const Matrix<float>& matrix() const { return levels_.front().matrix; }  ///< of the finest grid

  /// One cycle from zero: correction() := M residual() on the own rows and those of their neighbours.
  void precondition(ThreadTeam& team) { cycle(team, 0); }
  /// To be set on the own rows, in the order of the checkerboard; zero at its pads.
  std::vector<float>& residual() { return levels_.front().source; }
  std::vector<float>& correction() { return levels_.front().value; }

 private:
  using Slices = std::span<const RowRange>;
  /// Where a process computes what of a level; it knows the matrix on all of these.
  struct Rows {
    std::vector<RowRange> restricted, known;  // sums of residuals of the finer level; matrix and source
    std::vector<RowRange> first_red, first_black, corrected, last_black, last_red;
  };
  struct Level {
    Checkerboard board;
    std::array<int, 3> factor;                 // cells that the next coarser level merges along each axis: 1 or 2
    std::array<std::vector<float>, 3> extent;  // of the cells along each axis, in cells of the finest level
    Matrix<float> matrix;
    std::vector<float> inverse;  // of the diagonal
    std::vector<float> value, source;
    Aggregates aggregates;  // with the next coarser level
    Slabs slabs;            // all rows, of a level that all compute alike but the first one
    bool is_shared = true;
    Rows rows;
    Halo known, values;

    Level(const Checkerboard& board, std::array<std::vector<float>, 3> extent);
    RowRange all() const { return {0, board.rows()}; }
    /// Ghosts, diagonal and its inverse from the conductances.
    void complete(ThreadTeam& team, Slices known, Slices relaxed);
    void send_matrix();
    void smooth(ThreadTeam& team, int colour, Slices rows, bool from_zero = false);
    /// Pointers to the conductances of the low faces.
    std::array<const float*, 3> low() const {
      return {matrix.low[0].data(), matrix.low[1].data(), matrix.low[2].data()};
    }
  };

  static void coarsen(ThreadTeam& team, const Level& fine, Level& coarse, Slices rows);
  static void join_faces_beside_walls(const Level& fine, Level& coarse, std::size_t row);
  static void restrict_residual(ThreadTeam& team, const Level& fine, Level& coarse);
  static void add_correction(ThreadTeam& team, const Level& coarse, Level& fine);
  void cycle(ThreadTeam& team, std::size_t level);
  void plan();
  void plan(std::size_t level);
  static Slabs::Reach joined_rows(const Level& fine, const Level& coarse);
  static Slabs::Reach joining_rows(const Level& fine, const Level& coarse);

  std::vector<Level> levels_;
};

}  // namespace talus

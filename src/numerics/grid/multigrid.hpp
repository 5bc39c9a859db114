// SPDX-License-Identifier: Apache-2.0
/// One multigrid V-cycle for a seven-point Poisson matrix, as a preconditioner: symmetric, in single precision, the
/// results are bitwise identical for any number of threads.
///
/// Cells are joined in pairs along every axis, but for those that walls part (Aggregates); the conductances of joined
/// faces are added and divided by the larger distance of the centres. Prolongation is constant, restriction sums the
/// residuals. One red-black Gauss-Seidel sweep
/// before the coarse grid, one black-red sweep after it. Compare Trottenberg, Oosterlee & Schueller 2001, Multigrid,
/// 4.3 and 8.7.
#pragma once

#include <array>
#include <vector>

#include "base/parallel.hpp"
#include "numerics/grid/aggregates.hpp"
#include "numerics/grid/checkerboard.hpp"

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

  explicit Multigrid(const Checkerboard& finest);

  /// Sets the matrix of the finest grid, times `scale`, which keeps single precision within its range, and computes
  /// those of the coarser ones.
  /// \param walls_changed whether other faces are closed than at the last call
  void set_matrix(ThreadTeam& team, const Matrix<double>& finest, double scale, bool walls_changed);
  const Matrix<float>& matrix() const { return levels_.front().matrix; }  ///< of the finest grid

  /// One cycle from zero: correction() := M residual().
  void precondition(ThreadTeam& team) { cycle(team, 0); }
  /// To be set, in the order of the checkerboard; zero at its pads.
  std::vector<float>& residual() { return levels_.front().source; }
  std::vector<float>& correction() { return levels_.front().value; }

 private:
  struct Level {
    Checkerboard board;
    std::array<int, 3> factor;                 // cells that the next coarser level merges along each axis: 1 or 2
    std::array<std::vector<float>, 3> extent;  // of the cells along each axis, in cells of the finest level
    Matrix<float> matrix;
    std::vector<float> inverse;  // of the diagonal
    std::vector<float> value, source;
    Aggregates aggregates;  // with the next coarser level

    Level(const Checkerboard& board, std::array<std::vector<float>, 3> extent);
    /// Ghosts, diagonal and its inverse from the conductances.
    void complete(ThreadTeam& team);
    void smooth(ThreadTeam& team, int colour, bool from_zero = false);
    /// Pointers to the conductances of the low faces.
    std::array<const float*, 3> low() const {
      return {matrix.low[0].data(), matrix.low[1].data(), matrix.low[2].data()};
    }
  };

  static void coarsen(ThreadTeam& team, const Level& fine, Level& coarse);
  static void join_faces_beside_walls(const Level& fine, Level& coarse, std::size_t row);
  static void restrict_residual(ThreadTeam& team, const Level& fine, Level& coarse);
  static void add_correction(ThreadTeam& team, const Level& coarse, Level& fine);
  void cycle(ThreadTeam& team, std::size_t level);

  std::vector<Level> levels_;
};

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
/// Poisson's equation with a conductance on every face: the value of each cell such that the outflow through its faces
/// equals its source,
///   sum over faces of conductance * (value - value of the neighbour) + storage * value = source,
/// where the storage is zero unless given and the value outside an open boundary is zero (add conductance * outside
/// value to the source for another one). Conjugate gradients in single precision, preconditioned by a multigrid cycle,
/// solve for what the value lacks; the residual is then found in double precision, and what is left of it solved for
/// again (iterative refinement, Wilkinson 1963), so that the value has the precision of doubles; where single
/// precision gains nothing more, conjugate gradients in doubles finish. The result does not depend on the number of
/// threads. Faces of zero conductance may divide the grid into regions; the value in a region without an open boundary
/// is determined up to a constant, chosen so that its mean is zero, and its sources must balance.
///
/// Several processes share the rows of cells: each has what it is given, and gives the solution, on rows of its own.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/exact_sum.hpp"
#include "base/parallel.hpp"
#include "numerics/grid/conjugate_gradients.hpp"
#include "numerics/grid/grid.hpp"
#include "numerics/grid/multigrid.hpp"
#include "ranks/ranks.hpp"
#include "ranks/slabs.hpp"

namespace talus {

class PoissonSolver {
 public:
  struct Stop {
    double tolerance = 1e-6;  ///< of the residual over the source, both as root of the sum of squares
    double absolute = 0;      ///< absolute limit of the residual, root of the sum of squares
    int max_iterations = 200;
  };
  struct Outcome {
    int iterations = 0;
    double residual = 0;  ///< root of the sum of squares
  };

  /// \param ranks that share the cells; outlive the solver
  /// \param least_cells of a coarser level of the multigrid that they share
  /// \throws std::invalid_argument for a periodic axis with an odd number of cells above 1
  PoissonSolver(const Grid& grid, std::array<bool, 3> periodic, const Ranks& ranks = one_process(),
                std::size_t least_cells = 16384);

  /// The rows of cells of this process; a row has the number j + count[1] k.
  const Slabs& slabs() const { return slabs_; }

  // Calls together, of several processes.

  /// Sets the conductances, at least 0, unit [source] / [value]; those of the high faces of a periodic axis are not
  /// read. Finds the regions again if the pattern of zeros has changed.
  /// \param conductance of the faces of own cells
  /// \param storage at least 0 in every cell, in the grid's order; none: 0
  void set_conductance(ThreadTeam& team, const FaceField& conductance, const CellField* storage = nullptr);

  /// \param source of every cell, in the grid's order
  /// \param value in: a first guess, out: the solution; ghosts are unchanged
  /// \throws NumericalError if it does not converge, or if the sources of a closed region do not balance; the report
  ///         names the worst cell
  Outcome solve(ThreadTeam& team, const CellField& source, CellField& value, const Stop& stop);

 private:
  struct System;
  struct MultigridCycle;
  struct SystemOfDoubles;
  template <class Body>
  void for_each_range(ThreadTeam& team, Body&& body) const;
  template <class Term>
  double sum(ThreadTeam& team, Term&& term);
  template <class Body>
  double sum_over_runs(ThreadTeam& team, Body&& body);
  template <class Body>
  void for_each_run(ThreadTeam& team, Body&& body) const;
  double find_residual(ThreadTeam& team);
  int refine(ThreadTeam& team, double norm, double enough, int max_iterations);
  ConjugateGradients solve_in_doubles(ThreadTeam& team, double enough, int max_iterations);
  template <class Body>
  double sum_of_blocks(ThreadTeam& team, Body&& body);
  void refresh(std::vector<double>& column);
  void gather(std::span<std::vector<double>* const> columns) const;
  void find_closed_regions();
  void take_region(const std::vector<std::size_t>& cells);
  template <class Number>
  std::vector<double> totals_of_parted(const std::vector<Number>& column) const;
  double unbalanced() const;
  template <class Number>
  void remove_means(std::vector<Number>& column) const;
  void remove_constants(std::vector<float>& column) const;
  [[noreturn]] void fail(const char* what, const char* advice);

  Grid grid_;
  std::array<bool, 3> to_itself_;  // periodic axes of one cell
  const Ranks& ranks_;
  Checkerboard board_;
  Slabs slabs_;
  std::vector<RowRange> own_, around_;  // rows; with those of neighbours
  Halo neighbours_;
  Multigrid::Matrix<double> matrix_;
  Multigrid multigrid_;
  double scale_ = 1;  // scales the conductances to about 1
  /// A closed region: cells in the board's order.
  struct Region {
    std::vector<std::size_t> own, beside;  // on own rows, and on those of neighbours
    std::size_t size;                      // cells on all rows
    bool is_parted;                        // several processes have to do with it
    bool is_counted;                       // by this process: its first row is own
  };
  std::vector<Region> closed_;
  bool is_new_ = true;                  // no conductances yet
  std::vector<double> outside_before_;  // of matrix_, before the last conductances
  // In the board's order. Pads of source_, residual_ and applied_ are zero, so that they do not contribute to sums.
  std::vector<double> source_, value_, residual_;
  std::vector<float> direction_, applied_, change_;                // of the refinement, scaled
  std::vector<double> direction_of_doubles_, applied_of_doubles_;  // empty until they are needed
  std::vector<double> partial_;                                    // sums of the blocks of rows
};

/// Sum over blocks of rows, exact and of no order, of what body(begin, end, sum) adds to 0. Each block has one owner;
/// at the other processes it is 0.
template <class Body>
double PoissonSolver::sum_of_blocks(ThreadTeam& team, Body&& body) {
  partial_.assign(board_.blocks(), 0);
  board_.for_each_block(
      team, own_, [&](std::size_t block, std::size_t begin, std::size_t end) { body(begin, end, partial_[block]); });
  ranks_.add_up(partial_);
  return exact_sum(partial_);
}

/// The same of body(colour, row, first cell of the run, length) over runs.
template <class Body>
double PoissonSolver::sum_over_runs(ThreadTeam& team, Body&& body) {
  return sum_of_blocks(team, [&](std::size_t begin, std::size_t end, double& sum) {
    for (int colour = 0; colour < 2; ++colour)
      for (std::size_t r = begin; r < end; ++r) sum += body(colour, r, board_.run(colour, r), board_.length(colour, r));
  });
}

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
#include "numerics/grid/poisson.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "numerics/grid/run_loops.hpp"

namespace talus {

namespace {

Checkerboard board_of(const Grid& grid, std::array<bool, 3> periodic) {
  for (std::size_t a = 0; a < 3; ++a) {
    if (periodic[a] && grid.count[a] > 1 && grid.count[a] % 2 == 1)
      throw std::invalid_argument("PoissonSolver: a periodic axis needs an even number of cells");
    periodic[a] = periodic[a] && grid.count[a] > 1;
  }
  return Checkerboard(grid.count, periodic);
}

std::array<const double*, 3> pointers(const std::array<std::vector<double>, 3>& columns) {
  return {columns[0].data(), columns[1].data(), columns[2].data()};
}

// What a refinement in single precision may be asked for: less would be lost in rounding, and is left to the next one.
constexpr double min_reduction = 1e-4;
// A refinement that leaves more than this share of the residual, or needs more iterations, meets a part of the value
// that single precision does not resolve: the level of a region behind a bed that hardly lets air through. Doubles go
// on.
constexpr double min_gain = 0.1;
constexpr int max_iterations_of_floats = 50;

}  // namespace

PoissonSolver::PoissonSolver(const Grid& grid, std::array<bool, 3> periodic, const Ranks& ranks,
                             std::size_t least_cells)
    : grid_(grid),
      to_itself_{periodic[0] && grid.count[0] == 1, periodic[1] && grid.count[1] == 1,
                 periodic[2] && grid.count[2] == 1},
      ranks_(ranks),
      board_(board_of(grid, periodic)),
      slabs_(board_.dealt(ranks)),
      own_{slabs_.own()},
      matrix_(board_.size()),
      multigrid_(board_, slabs_, ranks, least_cells) {
  for (auto* column : {&source_, &value_, &residual_}) column->assign(board_.size(), 0);
  for (auto* column : {&direction_, &applied_, &change_}) column->assign(board_.size(), 0);
  const Slabs::Reach none;
  around_ = slabs_.around(own_[0].size() > 0 ? none.more(board_.reach()) : none);
  neighbours_ = slabs_.halo(around_);
}

/// Brings a column's values on the rows of neighbours, and, if x is periodic, the ghosts of the own rows.
void PoissonSolver::refresh(std::vector<double>& column) {
  if (board_.is_periodic(0))
    for (int colour = 0; colour < 2; ++colour)
      for (std::size_t r = own_[0].begin; r < own_[0].end; ++r)
        board_.fill_ghosts(column.data() + board_.run(colour, r), board_.length(colour, r));
  neighbours_.refresh(board_.columns(column));
}

/// Brings columns' values on all rows: rare, so that the way to them is not kept.
void PoissonSolver::gather(std::span<std::vector<double>* const> columns) const {
  Halo all = slabs_.halo(std::vector<RowRange>{{0, board_.rows()}});
  for (std::vector<double>* const column : columns) all.refresh(board_.columns(*column));
}

/// Calls body(block, begin, end) for own ranges in the board's order, pads among them.
template <class Body>
void PoissonSolver::for_each_range(ThreadTeam& team, Body&& body) const {
  board_.for_each_block(team, own_, [&](std::size_t block, std::size_t begin, std::size_t end) {
    for (int colour = 0; colour < 2; ++colour) body(block, board_.run(colour, begin) - 1, board_.run(colour, end) - 1);
  });
}

/// Sum of term(begin, length) over ranges: within a block of rows in order.
template <class Term>
double PoissonSolver::sum(ThreadTeam& team, Term&& term) {
  return sum_of_blocks(team, [&](std::size_t begin, std::size_t end, double& sum) {
    for (int colour = 0; colour < 2; ++colour) {
      const std::size_t first = board_.run(colour, begin) - 1;
      sum += term(first, board_.run(colour, end) - 1 - first);
    }
  });
}

/// Calls body(block, first cell of the run, length, first cell in the grid's order, row) for own runs; the cells of a
/// run are every second one of a row along x.
template <class Body>
void PoissonSolver::for_each_run(ThreadTeam& team, Body&& body) const {
  board_.for_each_block(team, own_, [&](std::size_t block, std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const int j = static_cast<int>(r) % grid_.count[1], k = static_cast<int>(r) / grid_.count[1];
      for (int colour = 0; colour < 2; ++colour)
        body(block, board_.run(colour, r), board_.length(colour, r), grid_.index(board_.first(colour, r), j, k),
             std::array{board_.first(colour, r), j, k});
    }
  });
}

void PoissonSolver::set_conductance(ThreadTeam& team, const FaceField& conductance, const CellField* storage) {
  std::vector<unsigned char> changed(board_.blocks(), 0);
  if (outside_before_.empty()) outside_before_.assign(board_.size(), 0);
  for_each_run(team, [&](std::size_t block, std::size_t own, int length, std::size_t from, std::array<int, 3> cell) {
    double* outside = matrix_.outside.data() + own;
    std::copy_n(outside, length, outside_before_.data() + own);
    if (storage)
      run_loops::take(length, storage->data() + from, outside);
    else
      std::fill_n(outside, length, 0.0);
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const double *low = conductance[a].data() + from, *high = low + grid_.stride(axis);
      double* own_low = matrix_.low[a].data() + own;
      const int n = grid_.count[a];
      const bool ends = !board_.is_periodic(axis), leaves = ends && !to_itself_[a];
      if (axis == 0) {
        const int skipped = cell[0] == 0 && ends ? 1 : 0;
        const bool ends_high = cell[0] + 2 * (length - 1) == n - 1;
        if (run_loops::take(length - skipped, low + 2 * skipped, own_low + skipped)) changed[block] = 1;
        if (skipped == 1) own_low[0] = 0;
        if (skipped == 1 && leaves) outside[0] += low[0];
        if (ends_high && leaves && length > 0) outside[length - 1] += high[2 * (length - 1)];
        board_.fill_ghosts(own_low, length);
        continue;
      }
      if (cell[a] == 0 && ends)
        std::fill_n(own_low, length, 0.0);
      else if (run_loops::take(length, low, own_low))
        changed[block] = 1;
      if (cell[a] == 0 && leaves) run_loops::add_strided(length, low, outside);
      if (cell[a] == n - 1 && leaves) run_loops::add_strided(length, high, outside);
    }
    for (int m = 0; m < length; ++m)
      if ((outside[m] > 0) != (outside_before_[own + static_cast<std::size_t>(m)] > 0)) changed[block] = 1;
  });
  std::array<Halo::Column, 4> low;
  for (std::size_t a : {0, 1})
    for (std::size_t colour : {0, 1}) low[2 * a + colour] = board_.columns(matrix_.low[a + 1])[colour];
  neighbours_.refresh(low);
  std::vector<double> largest(board_.blocks(), 0);
  board_.for_each_block(team, own_, [&](std::size_t block, std::size_t begin, std::size_t end) {
    for (int colour = 0; colour < 2; ++colour)
      for (std::size_t r = begin; r < end; ++r) {
        const std::size_t own = board_.run(colour, r);
        const Runs<double> runs(board_, pointers(matrix_.low), value_.data(), colour, r);
        largest[block] = std::max(largest[block],
                                  run_loops::find_diagonal(board_.length(colour, r), runs, matrix_.outside.data() + own,
                                                           matrix_.diagonal.data() + own));
      }
  });
  Votes votes{.least = {}, .largest = {*std::max_element(largest.begin(), largest.end())}, .sum = {}};
  votes.sum.push_back(static_cast<std::uint64_t>(std::count(changed.begin(), changed.end(), 1)));
  ranks_.join(votes);
  const double top = votes.largest[0];
  scale_ = top > 0 ? 1 / top : 1;
  const bool walls_changed = is_new_ || votes.sum[0] > 0;
  if (walls_changed) {
    gather(std::array{&matrix_.low[0], &matrix_.low[1], &matrix_.low[2], &matrix_.outside});
    find_closed_regions();
  }
  is_new_ = false;
  multigrid_.set_matrix(team, matrix_, scale_, walls_changed);
}

/// residual_ := source_ - matrix value_; \returns its square
double PoissonSolver::find_residual(ThreadTeam& team) {
  refresh(value_);
  return sum_over_runs(team, [&](int colour, std::size_t r, std::size_t own, int length) {
    const Runs<double> runs(board_, pointers(matrix_.low), value_.data(), colour, r);
    return run_loops::find_residual(length, runs, matrix_.diagonal.data() + own, value_.data() + own,
                                    source_.data() + own, residual_.data() + own);
  });
}

/// What the value lacks, for the conjugate gradients: the residual over its norm, the matrix times scale_.
struct PoissonSolver::System {
  PoissonSolver& s;
  ThreadTeam& team;
  double square;  ///< of the residual

  double residual_square() { return square; }
  double apply_to_direction() {
    return s.sum_over_runs(team, [&](int colour, std::size_t r, std::size_t own, int length) {
      const auto& matrix = s.multigrid_.matrix();
      const Runs<float> runs(s.board_, {matrix.low[0].data(), matrix.low[1].data(), matrix.low[2].data()},
                             s.direction_.data(), colour, r);
      return run_loops::apply(length, runs, matrix.diagonal.data() + own, s.direction_.data() + own,
                              s.applied_.data() + own);
    });
  }
  void advance(double step) {
    square = s.sum(team, [&](std::size_t c, std::size_t length) {
      return run_loops::advance(static_cast<int>(length), static_cast<float>(step), s.direction_.data() + c,
                                s.applied_.data() + c, s.change_.data() + c, s.multigrid_.residual().data() + c);
    });
  }
};

/// One cycle of the multigrid as the preconditioner.
struct PoissonSolver::MultigridCycle {
  PoissonSolver& s;
  ThreadTeam& team;

  double apply(double) {
    s.multigrid_.precondition(team);
    if (!s.closed_.empty()) s.remove_constants(s.multigrid_.correction());
    return s.sum(team, [&](std::size_t c, std::size_t length) {
      return run_loops::product(static_cast<int>(length), s.multigrid_.residual().data() + c,
                                s.multigrid_.correction().data() + c);
    });
  }
  void update_direction(double beta) {
    s.board_.for_each_block(team, s.around_, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (int colour = 0; colour < 2; ++colour) {
        const std::size_t first = s.board_.run(colour, begin) - 1, last = s.board_.run(colour, end) - 1;
        run_loops::update_direction(last - first, static_cast<float>(beta), s.multigrid_.correction().data() + first,
                                    s.direction_.data() + first);
      }
    });
  }
};

/// A region's constant, which no equation bounds, would take the digits of single precision from the rest.
void PoissonSolver::remove_constants(std::vector<float>& column) const {
  remove_means(column);
  if (!board_.is_periodic(0)) return;
  for (const RowRange& rows : around_)
    for (int colour = 0; colour < 2; ++colour)
      for (std::size_t r = rows.begin; r < rows.end; ++r)
        board_.fill_ghosts(column.data() + board_.run(colour, r), board_.length(colour, r));
}

/// Adds to value_ what it lacks for the residual, of size `norm`, to fall to `enough`, or as far as single precision
/// reaches. \returns iterations
int PoissonSolver::refine(ThreadTeam& team, double norm, double enough, int max_iterations) {
  remove_means(residual_);
  board_.for_each_block(team, around_, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (int colour = 0; colour < 2; ++colour)
      std::fill(direction_.data() + board_.run(colour, begin) - 1, direction_.data() + board_.run(colour, end) - 1,
                0.0f);
  });
  for_each_range(team, [&](std::size_t, std::size_t begin, std::size_t end) {
    run_loops::scale(end - begin, 1 / norm, residual_.data() + begin, multigrid_.residual().data() + begin);
    std::fill(change_.data() + begin, change_.data() + end, 0.0f);
  });
  System system{*this, team, 1};
  MultigridCycle cycle{*this, team};
  const ConjugateGradients found =
      solve_by_conjugate_gradients(system, cycle, std::max(0.9 * enough / norm, min_reduction), max_iterations);
  for_each_range(team, [&](std::size_t, std::size_t begin, std::size_t end) {
    run_loops::add(end - begin, norm * scale_, change_.data() + begin, value_.data() + begin);
  });
  return found.iterations;
}

PoissonSolver::Outcome PoissonSolver::solve(ThreadTeam& team, const CellField& source, CellField& value,
                                            const Stop& stop) {
  for_each_run(team, [&](std::size_t, std::size_t own, int length, std::size_t from, const std::array<int, 3>&) {
    run_loops::take(length, source.data() + from, source_.data() + own);
    run_loops::take(length, value.data() + from, value_.data() + own);
  });
  const double source_square = sum(team, [&](std::size_t c, std::size_t length) {
    return run_loops::square(static_cast<int>(length), source_.data() + c);
  });
  const double enough = std::max(stop.tolerance * std::sqrt(source_square), stop.absolute);
  if (!closed_.empty()) {
    residual_ = source_;
    if (!(unbalanced() <= enough))
      fail("the sources of a region without an opening do not balance",
           "an open face for every region that grains enter or leave");
    remove_means(source_);
  }
  const auto fail_to_converge = [this] {
    fail("the pressure equation has not converged", "a larger tolerance, or a smaller contrast of the drag");
  };
  int iterations = 0;
  double norm = std::sqrt(find_residual(team));
  while (!(norm <= enough)) {
    if (!(norm <= std::numeric_limits<double>::max()))
      fail("the pressure equation has a source or coefficient that is not finite", "a shorter time step");
    if (iterations >= stop.max_iterations) fail_to_converge();
    const double before = norm;
    iterations += refine(team, norm, enough, std::min(stop.max_iterations - iterations, max_iterations_of_floats));
    norm = std::sqrt(find_residual(team));
    if (!(norm > min_gain * before)) continue;
    const ConjugateGradients found = solve_in_doubles(team, enough, stop.max_iterations);
    iterations += found.iterations;
    norm = std::sqrt(find_residual(team));
    if (norm > enough && found.convergence != Convergence::reached) fail_to_converge();
  }
  remove_means(value_);
  for_each_run(team, [&](std::size_t, std::size_t own, int length, std::size_t to, const std::array<int, 3>&) {
    run_loops::put(length, value_.data() + own, value.data() + to);
  });
  return {iterations, norm};
}

}  // namespace talus

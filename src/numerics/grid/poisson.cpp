// SPDX-License-Identifier: Apache-2.0
#include "numerics/grid/poisson.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/clones.hpp"
#include "base/error.hpp"
#include "numerics/grid/conjugate_gradients.hpp"
#include "numerics/grid/runs.hpp"

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

TALUS_CLONES void find_outflow(int length, const Runs<double>& around, const double* diagonal, const double* value,
                               double* __restrict out) {
  const Runs<double> runs = around;
  for (int m = 0; m < length; ++m) out[m] = diagonal[m] * value[m] - runs.inflow(m);
}

}  // namespace

PoissonSolver::PoissonSolver(const Grid& grid, std::array<bool, 3> periodic)
    : grid_(grid),
      to_itself_{periodic[0] && grid.count[0] == 1, periodic[1] && grid.count[1] == 1,
                 periodic[2] && grid.count[2] == 1},
      board_(board_of(grid, periodic)),
      index_(board_.size(), pad),
      matrix_(board_.size()),
      multigrid_(board_),
      pattern_(board_.size(), 0xff) {
  for (int k = 0; k < grid.count[2]; ++k)
    for (int j = 0; j < grid.count[1]; ++j)
      for (int i = 0; i < grid.count[0]; ++i) index_[board_.at(i, j, k)] = grid.index(i, j, k);
  for (auto* column : {&value_, &residual_, &direction_, &applied_, &correction_}) column->assign(board_.size(), 0);
}

/// Calls body(block, begin, end) for ranges in the board's order, pads among them.
template <class Body>
void PoissonSolver::for_each_range(ThreadTeam& team, Body&& body) const {
  board_.for_each_block(team, [&](std::size_t block, std::size_t begin, std::size_t end) {
    for (int colour = 0; colour < 2; ++colour) body(block, board_.run(colour, begin) - 1, board_.run(colour, end) - 1);
  });
}

/// Sum of term(c) over all cells: in eight interleaved sums a range, then the blocks in order.
template <class Term>
double PoissonSolver::sum(ThreadTeam& team, Term&& term) {
  partial_.assign(board_.blocks(), 0);
  for_each_range(team, [&](std::size_t block, std::size_t begin, std::size_t end) {
    constexpr std::size_t lanes = 8;
    double lane[lanes] = {};
    std::size_t c = begin;
    for (; c + lanes <= end; c += lanes)
      for (std::size_t l = 0; l < lanes; ++l) lane[l] += term(c + l);
    for (; c < end; ++c) lane[0] += term(c);
    partial_[block] += ((lane[0] + lane[1]) + (lane[2] + lane[3])) + ((lane[4] + lane[5]) + (lane[6] + lane[7]));
  });
  double total = 0;
  for (const double part : partial_) total += part;
  return total;
}

void PoissonSolver::set_conductance(ThreadTeam& team, const FaceField& conductance, const CellField* storage) {
  const std::array<int, 3> count = grid_.count;
  board_.for_each_block(team, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const int j = static_cast<int>(r) % count[1], k = static_cast<int>(r) / count[1];
      for (int colour = 0; colour < 2; ++colour) {
        const std::size_t own = board_.run(colour, r);
        const int length = board_.length(colour, r), first = board_.first(colour, r);
        for (int m = 0; m < length; ++m) {
          const std::array<int, 3> place{2 * m + first, j, k};
          const std::size_t c = own + static_cast<std::size_t>(m);
          const auto n = static_cast<std::ptrdiff_t>(index_[c]);
          double outside = storage ? (*storage)[static_cast<std::size_t>(n)] : 0;
          for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const double low = conductance[a][static_cast<std::size_t>(n)];
            const double high = conductance[a][static_cast<std::size_t>(n + grid_.stride(axis))];
            const bool ends = !board_.is_periodic(axis);
            matrix_.low[a][c] = place[a] == 0 && ends ? 0 : low;
            if (place[a] == 0 && ends && !to_itself_[a]) outside += low;
            if (place[a] == count[a] - 1 && ends && !to_itself_[a]) outside += high;
          }
          matrix_.outside[c] = outside;
        }
        for (auto& low : matrix_.low) board_.fill_ghosts(low.data() + own, length);
      }
    }
  });
  std::vector<unsigned char> changed(board_.blocks(), 0);
  std::vector<double> largest(board_.blocks(), 0);
  board_.for_each_block(team, [&](std::size_t block, std::size_t begin, std::size_t end) {
    for (int colour = 0; colour < 2; ++colour)
      for (std::size_t r = begin; r < end; ++r) {
        const std::size_t own = board_.run(colour, r);
        const Runs<double> runs(board_, pointers(matrix_.low), value_.data(), colour, r);
        for (int m = 0; m < board_.length(colour, r); ++m) {
          const std::size_t c = own + static_cast<std::size_t>(m);
          matrix_.diagonal[c] = runs.conductance(m) + matrix_.outside[c];
          largest[block] = std::max(largest[block], matrix_.diagonal[c]);
          unsigned char open = matrix_.outside[c] > 0;
          for (std::size_t a = 0; a < 3; ++a) open = static_cast<unsigned char>(2 * open + (matrix_.low[a][c] > 0));
          if (open != pattern_[c]) pattern_[c] = open, changed[block] = 1;
        }
      }
  });
  const double top = *std::max_element(largest.begin(), largest.end());
  scale_ = top > 0 ? 1 / top : 1;
  if (std::count(changed.begin(), changed.end(), 1) > 0) find_closed_regions();
  multigrid_.set_matrix(team, matrix_, scale_);
}

/// Regions by flooding through open faces.
void PoissonSolver::find_closed_regions() {
  closed_.clear();
  std::vector<bool> seen(board_.size(), false);
  const auto [nx, ny, nz] = grid_.count;
  struct Place {
    int i, j, k;
  };
  std::vector<Place> front;
  std::vector<std::size_t> region;
  for (int k0 = 0; k0 < nz; ++k0)
    for (int j0 = 0; j0 < ny; ++j0)
      for (int i0 = 0; i0 < nx; ++i0) {
        if (seen[board_.at(i0, j0, k0)]) continue;
        seen[board_.at(i0, j0, k0)] = true;
        front.assign(1, {i0, j0, k0});
        region.clear();
        bool is_closed = true;
        while (!front.empty()) {
          const Place at = front.back();
          front.pop_back();
          const std::size_t here = board_.at(at.i, at.j, at.k);
          region.push_back(here);
          is_closed = is_closed && matrix_.outside[here] <= 0;
          for (int axis = 0; axis < 3; ++axis)
            for (const int step : {-1, 1}) {
              Place to = at;
              int& moved = axis == 0 ? to.i : axis == 1 ? to.j : to.k;
              const int n = grid_.count[static_cast<std::size_t>(axis)];
              moved += step;
              if (moved < 0 || moved >= n) {
                if (!board_.is_periodic(axis)) continue;
                moved = (moved + n) % n;
              }
              const std::size_t there = board_.at(to.i, to.j, to.k);
              const double through = matrix_.low[static_cast<std::size_t>(axis)][step < 0 ? here : there];
              if (through > 0 && !seen[there]) seen[there] = true, front.push_back(to);
            }
        }
        if (!is_closed) continue;
        std::sort(region.begin(), region.end());
        closed_.push_back(region);
      }
}

/// Size of the part of the residual that no value can balance.
double PoissonSolver::unbalanced() const {
  double square = 0;
  for (const auto& region : closed_) {
    double total = 0;
    for (const std::size_t c : region) total += residual_[c];
    square += total * total / static_cast<double>(region.size());
  }
  return std::sqrt(square);
}

void PoissonSolver::remove_means(std::vector<double>& column) const {
  for (const auto& region : closed_) {
    double total = 0;
    for (const std::size_t c : region) total += column[c];
    const double mean = total / static_cast<double>(region.size());
    for (const std::size_t c : region) column[c] -= mean;
  }
}

/// applied := matrix x; \returns x . applied
double PoissonSolver::apply(ThreadTeam& team, const std::vector<double>& x, std::vector<double>& applied) {
  board_.for_each_block(team, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (int colour = 0; colour < 2; ++colour)
      for (std::size_t r = begin; r < end; ++r) {
        const std::size_t own = board_.run(colour, r);
        const int length = board_.length(colour, r);
        const Runs<double> runs(board_, pointers(matrix_.low), x.data(), colour, r);
        find_outflow(length, runs, matrix_.diagonal.data() + own, x.data() + own, applied.data() + own);
      }
  });
  return sum(team, [&](std::size_t c) { return x[c] * applied[c]; });
}

double PoissonSolver::residual_square(ThreadTeam& team) {
  return sum(team, [&](std::size_t c) { return residual_[c] * residual_[c]; });
}

/// The pressure's equation for the conjugate gradients.
struct PoissonSolver::System {
  PoissonSolver& solver;
  ThreadTeam& team;

  double residual_square() { return solver.residual_square(team); }
  double apply_to_direction() { return solver.apply(team, solver.direction_, solver.applied_); }
  void advance(double step) {
    PoissonSolver& s = solver;
    s.for_each_range(team, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c) {
        s.value_[c] += step * s.direction_[c];
        s.residual_[c] -= step * s.applied_[c];
      }
    });
  }
};

/// One cycle of the multigrid as the preconditioner.
struct PoissonSolver::MultigridCycle {
  PoissonSolver& solver;
  ThreadTeam& team;

  double apply(double norm) {
    PoissonSolver& s = solver;
    s.multigrid_.precondition(team, s.residual_, 1 / norm, norm * s.scale_, s.correction_);
    return s.sum(team, [&](std::size_t c) { return s.residual_[c] * s.correction_[c]; });
  }
  void update_direction(double beta) {
    PoissonSolver& s = solver;
    s.for_each_range(team, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c) s.direction_[c] = s.correction_[c] + beta * s.direction_[c];
    });
  }
};

PoissonSolver::Outcome PoissonSolver::solve(ThreadTeam& team, const CellField& source, CellField& value,
                                            const Stop& stop) {
  for_each_range(team, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      const bool is_cell = index_[c] != pad;
      residual_[c] = is_cell ? source[index_[c]] : 0;
      value_[c] = is_cell ? value[index_[c]] : 0;
      direction_[c] = 0;
    }
  });
  const double enough = std::max(stop.tolerance * std::sqrt(residual_square(team)), stop.absolute);
  if (!(unbalanced() <= enough))
    fail("the sources of a region without an opening do not balance",
         "an open face for every region that grains enter or leave");
  remove_means(residual_);
  if (board_.is_periodic(0))
    for (int colour = 0; colour < 2; ++colour)
      for (std::size_t r = 0; r < board_.rows(); ++r)
        board_.fill_ghosts(value_.data() + board_.run(colour, r), board_.length(colour, r));
  apply(team, value_, applied_);
  for_each_range(team, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) residual_[c] -= applied_[c];
  });

  System system{*this, team};
  MultigridCycle cycle{*this, team};
  const ConjugateGradients found = solve_by_conjugate_gradients(system, cycle, enough, stop.most_iterations);
  if (found.convergence == Convergence::not_finite)
    fail("the pressure equation has a source or coefficient that is not finite", "a shorter time step");
  if (found.convergence == Convergence::too_slow)
    fail("the pressure equation has not converged", "a larger tolerance, or a smaller contrast of the drag");
  remove_means(value_);
  for_each_range(team, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c)
      if (index_[c] != pad) value[index_[c]] = value_[c];
  });
  return {found.iterations, found.residual};
}

void PoissonSolver::fail(const char* what, const char* advice) const {
  std::array<int, 3> worst{};
  double most = -1;
  for (int k = 0; k < grid_.count[2]; ++k)
    for (int j = 0; j < grid_.count[1]; ++j)
      for (int i = 0; i < grid_.count[0]; ++i) {
        const double size = std::abs(residual_[board_.at(i, j, k)]);
        if (size > most || (std::isnan(size) && !std::isnan(most))) most = size, worst = {i, j, k};
      }
  const auto [i, j, k] = worst;
  const Vector3 x = grid_.centre(i, j, k);
  throw NumericalError({.what = what,
                        .term = fmt::format("largest residual of a cell {:.3g}", most),
                        .place = fmt::format("cell ({}, {}, {}) at ({:.4g}, {:.4g}, {:.4g}) m", i, j, k, x.x, x.y, x.z),
                        .advice = advice});
}

}  // namespace talus

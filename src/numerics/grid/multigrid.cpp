// SPDX-License-Identifier: Apache-2.0
#include "numerics/grid/multigrid.hpp"

#include <algorithm>
#include <utility>

#include "base/clones.hpp"
#include "numerics/grid/runs.hpp"

namespace talus {

namespace {

// Red-black sweeps on the coarsest grid. It has few cells, so they cost nothing.
constexpr int coarsest_sweeps = 20;

/// How many cells may be joined along an axis. A periodic axis keeps an even number of cells, or one.
int coarsening(const Checkerboard& board, int axis) {
  const int n = board.count()[static_cast<std::size_t>(axis)];
  if (n == 1) return 1;
  return !board.is_periodic(axis) || n == 2 || n % 4 == 0 ? 2 : 1;
}

/// Calls body(m, I) for each cell m of a run, I the coarse cell along x that it belongs to.
template <class Body>
void for_each_joined(const Checkerboard& board, int factor, int colour, std::size_t r, Body&& body) {
  const int length = board.length(colour, r), first = board.first(colour, r);
  if (factor == 2)
    for (int m = 0; m < length; ++m) body(m, m);
  else
    for (int m = 0; m < length; ++m) body(m, 2 * m + first);
}

/// Calls body(fine row, whether it is the lowest along y, along z) for the fine rows of a coarse row.
template <class Body>
void for_each_joined_row(const Checkerboard& fine, const Checkerboard& coarse, const std::array<int, 3>& factor,
                         std::size_t coarse_row, Body&& body) {
  const int J = static_cast<int>(coarse_row) % coarse.count()[1], K = static_cast<int>(coarse_row) / coarse.count()[1];
  const int j_end = std::min((J + 1) * factor[1], fine.count()[1]),
            k_end = std::min((K + 1) * factor[2], fine.count()[2]);
  for (int k = K * factor[2]; k < k_end; ++k)
    for (int j = J * factor[1]; j < j_end; ++j) body(fine.row(j, k), j == J * factor[1], k == K * factor[2]);
}

/// Hands a row in the order of x to the runs of both colours.
template <class Body>
void for_each_in_row(const Checkerboard& board, std::size_t r, Body&& body) {
  for (int colour = 0; colour < 2; ++colour) {
    const std::size_t own = board.run(colour, r);
    const int length = board.length(colour, r), first = board.first(colour, r);
    for (int m = 0; m < length; ++m) body(own + static_cast<std::size_t>(m), 2 * m + first);
  }
}

std::array<const float*, 3> pointers(const std::array<std::vector<float>, 3>& columns) {
  return {columns[0].data(), columns[1].data(), columns[2].data()};
}

TALUS_CLONES void relax(int length, const Runs<float>& around, const float* source, const float* inverse,
                        float* __restrict x) {
  const Runs<float> runs = around;
  for (int m = 0; m < length; ++m) x[m] = inverse[m] * (source[m] + runs.inflow(m));
}

}  // namespace

Multigrid::Level::Level(const Checkerboard& checkerboard, std::array<std::vector<float>, 3> extents)
    : board(checkerboard), extent(std::move(extents)), matrix(board.size()) {
  for (int a = 0; a < 3; ++a) factor[static_cast<std::size_t>(a)] = coarsening(board, a);
  for (auto* column : {&inverse, &value, &source}) column->assign(board.size(), 0);
}

void Multigrid::Level::complete(ThreadTeam& team) {
  board.for_each_block(team, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (int colour = 0; colour < 2; ++colour)
      for (std::size_t r = begin; r < end; ++r)
        for (auto& low : matrix.low) board.fill_ghosts(low.data() + board.run(colour, r), board.length(colour, r));
  });
  board.for_each_block(team, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (int colour = 0; colour < 2; ++colour)
      for (std::size_t r = begin; r < end; ++r) {
        const std::size_t own = board.run(colour, r);
        const Runs<float> runs(board, pointers(matrix.low), value.data(), colour, r);
        for (int m = 0; m < board.length(colour, r); ++m) {
          const std::size_t c = own + static_cast<std::size_t>(m);
          matrix.diagonal[c] = runs.conductance(m) + matrix.outside[c];
          inverse[c] = matrix.diagonal[c] > 0 ? 1 / matrix.diagonal[c] : 0.0f;
        }
      }
  });
}

/// Gauss-Seidel on the cells of one colour. \param from_zero the other colour is zero
void Multigrid::Level::smooth(ThreadTeam& team, int colour, bool from_zero) {
  board.for_each_block(team, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const std::size_t own = board.run(colour, r);
      const int length = board.length(colour, r);
      float* __restrict x = value.data() + own;
      const float *b = source.data() + own, *d = inverse.data() + own;
      const Runs<float> runs(board, pointers(matrix.low), value.data(), colour, r);
      if (from_zero)
        for (int m = 0; m < length; ++m) x[m] = d[m] * b[m];
      else
        relax(length, runs, b, d, x);
      board.fill_ghosts(x, length);
    }
  });
}

Multigrid::Multigrid(const Checkerboard& finest) {
  std::array<std::vector<float>, 3> extent;
  for (std::size_t a = 0; a < 3; ++a) extent[a].assign(static_cast<std::size_t>(finest.count()[a]), 1.0f);
  levels_.emplace_back(finest, extent);
  while (levels_.back().factor != std::array{1, 1, 1}) {
    const Level& fine = levels_.back();
    std::array<int, 3> count;
    std::array<bool, 3> periodic;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto f = static_cast<std::size_t>(fine.factor[a]);
      const std::size_t n = fine.extent[a].size();
      extent[a].assign((n + f - 1) / f, 0.0f);
      for (std::size_t i = 0; i < n; ++i) extent[a][i / f] += fine.extent[a][i];
      count[a] = static_cast<int>(extent[a].size());
      periodic[a] = fine.board.is_periodic(static_cast<int>(a)) && count[a] > 1;
    }
    levels_.emplace_back(Checkerboard(count, periodic), extent);
  }
}

void Multigrid::set_matrix(ThreadTeam& team, const Matrix<double>& finest, double scale) {
  Level& top = levels_.front();
  const Checkerboard& board = top.board;
  const auto convert = [&](const std::vector<double>& from, std::vector<float>& to) {
    board.for_each_block(team, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (int colour = 0; colour < 2; ++colour)
        for (std::size_t c = board.run(colour, begin) - 1; c < board.run(colour, end) - 1; ++c)
          to[c] = static_cast<float>(scale * from[c]);
    });
  };
  for (std::size_t a = 0; a < 3; ++a) convert(finest.low[a], top.matrix.low[a]);
  convert(finest.outside, top.matrix.outside);
  top.complete(team);
  for (std::size_t l = 1; l < levels_.size(); ++l) coarsen(team, levels_[l - 1], levels_[l]);
}

/// The conductances of joined faces add up; the way between the centres is longer, also that to the outside.
void Multigrid::coarsen(ThreadTeam& team, const Level& fine, Level& coarse) {
  const float to_outside = 0.5f;  // exact where the axis of the open face is joined
  coarse.board.for_each_block(team, [&](std::size_t, std::size_t begin, std::size_t end) {
    const std::size_t nx = coarse.extent[0].size();
    std::array<std::vector<float>, 4> sum;
    for (std::size_t r = begin; r < end; ++r) {
      for (auto& row : sum) row.assign(nx, 0.0f);
      for_each_joined_row(fine.board, coarse.board, fine.factor, r, [&](std::size_t f, bool lowest_y, bool lowest_z) {
        for (int colour = 0; colour < 2; ++colour) {
          const std::size_t own = fine.board.run(colour, f);
          const float *x = fine.matrix.low[0].data() + own, *y = fine.matrix.low[1].data() + own,
                      *z = fine.matrix.low[2].data() + own, *outside = fine.matrix.outside.data() + own;
          const bool lowest_x = fine.factor[0] == 1 || fine.board.first(colour, f) == 0;
          for_each_joined(fine.board, fine.factor[0], colour, f, [&](int m, int I) {
            if (lowest_x) sum[0][I] += x[m];
            if (lowest_y) sum[1][I] += y[m];
            if (lowest_z) sum[2][I] += z[m];
            sum[3][I] += outside[m];
          });
        }
      });
      const std::size_t J = r % coarse.extent[1].size(), K = r / coarse.extent[1].size();
      // The way between the fine cells next to the face over that to the low neighbour; none to the cell itself.
      const auto shorter = [&](std::size_t axis, std::size_t I) {
        if (fine.factor[axis] == 1) return 1.0f;
        if (coarse.extent[axis].size() == 1) return 0.0f;
        const auto& wide = coarse.extent[axis];
        const auto& narrow = fine.extent[axis];
        const std::size_t below = I == 0 ? wide.size() - 1 : I - 1, fine_below = I == 0 ? narrow.size() - 1 : 2 * I - 1;
        return (narrow[2 * I] + narrow[fine_below]) / (wide[I] + wide[below]);
      };
      const float way_y = shorter(1, J), way_z = shorter(2, K);
      for_each_in_row(coarse.board, r, [&](std::size_t c, int I) {
        const auto i = static_cast<std::size_t>(I);
        coarse.matrix.low[0][c] = sum[0][i] * shorter(0, i);
        coarse.matrix.low[1][c] = sum[1][i] * way_y;
        coarse.matrix.low[2][c] = sum[2][i] * way_z;
        coarse.matrix.outside[c] = to_outside * sum[3][i];
      });
    }
  });
  coarse.complete(team);
}

/// After a sweep that ended with black, only red cells have a residual left.
void Multigrid::restrict_residual(ThreadTeam& team, const Level& fine, Level& coarse) {
  coarse.board.for_each_block(team, [&](std::size_t, std::size_t begin, std::size_t end) {
    std::vector<float> sum(coarse.extent[0].size());
    for (std::size_t r = begin; r < end; ++r) {
      std::fill(sum.begin(), sum.end(), 0.0f);
      for_each_joined_row(fine.board, coarse.board, fine.factor, r, [&](std::size_t f, bool, bool) {
        const std::size_t own = fine.board.run(0, f);
        const float *x = fine.value.data() + own, *b = fine.source.data() + own, *d = fine.matrix.diagonal.data() + own;
        const Runs<float> runs(fine.board, pointers(fine.matrix.low), fine.value.data(), 0, f);
        float* __restrict row = sum.data();
        for_each_joined(fine.board, fine.factor[0], 0, f,
                        [&](int m, int I) { row[I] += (b[m] - d[m] * x[m]) + runs.inflow(m); });
      });
      for_each_in_row(coarse.board, r,
                      [&](std::size_t c, int I) { coarse.source[c] = sum[static_cast<std::size_t>(I)]; });
    }
  });
}

void Multigrid::add_correction(ThreadTeam& team, const Level& coarse, Level& fine) {
  fine.board.for_each_block(team, [&](std::size_t, std::size_t begin, std::size_t end) {
    std::vector<float> correction(coarse.extent[0].size());
    std::size_t held = coarse.board.rows();
    for (std::size_t r = begin; r < end; ++r) {
      const int j = static_cast<int>(r) % fine.board.count()[1], k = static_cast<int>(r) / fine.board.count()[1];
      const std::size_t from = coarse.board.row(j / fine.factor[1], k / fine.factor[2]);
      if (from != held)
        for_each_in_row(coarse.board, held = from,
                        [&](std::size_t c, int I) { correction[static_cast<std::size_t>(I)] = coarse.value[c]; });
      for (int colour = 0; colour < 2; ++colour) {
        float* __restrict x = fine.value.data() + fine.board.run(colour, r);
        const float* e = correction.data();
        for_each_joined(fine.board, fine.factor[0], colour, r, [&](int m, int I) { x[m] += e[I]; });
        fine.board.fill_ghosts(x, fine.board.length(colour, r));
      }
    }
  });
}

void Multigrid::cycle(ThreadTeam& team, std::size_t l) {
  Level& level = levels_[l];
  level.smooth(team, 0, true);
  level.smooth(team, 1);
  if (l + 1 == levels_.size()) {
    for (int n = 1; n < coarsest_sweeps; ++n) level.smooth(team, 0), level.smooth(team, 1);
  } else {
    restrict_residual(team, level, levels_[l + 1]);
    cycle(team, l + 1);
    add_correction(team, levels_[l + 1], level);
    level.smooth(team, 1);
  }
  level.smooth(team, 0);
}

void Multigrid::precondition(ThreadTeam& team, const std::vector<double>& residual, double residual_scale,
                             double correction_scale, std::vector<double>& correction) {
  Level& top = levels_.front();
  const Checkerboard& board = top.board;
  const auto for_each_cell = [&](auto&& body) {
    board.for_each_block(team, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (int colour = 0; colour < 2; ++colour)
        for (std::size_t c = board.run(colour, begin) - 1; c < board.run(colour, end) - 1; ++c) body(c);
    });
  };
  for_each_cell([&](std::size_t c) { top.source[c] = static_cast<float>(residual_scale * residual[c]); });
  cycle(team, 0);
  for_each_cell([&](std::size_t c) { correction[c] = correction_scale * top.value[c]; });
}

}  // namespace talus

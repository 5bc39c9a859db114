// SPDX-License-Identifier: Apache-2.0
#include "numerics/grid/multigrid.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "numerics/grid/joined_rows.hpp"
#include "numerics/grid/run_loops.hpp"

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

/// Distance of the fine cells next to the low face of a coarse cell over the distance of the coarse ones; 0 for a face
/// between the cell and itself.
float shorter(int factor, const std::vector<float>& narrow, const std::vector<float>& wide, std::size_t I) {
  if (factor == 1) return 1.0f;
  if (wide.size() == 1) return 0.0f;
  const std::size_t below = I == 0 ? wide.size() - 1 : I - 1, fine_below = I == 0 ? narrow.size() - 1 : 2 * I - 1;
  return (narrow[2 * I] + narrow[fine_below]) / (wide[I] + wide[below]);
}

// Of the distance of an open end: exact where its axis is joined.
constexpr float to_outside = 0.5f;

/// Calls body(m, I) for each cell m of a run, I the coarse cell along x that it belongs to.
template <class Body>
void for_each_joined(const Checkerboard& board, int factor, int colour, std::size_t r, Body&& body) {
  const int length = board.length(colour, r), first = board.first(colour, r);
  if (factor == 2)
    for (int m = 0; m < length; ++m) body(m, m);
  else
    for (int m = 0; m < length; ++m) body(m, 2 * m + first);
}

/// run[I] += the sums of joined cells.
void add_joined(const Checkerboard& fine, int factor, int colour, std::size_t r, const float* run, float* row) {
  if (factor == 2) return run_loops::add(fine.length(colour, r), run, row);
  for_each_joined(fine, factor, colour, r, [&](int m, int I) { row[I] += run[m]; });
}

/// Calls body(list, its parts) for the lists of a row of the coarse grid.
template <class Lists, class Body>
void for_each_listed(const Lists& lists, std::size_t row, Body&& body) {
  for (std::size_t list = lists.of_row[row]; list < lists.of_row[row + 1]; ++list)
    body(list, std::span(lists.parts).subspan(lists.begin[list], lists.begin[list + 1] - lists.begin[list]));
}

/// Hands a row in the order of x to the runs of both colours.
void take_row(const Checkerboard& board, std::size_t r, const float* row, float* column) {
  for (int colour = 0; colour < 2; ++colour)
    run_loops::take(board.length(colour, r), row + board.first(colour, r), column + board.run(colour, r));
}

}  // namespace

Multigrid::Level::Level(const Checkerboard& checkerboard, std::array<std::vector<float>, 3> extents)
    : board(checkerboard), extent(std::move(extents)), matrix(board.size()), slabs(board.rows()) {
  for (int a = 0; a < 3; ++a) factor[static_cast<std::size_t>(a)] = coarsening(board, a);
  for (auto* column : {&inverse, &value, &source}) column->assign(board.size(), 0);
}

void Multigrid::Level::send_matrix() {
  std::vector<Halo::Column> columns;
  for (auto* column : {&matrix.low[0], &matrix.low[1], &matrix.low[2], &matrix.outside})
    for (const Halo::Column& of_colour : board.columns(*column)) columns.push_back(of_colour);
  known.refresh(columns);
}

/// \param relaxed where the diagonal is needed
void Multigrid::Level::complete(ThreadTeam& team, Slices known_rows, Slices relaxed) {
  board.for_each_block(team, known_rows, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (int colour = 0; colour < 2; ++colour)
      for (std::size_t r = begin; r < end; ++r)
        for (auto& low : matrix.low) board.fill_ghosts(low.data() + board.run(colour, r), board.length(colour, r));
  });
  board.for_each_block(team, relaxed, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (int colour = 0; colour < 2; ++colour) {
      for (std::size_t r = begin; r < end; ++r) {
        const std::size_t own = board.run(colour, r);
        const Runs<float> runs(board, low(), value.data(), colour, r);
        run_loops::find_diagonal(board.length(colour, r), runs, matrix.outside.data() + own,
                                 matrix.diagonal.data() + own);
      }
      const std::size_t first = board.run(colour, begin) - 1;
      run_loops::invert(board.run(colour, end) - 1 - first, matrix.diagonal.data() + first, inverse.data() + first);
    }
  });
}

/// Gauss-Seidel on the cells of one colour. \param from_zero the other colour is zero
void Multigrid::Level::smooth(ThreadTeam& team, int colour, Slices of_rows, bool from_zero) {
  board.for_each_block(team, of_rows, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const std::size_t own = board.run(colour, r);
      const int length = board.length(colour, r);
      float* x = value.data() + own;
      const float *b = source.data() + own, *d = inverse.data() + own;
      if (from_zero)
        run_loops::relax_from_zero(length, b, d, x);
      else
        run_loops::relax(length, Runs<float>(board, low(), value.data(), colour, r), b, d, x);
      board.fill_ghosts(x, length);
    }
  });
}

Multigrid::Multigrid(const Checkerboard& finest, const Slabs& slabs, const Ranks& ranks, std::size_t least_cells) {
  std::array<std::vector<float>, 3> extent;
  for (std::size_t a = 0; a < 3; ++a) extent[a].assign(static_cast<std::size_t>(finest.count()[a]), 1.0f);
  levels_.emplace_back(finest, extent);
  levels_.front().slabs = slabs;
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
    const bool was_shared = fine.is_shared;
    Level coarse(Checkerboard(count, periodic), extent);
    coarse.is_shared =
        was_shared && coarse.factor != std::array{1, 1, 1} && coarse.board.rows() * extent[0].size() >= least_cells;
    if (was_shared) coarse.slabs = coarse.board.dealt_as(ranks, fine.board, fine.slabs, fine.factor[2]);
    levels_.push_back(std::move(coarse));
  }
}

void Multigrid::set_matrix(ThreadTeam& team, const Matrix<double>& finest, double scale, bool walls_changed) {
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    Level& level = levels_[l];
    const std::vector<RowRange> all{level.all()};
    const auto rows = [&](const std::vector<RowRange>& own) -> Slices { return walls_changed ? all : own; };
    if (l > 0)
      coarsen(team, levels_[l - 1], level, rows(level.rows.restricted));
    else
      level.board.for_each_block(
          team, rows(level.rows.restricted), [&](std::size_t, std::size_t begin, std::size_t end) {
            for (int colour = 0; colour < 2; ++colour) {
              const std::size_t first = level.board.run(colour, begin) - 1,
                                length = level.board.run(colour, end) - 1 - first;
              for (std::size_t a = 0; a < 3; ++a)
                run_loops::scale(length, scale, finest.low[a].data() + first, level.matrix.low[a].data() + first);
              run_loops::scale(length, scale, finest.outside.data() + first, level.matrix.outside.data() + first);
            }
          });
    if (!walls_changed) level.send_matrix();
    level.complete(team, rows(level.rows.known), rows(level.rows.first_red));
    if (walls_changed && l + 1 < levels_.size())
      level.aggregates = find_aggregates(level.board, level.low(), levels_[l + 1].board, level.factor);
  }
  if (walls_changed) plan();
}

/// The conductances of joined faces add up; the way between the centres is longer, also that to the outside.
void Multigrid::coarsen(ThreadTeam& team, const Level& fine, Level& coarse, Slices rows) {
  coarse.board.for_each_block(team, rows, [&](std::size_t, std::size_t begin, std::size_t end) {
    const std::size_t nx = coarse.extent[0].size();
    std::array<std::vector<float>, 4> sum;
    for (std::size_t r = begin; r < end; ++r) {
      for (auto& row : sum) row.assign(nx, 0.0f);
      for_each_joined_row(fine.board, coarse.board, fine.factor, r, [&](std::size_t f, bool lowest_y, bool lowest_z) {
        for (int colour = 0; colour < 2; ++colour) {
          const std::size_t own = fine.board.run(colour, f);
          const bool lowest_x = fine.factor[0] == 1 || fine.board.first(colour, f) == 0;
          const auto join = [&](const std::vector<float>& from, std::vector<float>& to) {
            add_joined(fine.board, fine.factor[0], colour, f, from.data() + own, to.data());
          };
          if (lowest_x) join(fine.matrix.low[0], sum[0]);
          if (lowest_y) join(fine.matrix.low[1], sum[1]);
          if (lowest_z) join(fine.matrix.low[2], sum[2]);
          join(fine.matrix.outside, sum[3]);
        }
      });
      const auto shorten = [&](std::size_t a, std::size_t I) {
        return shorter(fine.factor[a], fine.extent[a], coarse.extent[a], I);
      };
      const std::size_t J = r % coarse.extent[1].size(), K = r / coarse.extent[1].size();
      const float way_y = shorten(1, J), way_z = shorten(2, K);
      for (std::size_t i = 0; i < nx; ++i) {
        sum[0][i] *= shorten(0, i), sum[1][i] *= way_y, sum[2][i] *= way_z;
        sum[3][i] *= to_outside;
      }
      for (std::size_t a = 0; a < 3; ++a) take_row(coarse.board, r, sum[a].data(), coarse.matrix.low[a].data());
      take_row(coarse.board, r, sum[3].data(), coarse.matrix.outside.data());
      if (!fine.aggregates.empty()) join_faces_beside_walls(fine, coarse, r);
    }
  });
}

/// Sets the conductances of the coarse cells of a row that are not joined in pairs.
void Multigrid::join_faces_beside_walls(const Level& fine, Level& coarse, std::size_t row) {
  for (std::size_t a = 0; a < 3; ++a)
    for_each_listed(fine.aggregates.faces[a], row, [&](std::size_t list, auto faces) {
      float sum = 0;
      for (const auto [axis, index] : faces) sum += fine.matrix.low[axis][index];
      const auto& lists = fine.aggregates.faces[a];
      coarse.matrix.low[a][lists.index[list]] =
          sum * shorter(fine.factor[a], fine.extent[a], coarse.extent[a], lists.at[list][a]);
    });
  for_each_listed(fine.aggregates.cells, row, [&](std::size_t list, auto cells) {
    float sum = 0;
    for (const auto& c : cells) sum += fine.matrix.outside[fine.board.run(c.colour, c.row) + c.m];
    coarse.matrix.outside[fine.aggregates.cells.index[list]] = sum * to_outside;
  });
}

/// After one sweep from zero only red cells have a residual left: what flows to them from black ones, which were zero
/// when the red ones were relaxed.
void Multigrid::restrict_residual(ThreadTeam& team, const Level& fine, Level& coarse) {
  coarse.board.for_each_block(team, coarse.rows.restricted, [&](std::size_t, std::size_t begin, std::size_t end) {
    std::vector<float> sum(coarse.extent[0].size()), inflow(fine.extent[0].size());
    for (std::size_t r = begin; r < end; ++r) {
      std::fill(sum.begin(), sum.end(), 0.0f);
      for_each_joined_row(fine.board, coarse.board, fine.factor, r, [&](std::size_t f, bool, bool) {
        const Runs<float> runs(fine.board, fine.low(), fine.value.data(), 0, f);
        const int length = fine.board.length(0, f);
        if (fine.factor[0] == 2) return run_loops::add_inflow(length, runs, sum.data());
        std::fill(inflow.begin(), inflow.end(), 0.0f);
        run_loops::add_inflow(length, runs, inflow.data());
        for_each_joined(fine.board, 1, 0, f, [&](int m, int I) { sum[I] += inflow[m]; });
      });
      take_row(coarse.board, r, sum.data(), coarse.source.data());
      if (fine.aggregates.empty()) continue;
      for_each_listed(fine.aggregates.cells, r, [&](std::size_t list, auto cells) {
        float residual = 0;
        for (const auto& c : cells)
          if (c.colour == 0) residual += Runs<float>(fine.board, fine.low(), fine.value.data(), 0, c.row).inflow(c.m);
        coarse.source[fine.aggregates.cells.index[list]] = residual;
      });
    }
  });
}

/// To the red cells: the sweep that follows begins with the black ones, from the red.
void Multigrid::add_correction(ThreadTeam& team, const Level& coarse, Level& fine) {
  fine.board.for_each_block(team, fine.rows.corrected, [&](std::size_t, std::size_t begin, std::size_t end) {
    std::vector<float> correction(coarse.extent[0].size());
    std::size_t held = coarse.board.rows();
    for (std::size_t r = begin; r < end; ++r) {
      const std::size_t from = joining_row(fine.board, coarse.board, fine.factor, r);
      for (int colour = 0; colour < 2 && from != held; ++colour)
        run_loops::put(coarse.board.length(colour, from), coarse.value.data() + coarse.board.run(colour, from),
                       correction.data() + coarse.board.first(colour, from));
      held = from;
      float* x = fine.value.data() + fine.board.run(0, r);
      const int length = fine.board.length(0, r);
      if (fine.factor[0] == 2)
        run_loops::add(length, correction.data(), x);
      else
        for_each_joined(fine.board, 1, 0, r, [&](int m, int I) { x[m] += correction[I]; });
      if (!fine.aggregates.empty())
        for (auto n = fine.aggregates.moved_of_row[r]; n < fine.aggregates.moved_of_row[r + 1]; ++n) {
          const Aggregates::Moved& cell = fine.aggregates.moved[n];
          fine.value[cell.index] += coarse.value[cell.coarse] - coarse.value[cell.coarse_neighbour];
        }
      fine.board.fill_ghosts(x, length);
    }
  });
}

void Multigrid::cycle(ThreadTeam& team, std::size_t l) {
  Level& level = levels_[l];
  level.known.refresh(level.board.columns(level.source));
  level.smooth(team, 0, level.rows.first_red, true);
  level.smooth(team, 1, level.rows.first_black);
  if (l + 1 == levels_.size()) {
    for (int n = 1; n < coarsest_sweeps; ++n) {
      level.values.refresh(level.board.columns(level.value));
      level.smooth(team, 0, level.rows.corrected), level.smooth(team, 1, level.rows.last_black);
    }
  } else {
    Level& coarse = levels_[l + 1];
    restrict_residual(team, level, coarse);
    cycle(team, l + 1);
    coarse.values.refresh(coarse.board.columns(coarse.value));
    add_correction(team, coarse, level);
    level.smooth(team, 1, level.rows.last_black);
  }
  level.smooth(team, 0, level.rows.last_red);
}

}  // namespace talus

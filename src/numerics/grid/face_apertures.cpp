// SPDX-License-Identifier: Apache-2.0
#include "numerics/grid/face_apertures.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <unordered_map>

namespace talus {

DistinctRows::DistinctRows(const Grid& grid, const CellField& field) : length_(grid.length(0)) {
  // Rows as bytes: equal ones are bitwise identical.
  std::unordered_map<std::string_view, std::size_t> known;
  for (std::size_t begin = 0; begin < field.size(); begin += length_) {
    const double* row = field.data() + begin;
    const std::string_view bytes(reinterpret_cast<const char*>(row), length_ * sizeof(double));
    const auto [found, is_new] = known.try_emplace(bytes, numbers_.size() + Grid::margin);
    start_.push_back(found->second);
    if (!is_new) continue;
    if (std::all_of(row, row + length_, [](double x) { return x == 0; })) zero_ = found->second;
    numbers_.insert(numbers_.end(), row, row + length_);
  }
}

namespace {

using Cell = std::array<int, 3>;

/// Calls body(cell) for low <= cell < high.
template <class Body>
void for_each_place(const Cell& low, const Cell& high, Body&& body) {
  for (int k = low[2]; k < high[2]; ++k)
    for (int j = low[1]; j < high[1]; ++j)
      for (int i = low[0]; i < high[0]; ++i) body(Cell{i, j, k});
}

Cell moved(Cell cell, int axis, int by) {
  cell[static_cast<std::size_t>(axis)] += by;
  return cell;
}

std::size_t index(const Grid& grid, const Cell& cell) {
  return grid.index(cell[0], cell[1], cell[2]);
}

/// Closes the faces that a wall's solid part stands before.
void close_faces(const FaceApertures& apertures, const Wall& wall, FaceField& open) {
  const Grid& grid = apertures.grid;
  for (const int axis : {0, 2}) {
    const auto a = static_cast<std::size_t>(axis);
    Vector3 step;
    step[axis] = grid.spacing[axis];
    const auto faces = apertures.faces(axis);
    for_each_place({0, 0, 0}, {faces[0], faces[1], faces[2]}, [&](const Cell& at) {
      const Vector3 after = grid.centre(at[0], at[1], at[2]);
      if (wall.intersection(after - step, after)) open[a][index(grid, at)] = 0;
    });
  }
}

/// The same of a surface.
void close_faces(const FaceApertures& apertures, const Surface& surface, FaceField& open) {
  const Grid& grid = apertures.grid;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    Vector3 step;
    step[axis] = grid.spacing[axis];
    Cell low{}, high{};
    for (int b = 0; b < 3; ++b) {
      const auto n = static_cast<std::size_t>(b);
      const int faces = apertures.faces(axis, b);
      const auto cell_of = [&](double x) { return (x - grid.low[b]) / grid.spacing[b] - 0.5; };
      low[n] = static_cast<int>(std::clamp(std::floor(cell_of(surface.low()[b])), 0.0, static_cast<double>(faces)));
      high[n] =
          static_cast<int>(std::clamp(std::ceil(cell_of(surface.high()[b])) + 2, 0.0, static_cast<double>(faces)));
    }
    for_each_place(low, high, [&](const Cell& at) {
      const Vector3 after = grid.centre(at[0], at[1], at[2]);
      if (open[a][index(grid, at)] > 0 && surface.blocks(after - step, after)) open[a][index(grid, at)] = 0;
    });
  }
}

}  // namespace

FaceApertures::FaceApertures(const Grid& cells, const FlowBoundaries& bounds, const std::vector<Wall>& walls,
                             const Surface& surface)
    : grid(cells), boundaries(bounds), open(grid.face_field()), wall(open), drive(open), inner(grid.cell_field()) {
  link = {open, open, open}, wide = link;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    if ((bounds.kind[2 * a] == FlowBoundary::periodic) != (bounds.kind[2 * a + 1] == FlowBoundary::periodic))
      throw std::invalid_argument("FaceApertures: a periodic face needs its opposite periodic too");
    for_each_place({0, 0, 0}, {faces(axis, 0), faces(axis, 1), faces(axis, 2)}, [&](const Cell& at) {
      const bool passes = !is_end(axis, at[a]) || bounds.is_open(axis, at[a] == 0 ? 0 : 1);
      open[a][index(grid, at)] = passes;
    });
  }
  for (const Wall& solid : walls) close_faces(*this, solid, open);
  if (!surface.is_empty()) close_faces(*this, surface, open);
  for (auto& faces_of_axis : open) wrap(faces_of_axis);

  for_each_place({0, 0, 0}, grid.count, [&](const Cell& at) {
    bool is_inner = true;
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        const int end = side == 0 ? 0 : grid.count[static_cast<std::size_t>(axis)] - 1;
        if (at[static_cast<std::size_t>(axis)] == end && bounds.is_open(axis, side)) is_inner = false;
      }
    inner[index(grid, at)] = is_inner;
  });

  for (int axis = 0; axis < 3; ++axis)
    for (int second = 0; second < 3; ++second) {
      const auto a = static_cast<std::size_t>(axis), b = static_cast<std::size_t>(second);
      const int n = faces(axis, second);
      const bool ring = bounds.is_periodic(second);
      const double stiffness = 2 / (grid.spacing[second] * grid.spacing[second]);
      // Cells between a face and the one before it, those at the ends of the box among them.
      Cell high{faces(axis, 0), faces(axis, 1), faces(axis, 2)};
      high[b] = grid.count[b] + (ring ? 0 : 1);
      for_each_place({0, 0, 0}, high, [&](const Cell& at) {
        const bool has_this = ring || at[b] < n, has_before = ring || at[b] > 0;
        const std::size_t f = index(grid, at);
        if (second == axis) {
          link[a][b][f] = has_this && has_before;
          return;
        }
        // The faces of the second axis of the two cells next to this face, or of the one within the box.
        const auto passes = [&](const Cell& cell) {
          const bool within = bounds.is_periodic(axis) || (cell[a] >= 0 && cell[a] < grid.count[a]);
          return !within || open[b][index(grid, cell)] > 0;
        };
        const bool free = passes(at) && passes(moved(at, axis, -1));
        link[a][b][f] = free && has_this && has_before;
        if (free) return;
        const bool at_end = is_end(second, at[b]);
        const std::size_t side = 2 * b + (at[b] == 0 ? 0 : 1);
        if (at_end && bounds.kind[side] == FlowBoundary::free_slip) return;
        const double speed = at_end ? bounds.wall_velocity[side][axis] : 0;
        const auto hold = [&](const Cell& cell) {
          wall[a][index(grid, cell)] += stiffness;
          drive[a][index(grid, cell)] += stiffness * speed;
        };
        if (has_this) hold(at);
        if (has_before) {
          Cell before = moved(at, second, -1);
          if (before[b] < 0) before[b] += n;
          hold(before);
        }
      });
      wrap(link[a][b]);
      for_each_place({0, 0, 0}, high, [&](const Cell& at) {
        const std::size_t f = index(grid, at), before = index(grid, moved(at, second, -1)),
                          after = index(grid, moved(at, second, 1));
        bool all = link[a][b][before] * link[a][b][f] * link[a][b][after] > 0;
        if (second == axis) all = all && open[a][f] > 0 && open[a][before] > 0;
        wide[a][b][f] = all;
      });
      wrap(wide[a][b]);
    }
  for (std::size_t a = 0; a < 3; ++a) {
    wrap(wall[a]), wrap(drive[a]);
    rows.open[a] = {grid, open[a]}, rows.wall[a] = {grid, wall[a]}, rows.drive[a] = {grid, drive[a]};
    for (std::size_t b = 0; b < 3; ++b) rows.link[a][b] = {grid, link[a][b]}, rows.wide[a][b] = {grid, wide[a][b]};
  }
  rows.inner = {grid, inner};
}

void FaceApertures::wrap(CellField& field) const {
  constexpr int m = Grid::margin;
  const int length = grid.count[0] + 2 * m;
  for (int axis = 0; axis < 3; ++axis) {
    if (!boundaries.is_periodic(axis)) continue;
    const auto a = static_cast<std::size_t>(axis);
    const int n = grid.count[a];
    // Row by row along x, but for the layers across it.
    const auto copy = [&](int from, int to) {
      Cell low{-m, -m, -m}, high{1 - m, grid.count[1] + m, grid.count[2] + m};
      low[a] = to, high[a] = to + 1;
      const std::ptrdiff_t back = (from - to) * grid.stride(axis);
      for_each_place(low, high, [&](const Cell& at) {
        double* row = field.data() + index(grid, at);
        std::copy_n(row + back, axis == 0 ? 1 : length, row);
      });
    };
    for (int k = 0; k < m; ++k) copy(k % n, n + k), copy(n - 1 - k % n, -1 - k);
  }
}

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
#include "physics/coupling/cells_along.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/sph/cubic_spline.hpp"
#include "physics/coupling/deposition_rows.hpp"

namespace talus::coupling {

namespace {

/// The cell within the box that a cell beyond its ends stands for.
int fold(int index, int count, bool is_periodic) {
  if (is_periodic) return ((index % count) + count) % count;
  while (index < 0 || index >= count) index = index < 0 ? -1 - index : 2 * count - 1 - index;
  return index;
}

}  // namespace

int CellsAlong::parts(const Grid& grid, int axis) {
  const double across = std::max(grid.spacing[(axis + 1) % 3], grid.spacing[(axis + 2) % 3]);
  return std::max(1, static_cast<int>(std::lround(grid.spacing[axis] / across)));
}

void CellsAlong::find(const Grid& grid, const Box& box, int axis, bool is_mirrored, double x, double reach,
                      double per_width) {
  const int of_cell = parts(grid, axis);
  const double width = grid.spacing[axis] / of_cell, centre = (x - grid.low[axis]) / width - 0.5, far = reach / width;
  // Rounded down and up.
  const auto floor_of = [](double number) {
    const int n = static_cast<int>(number);
    return n > number ? n - 1 : n;
  };
  const int to = floor_of(centre + far), count = of_cell * grid.count[static_cast<std::size_t>(axis)];
  from = -floor_of(far - centre);
  const auto many = static_cast<std::size_t>(to - from + 1);
  slot.resize(many), square.resize((many + row_lanes - 1) / row_lanes * row_lanes);
  const double step = width * per_width;
  for (std::size_t n = 0; n < many; ++n) {
    const double distance = (from + static_cast<int>(n) - centre) * step;
    square[n] = static_cast<float>(distance * distance);
  }
  for (std::size_t n = many; n < square.size(); ++n) square[n] = static_cast<float>(4 * sph::support * sph::support);
  is_plain = from >= 0 && to < count;
  if (is_plain) {
    cell.resize(many);
    for (std::size_t n = 0; n < many; ++n) slot[n] = n, cell[n] = from + static_cast<int>(n);
  } else if (is_mirrored && centre > -1 && centre < count && from >= -count && to < 2 * count) {
    fold_at_mirrors(to, count);
  } else {
    fold_at_any(box, axis, to, count);
    sort();
  }
  if (of_cell > 1) join_parts(of_cell);
}

/// For a particle in the box that reaches beyond it, by no more than its length.
void CellsAlong::fold_at_mirrors(int to, int count) {
  const int lowest = from < 0 ? 0 : std::min(from, 2 * count - 1 - to);
  const int highest = to >= count ? count - 1 : std::max(to, -1 - from);
  cell.resize(static_cast<std::size_t>(highest - lowest + 1));
  for (std::size_t n = 0; n < cell.size(); ++n) cell[n] = lowest + static_cast<int>(n);
  for (int n = from; n <= to; ++n) {
    const int within = n < 0 ? -1 - n : n >= count ? 2 * count - 1 - n : n;
    slot[static_cast<std::size_t>(n - from)] = static_cast<std::size_t>(within - lowest);
  }
}

void CellsAlong::fold_at_any(const Box& box, int axis, int to, int count) {
  const bool is_periodic = box.face(axis, 0) == FaceKind::periodic;
  const auto has_left = [&](int n) {
    return (n < 0 && box.face(axis, 0) == FaceKind::open) || (n >= count && box.face(axis, 1) == FaceKind::open);
  };
  cell.clear();
  for (int n = from; n <= to; ++n) {
    const int within = has_left(n) ? left : fold(n, count, is_periodic);
    const auto found = std::find(cell.begin(), cell.end(), within);
    slot[static_cast<std::size_t>(n - from)] = static_cast<std::size_t>(found - cell.begin());
    if (found == cell.end()) cell.push_back(within);
  }
}

/// All cells from the lowest to the highest; then `left`, if it is among them.
void CellsAlong::sort() {
  int lowest = std::numeric_limits<int>::max(), highest = lowest;
  bool has_left = false;
  for (const int n : cell) {
    if (n == left) {
      has_left = true;
    } else {
      highest = lowest == std::numeric_limits<int>::max() ? n : std::max(highest, n);
      lowest = std::min(lowest, n);
    }
  }
  const bool has_cells = lowest != std::numeric_limits<int>::max();
  const std::size_t many = has_cells ? static_cast<std::size_t>(highest - lowest + 1) : 0;
  for (std::size_t& s : slot) s = cell[s] == left ? many : static_cast<std::size_t>(cell[s] - lowest);
  cell.resize(many);
  for (std::size_t n = 0; n < many; ++n) cell[n] = lowest + static_cast<int>(n);
  if (has_left) cell.push_back(left);
}

/// \pre `cell` is sorted and holds parts of cells
void CellsAlong::join_parts(int parts) {
  is_plain = false;
  const bool has_left = cell.back() == left;
  const std::size_t many = cell.size() - (has_left ? 1 : 0);
  const int lowest = many > 0 ? cell.front() / parts : 0, highest = many > 0 ? cell[many - 1] / parts : -1;
  const auto wholes = static_cast<std::size_t>(highest - lowest + 1);
  for (std::size_t& s : slot) s = s == many ? wholes : static_cast<std::size_t>(cell[s] / parts - lowest);
  cell.resize(wholes);
  for (std::size_t n = 0; n < wholes; ++n) cell[n] = lowest + static_cast<int>(n);
  if (has_left) cell.push_back(left);
}

std::optional<std::size_t> CellsAlong::slot_at(const Grid& grid, int axis, double x) const {
  const double centre = (x - grid.low[axis]) / grid.spacing[axis] - 0.5, nearest = std::round(centre);
  if (std::abs(centre - nearest) > 1e-6) return std::nullopt;
  const bool within = nearest >= 0 && nearest < grid.count[static_cast<std::size_t>(axis)];
  const auto found = std::find(cell.begin(), cell.end(), within ? static_cast<int>(nearest) : left);
  if (found == cell.end()) return std::nullopt;
  return static_cast<std::size_t>(found - cell.begin());
}

}  // namespace talus::coupling

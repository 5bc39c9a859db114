// SPDX-License-Identifier: Apache-2.0
#include "numerics/cell_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace talus {

namespace {

// 21 bits a direction; one is left so that a row may reach one cell past the last.
constexpr std::int64_t most_cells = std::int64_t{1} << 20;

Vector3 lowest(std::span<const Vector3> points) {
  Vector3 low = points.empty() ? Vector3{} : points[0];
  for (const Vector3& p : points) low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
  return low;
}

void check_fits(std::span<const Vector3> points, const Vector3& origin, double cell_size) {
  const double reach = cell_size * static_cast<double>(most_cells);
  for (const Vector3& p : points) {
    const Vector3 d = p - origin;
    if (!(d.x < reach && d.y < reach && d.z < reach))
      throw std::invalid_argument("points are not finite or extend over more than 2^20 cells");
  }
}

/// Spreads the lower 21 bits to every third bit.
std::uint64_t every_third_bit(std::uint64_t v) {
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffff;
  v = (v | v << 16) & 0x1f0000ff0000ff;
  v = (v | v << 8) & 0x100f00f00f00f00f;
  v = (v | v << 4) & 0x10c30c30c30c30c3;
  v = (v | v << 2) & 0x1249249249249249;
  return v;
}

std::vector<std::uint32_t> sort_by(const std::vector<std::uint64_t>& keys) {
  std::vector<std::uint32_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return keys[a] != keys[b] ? keys[a] < keys[b] : a < b; });
  return order;
}

std::uint64_t row_key(std::int64_t i, std::int64_t j, std::int64_t k) {
  return static_cast<std::uint64_t>(k) << 42 | static_cast<std::uint64_t>(j) << 21 | static_cast<std::uint64_t>(i);
}

}  // namespace

CellGrid::CellGrid(std::span<const Vector3> points, double cell_size) : origin_(lowest(points)), cell_size_(cell_size) {
  if (!(cell_size > 0)) throw std::invalid_argument("the edge of a cell must be positive");
  check_fits(points, origin_, cell_size);
  std::vector<std::uint64_t> keys(points.size());
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Cell cell = cell_of(points[n]);
    keys[n] = row_key(cell.i, cell.j, cell.k);
  }
  order_ = sort_by(keys);
  keys_.resize(keys.size());
  for (std::size_t n = 0; n < keys.size(); ++n) keys_[n] = keys[order_[n]];
}

CellGrid::Cell CellGrid::cell_of(const Vector3& x) const {
  const Vector3 d = x - origin_;
  return {static_cast<std::int64_t>(std::floor(d.x / cell_size_)),
          static_cast<std::int64_t>(std::floor(d.y / cell_size_)),
          static_cast<std::int64_t>(std::floor(d.z / cell_size_))};
}

CellGrid::Range CellGrid::points_in_row(Cell first, Cell last) const {
  if (first.j < 0 || first.k < 0 || last.i < 0 || first.j >= most_cells || first.k >= most_cells ||
      first.i >= most_cells)
    return {0, 0};
  const auto begin =
      std::lower_bound(keys_.begin(), keys_.end(), row_key(std::max<std::int64_t>(first.i, 0), first.j, first.k));
  const auto end = std::upper_bound(begin, keys_.end(), row_key(std::min(last.i, most_cells), last.j, last.k));
  return {static_cast<std::size_t>(begin - keys_.begin()), static_cast<std::size_t>(end - keys_.begin())};
}

std::vector<std::uint32_t> spatial_order(std::span<const Vector3> points, double cell_size) {
  if (!(cell_size > 0)) throw std::invalid_argument("the edge of a cell must be positive");
  const Vector3 origin = lowest(points);
  check_fits(points, origin, cell_size);
  std::vector<std::uint64_t> keys(points.size());
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Vector3 d = points[n] - origin;
    keys[n] = every_third_bit(static_cast<std::uint64_t>(d.x / cell_size)) |
              every_third_bit(static_cast<std::uint64_t>(d.y / cell_size)) << 1 |
              every_third_bit(static_cast<std::uint64_t>(d.z / cell_size)) << 2;
  }
  return sort_by(keys);
}

}  // namespace talus

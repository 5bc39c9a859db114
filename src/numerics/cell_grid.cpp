// SPDX-License-Identifier: Apache-2.0
#include "numerics/cell_grid.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>

namespace talus {

namespace {

// 21 bits a direction; one is left so that a row may reach one cell past the last.
constexpr std::int64_t max_cells = std::int64_t{1} << 20;

Vector3 lowest(std::span<const Vector3> points) {
  Vector3 low = points.empty() ? Vector3{} : points[0];
  for (const Vector3& p : points) low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
  return low;
}

void check_fits(std::span<const Vector3> points, const Vector3& origin, double cell_size) {
  const double reach = cell_size * static_cast<double>(max_cells);
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

struct Keyed {
  std::uint64_t key;
  std::uint32_t point;
};

/// By key, equal ones as they come: sorted by one digit after the other, the lowest first.
void sort(std::vector<Keyed>& points) {
  constexpr int bits = 7;  // the numbers of a cell along the axes of a grid of up to 128 cells are three digits
  constexpr std::size_t digits = std::size_t{1} << bits;
  std::uint64_t used = 0;
  for (const Keyed& p : points) used |= p.key;
  std::vector<Keyed> sorted(points.size());
  for (int shift = 0; shift < 64; shift += bits) {
    const auto digit = [&](std::uint64_t key) { return (key >> shift) % digits; };
    if (digit(used) == 0) continue;
    std::array<std::size_t, digits> next{};
    for (const Keyed& p : points) ++next[digit(p.key)];
    std::exclusive_scan(next.begin(), next.end(), next.begin(), std::size_t{0});
    for (const Keyed& p : points) sorted[next[digit(p.key)]++] = p;
    points.swap(sorted);
  }
}

/// Largest whole number not above x. std::floor is a call on a machine without SSE 4.1.
std::int64_t whole(double x) {
  const auto cut = static_cast<std::int64_t>(x);
  return cut - (x < static_cast<double>(cut));
}

std::uint64_t cell_key(std::int64_t i, std::int64_t j, std::int64_t k) {
  return static_cast<std::uint64_t>(k) << 42 | static_cast<std::uint64_t>(j) << 21 | static_cast<std::uint64_t>(i);
}

}  // namespace

CellGrid::CellGrid(std::span<const Vector3> points, double cell_size) : origin_(lowest(points)), cell_size_(cell_size) {
  if (!(cell_size > 0)) throw std::invalid_argument("the edge of a cell must be positive");
  check_fits(points, origin_, cell_size);
  std::vector<Index> cell(points.size());
  for (std::size_t n = 0; n < points.size(); ++n) {
    cell[n] = cell_of(points[n]);
    last_ = {std::max(last_.i, cell[n].i), std::max(last_.j, cell[n].j), std::max(last_.k, cell[n].k)};
  }
  order_.resize(points.size());
  constexpr std::int64_t max_per_point = 4;
  const auto most = max_per_point * static_cast<std::int64_t>(points.size()) + 64;
  // None of the products is too large for its type.
  if ((last_.i + 1) * (last_.j + 1) <= most && (last_.i + 1) * (last_.j + 1) * (last_.k + 1) <= most)
    sort_into_box(cell);
  else
    sort_by_key(cell);
  cells_.push_back({~std::uint64_t{0}, points.size()});
}

void CellGrid::sort_into_box(std::span<const Index> cell) {
  const auto all = static_cast<std::size_t>((last_.i + 1) * (last_.j + 1) * (last_.k + 1));
  std::vector<std::uint32_t> next(all + 1, 0);  // index in the order of the next point of a cell of the box
  for (const Index& at : cell) ++next[place_in_box(at.i, at.j, at.k) + 1];
  first_cell_.resize(all + 1);
  std::size_t index = 0;
  for (std::int64_t k = 0; k <= last_.k; ++k)
    for (std::int64_t j = 0; j <= last_.j; ++j)
      for (std::int64_t i = 0; i <= last_.i; ++i, ++index) {
        first_cell_[index] = static_cast<std::uint32_t>(cells_.size());
        if (next[index + 1] != 0) cells_.push_back({cell_key(i, j, k), next[index]});
        next[index + 1] += next[index];
      }
  first_cell_[all] = static_cast<std::uint32_t>(cells_.size());
  for (std::uint32_t n = 0; n < cell.size(); ++n) order_[next[place_in_box(cell[n].i, cell[n].j, cell[n].k)]++] = n;
}

void CellGrid::sort_by_key(std::span<const Index> cell) {
  std::vector<Keyed> keyed(cell.size());
  for (std::uint32_t n = 0; n < cell.size(); ++n) keyed[n] = {cell_key(cell[n].i, cell[n].j, cell[n].k), n};
  sort(keyed);
  for (std::size_t n = 0; n < keyed.size(); ++n) {
    order_[n] = keyed[n].point;
    if (cells_.empty() || cells_.back().key != keyed[n].key) cells_.push_back({keyed[n].key, n});
  }
}

CellGrid::Index CellGrid::cell_of(const Vector3& x) const {
  const Vector3 d = x - origin_;
  return {whole(d.x / cell_size_), whole(d.y / cell_size_), whole(d.z / cell_size_)};
}

std::span<const CellGrid::Cell> CellGrid::cells_in_row(std::int64_t first, std::int64_t last, std::int64_t j,
                                                       std::int64_t k) const {
  if (first > last) return {};
  if (!first_cell_.empty())
    return std::span(cells_).subspan(
        first_cell_[place_in_box(first, j, k)],
        first_cell_[place_in_box(last, j, k) + 1] - first_cell_[place_in_box(first, j, k)]);
  const auto begin = std::lower_bound(cells_.begin(), cells_.end(), cell_key(first, j, k),
                                      [](const Cell& cell, std::uint64_t key) { return cell.key < key; });
  auto end = begin;  // the cell at the end of all stops it
  while (end->key <= cell_key(last, j, k)) ++end;
  return {begin, end};
}

std::span<const std::uint32_t> CellGrid::points_in_row(std::int64_t first, std::int64_t last, std::int64_t j,
                                                       std::int64_t k) const {
  const auto cells = cells_in_row(std::max(first, first_.i), std::min(last, last_.i), j, k);
  if (cells.empty()) return {};
  // Behind the last of them stands another cell, if only that at the end of all.
  return order().subspan(cells.front().begin, (&cells.back() + 1)->begin - cells.front().begin);
}

std::vector<std::uint64_t> spatial_keys(std::span<const Vector3> points, const Vector3& origin, double cell_size) {
  if (!(cell_size > 0)) throw std::invalid_argument("the edge of a cell must be positive");
  check_fits(points, origin, cell_size);
  std::vector<std::uint64_t> keys;
  keys.reserve(points.size());
  for (const Vector3& point : points) {
    const Vector3 d = point - origin;
    keys.push_back(every_third_bit(static_cast<std::uint64_t>(d.x / cell_size)) |
                   every_third_bit(static_cast<std::uint64_t>(d.y / cell_size)) << 1 |
                   every_third_bit(static_cast<std::uint64_t>(d.z / cell_size)) << 2);
  }
  return keys;
}

std::vector<std::uint32_t> spatial_order(std::span<const Vector3> points, double cell_size) {
  const std::vector<std::uint64_t> keys = spatial_keys(points, lowest(points), cell_size);
  std::vector<Keyed> keyed(points.size());
  for (std::uint32_t n = 0; n < points.size(); ++n) keyed[n] = {keys[n], n};
  sort(keyed);
  std::vector<std::uint32_t> order(keyed.size());
  std::transform(keyed.begin(), keyed.end(), order.begin(), [](const Keyed& k) { return k.point; });
  return order;
}

}  // namespace talus

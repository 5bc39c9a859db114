// SPDX-License-Identifier: Apache-2.0
#include "numerics/cell_grid.hpp"

#include <algorithm>
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

struct Keyed {
  std::uint64_t key;
  std::uint32_t point;
};

void sort(std::vector<Keyed>& points) {
  std::sort(points.begin(), points.end(),
            [](const Keyed& a, const Keyed& b) { return a.key != b.key ? a.key < b.key : a.point < b.point; });
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
  std::vector<Keyed> keyed(points.size());
  for (std::uint32_t n = 0; n < points.size(); ++n) {
    const Cell cell = cell_of(points[n]);
    last_ = {std::max(last_.i, cell.i), std::max(last_.j, cell.j), std::max(last_.k, cell.k)};
    keyed[n] = {cell_key(cell.i, cell.j, cell.k), n};
  }
  sort(keyed);
  order_.resize(keyed.size());
  keys_.resize(keyed.size());
  for (std::size_t n = 0; n < keyed.size(); ++n) {
    order_[n] = keyed[n].point;
    keys_[n] = keyed[n].key;
    const std::uint64_t row = keys_[n] & ~cell_key(most_cells * 2 - 1, 0, 0);
    if (rows_.empty() || rows_.back().key != row) rows_.push_back({row, n});
  }
  rows_.push_back({~std::uint64_t{0}, keyed.size()});
}

CellGrid::Cell CellGrid::cell_of(const Vector3& x) const {
  const Vector3 d = x - origin_;
  return {whole(d.x / cell_size_), whole(d.y / cell_size_), whole(d.z / cell_size_)};
}

CellGrid::Range CellGrid::points_in_row(std::int64_t first, std::int64_t last, std::int64_t j, std::int64_t k) const {
  first = std::max(first, first_.i);
  last = std::min(last, last_.i);
  if (first > last) return {0, 0};
  const std::uint64_t key = cell_key(0, j, k);
  const auto row =
      std::lower_bound(rows_.begin(), rows_.end(), key, [](const Row& r, std::uint64_t v) { return r.key < v; });
  if (row->key != key) return {0, 0};
  const auto row_begin = keys_.begin() + static_cast<std::ptrdiff_t>(row->begin);
  const auto row_end = keys_.begin() + static_cast<std::ptrdiff_t>((row + 1)->begin);
  const auto begin = std::lower_bound(row_begin, row_end, cell_key(first, j, k));
  auto end = begin;  // a cell holds few points: walking beats searching
  while (end != row_end && *end <= cell_key(last, j, k)) ++end;
  return {static_cast<std::size_t>(begin - keys_.begin()), static_cast<std::size_t>(end - keys_.begin())};
}

std::vector<std::uint32_t> spatial_order(std::span<const Vector3> points, double cell_size) {
  if (!(cell_size > 0)) throw std::invalid_argument("the edge of a cell must be positive");
  const Vector3 origin = lowest(points);
  check_fits(points, origin, cell_size);
  std::vector<Keyed> keyed(points.size());
  for (std::uint32_t n = 0; n < points.size(); ++n) {
    const Vector3 d = points[n] - origin;
    keyed[n] = {every_third_bit(static_cast<std::uint64_t>(d.x / cell_size)) |
                    every_third_bit(static_cast<std::uint64_t>(d.y / cell_size)) << 1 |
                    every_third_bit(static_cast<std::uint64_t>(d.z / cell_size)) << 2,
                n};
  }
  sort(keyed);
  std::vector<std::uint32_t> order(keyed.size());
  std::transform(keyed.begin(), keyed.end(), order.begin(), [](const Keyed& k) { return k.point; });
  return order;
}

}  // namespace talus

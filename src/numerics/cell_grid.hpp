// SPDX-License-Identifier: Apache-2.0
/// Points sorted into the cells of a uniform grid. Only occupied cells are stored: memory and time are O(N log N),
/// independent of the extent.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "base/vector.hpp"

namespace talus {

class CellGrid {
 public:
  /// \param points positions, finite, in m; not kept
  /// \param cell_size edge of a cell, > 0, in m; at least the largest extent over 2^20
  /// \throws std::invalid_argument if a position is not finite or the grid is too fine for its extent
  CellGrid(std::span<const Vector3> points, double cell_size);

  /// Calls visit(j) for each point j in the cell of x and the 26 around it: all points within `cell_size` of x, and
  /// some beyond. The order is fixed by the points alone.
  template <class Visit>
  void for_each_candidate(const Vector3& x, Visit&& visit) const {
    const Index centre = cell_of(x);
    for (std::int64_t k = std::max(centre.k - 1, first_.k); k <= std::min(centre.k + 1, last_.k); ++k)
      for (std::int64_t j = std::max(centre.j - 1, first_.j); j <= std::min(centre.j + 1, last_.j); ++j)
        for (const std::uint32_t point : points_in_row(centre.i - 1, centre.i + 1, j, k)) visit(point);
  }

  /// Calls visit(points) for rows of cells, each a part of order(), in its order: all points between two corners of a
  /// box are among them, and some beyond.
  template <class Visit>
  void for_each_row_between(const Vector3& low, const Vector3& high, Visit&& visit) const {
    const Index from = cell_of(low), to = cell_of(high);
    for (std::int64_t k = std::max(from.k, first_.k); k <= std::min(to.k, last_.k); ++k)
      for (std::int64_t j = std::max(from.j, first_.j); j <= std::min(to.j, last_.j); ++j)
        if (const auto points = points_in_row(from.i, to.i, j, k); !points.empty()) visit(points);
  }

  /// Calls visit(number of the cell, square of its least distance, m^2) for each cell that holds points and is at most
  /// `range` cells from one, itself among them. The order is fixed by the points alone.
  template <class Visit>
  void for_each_cell_near(std::size_t cell, std::int64_t range, Visit&& visit) const {
    constexpr std::uint64_t digits = 0x1fffff;
    const std::uint64_t key = cells_[cell].key;
    const Index centre{static_cast<std::int64_t>(key & digits), static_cast<std::int64_t>(key >> 21 & digits),
                       static_cast<std::int64_t>(key >> 42)};
    const auto gap = [&](std::int64_t a, std::int64_t b) {
      const double cells = static_cast<double>(std::max<std::int64_t>(std::abs(a - b) - 1, 0));
      return cells * cells * cell_size_ * cell_size_;
    };
    for (std::int64_t k = std::max(centre.k - range, first_.k); k <= std::min(centre.k + range, last_.k); ++k)
      for (std::int64_t j = std::max(centre.j - range, first_.j); j <= std::min(centre.j + range, last_.j); ++j) {
        const auto cells =
            cells_in_row(std::max(centre.i - range, first_.i), std::min(centre.i + range, last_.i), j, k);
        for (const Cell& near : cells)
          visit(static_cast<std::size_t>(&near - cells_.data()),
                gap(static_cast<std::int64_t>(near.key & digits), centre.i) + gap(j, centre.j) + gap(k, centre.k));
      }
  }

  /// The points in the order of their cells, x fastest; points of a cell by number.
  std::span<const std::uint32_t> order() const { return order_; }

  /// How many cells hold points, and the points of one of them, sorted.
  std::size_t cells() const { return cells_.size() - 1; }
  std::span<const std::uint32_t> points_of(std::size_t cell) const {
    return order().subspan(cells_[cell].begin, cells_[cell + 1].begin - cells_[cell].begin);
  }

 private:
  struct Index {
    std::int64_t i, j, k;
  };
  struct Cell {
    std::uint64_t key;
    std::size_t begin;  // its first point in the order
  };
  Index cell_of(const Vector3& x) const;
  /// Sorts the points: by the positions of their cells in the box of all cells; where that is too large, by their keys.
  void sort_into_box(std::span<const Index> cell);
  void sort_by_key(std::span<const Index> cell);
  std::size_t place_in_box(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return static_cast<std::size_t>((k * (last_.j + 1) + j) * (last_.i + 1) + i);
  }
  /// \pre the row is within those that hold points, as is its part unless first > last
  std::span<const Cell> cells_in_row(std::int64_t first, std::int64_t last, std::int64_t j, std::int64_t k) const;
  std::span<const std::uint32_t> points_in_row(std::int64_t first, std::int64_t last, std::int64_t j,
                                               std::int64_t k) const;

  Vector3 origin_;
  double cell_size_;
  Index first_{}, last_{};                 // that hold points
  std::vector<std::uint32_t> order_;       // the points by cell
  std::vector<Cell> cells_;                // that hold points, sorted; one more at the end
  std::vector<std::uint32_t> first_cell_;  // in cells_, from a position in the box on; one more; empty: sorted by key
};

/// For each point a number along a space-filling curve (Morton order of cells of edge `cell_size`).
/// \param origin not above any point, m \throws std::invalid_argument as CellGrid
std::vector<std::uint64_t> spatial_keys(std::span<const Vector3> points, const Vector3& origin, double cell_size);

/// A permutation that keeps points near in space near in memory (Morton order of cells of edge `cell_size`).
/// \throws std::invalid_argument as CellGrid
std::vector<std::uint32_t> spatial_order(std::span<const Vector3> points, double cell_size);

}  // namespace talus

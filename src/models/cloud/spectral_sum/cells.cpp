// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/spectral_sum/cells.hpp"

#include <algorithm>
#include <cmath>

namespace talus::cloud {

namespace {

constexpr std::size_t chunk_of_spheres = 1 << 14;
constexpr std::size_t max_chunks = 16;

}  // namespace

Extent extent_of(ThreadTeam& team, std::span<const Vector3> position, const Axes& axis, std::size_t dimensions) {
  Extent initial;
  for (std::size_t k = dimensions; k < 3; ++k) initial.least[k] = initial.most[k] = 0;
  return accumulate(
      team, position.size(), initial,
      [&](std::size_t i, Extent& extent) {
        for (std::size_t k = 0; k < dimensions; ++k) {
          const double x = position[i].*axis[k];
          extent.least[k] = std::min(extent.least[k], x), extent.most[k] = std::max(extent.most[k], x);
          extent.finite = extent.finite && std::isfinite(x);
        }
      },
      [](Extent a, const Extent& b) {
        for (std::size_t k = 0; k < 3; ++k) {
          a.least[k] = std::min(a.least[k], b.least[k]), a.most[k] = std::max(a.most[k], b.most[k]);
        }
        a.finite = a.finite && b.finite;
        return a;
      });
}

Lattice lattice_over(const Extent& extent, const Axes& axis, std::size_t dimensions, double cell) {
  std::array<std::size_t, 3> from = {0, 1, 2};
  std::stable_sort(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(dimensions),
                   [&](std::size_t k, std::size_t l) {
                     return extent.most[k] - extent.least[k] < extent.most[l] - extent.least[l];
                   });
  Lattice lattice{.per_length = 1 / cell};
  for (std::size_t k = 0; k < 3; ++k) {
    lattice.axis[k] = axis[from[k]];
    if (k >= dimensions) continue;
    lattice.origin[k] = std::floor(extent.least[from[k]] * lattice.per_length);
    const double count = std::floor(extent.most[from[k]] * lattice.per_length - lattice.origin[k]) + 1;
    lattice.count[k] = static_cast<std::size_t>(std::min(count, 1e12));
  }
  return lattice;
}

void Cells::sort(ThreadTeam& team, const Lattice& lattice, std::span<const Vector3> position,
                 std::span<const std::uint32_t> order) {
  lattice_ = lattice;
  const std::size_t count = order.size(), rows = lattice.all_rows(), columns = lattice.columns();
  const std::size_t chunks = std::clamp<std::size_t>(count / chunk_of_spheres, 1, max_chunks);
  const auto begin_of = [&](std::size_t chunk) { return count * chunk / chunks; };
  const auto cell_along = [&](std::size_t k, std::uint32_t i) {
    return static_cast<std::uint32_t>(lattice.cells_along(k, position[i]));
  };
  const auto row_of = [&](std::uint32_t i) {
    const std::uint32_t row = cell_along(1, i);
    return lattice.layers() == 1 ? row : cell_along(2, i) * static_cast<std::uint32_t>(lattice.rows()) + row;
  };
  row_.resize(count), by_row_.resize(count), sphere_.resize(count);
  counts_.assign(chunks * rows, 0);
  first_.resize(rows * (columns + 1));

  // By rows: the chunks count, then position, each its own.
  team.run(chunks, [&](std::size_t chunk) {
    for (std::size_t n = begin_of(chunk); n < begin_of(chunk + 1); ++n) {
      row_[n] = row_of(order[n]);
      ++counts_[chunk * rows + row_[n]];
    }
  });
  std::uint32_t place = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    first_[row * (columns + 1)] = place;
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
      const std::uint32_t here = counts_[chunk * rows + row];
      counts_[chunk * rows + row] = place;
      place += here;
    }
    first_[row * (columns + 1) + columns] = place;
  }
  team.run(chunks, [&](std::size_t chunk) {
    for (std::size_t n = begin_of(chunk); n < begin_of(chunk + 1); ++n)
      by_row_[counts_[chunk * rows + row_[n]]++] = order[n];
  });
  // By cells of a row. `row_` is reused for the column of each position.
  team.run(rows, [&](std::size_t row) {
    std::uint32_t* const first = first_.data() + row * (columns + 1);
    const std::uint32_t begin = first[0], end = first[columns];
    std::fill(first, first + columns, 0u);
    for (std::uint32_t n = begin; n < end; ++n) ++first[row_[n] = cell_along(0, by_row_[n])];
    std::uint32_t next = begin;
    for (std::size_t column = 0; column < columns; ++column) {
      const std::uint32_t here = first[column];
      first[column] = next;
      next += here;
    }
    for (std::uint32_t n = begin; n < end; ++n) sphere_[first[row_[n]]++] = by_row_[n];
    for (std::size_t column = columns; column-- > 1;) first[column] = first[column - 1];
    first[0] = begin;
  });
}

}  // namespace talus::cloud

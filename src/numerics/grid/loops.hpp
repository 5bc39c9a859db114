// SPDX-License-Identifier: Apache-2.0
/// Parallel loops over the rows of a grid along x, over its cells, and over its faces. A body that writes only to its
/// own index is bitwise identical for any number of threads.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "base/parallel.hpp"
#include "numerics/grid/face_apertures.hpp"
#include "ranks/slabs.hpp"

namespace talus {

/// Rows of cells of a grid, (j, k) in the order j + count[1] k. A row of faces goes with the cells above it; at the
/// high end of y with those within, at that of z with the last row.
using Slices = std::span<const RowRange>;

/// Calls body(what make() returns, j, k, begin, end) with the indices of each row of slices of a block of so many
/// positions from the first cell on; what is made serves one row after another, along y, then z.
/// \param count of cells, or of the faces of an axis
template <class Make, class Body>
void for_each_row(ThreadTeam& team, const Grid& grid, const std::array<int, 3>& count, Slices slices, Make&& make,
                  Body&& body) {
  constexpr std::size_t rows_at_once = 16;
  const auto rows_of_plane = static_cast<std::size_t>(count[1]),
             cells_of_plane = static_cast<std::size_t>(grid.count[1]);
  const auto border = [&](std::size_t row) {
    return row == cells_of_plane * static_cast<std::size_t>(grid.count[2])
               ? rows_of_plane * static_cast<std::size_t>(count[2])
               : row % cells_of_plane + rows_of_plane * (row / cells_of_plane);
  };
  for (const RowRange& slice : slices) {
    const RowRange rows{border(slice.begin), border(slice.end)};
    for_each_block(team, std::span(&rows, 1), rows_at_once, [&](std::size_t, std::size_t first, std::size_t last) {
      auto made = make();
      for (std::size_t row = first; row < last; ++row) {
        const int j = static_cast<int>(row) % count[1], k = static_cast<int>(row) / count[1];
        const auto begin = static_cast<std::ptrdiff_t>(grid.index(0, j, k));
        body(made, j, k, begin, begin + count[0]);
      }
    });
  }
}

/// Calls body(j, k, begin, end).
template <class Body>
void for_each_row(ThreadTeam& team, const Grid& grid, const std::array<int, 3>& count, Slices slices, Body&& body) {
  const auto nothing = [] { return 0; };
  for_each_row(team, grid, count, slices, nothing,
               [&](int, int j, int k, std::ptrdiff_t begin, std::ptrdiff_t end) { body(j, k, begin, end); });
}

/// Calls body(i, j, k, index) for the cells.
template <class Body>
void for_each_cell(ThreadTeam& team, const Grid& grid, Slices slices, Body&& body) {
  for_each_row(team, grid, grid.count, slices, [&](int j, int k, std::ptrdiff_t begin, std::ptrdiff_t end) {
    for (auto c = begin; c < end; ++c) body(static_cast<int>(c - begin), j, k, c);
  });
}

/// Largest value(index) over the cells of a slab, at least 0.
template <class Value>
double max_of_cells(ThreadTeam& team, const Grid& grid, const RowRange& slab, Value&& value) {
  const int ny = grid.count[1];
  return reduce(
      team, slab.size(), 0.0,
      [&](std::size_t n) {
        const int row = static_cast<int>(slab.begin + n);
        const auto begin = static_cast<std::ptrdiff_t>(grid.index(0, row % ny, row / ny));
        double most = 0;
        for (auto c = begin; c < begin + grid.count[0]; ++c) most = std::max(most, value(c));
        return most;
      },
      [](double a, double b) { return std::max(a, b); });
}

/// Faces of an axis, one after another along x, that have their neighbours in the same positions.
struct FaceRun {
  std::ptrdiff_t begin, end;
  int index;              ///< of the first along the axis
  std::ptrdiff_t before;  ///< from a face to the cell below it; at the low end of the box to the one within
  std::ptrdiff_t here;    ///< to the cell above it; at the high end to the one within
  bool is_end;            ///< the faces lie in an end of the box, which is not periodic
};

/// Calls body(run) for the faces of an axis in the row (j, k).
template <class Body>
void for_each_run_of_row(const FaceApertures& apertures, int axis, int j, int k, std::ptrdiff_t begin,
                         std::ptrdiff_t end, Body&& body) {
  const int n = apertures.grid.count[static_cast<std::size_t>(axis)];
  const std::ptrdiff_t stride = apertures.grid.stride(axis);
  const bool ring = apertures.boundaries.is_periodic(axis);
  const auto run = [&](std::ptrdiff_t from, std::ptrdiff_t to, int index) {
    const std::ptrdiff_t before = index > 0 ? -stride : ring ? stride * (n - 1) : 0;
    body(FaceRun{from, to, index, before, index < n ? 0 : before, apertures.is_end(axis, index)});
  };
  if (axis > 0) return run(begin, end, axis == 1 ? j : k);
  run(begin, begin + 1, 0);
  run(begin + 1, begin + n, 1);
  run(begin + n, end, n);
}

/// Calls body(run) for the faces of an axis.
template <class Body>
void for_each_run(ThreadTeam& team, const FaceApertures& apertures, int axis, Slices slices, Body&& body) {
  for_each_row(team, apertures.grid, apertures.faces(axis), slices,
               [&](int j, int k, std::ptrdiff_t begin, std::ptrdiff_t end) {
                 for_each_run_of_row(apertures, axis, j, k, begin, end, body);
               });
}

/// Calls body(index) for the faces of an axis.
template <class Body>
void for_each_face(ThreadTeam& team, const FaceApertures& apertures, int axis, Slices slices, Body&& body) {
  for_each_row(team, apertures.grid, apertures.faces(axis), slices,
               [&](int, int, std::ptrdiff_t begin, std::ptrdiff_t end) {
                 for (auto f = begin; f < end; ++f) body(f);
               });
}

}  // namespace talus

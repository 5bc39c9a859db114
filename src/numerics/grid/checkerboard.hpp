// SPDX-License-Identifier: Apache-2.0
/// The order in which the pressure solver keeps the cells of a grid: red cells and black cells in separate arrays, row
/// by row along x, so that a sweep over one colour accesses contiguous memory. A cell is red if i + j + k is even. In
/// row r = (j, k) the cells of a colour are i = 2 m + first, m = 0, 1, ...; its neighbours along x are m + first - 1
/// and m + first of the other colour in the same row, those along y and z are m of the other colour in the neighbouring
/// rows.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "ranks/halo.hpp"
#include "ranks/slabs.hpp"

namespace talus {

class Checkerboard {
 public:
  Checkerboard(std::array<int, 3> count, std::array<bool, 3> periodic);

  const std::array<int, 3>& count() const { return count_; }
  bool is_periodic(int axis) const { return periodic_[static_cast<std::size_t>(axis)]; }
  std::size_t rows() const { return rows_; }
  /// Length of an array; its tail is a row of zeros that represents all cells outside the grid.
  std::size_t size() const { return 2 * (rows_ + 1) * stride_; }

  /// First cell of the colour in row r; one pad cell before and at least one after the run.
  std::size_t run(int colour, std::size_t r) const {
    return (static_cast<std::size_t>(colour) * (rows_ + 1) + r) * stride_ + 1;
  }
  int first(int colour, std::size_t r) const { return (parity_[r] + colour) & 1; }
  int length(int colour, std::size_t r) const { return (count_[0] - first(colour, r) + 1) / 2; }

  /// The rows below and above in y, then in z; outside the grid: the row of zeros.
  const std::array<std::uint32_t, 4>& around(std::size_t r) const { return around_[r]; }

  std::size_t row(int j, int k) const {
    return static_cast<std::size_t>(j) + static_cast<std::size_t>(count_[1]) * static_cast<std::size_t>(k);
  }
  std::size_t at(int i, int j, int k) const {
    const int colour = (i + j + k) & 1;
    return run(colour, row(j, k)) + static_cast<std::size_t>(i / 2);
  }

  /// The row of a place in an array; rows() outside the grid.
  std::size_t row_at(std::size_t index) const { return index / stride_ % (rows_ + 1); }

  /// Calls body(block, first row, end row) for the rows of slabs in blocks of fixed size.
  template <class Body>
  void for_each_block(ThreadTeam& team, std::span<const RowRange> slabs, Body&& body) const {
    talus::for_each_block(team, slabs, block_, body);
  }
  std::size_t blocks() const { return (rows_ + block_ - 1) / block_; }

  // Several processes.

  /// How far the neighbours of a row are at most, in rows.
  std::size_t reach() const { return static_cast<std::size_t>(count_[1]); }
  /// Whole blocks for each process, the last plane of rows not parted.
  Slabs dealt(const Ranks& ranks) const;
  /// Slabs of this board, whose cells join those of a finer one, near the slabs of that. \param factor cells joined
  /// along z
  Slabs dealt_as(const Ranks& ranks, const Checkerboard& fine, const Slabs& of_fine, int factor) const;
  /// A column in the order of the board as columns of rows, for a halo.
  template <class Number>
  std::array<Halo::Column, 2> columns(std::vector<Number>& column) const {
    const std::size_t words = stride_ * sizeof(Number) / 8;  // a row of a colour is a whole number of 16 bytes
    auto* const data = reinterpret_cast<std::byte*>(column.data());
    return {Halo::Column{data, words}, Halo::Column{data + (rows_ + 1) * stride_ * sizeof(Number), words}};
  }

  /// Fills the ghosts at both ends of a run if x is periodic.
  template <class Number>
  void fill_ghosts(Number* run, int length) const {
    if (!periodic_[0]) return;
    run[-1] = run[length - 1];
    run[length] = run[0];
  }

 private:
  std::array<int, 3> count_;
  std::array<bool, 3> periodic_;
  std::size_t rows_, stride_, block_;
  std::vector<std::uint8_t> parity_;
  std::vector<std::array<std::uint32_t, 4>> around_;
};

inline Checkerboard::Checkerboard(std::array<int, 3> count, std::array<bool, 3> periodic)
    : count_(count), periodic_(periodic) {
  const auto nx = static_cast<std::size_t>(count[0]);
  rows_ = static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(count[2]);
  stride_ = ((nx + 1) / 2 + 2 + 3) / 4 * 4;
  // Blocks of some 2000 cells: enough work to hand out, and enough blocks for several threads.
  block_ = std::max<std::size_t>(1, 2048 / nx);
  parity_.resize(rows_);
  around_.resize(rows_);
  const auto outside = static_cast<std::uint32_t>(rows_);
  const auto neighbour = [&](int axis, int j, int k, int step) {
    const int n = count_[static_cast<std::size_t>(axis)];
    int& moved = axis == 1 ? j : k;
    moved += step;
    if (moved < 0 || moved >= n) {
      if (!is_periodic(axis)) return outside;
      moved = (moved + n) % n;
    }
    return static_cast<std::uint32_t>(row(j, k));
  };
  for (int k = 0; k < count[2]; ++k)
    for (int j = 0; j < count[1]; ++j) {
      parity_[row(j, k)] = static_cast<std::uint8_t>((j + k) & 1);
      around_[row(j, k)] = {neighbour(1, j, k, -1), neighbour(1, j, k, 1), neighbour(2, j, k, -1),
                            neighbour(2, j, k, 1)};
    }
}

inline Slabs Checkerboard::dealt(const Ranks& ranks) const {
  const auto size = static_cast<std::size_t>(ranks.size());
  std::vector<std::size_t> border;
  for (std::size_t r = 0; r <= size; ++r) {
    const std::size_t row = block_ * (blocks() * r / size);
    border.push_back(r == size || row + reach() > rows_ ? rows_ : row);
  }
  return {ranks, std::move(border), is_periodic(2)};
}

inline Slabs Checkerboard::dealt_as(const Ranks& ranks, const Checkerboard& fine, const Slabs& of_fine,
                                    int factor) const {
  const std::size_t planes = fine.reach() * static_cast<std::size_t>(factor);  // of the fine board, in rows
  std::vector<std::size_t> border;
  for (const std::size_t row : of_fine.border())
    border.push_back(std::min(rows_, reach() * ((row + planes / 2) / planes)));
  border.back() = rows_;
  return {ranks, std::move(border), is_periodic(2)};
}

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
#include "numerics/grid/aggregates.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace talus {

namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// Cells of a board by number, x fastest.
class Numbered {
 public:
  explicit Numbered(const Checkerboard& board) : board_(board) {
    const auto [nx, ny, nz] = board.count();
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) place_.push_back(static_cast<std::uint32_t>(board.at(i, j, k)));
  }

  std::uint32_t cells() const { return static_cast<std::uint32_t>(place_.size()); }
  std::uint32_t index(std::uint32_t c) const { return place_[c]; }
  std::array<std::uint32_t, 3> at(std::uint32_t c) const {
    const auto nx = static_cast<std::uint32_t>(board_.count()[0]), ny = static_cast<std::uint32_t>(board_.count()[1]);
    return {c % nx, c / nx % ny, c / (nx * ny)};
  }
  std::uint32_t number(const std::array<std::uint32_t, 3>& at) const {
    const auto nx = static_cast<std::uint32_t>(board_.count()[0]), ny = static_cast<std::uint32_t>(board_.count()[1]);
    return at[0] + nx * (at[1] + ny * at[2]);
  }
  /// The next cell along an axis; none: outside. \param step -1 or 1
  std::uint32_t next(std::uint32_t c, int axis, int step) const {
    const auto a = static_cast<std::size_t>(axis);
    const auto n = static_cast<std::uint32_t>(board_.count()[a]);
    std::array<std::uint32_t, 3> index = at(c);
    const bool leaves = step < 0 ? index[a] == 0 : index[a] + 1 == n;
    if (leaves && !board_.is_periodic(axis)) return none;
    index[a] = (step < 0 ? index[a] + n - 1 : index[a] + 1) % n;
    return number(index);
  }
  const Checkerboard& board() const { return board_; }

 private:
  const Checkerboard& board_;
  std::vector<std::uint32_t> place_;
};

/// Finds the parent, the coarse cell that it is joined to, of every cell.
class Parents {
 public:
  Parents(const Numbered& fine, const std::array<const float*, 3>& low, const Numbered& coarse,
          const std::array<int, 3>& factor)
      : fine_(fine), low_(low) {
    for (std::uint32_t c = 0; c < fine.cells(); ++c) {
      std::array<std::uint32_t, 3> at = fine.at(c);
      for (std::size_t a = 0; a < 3; ++a) at[a] /= static_cast<std::uint32_t>(factor[a]);
      neighbour_.push_back(coarse.number(at));
    }
    find_parts();
    keep_largest(coarse.cells());
    while (move_parts()) {
    }
  }

  /// Of the cells that are joined in pairs.
  std::uint32_t neighbour(std::uint32_t c) const { return neighbour_[c]; }
  /// none: it is joined to no coarse cell.
  std::uint32_t of(std::uint32_t c) const { return part_[c] == none ? neighbour_[c] : parent_[part_[c]]; }
  bool is_moved(std::uint32_t c) const { return of(c) != neighbour_[c]; }
  bool is_open(std::uint32_t c, int axis, int step, std::uint32_t next) const {
    return low_[static_cast<std::size_t>(axis)][fine_.index(step < 0 ? c : next)] > 0;
  }

 private:
  template <class Body>
  void for_each_open(std::uint32_t c, Body&& body) const {
    for (int axis = 0; axis < 3; ++axis)
      for (const int step : {-1, 1}) {
        const std::uint32_t n = fine_.next(c, axis, step);
        if (n != none && is_open(c, axis, step, n)) body(n);
      }
  }

  /// Connected cells within the pairs; a cell without open faces is in no part.
  void find_parts() {
    part_.assign(fine_.cells(), none);
    std::vector<std::uint32_t> front;
    for (std::uint32_t first = 0; first < fine_.cells(); ++first) {
      if (part_[first] != none) continue;
      bool has_faces = false;
      for_each_open(first, [&](std::uint32_t) { has_faces = true; });
      if (!has_faces) continue;
      const auto part = static_cast<std::uint32_t>(cells_.size());
      cells_.emplace_back();
      part_[first] = part;
      front.assign(1, first);
      while (!front.empty()) {
        const std::uint32_t c = front.back();
        front.pop_back();
        cells_[part].push_back(c);
        for_each_open(c, [&](std::uint32_t n) {
          if (neighbour_[n] == neighbour_[c] && part_[n] == none) part_[n] = part, front.push_back(n);
        });
      }
    }
  }

  void keep_largest(std::uint32_t coarse_cells) {
    std::vector<std::uint32_t> largest(coarse_cells, none);
    for (std::uint32_t p = 0; p < cells_.size(); ++p) {
      std::uint32_t& most = largest[neighbour_[cells_[p].front()]];
      if (most == none || cells_[p].size() > cells_[most].size()) most = p;
    }
    parent_.assign(cells_.size(), none);
    for (std::uint32_t p = 0; p < cells_.size(); ++p)
      if (const std::uint32_t own = neighbour_[cells_[p].front()]; largest[own] == p)
        parent_[p] = own;
      else
        without_.push_back(p);
  }

  /// Each part without a parent goes where most of its open faces lead. \returns whether one has found its parent
  bool move_parts() {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
    std::vector<std::uint32_t> left;
    for (const std::uint32_t p : without_) {
      std::map<std::uint32_t, int> faces;
      for (const std::uint32_t c : cells_[p])
        for_each_open(c, [&](std::uint32_t n) {
          if (const std::uint32_t to = parent_[part_[n]]; to != none) ++faces[to];
        });
      if (faces.empty()) {
        left.push_back(p);
        continue;
      }
      const auto most = std::max_element(faces.begin(), faces.end(),
                                         [](const auto& a, const auto& b) { return a.second < b.second; });
      found.emplace_back(p, most->first);
    }
    for (const auto& [p, to] : found) parent_[p] = to;
    without_ = left;
    return !found.empty();
  }

  const Numbered& fine_;
  const std::array<const float*, 3>& low_;
  std::vector<std::uint32_t> neighbour_, part_;
  std::vector<std::vector<std::uint32_t>> cells_;  // of every part
  std::vector<std::uint32_t> parent_;              // of every part
  std::vector<std::uint32_t> without_;             // parts that have none yet
};

/// Puts parts, each with the number of its coarse cell, into lists.
template <class Part>
Aggregates::Lists<Part> list(const Numbered& coarse, std::vector<std::pair<std::uint32_t, Part>> parts,
                             const std::vector<bool>& listed) {
  std::stable_sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  Aggregates::Lists<Part> lists;
  const auto nx = static_cast<std::uint32_t>(coarse.board().count()[0]);
  std::size_t next = 0;
  for (std::uint32_t c = 0; c < coarse.cells(); ++c) {
    if (c % nx == 0) lists.of_row.push_back(static_cast<std::uint32_t>(lists.index.size()));
    if (!listed[c]) continue;
    lists.index.push_back(coarse.index(c));
    lists.at.push_back(coarse.at(c));
    lists.begin.push_back(static_cast<std::uint32_t>(next));
    for (; next < parts.size() && parts[next].first == c; ++next) lists.parts.push_back(parts[next].second);
  }
  lists.of_row.push_back(static_cast<std::uint32_t>(lists.index.size()));
  lists.begin.push_back(static_cast<std::uint32_t>(next));
  return lists;
}

/// The coarse cell whose low face along one of the axes leads from one of two coarse cells to the other; the axis is 3
/// where they are no neighbours.
std::pair<std::size_t, std::uint32_t> face_between(const Numbered& coarse, std::uint32_t a, std::uint32_t b) {
  if (a != none && b != none && a != b)
    for (int axis = 0; axis < 3; ++axis) {
      if (coarse.next(b, axis, -1) == a) return {static_cast<std::size_t>(axis), b};
      if (coarse.next(a, axis, -1) == b) return {static_cast<std::size_t>(axis), a};
    }
  return {3, none};
}

}  // namespace

Aggregates find_aggregates(const Checkerboard& fine_board, const std::array<const float*, 3>& low,
                           const Checkerboard& coarse_board, const std::array<int, 3>& factor) {
  const Numbered fine(fine_board), coarse(coarse_board);
  const Parents parents(fine, low, coarse, factor);
  std::vector<bool> cells_listed(coarse.cells(), false);
  std::array<std::vector<bool>, 3> faces_listed{cells_listed, cells_listed, cells_listed};
  bool is_any_moved = false;
  const auto for_each_face = [&](auto&& body) {  // body(axis, cell below, cell above) for open faces
    for (std::uint32_t c = 0; c < fine.cells(); ++c)
      for (int axis = 0; axis < 3; ++axis)
        if (const std::uint32_t n = fine.next(c, axis, -1); n != none && parents.is_open(c, axis, -1, n))
          body(axis, n, c);
  };
  for (std::uint32_t c = 0; c < fine.cells(); ++c) {
    if (!parents.is_moved(c)) continue;
    is_any_moved = true;
    cells_listed[parents.neighbour(c)] = true;
    if (parents.of(c) != none) cells_listed[parents.of(c)] = true;
  }
  if (!is_any_moved) return {};
  for_each_face([&](int, std::uint32_t a, std::uint32_t b) {
    if (!parents.is_moved(a) && !parents.is_moved(b)) return;
    for (const auto& [axis, cell] : {face_between(coarse, parents.neighbour(a), parents.neighbour(b)),
                                     face_between(coarse, parents.of(a), parents.of(b))})
      if (axis < 3) faces_listed[axis][cell] = true;
  });

  std::vector<std::pair<std::uint32_t, Aggregates::Cell>> cells;
  std::array<std::vector<std::pair<std::uint32_t, Aggregates::Face>>, 3> faces;
  Aggregates found;
  const auto outside = static_cast<std::uint32_t>(coarse_board.run(0, coarse_board.rows()));
  for (std::uint32_t c = 0; c < fine.cells(); ++c) {
    const auto [i, j, k] = fine.at(c);
    const int colour = static_cast<int>((i + j + k) & 1);
    if (i == 0) found.moved_of_row.push_back(static_cast<std::uint32_t>(found.moved.size()));
    const std::uint32_t parent = parents.of(c);
    if (parent != none && cells_listed[parent])
      cells.push_back({parent,
                       {static_cast<std::uint32_t>(fine_board.row(static_cast<int>(j), static_cast<int>(k))),
                        static_cast<std::uint16_t>(colour), static_cast<std::uint16_t>(i / 2)}});
    if (colour == 0 && parents.is_moved(c))
      found.moved.push_back(
          {fine.index(c), parent == none ? outside : coarse.index(parent), coarse.index(parents.neighbour(c))});
  }
  found.moved_of_row.push_back(static_cast<std::uint32_t>(found.moved.size()));
  for_each_face([&](int axis, std::uint32_t a, std::uint32_t b) {
    if (const auto [across, cell] = face_between(coarse, parents.of(a), parents.of(b));
        across < 3 && faces_listed[across][cell])
      faces[across].push_back({cell, {static_cast<std::uint32_t>(axis), fine.index(b)}});
  });
  found.cells = list(coarse, std::move(cells), cells_listed);
  for (std::size_t a = 0; a < 3; ++a) found.faces[a] = list(coarse, std::move(faces[a]), faces_listed[a]);
  return found;
}

}  // namespace talus

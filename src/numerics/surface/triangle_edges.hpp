// SPDX-License-Identifier: Apache-2.0
/// The corners of triangles as numbers, and which triangles have an edge in common.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "numerics/surface/triangle.hpp"

namespace talus {

class TriangleEdges {
 public:
  struct Edge {
    std::uint32_t from, to;  ///< numbers of its corners, the lower first
    std::uint32_t triangle;
    std::uint8_t side;  ///< of the triangle: from its corner of that number to the next
    bool reversed;      ///< which runs through it from `to` to `from`
  };

  /// Corners are one where their coordinates are the same numbers. The time grows with the number of triangles.
  /// \param left_out triangles whose corners and edges do not count; empty: none. The others are finite
  explicit TriangleEdges(std::span<const Triangle> triangles, const std::vector<bool>& left_out = {});

  /// The numbers of the corners of each triangle, from 0 as they come; of one that is left out without meaning.
  std::span<const std::array<std::uint32_t, 3>> corners() const { return corners_; }
  /// The places of the corners by their numbers.
  std::span<const Vector3> places() const { return places_; }

  /// Calls visit(edges) for the edges between the same two corners, by rising number of triangle.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (std::size_t begin = 0, end = 0; begin < edges_.size(); begin = end) {
      while (end < edges_.size() && edges_[end].from == edges_[begin].from && edges_[end].to == edges_[begin].to) ++end;
      visit(std::span(edges_).subspan(begin, end - begin));
    }
  }

 private:
  std::vector<std::array<std::uint32_t, 3>> corners_;
  std::vector<Vector3> places_;
  std::vector<Edge> edges_;
};

}  // namespace talus

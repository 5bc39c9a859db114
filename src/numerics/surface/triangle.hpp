// SPDX-License-Identifier: Apache-2.0
/// Triangles of a surface, their edges, and its rims: closed lines of edges that belong to one triangle alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/vector.hpp"

namespace talus {

struct Triangle {
  std::array<Vector3, 3> corner;  ///< m; the normal is to the side from which they appear counterclockwise
  std::uint32_t patch = 0;        ///< number of the part of the surface that it belongs to

  Vector3 area() const;    ///< area times unit normal, m^2
  Vector3 normal() const;  ///< unit; not finite for a triangle without area
  bool operator==(const Triangle&) const = default;
  Vector3 middle() const { return (1.0 / 3) * (corner[0] + corner[1] + corner[2]); }
};

/// The position of a triangle nearest to x. Source: Ericson, Real-Time Collision Detection (Morgan Kaufmann,
/// 2005), 5.1.5.
Vector3 nearest_place(const Triangle& triangle, const Vector3& x);

/// The fraction of the straight line from a to b at which it crosses the triangle; nothing if it does not. Edges and
/// corners belong to the triangle, neighbours overlap by rounding, and two triangles with a common edge judge it by the
/// same numbers: no line slips through between them. A plane belongs to the side of its normal.
std::optional<double> crossing(const Triangle& triangle, const Vector3& a, const Vector3& b);

/// What of a convex polygon lies above (side 1) or below (-1) a bound along an axis. Polygons with a common edge get
/// the same corner on it.
std::vector<Vector3> clipped(const std::vector<Vector3>& polygon, int axis, double bound, int side);

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
  /// The positions of the corners by their numbers.
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

/// A closed line along edges.
struct Rim {
  std::vector<Vector3> corners;          ///< in its order; the last one is joined to the first
  std::vector<std::uint32_t> triangles;  ///< that have the edge from each corner to the next
};

/// All closed ones, by the first of their triangles. Corners are one where they are the same numbers.
/// \param triangles finite, each with an area
std::vector<Rim> rims_of(std::span<const Triangle> triangles);

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/triangle.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>
#include <utility>

namespace talus {

namespace {

bool comes_before(const Vector3& a, const Vector3& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// Six times the volume of the tetrahedron of a line and an edge; exactly the opposite for the edge's other direction.
double volume(const Vector3& a, const Vector3& direction, const Vector3& p, const Vector3& q) {
  const auto ordered = [&](const Vector3& first, const Vector3& second) {
    return dot(direction, cross(first - a, second - a));
  };
  return comes_before(p, q) ? ordered(p, q) : -ordered(q, p);
}

}  // namespace

Vector3 Triangle::area() const {
  return 0.5 * cross(corner[1] - corner[0], corner[2] - corner[0]);
}

Vector3 Triangle::normal() const {
  const Vector3 n = area();
  return (1 / norm(n)) * n;
}

Vector3 nearest_place(const Triangle& triangle, const Vector3& x) {
  const auto& [a, b, c] = triangle.corner;
  const Vector3 ab = b - a, ac = c - a, ax = x - a;
  const double d1 = dot(ab, ax), d2 = dot(ac, ax);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vector3 bx = x - b;
  const double d3 = dot(ab, bx), d4 = dot(ac, bx);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + (d1 / (d1 - d3)) * ab;
  const Vector3 cx = x - c;
  const double d5 = dot(ab, cx), d6 = dot(ac, cx);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + (d2 / (d2 - d6)) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b);
  const double whole = 1 / (va + vb + vc);
  return a + (vb * whole) * ab + (vc * whole) * ac;
}

std::optional<double> crossing(const Triangle& triangle, const Vector3& a, const Vector3& b) {
  const auto& [p, q, r] = triangle.corner;
  const Vector3 n = cross(q - p, r - p);
  const double at_a = dot(n, a - p), at_b = dot(n, b - p);
  if ((at_a >= 0) == (at_b >= 0)) return std::nullopt;
  const Vector3 direction = b - a;
  const double u = volume(a, direction, p, q), v = volume(a, direction, q, r), w = volume(a, direction, r, p);
  // Beside a corner rounding may set each of its triangles apart from the line: they overlap by more than that.
  const double slack = 1e-13 * (std::abs(u) + std::abs(v) + std::abs(w));
  const bool within = (u >= -slack && v >= -slack && w >= -slack) || (u <= slack && v <= slack && w <= slack);
  if (!within) return std::nullopt;
  return at_a / (at_a - at_b);
}

namespace {

/// Numbers positions as they come: a table of twice as many rows as there may be positions, each looked for from the
/// row of its hash on. Not for positions that are no numbers, none of which is the same as another.
class Numbering {
 public:
  /// \param positions that have numbers, as they come
  Numbering(std::size_t most, std::vector<Vector3>& places)
      : row_(std::bit_ceil(2 * most + 1), nothing), places_(places) {}

  std::uint32_t of(const Vector3& x) {
    for (std::size_t row = bits_of(x) & (row_.size() - 1);; row = (row + 1) & (row_.size() - 1)) {
      if (row_[row] == nothing) {
        row_[row] = static_cast<std::uint32_t>(places_.size());
        places_.push_back(x);
        return row_[row];
      }
      if (places_[row_[row]] == x) return row_[row];
    }
  }

 private:
  static constexpr std::uint32_t nothing = 0xffffffff;

  static std::uint64_t bits_of(const Vector3& x) {
    std::uint64_t bits = 0;
    for (int axis = 0; axis < 3; ++axis) {
      bits = (bits ^ std::bit_cast<std::uint64_t>(x[axis] + 0.0)) * 0x9e3779b97f4a7c15;  // + 0.0: -0 is 0
      bits ^= bits >> 32;
    }
    return bits;
  }

  std::vector<std::uint32_t> row_;
  std::vector<Vector3>& places_;
};

}  // namespace

std::vector<Vector3> clipped(const std::vector<Vector3>& polygon, int axis, double bound, int side) {
  std::vector<Vector3> left;
  const auto at = [&](const Vector3& x) { return side * (x[axis] - bound); };
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const Vector3 &a = polygon[n], &b = polygon[(n + 1) % polygon.size()];
    if (at(a) >= 0) left.push_back(a);
    if (at(a) * at(b) >= 0) continue;
    const auto& [from, to] = at(a) > 0 ? std::pair(a, b) : std::pair(b, a);  // the same of both triangles of an edge
    Vector3 x = from + (at(from) / (at(from) - at(to))) * (to - from);
    x[axis] = bound;
    left.push_back(x);
  }
  return left;
}

TriangleEdges::TriangleEdges(std::span<const Triangle> triangles, const std::vector<bool>& left_out) {
  Numbering number(3 * triangles.size(), places_);
  const auto counts = [&](std::size_t t) { return left_out.empty() || !left_out[t]; };
  corners_.resize(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t c = 0; c < 3 && counts(t); ++c) corners_[t][c] = number.of(triangles[t].corner[c]);
  const auto for_each_edge = [&](auto&& visit) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
      for (std::size_t c = 0; c < 3 && counts(t); ++c) {
        const std::uint32_t a = corners_[t][c], b = corners_[t][(c + 1) % 3];
        visit(Edge{std::min(a, b), std::max(a, b), t, static_cast<std::uint8_t>(c), b < a});
      }
  };
  // By their first corner, and among the few of each by the second.
  std::vector<std::uint32_t> first(places_.size() + 1, 0);
  for_each_edge([&](const Edge& e) { ++first[e.from + 1]; });
  for (std::size_t n = 1; n < first.size(); ++n) first[n] += first[n - 1];
  edges_.resize(first.back());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for_each_edge([&](const Edge& e) { edges_[next[e.from]++] = e; });
  for (std::size_t n = 0; n + 1 < first.size(); ++n)
    std::sort(edges_.begin() + first[n], edges_.begin() + first[n + 1],
              [](const Edge& a, const Edge& b) { return std::tie(a.to, a.triangle) < std::tie(b.to, b.triangle); });
}

std::vector<Rim> rims_of(std::span<const Triangle> triangles) {
  const TriangleEdges edges(triangles);
  std::vector<TriangleEdges::Edge> border;
  edges.for_each([&](std::span<const TriangleEdges::Edge> same) {
    if (same.size() == 1) border.push_back(same.front());
  });
  std::sort(border.begin(), border.end(), [](const TriangleEdges::Edge& a, const TriangleEdges::Edge& b) {
    return std::tie(a.triangle, a.side) < std::tie(b.triangle, b.side);
  });
  std::vector<std::pair<std::uint32_t, std::size_t>> at;  // edges by corner
  for (std::size_t e = 0; e < border.size(); ++e) at.emplace_back(border[e].from, e), at.emplace_back(border[e].to, e);
  std::sort(at.begin(), at.end());
  std::vector<bool> used(border.size());
  const auto next_at = [&](std::uint32_t corner) {
    auto found = std::lower_bound(at.begin(), at.end(), std::pair(corner, std::size_t{0}));
    while (found != at.end() && found->first == corner && used[found->second]) ++found;
    return found != at.end() && found->first == corner ? found->second : border.size();
  };
  std::vector<Rim> rims;
  for (std::size_t first = 0; first < border.size(); ++first) {
    if (used[first]) continue;
    Rim rim;
    const std::uint32_t begin = border[first].from;
    std::uint32_t corner = begin;
    for (std::size_t e = first; e < border.size(); e = corner == begin ? border.size() : next_at(corner)) {
      used[e] = true;
      rim.corners.push_back(edges.places()[corner]);
      rim.triangles.push_back(border[e].triangle);
      corner = border[e].from == corner ? border[e].to : border[e].from;
    }
    if (corner == begin) rims.push_back(std::move(rim));
  }
  return rims;
}

}  // namespace talus

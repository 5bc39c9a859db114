// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/surface_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace talus {

namespace {

/// The longest edge from corner n to the next one.
std::size_t longest_edge(const Triangle& t) {
  std::size_t longest = 0;
  double most = -1;
  for (std::size_t n = 0; n < 3; ++n) {
    const Vector3 d = t.corner[(n + 1) % 3] - t.corner[n];
    if (dot(d, d) > most) most = dot(d, d), longest = n;
  }
  return longest;
}

double length(const Triangle& t, std::size_t edge) {
  return norm(t.corner[(edge + 1) % 3] - t.corner[edge]);
}

/// A triangle that is gathered with others of its cell.
struct Small {
  std::uint32_t part;
  std::array<std::int64_t, 3> cell;
  std::uint32_t triangle;
};

}  // namespace

std::vector<SurfacePoint> spread_points(const Surface& surface, double edge) {
  std::vector<SurfacePoint> points;
  std::vector<Small> small;
  std::vector<Triangle> pieces;
  for (std::uint32_t t = 0; t < surface.triangles().size(); ++t) {
    const Triangle& whole = surface.triangles()[t];
    if (length(whole, longest_edge(whole)) < 0.5 * edge) {
      const Vector3 x = (1 / edge) * (whole.middle() - surface.low());
      small.push_back({surface.part(t),
                       {static_cast<std::int64_t>(x.x), static_cast<std::int64_t>(x.y), static_cast<std::int64_t>(x.z)},
                       t});
      continue;
    }
    pieces.assign(1, whole);
    while (!pieces.empty()) {
      const Triangle piece = pieces.back();
      pieces.pop_back();
      const std::size_t n = longest_edge(piece);
      if (length(piece, n) <= edge) {
        points.push_back({piece.middle(), surface.normal(t), norm(piece.area()), whole.patch, surface.part(t)});
        continue;
      }
      const Vector3 &a = piece.corner[n], &b = piece.corner[(n + 1) % 3], &c = piece.corner[(n + 2) % 3];
      const Vector3 half = 0.5 * (a + b);
      pieces.push_back({{half, b, c}, whole.patch});
      pieces.push_back({{a, half, c}, whole.patch});
    }
  }
  const auto key = [](const Small& s) { return std::tie(s.part, s.cell, s.triangle); };
  std::sort(small.begin(), small.end(), [&](const Small& a, const Small& b) { return key(a) < key(b); });
  for (std::size_t begin = 0, end = 0; begin < small.size(); begin = end) {
    Vector3 place, area;
    double total = 0;
    for (; end < small.size() && small[end].part == small[begin].part && small[end].cell == small[begin].cell; ++end) {
      const Triangle& t = surface.triangles()[small[end].triangle];
      const Vector3 own = t.area();
      place += norm(own) * t.middle(), area += own, total += norm(own);
    }
    points.push_back({(1 / total) * place, (1 / norm(area)) * area, total,
                      surface.triangles()[small[begin].triangle].patch, small[begin].part});
  }
  return points;
}

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/surface_faults.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "numerics/surface/triangle_tree.hpp"

namespace talus {

namespace {

using Kind = SurfaceFault::Kind;

auto order(const Vector3& a) {
  return std::tie(a.x, a.y, a.z);
}

struct Edge {
  Vector3 from, to;  // in order
  std::uint32_t triangle;
  bool reversed;  // the triangle runs through it from `to` to `from`
};

std::vector<Edge> sorted_edges(std::span<const Triangle> triangles, const std::vector<bool>& skip) {
  std::vector<Edge> edges;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::size_t c = 0; c < 3 && !skip[t]; ++c) {
      const Vector3 &a = triangles[t].corner[c], &b = triangles[t].corner[(c + 1) % 3];
      edges.push_back(order(a) < order(b) ? Edge{a, b, t, false} : Edge{b, a, t, true});
    }
  const auto key = [](const Edge& e) { return std::tuple(order(e.from), order(e.to), e.triangle); };
  std::sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) { return key(a) < key(b); });
  return edges;
}

/// Calls visit(first, count) for the edges between the same two corners.
template <class Visit>
void for_each_edge(const std::vector<Edge>& edges, Visit&& visit) {
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end].from == edges[begin].from && edges[end].to == edges[begin].to) ++end;
    visit(begin, end - begin);
  }
}

bool is_finite(const Triangle& t) {
  return std::all_of(t.corner.begin(), t.corner.end(),
                     [](const Vector3& c) { return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z); });
}

/// Height over the longest edge, below rounding of single precision.
bool is_flat(const Triangle& t) {
  double longest = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const Vector3 d = t.corner[(c + 1) % 3] - t.corner[c];
    longest = std::max(longest, dot(d, d));
  }
  return !(2 * norm(t.area()) > 1e-7 * longest);
}

bool share_a_corner(const Triangle& a, const Triangle& b) {
  for (const Vector3& p : a.corner)
    for (const Vector3& q : b.corner)
      if (p == q) return true;
  return false;
}

/// Where an edge of one passes through the inside of the other, away from its ends: triangles that touch do not cross.
std::optional<Vector3> passage(const Triangle& a, const Triangle& b) {
  constexpr double inside = 1e-6;
  for (std::size_t c = 0; c < 3; ++c) {
    const Vector3 &p = a.corner[c], &q = a.corner[(c + 1) % 3];
    const auto at = crossing(b, p, q);
    if (!at || *at < inside || *at > 1 - inside) continue;
    const Vector3 x = p + *at * (q - p);
    const Vector3 whole = b.area();
    double least = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3 part = cross(b.corner[(k + 1) % 3] - b.corner[k], x - b.corner[k]);
      least = std::min(least, 0.5 * dot(part, whole) / dot(whole, whole));
    }
    if (least > inside) return x;
  }
  return std::nullopt;
}

}  // namespace

std::string_view text_of(Kind kind) {
  switch (kind) {
    case Kind::not_finite:
      return "a coordinate is not a number";
    case Kind::without_area:
      return "has no area";
    case Kind::twice:
      return "the same triangle twice";
    case Kind::turned_over:
      return "their normals are on different sides";
    case Kind::branching:
      return "more than two triangles meet at an edge";
    case Kind::open_rim:
      return "no triangle joins it at an edge: the surface is not closed there";
    case Kind::crossing_another:
      return "they pass through each other";
  }
  return "";
}

std::vector<SurfaceFault> faults_of(std::span<const Triangle> triangles, bool closed) {
  std::vector<SurfaceFault> faults;
  std::vector<bool> skip(triangles.size(), false);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const bool finite = is_finite(triangles[t]);
    if (finite && !is_flat(triangles[t])) continue;
    skip[t] = true;
    faults.push_back({finite ? Kind::without_area : Kind::not_finite, t, {}, triangles[t].middle()});
  }
  std::vector<SurfaceFault> turned, branching, rims;
  const std::vector<Edge> edges = sorted_edges(triangles, skip);
  for_each_edge(edges, [&](std::size_t first, std::size_t count) {
    const Edge &a = edges[first], &b = edges[std::min(first + 1, edges.size() - 1)];
    const Vector3 middle = 0.5 * (a.from + a.to);
    if (count == 1 && closed) rims.push_back({Kind::open_rim, a.triangle, {}, middle});
    if (count > 2) branching.push_back({Kind::branching, a.triangle, edges[first + 2].triangle, middle});
    if (count == 2 && a.reversed == b.reversed) turned.push_back({Kind::turned_over, a.triangle, b.triangle, middle});
  });

  std::vector<Triangle> whole;
  std::vector<std::uint32_t> number;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    if (!skip[t]) {
      whole.push_back(triangles[t]);
      whole.back().patch = 0;
      number.push_back(t);
    }
  std::vector<SurfaceFault> twice, through;
  if (!whole.empty()) {
    TriangleTree(whole).for_each_near_pair([&](std::uint32_t a, std::uint32_t b) {
      if (b < a) std::swap(a, b);
      const auto corners = [](std::array<Vector3, 3> c) {
        std::sort(c.begin(), c.end(), [](const Vector3& p, const Vector3& q) { return order(p) < order(q); });
        return c;
      };
      if (corners(whole[a].corner) == corners(whole[b].corner)) {
        twice.push_back({Kind::twice, number[a], number[b], whole[a].middle()});
      } else if (!share_a_corner(whole[a], whole[b])) {
        auto x = passage(whole[a], whole[b]);
        if (!x) x = passage(whole[b], whole[a]);
        if (x) through.push_back({Kind::crossing_another, number[a], number[b], *x});
      }
    });
  }
  for (std::vector<SurfaceFault>* of : {&twice, &turned, &branching, &rims, &through}) {
    std::sort(of->begin(), of->end(), [](const SurfaceFault& a, const SurfaceFault& b) {
      return std::tie(a.triangle, a.other) < std::tie(b.triangle, b.other);
    });
    faults.insert(faults.end(), of->begin(), of->end());
  }
  return faults;
}

}  // namespace talus

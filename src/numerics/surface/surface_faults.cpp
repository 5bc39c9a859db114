// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/surface_faults.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "numerics/surface/triangle.hpp"
#include "numerics/surface/triangle_tree.hpp"

namespace talus {

namespace {

using Kind = SurfaceFault::Kind;

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

using Corners = std::array<std::uint32_t, 3>;  // by number

bool are_the_same(Corners a, Corners b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

bool share_a_corner(const Corners& a, const Corners& b) {
  return std::any_of(a.begin(), a.end(), [&](std::uint32_t p) { return p == b[0] || p == b[1] || p == b[2]; });
}

/// Around a triangle.
struct Box {
  Vector3 low, high;

  explicit Box(const Triangle& t) : low(t.corner[0]), high(t.corner[0]) {
    for (const Vector3& c : t.corner)
      for (int axis = 0; axis < 3; ++axis)
        low[axis] = std::min(low[axis], c[axis]), high[axis] = std::max(high[axis], c[axis]);
  }
  bool meets(const Box& b) const {
    return low.x <= b.high.x && b.low.x <= high.x && low.y <= b.high.y && b.low.y <= high.y && low.z <= b.high.z &&
           b.low.z <= high.z;
  }
};

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
  const TriangleEdges edges(triangles, skip);
  edges.for_each([&](std::span<const TriangleEdges::Edge> same) {
    const auto add = [&](std::vector<SurfaceFault>& to, Kind kind, std::optional<std::uint32_t> other) {
      const auto& corner = triangles[same[0].triangle].corner;
      const std::size_t side = same[0].side;
      to.push_back({kind, same[0].triangle, other, 0.5 * (corner[side] + corner[(side + 1) % 3])});
    };
    if (same.size() == 1 && closed) add(rims, Kind::open_rim, {});
    if (same.size() > 2) add(branching, Kind::branching, same[2].triangle);
    if (same.size() == 2 && same[0].reversed == same[1].reversed) add(turned, Kind::turned_over, same[1].triangle);
  });

  std::vector<Triangle> whole;
  std::vector<std::uint32_t> number;
  std::vector<Box> boxes;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    if (!skip[t]) {
      whole.push_back(triangles[t]);
      whole.back().patch = 0;
      number.push_back(t);
      boxes.emplace_back(triangles[t]);
    }
  std::vector<SurfaceFault> twice, through;
  if (!whole.empty()) {
    TriangleTree(whole).for_each_near_pair([&](std::uint32_t a, std::uint32_t b) {
      if (!boxes[a].meets(boxes[b])) return;
      if (b < a) std::swap(a, b);
      const Corners &of_a = edges.corners()[number[a]], &of_b = edges.corners()[number[b]];
      if (share_a_corner(of_a, of_b)) {
        if (are_the_same(of_a, of_b)) twice.push_back({Kind::twice, number[a], number[b], whole[a].middle()});
        return;
      }
      auto x = passage(whole[a], whole[b]);
      if (!x) x = passage(whole[b], whole[a]);
      if (x) through.push_back({Kind::crossing_another, number[a], number[b], *x});
    });
  }
  for (std::vector<SurfaceFault>* of : {&twice, &turned, &branching, &rims, &through}) {
    std::sort(of->begin(), of->end(), [](const SurfaceFault& a, const SurfaceFault& b) {
      return std::tie(a.triangle, a.other, a.place.x, a.place.y, a.place.z) <
             std::tie(b.triangle, b.other, b.place.x, b.place.y, b.place.z);
    });
    faults.insert(faults.end(), of->begin(), of->end());
  }
  return faults;
}

namespace {

using Kind = SurfaceFault::Kind;

void sort_once(std::vector<std::uint32_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// Which triangles are to be turned over.
std::vector<bool> turned_of(std::size_t count, const TriangleEdges& edges) {
  struct Neighbour {
    std::uint32_t triangle;
    bool agrees;
  };
  std::vector<std::vector<Neighbour>> neighbours(count);
  edges.for_each([&](std::span<const TriangleEdges::Edge> same) {
    if (same.size() != 2) return;
    const bool agree = same[0].reversed != same[1].reversed;
    neighbours[same[0].triangle].push_back({same[1].triangle, agree});
    neighbours[same[1].triangle].push_back({same[0].triangle, agree});
  });
  std::vector<bool> turned(count), reached(count);
  std::vector<std::uint32_t> piece;
  for (std::uint32_t first = 0; first < count; ++first) {
    if (reached[first]) continue;
    piece.assign(1, first);
    reached[first] = true;
    for (std::size_t n = 0; n < piece.size(); ++n)
      for (const Neighbour& next : neighbours[piece[n]]) {
        if (reached[next.triangle]) continue;
        reached[next.triangle] = true;
        turned[next.triangle] = turned[piece[n]] == next.agrees;
        piece.push_back(next.triangle);
      }
    const auto many =
        std::count_if(piece.begin(), piece.end(), [&](std::uint32_t t) { return static_cast<bool>(turned[t]); });
    if (2 * static_cast<std::size_t>(many) > piece.size())
      for (const std::uint32_t t : piece) turned[t] = !turned[t];
  }
  return turned;
}

}  // namespace

MendedSurface mended(std::span<const Triangle> triangles, std::span<const SurfaceFault> faults) {
  MendedSurface result;
  for (const SurfaceFault& fault : faults) {
    if (fault.kind == Kind::not_finite || fault.kind == Kind::without_area) result.flat.push_back(fault.triangle);
    if (fault.kind == Kind::twice) result.twice.push_back(*fault.other);
  }
  sort_once(result.flat);
  sort_once(result.twice);
  std::vector<std::uint32_t> number;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (std::binary_search(result.flat.begin(), result.flat.end(), t) ||
        std::binary_search(result.twice.begin(), result.twice.end(), t))
      continue;
    result.triangles.push_back(triangles[t]);
    number.push_back(t);
  }
  const TriangleEdges edges(result.triangles);
  const std::vector<bool> turned = turned_of(result.triangles.size(), edges);
  edges.for_each([&](std::span<const TriangleEdges::Edge> same) {
    const Vector3 middle = 0.5 * (edges.places()[same[0].from] + edges.places()[same[0].to]);
    if (same.size() > 2) result.branching.push_back(middle);
    if (same.size() != 2) return;
    const bool agree = same[0].reversed != same[1].reversed;
    if (agree != (turned[same[0].triangle] == turned[same[1].triangle])) result.without_outside.push_back(middle);
  });
  for (std::size_t t = 0; t < turned.size(); ++t) {
    if (!turned[t]) continue;
    std::swap(result.triangles[t].corner[1], result.triangles[t].corner[2]);
    result.turned.push_back(number[t]);
  }
  return result;
}

}  // namespace talus

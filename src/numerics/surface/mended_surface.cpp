// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/mended_surface.hpp"

#include <algorithm>
#include <utility>

#include "numerics/surface/triangle_edges.hpp"

namespace talus {

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
  std::vector<std::vector<Neighbour>> beside(count);
  edges.for_each([&](std::span<const TriangleEdges::Edge> same) {
    if (same.size() != 2) return;
    const bool agree = same[0].reversed != same[1].reversed;
    beside[same[0].triangle].push_back({same[1].triangle, agree});
    beside[same[1].triangle].push_back({same[0].triangle, agree});
  });
  std::vector<bool> turned(count), reached(count);
  std::vector<std::uint32_t> piece;
  for (std::uint32_t first = 0; first < count; ++first) {
    if (reached[first]) continue;
    piece.assign(1, first);
    reached[first] = true;
    for (std::size_t n = 0; n < piece.size(); ++n)
      for (const Neighbour& next : beside[piece[n]]) {
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

// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/rims.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "numerics/surface/triangle_edges.hpp"

namespace talus {

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

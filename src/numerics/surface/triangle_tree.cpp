// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/triangle_tree.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace talus {

namespace {

/// The box around points, one after the other.
struct Box {
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  Vector3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};

  void add(const Vector3& x) {
    for (int axis = 0; axis < 3; ++axis)
      low[axis] = std::min(low[axis], x[axis]), high[axis] = std::max(high[axis], x[axis]);
  }
};

}  // namespace

TriangleTree::TriangleTree(std::span<const Triangle> triangles) : order_(triangles.size()) {
  if (triangles.empty()) return;
  std::iota(order_.begin(), order_.end(), 0u);
  std::vector<Vector3> middle;
  for (const Triangle& t : triangles) middle.push_back(t.middle());
  add(triangles, middle, 0, static_cast<std::uint32_t>(triangles.size()));
  const Vector3 extent = nodes_[0].high - nodes_[0].low;
  margin_ = 1e-9 * (extent.x + extent.y + extent.z);
  find_flatness(triangles);
}

/// The normal of a slab is that of the whole area of its triangles.
void TriangleTree::find_flatness(std::span<const Triangle> triangles) {
  for (const Node& node : nodes_) {
    const std::uint32_t patch = triangles[order_[node.begin]].patch;
    Vector3 area;
    bool one_patch = true;
    for (std::uint32_t t = node.begin; t < node.end; ++t) {
      area += triangles[order_[t]].area();
      one_patch = one_patch && triangles[order_[t]].patch == patch;
    }
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (!one_patch || !(norm(area) > 0)) {
      flatness_.push_back({{}, 0, infinity, patch});
      continue;
    }
    const Vector3 normal = (1 / norm(area)) * area;
    double low = infinity, high = -infinity;
    for (std::uint32_t t = node.begin; t < node.end; ++t)
      for (const Vector3& corner : triangles[order_[t]].corner)
        low = std::min(low, dot(normal, corner)), high = std::max(high, dot(normal, corner));
    flatness_.push_back({normal, 0.5 * (low + high), 0.5 * (high - low), patch});
  }
}

/// \returns the number of the node
std::uint32_t TriangleTree::add(std::span<const Triangle> triangles, std::span<const Vector3> middle,
                                std::uint32_t begin, std::uint32_t end) {
  const auto n = static_cast<std::uint32_t>(nodes_.size());
  Box around, of_middles;
  for (std::uint32_t t = begin; t < end; ++t) {
    for (const Vector3& corner : triangles[order_[t]].corner) around.add(corner);
    of_middles.add(middle[order_[t]]);
  }
  nodes_.push_back({around.low, around.high, begin, end, 0});
  if (end - begin <= leaf) return n;
  const Vector3 extent = of_middles.high - of_middles.low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const std::uint32_t half = begin + (end - begin) / 2;
  const auto at = [&](std::uint32_t place) { return order_.begin() + place; };
  std::nth_element(at(begin), at(half), at(end), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(middle[a][axis], a) < std::pair(middle[b][axis], b);
  });
  add(triangles, middle, begin, half);
  const std::uint32_t second = add(triangles, middle, half, end);
  nodes_[n].second = second;
  return n;
}

}  // namespace talus

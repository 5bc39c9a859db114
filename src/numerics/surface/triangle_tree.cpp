// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/triangle_tree.hpp"

#include <algorithm>
#include <limits>

namespace talus {

bool find_half_spaces(const Vector3& x, double reach, std::span<const Slab> slabs, std::vector<Slab>& half_spaces) {
  constexpr double rounding = 1e-8;  // of heights, over the reach
  half_spaces.clear();
  for (Slab slab : slabs) {
    if (slab.distance(x) > reach) continue;
    slab.slack += rounding * reach;
    const double height = slab.height(x);
    if (std::abs(height) <= slab.slack) return false;
    if (height < 0) slab.normal = -1.0 * slab.normal, slab.offset = -slab.offset;
    half_spaces.push_back(slab);
  }
  return true;
}

namespace {

/// The box around points, one after the other.
struct BoxOfPoints {
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  Vector3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};

  void add(const Vector3& x) {
    for (int axis = 0; axis < 3; ++axis)
      low[axis] = std::min(low[axis], x[axis]), high[axis] = std::max(high[axis], x[axis]);
  }
};

}  // namespace

TriangleTree::TriangleTree(std::span<const Triangle> triangles) {
  if (triangles.empty()) return;
  std::vector<Middle> middles;
  middles.reserve(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) middles.push_back({triangles[t].middle(), t});
  add(middles, 0, static_cast<std::uint32_t>(triangles.size()));
  std::vector<Triangle> in_order;  // what a node looks at stands together
  in_order.reserve(triangles.size());
  order_.reserve(triangles.size());
  for (const Middle& m : middles) order_.push_back(m.triangle), in_order.push_back(triangles[m.triangle]);
  find_boxes(in_order);
  const Vector3 extent = nodes_[0].high - nodes_[0].low;
  margin_ = 1e-9 * (extent.x + extent.y + extent.z);
  find_flatness(in_order);
}

/// Children stand behind their parent: from the last node to the first.
void TriangleTree::find_boxes(std::span<const Triangle> in_order) {
  for (std::size_t n = nodes_.size(); n-- > 0;) {
    Node& node = nodes_[n];
    BoxOfPoints around;
    if (node.second == 0) {
      for (std::uint32_t t = node.begin; t < node.end; ++t)
        for (const Vector3& corner : in_order[t].corner) around.add(corner);
    } else {
      for (const std::size_t child : {n + 1, std::size_t{node.second}})
        around.add(nodes_[child].low), around.add(nodes_[child].high);
    }
    node.low = around.low, node.high = around.high;
  }
}

/// The normal of a slab belongs to the whole area of its triangles.
void TriangleTree::find_flatness(std::span<const Triangle> in_order) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<Vector3> areas;
  areas.reserve(in_order.size());
  for (const Triangle& t : in_order) areas.push_back(t.area());
  std::vector<std::uint32_t> last_alike(in_order.size());  // of the triangles of its patch that follow each other
  for (std::size_t t = in_order.size(); t-- > 0;)
    last_alike[t] = t + 1 < in_order.size() && in_order[t].patch == in_order[t + 1].patch
                        ? last_alike[t + 1]
                        : static_cast<std::uint32_t>(t);
  flatness_.reserve(nodes_.size());
  for (const Node& node : nodes_) {
    const std::uint32_t patch = in_order[node.begin].patch;
    flatness_.push_back({{}, 0, infinity, patch});
    if (last_alike[node.begin] + 1 < node.end) continue;
    Vector3 area;
    for (std::uint32_t t = node.begin; t < node.end; ++t) area += areas[t];
    if (!(norm(area) > 0)) continue;
    const Vector3 normal = (1 / norm(area)) * area;
    double low = infinity, high = -infinity;
    for (std::uint32_t t = node.begin; t < node.end; ++t)
      for (const Vector3& corner : in_order[t].corner) {
        const double height = dot(normal, corner);
        low = std::min(low, height), high = std::max(high, height);
      }
    flatness_.back() = {normal, 0.5 * (low + high), 0.5 * (high - low), patch};
  }
}

/// Without boxes. \returns the number of the node
std::uint32_t TriangleTree::add(std::span<Middle> middles, std::uint32_t begin, std::uint32_t end) {
  const auto n = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({{}, {}, begin, end, 0});
  if (end - begin <= leaf) return n;
  BoxOfPoints around;
  for (const Middle& m : middles.subspan(begin, end - begin)) around.add(m.place);
  const Vector3 extent = around.high - around.low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  double Vector3::*const along = axis == 0 ? &Vector3::x : axis == 1 ? &Vector3::y : &Vector3::z;
  const std::uint32_t half = begin + (end - begin) / 2;
  const auto at = [&](std::uint32_t place) { return middles.begin() + place; };
  std::nth_element(at(begin), at(half), at(end), [along](const Middle& a, const Middle& b) {
    return a.place.*along < b.place.*along || (a.place.*along == b.place.*along && a.triangle < b.triangle);
  });
  add(middles, begin, half);
  const std::uint32_t second = add(middles, half, end);
  nodes_[n].second = second;
  return n;
}

}  // namespace talus

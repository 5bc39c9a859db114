// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/surface.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include "numerics/surface/triangle.hpp"

namespace talus {

namespace {

constexpr double smooth = 0.848;   // cosine of 32 degrees
constexpr double flat = 1 - 1e-9;  // of 0.003 degrees
constexpr double rounding = 1e-9;  // of positions, over the length of a line

Vector3 least(const Vector3& a, const Vector3& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vector3 largest(const Vector3& a, const Vector3& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

auto order(const Vector3& a) {
  return std::tie(a.x, a.y, a.z);
}

/// Numbers triangles of a patch alike that are joined by edges across which the normal turns by no more than that.
std::vector<std::uint32_t> joined(std::span<const Triangle> triangles, std::span<const Vector3> normals,
                                  const TriangleEdges& edges, double cosine, std::size_t& groups) {
  std::vector<std::uint32_t> root(triangles.size());
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](std::uint32_t t) {
    while (root[t] != t) t = root[t] = root[root[t]];
    return t;
  };
  edges.for_each([&](std::span<const TriangleEdges::Edge> same) {
    for (std::size_t e = 1; e < same.size(); ++e)
      for (std::size_t before = 0; before < e; ++before) {  // of more than two any pair may be one surface
        const std::uint32_t a = same[before].triangle, b = same[e].triangle;
        if (triangles[a].patch != triangles[b].patch || std::abs(dot(normals[a], normals[b])) < cosine) continue;
        const std::uint32_t p = find(a), q = find(b);
        root[std::max(p, q)] = std::min(p, q);
      }
  });
  std::vector<std::uint32_t> number(triangles.size()), result(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (find(t) == t) number[t] = static_cast<std::uint32_t>(groups++);
    result[t] = number[find(t)];
  }
  return result;
}

}  // namespace

const std::shared_ptr<const Surface::Made>& Surface::nothing() {
  static const auto empty = std::make_shared<const Made>();
  return empty;
}

Surface::Surface(std::vector<Triangle> triangles, std::size_t patches) : is_open_(patches, false) {
  if (triangles.empty()) return;
  Made made;
  made.triangles = std::move(triangles);
  made.low = made.high = made.triangles.front().corner[0];
  made.normals.reserve(made.triangles.size());
  for (const Triangle& t : made.triangles) {
    for (const Vector3& c : t.corner) made.low = least(made.low, c), made.high = largest(made.high, c);
    made.normals.push_back(t.normal());
    if (!(std::isfinite(made.normals.back().x) && norm(t.area()) > 0) || t.patch >= patches)
      throw std::invalid_argument("a triangle without area or of no patch");
  }
  const TriangleEdges edges(made.triangles);
  made.parts = joined(made.triangles, made.normals, edges, smooth, made.part_count);
  made.facets = joined(made.triangles, made.normals, edges, flat, made.facet_count);
  made.tree = TriangleTree(made.triangles);
  made_ = std::make_shared<const Made>(std::move(made));
}

const Surface& Surface::none() {
  static const Surface empty;
  return empty;
}

std::optional<Surface::Foot> Surface::nearest(const Vector3& x, double within, std::size_t tried) const {
  std::optional<Foot> best;
  const auto meet = [&](std::uint32_t t) {
    if (is_open_[made_->triangles[t].patch]) return;
    const Vector3 place = nearest_place(made_->triangles[t], x);
    const double distance = norm(place - x);
    if (!(distance <= within) || (best && distance == best->distance && t >= best->triangle)) return;
    best = Foot{t, place, distance};
    within = distance;
  };
  if (tried < made_->triangles.size()) meet(static_cast<std::uint32_t>(tried));
  made_->tree.near_place(x, within, meet);
  return best;
}

/// Whether both ends of a line are clearly on one side of a triangle's plane: quicker than crossing(), which judges the
/// others.
bool Surface::is_on_one_side(std::uint32_t triangle, const Vector3& a, const Vector3& b, double slack) const {
  const Vector3 &n = made_->normals[triangle], &p = made_->triangles[triangle].corner[0];
  const double at_a = dot(n, a - p), at_b = dot(n, b - p);
  return (at_a > slack && at_b > slack) || (at_a < -slack && at_b < -slack);
}

std::optional<Surface::Crossing> Surface::first_crossing(const Vector3& a, const Vector3& b) const {
  std::optional<Crossing> first;
  const double slack = rounding * norm(b - a);
  made_->tree.along_line(a, b, [&](std::uint32_t t) {
    if (is_open_[made_->triangles[t].patch] || is_on_one_side(t, a, b, slack)) return;
    const auto at = crossing(made_->triangles[t], a, b);
    if (at && (!first || *at < first->at || (*at == first->at && t < first->triangle))) first = Crossing{t, *at};
  });
  return first;
}

bool Surface::blocks(const Vector3& a, const Vector3& b) const {
  return order(a) < order(b) ? first_crossing(a, b).has_value() : first_crossing(b, a).has_value();
}

bool Surface::blocks(const Vector3& a, const Vector3& b, std::span<const std::uint32_t> near) const {
  const bool forward = order(a) < order(b);
  const double slack = rounding * norm(b - a);
  return std::any_of(near.begin(), near.end(), [&](std::uint32_t t) {
    return !is_on_one_side(t, a, b, slack) &&
           crossing(made_->triangles[t], forward ? a : b, forward ? b : a).has_value();
  });
}

bool Surface::near(const Vector3& x, double within, std::size_t most, std::vector<std::uint32_t>& found) const {
  found.clear();
  bool all = true;
  made_->tree.near_place(x, within, [&](std::uint32_t t) {
    if (is_open_[made_->triangles[t].patch]) return;
    if (found.size() == most) {
      all = false;
      within = 0;  // enough
    } else {
      found.push_back(t);
    }
  });
  return all;
}

bool Surface::slabs_within(const Vector3& low, const Vector3& high, double thin, double wide, std::size_t most,
                           std::vector<Slab>& found) const {
  found.clear();
  bool all = true;
  const Vector3 middle = 0.5 * (low + high), half = 0.5 * (high - low);
  const auto add = [&](const Slab& slab) {
    const Vector3& n = slab.normal;
    const double extent = std::abs(n.x) * half.x + std::abs(n.y) * half.y + std::abs(n.z) * half.z;
    if (is_open_[slab.patch] || std::abs(slab.height(middle)) > extent + slab.slack) return true;
    if (all = found.size() < most; all) found.push_back(slab);
    return all;
  };
  made_->tree.slabs_within(low, high, thin, wide, add, [&](std::uint32_t t) {
    const auto& [a, b, c] = made_->triangles[t].corner;
    return add({least(a, least(b, c)), largest(a, largest(b, c)), made_->normals[t], dot(made_->normals[t], a), 0,
                made_->triangles[t].patch});
  });
  return all;
}

std::vector<std::array<Vector3, 2>> section_at(const Surface& surface, double y) {
  std::vector<std::array<Vector3, 2>> lines;
  for (const Triangle& t : surface.triangles()) {
    if (surface.is_open(t.patch)) continue;
    std::array<Vector3, 2> ends;
    std::size_t count = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vector3 &a = t.corner[c], &b = t.corner[(c + 1) % 3];
      if ((a.y >= y) != (b.y >= y)) ends[count++] = a + ((y - a.y) / (b.y - a.y)) * (b - a);
    }
    if (count == 2) lines.push_back(ends);
  }
  return lines;
}

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/surface.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <tuple>

namespace talus {

namespace {

constexpr double smooth = 0.848;   // cosine of 32 degrees
constexpr double flat = 1 - 1e-9;  // of 0.003 degrees
constexpr double rounding = 1e-9;  // of places, over the length of a line

Vector3 least(const Vector3& a, const Vector3& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vector3 largest(const Vector3& a, const Vector3& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

auto order(const Vector3& a) {
  return std::tie(a.x, a.y, a.z);
}

/// An edge of a triangle, its ends in order.
struct Edge {
  Vector3 from, to;
  std::uint32_t triangle;
};

}  // namespace

Surface::Surface(std::vector<Triangle> triangles, std::size_t patches)
    : triangles_(std::move(triangles)), is_open_(patches, false) {
  if (triangles_.empty()) return;
  low_ = high_ = triangles_.front().corner[0];
  for (const Triangle& t : triangles_) {
    for (const Vector3& c : t.corner) low_ = least(low_, c), high_ = largest(high_, c);
    normals_.push_back(t.normal());
    if (!(std::isfinite(normals_.back().x) && norm(t.area()) > 0) || t.patch >= patches)
      throw std::invalid_argument("a triangle without area or of no patch");
  }
  parts_ = joined(smooth, part_count_);
  facets_ = joined(flat, facet_count_);
  tree_ = TriangleTree(triangles_);
}

const Surface& Surface::none() {
  static const Surface empty;
  return empty;
}

/// Numbers triangles of a patch alike that are joined by edges across which the normal turns by no more than that.
std::vector<std::uint32_t> Surface::joined(double cosine, std::size_t& groups) const {
  std::vector<std::uint32_t> root(triangles_.size());
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](std::uint32_t t) {
    while (root[t] != t) t = root[t] = root[root[t]];
    return t;
  };
  std::vector<Edge> edges;
  for (std::uint32_t t = 0; t < triangles_.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const Vector3 &a = triangles_[t].corner[c], &b = triangles_[t].corner[(c + 1) % 3];
      edges.push_back(order(a) < order(b) ? Edge{a, b, t} : Edge{b, a, t});
    }
  const auto key = [](const Edge& e) { return std::tuple(order(e.from), order(e.to), e.triangle); };
  std::sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) { return key(a) < key(b); });
  for (std::size_t e = 1; e < edges.size(); ++e) {
    const Edge &a = edges[e - 1], &b = edges[e];
    if (!(a.from == b.from && a.to == b.to) || triangles_[a.triangle].patch != triangles_[b.triangle].patch) continue;
    if (std::abs(dot(normals_[a.triangle], normals_[b.triangle])) < cosine) continue;
    const std::uint32_t p = find(a.triangle), q = find(b.triangle);
    root[std::max(p, q)] = std::min(p, q);
  }
  std::vector<std::uint32_t> number(triangles_.size()), result(triangles_.size());
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    if (find(t) == t) number[t] = static_cast<std::uint32_t>(groups++);
    result[t] = number[find(t)];
  }
  return result;
}

std::optional<Surface::Foot> Surface::nearest(const Vector3& x, double within, std::size_t tried) const {
  std::optional<Foot> best;
  const auto meet = [&](std::uint32_t t) {
    if (is_open_[triangles_[t].patch]) return;
    const Vector3 place = nearest_place(triangles_[t], x);
    const double distance = norm(place - x);
    if (!(distance <= within) || (best && distance == best->distance && t >= best->triangle)) return;
    best = Foot{t, place, distance};
    within = distance;
  };
  if (tried < triangles_.size()) meet(static_cast<std::uint32_t>(tried));
  tree_.near_place(x, within, meet);
  return best;
}

/// Whether both ends of a line are clearly on one side of a triangle's plane: quicker than crossing(), which judges the
/// others.
bool Surface::is_on_one_side(std::uint32_t triangle, const Vector3& a, const Vector3& b, double slack) const {
  const Vector3 &n = normals_[triangle], &p = triangles_[triangle].corner[0];
  const double at_a = dot(n, a - p), at_b = dot(n, b - p);
  return (at_a > slack && at_b > slack) || (at_a < -slack && at_b < -slack);
}

std::optional<Surface::Crossing> Surface::first_crossing(const Vector3& a, const Vector3& b) const {
  std::optional<Crossing> first;
  const double slack = rounding * norm(b - a);
  tree_.along_line(a, b, [&](std::uint32_t t) {
    if (is_open_[triangles_[t].patch] || is_on_one_side(t, a, b, slack)) return;
    const auto at = crossing(triangles_[t], a, b);
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
    return !is_on_one_side(t, a, b, slack) && crossing(triangles_[t], forward ? a : b, forward ? b : a).has_value();
  });
}

bool Surface::near(const Vector3& x, double within, std::size_t most, std::vector<std::uint32_t>& found) const {
  found.clear();
  bool all = true;
  tree_.near_place(x, within, [&](std::uint32_t t) {
    if (is_open_[triangles_[t].patch]) return;
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
    if (is_open_[slab.patch] || std::abs(slab.height(middle)) > extent + slab.slack) return;
    if (all = all && found.size() < most; all) found.push_back(slab);
  };
  tree_.slabs_within(low, high, thin, wide, add, [&](std::uint32_t t) {
    const auto& [a, b, c] = triangles_[t].corner;
    add({least(a, least(b, c)), largest(a, largest(b, c)), normals_[t], dot(normals_[t], a), 0, triangles_[t].patch});
  });
  return all;
}

}  // namespace talus

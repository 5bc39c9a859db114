// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/surface.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <tuple>

namespace talus {

namespace {

constexpr double most_cells = 1e7;
constexpr double smooth = 0.848;   // cosine of 32 degrees
constexpr double flat = 1 - 1e-9;  // of 0.003 degrees

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

Surface::Surface(std::vector<Triangle> triangles, std::size_t patches, double cell)
    : triangles_(std::move(triangles)), is_open_(patches, false), cell_(cell) {
  if (!(cell > 0)) throw std::invalid_argument("the edge of a cell must be positive");
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
  fill_grid();
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

int Surface::along(double x, int axis) const {
  const double n = std::floor((x - low_[axis]) / cell_);
  const int last = count_[static_cast<std::size_t>(axis)] - 1;
  return n < 0 ? 0 : n > last ? last : static_cast<int>(n);
}

/// The cells that overlap a box, each with its number.
template <class Visit>
void Surface::for_each_cell(const Vector3& low, const Vector3& high, Visit&& visit) const {
  for (int axis = 0; axis < 3; ++axis)
    if (high[axis] < low_[axis] || low[axis] > high_[axis]) return;
  const int i0 = along(low.x, 0), i1 = along(high.x, 0), j0 = along(low.y, 1), j1 = along(high.y, 1),
            k0 = along(low.z, 2), k1 = along(high.z, 2);
  for (int k = k0; k <= k1; ++k)
    for (int j = j0; j <= j1; ++j)
      for (int i = i0; i <= i1; ++i)
        visit((static_cast<std::size_t>(k) * static_cast<std::size_t>(count_[1]) + static_cast<std::size_t>(j)) *
                      static_cast<std::size_t>(count_[0]) +
                  static_cast<std::size_t>(i),
              Cell{i, j, k});
}

void Surface::fill_grid() {
  const Vector3 extent = high_ - low_;
  const auto cells = [&] {
    double product = 1;
    for (int axis = 0; axis < 3; ++axis) product *= std::floor(extent[axis] / cell_) + 1;
    return product;
  };
  while (cells() > most_cells) cell_ *= 1.25;
  for (int axis = 0; axis < 3; ++axis)
    count_[static_cast<std::size_t>(axis)] = static_cast<int>(std::floor(extent[axis] / cell_)) + 1;
  // Two passes: how many triangles a cell has, then which. A triangle is in the cells of its box that its plane passes.
  const auto for_each_entry = [&](const auto& enter) {
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      const std::array<Vector3, 3>& corner = triangles_[t].corner;
      const Vector3 low = least(corner[0], least(corner[1], corner[2]));
      const Vector3 high = largest(corner[0], largest(corner[1], corner[2]));
      const Vector3& n = normals_[t];
      const double half = (0.5 + 1e-6) * cell_ * (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
      for_each_cell(low, high, [&](std::size_t cell, const Cell& at) {
        const Vector3 middle = low_ + cell_ * Vector3{at.i + 0.5, at.j + 0.5, at.k + 0.5};
        if (std::abs(dot(n, middle - corner[0])) <= half) enter(cell, t);
      });
    }
  };
  const auto size =
      static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) * static_cast<std::size_t>(count_[2]);
  first_.assign(size + 1, 0);
  for_each_entry([&](std::size_t cell, std::uint32_t) { ++first_[cell + 1]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  of_cells_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for_each_entry([&](std::size_t cell, std::uint32_t t) { of_cells_[next[cell]++] = t; });
}

std::optional<Surface::Foot> Surface::nearest(const Vector3& x, double within) const {
  std::optional<Foot> best;
  const Vector3 reach{within, within, within};
  for_each_cell(x - reach, x + reach, [&](std::size_t cell, const Cell&) {
    for (const std::uint32_t t : in_cell(cell)) {
      if (is_open_[triangles_[t].patch]) continue;
      const Vector3 place = nearest_place(triangles_[t], x);
      const double distance = norm(place - x);
      if (!(distance <= within) ||
          (best && (distance > best->distance || (distance == best->distance && t >= best->triangle))))
        continue;
      best = Foot{t, place, distance};
    }
  });
  return best;
}

std::optional<Surface::Crossing> Surface::first_crossing(const Vector3& a, const Vector3& b) const {
  if (triangles_.empty()) return std::nullopt;
  // A long line is followed piece by piece; within a piece the box of cells around it is searched.
  const double length = norm(b - a);
  const int pieces = std::max(1, static_cast<int>(std::min(1e6, std::ceil(length / (2 * cell_)))));
  for (int piece = 0; piece < pieces; ++piece) {
    const double begin = static_cast<double>(piece) / pieces, end = static_cast<double>(piece + 1) / pieces;
    const Vector3 p = a + begin * (b - a), q = a + end * (b - a);
    const double slack = 1e-9 * (length + cell_);
    const Vector3 margin{slack, slack, slack};
    std::optional<Crossing> first;
    for_each_cell(least(p, q) - margin, largest(p, q) + margin, [&](std::size_t cell, const Cell&) {
      for (const std::uint32_t t : in_cell(cell)) {
        if (is_open_[triangles_[t].patch]) continue;
        const auto at = crossing(triangles_[t], a, b);
        if (at && (!first || *at < first->at || (*at == first->at && t < first->triangle))) first = Crossing{t, *at};
      }
    });
    // Beyond the piece another triangle may come first.
    if (first && (first->at <= end || piece + 1 == pieces)) return first;
  }
  return std::nullopt;
}

void Surface::for_each_near_pair(const std::function<void(std::uint32_t, std::uint32_t)>& visit) const {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::size_t cell = 0; cell + 1 < first_.size(); ++cell) {
    const auto near = in_cell(cell);
    for (std::size_t n = 0; n < near.size(); ++n)
      for (std::size_t m = 0; m < n; ++m) pairs.emplace_back(near[m], near[n]);
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  for (const auto& [a, b] : pairs) visit(a, b);
}

bool Surface::blocks(const Vector3& a, const Vector3& b) const {
  return order(a) < order(b) ? first_crossing(a, b).has_value() : first_crossing(b, a).has_value();
}

}  // namespace talus

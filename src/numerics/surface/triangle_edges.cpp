// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/triangle_edges.hpp"

#include <algorithm>
#include <bit>
#include <tuple>

namespace talus {

namespace {

/// Numbers places as they come: a table of twice as many rows as there may be places, each looked for from the row of
/// its bits on. Not for places that are no numbers, none of which is the same as another.
class Numbering {
 public:
  /// \param places that have numbers, as they come
  Numbering(std::size_t most, std::vector<Vector3>& places)
      : row_(std::bit_ceil(2 * most + 1), nothing), places_(places) {}

  std::uint32_t of(const Vector3& x) {
    for (std::size_t row = bits_of(x) & (row_.size() - 1);; row = (row + 1) & (row_.size() - 1)) {
      if (row_[row] == nothing) {
        row_[row] = static_cast<std::uint32_t>(places_.size());
        places_.push_back(x);
        return row_[row];
      }
      if (places_[row_[row]] == x) return row_[row];
    }
  }

 private:
  static constexpr std::uint32_t nothing = 0xffffffff;

  static std::uint64_t bits_of(const Vector3& x) {
    std::uint64_t bits = 0;
    for (int axis = 0; axis < 3; ++axis) {
      bits = (bits ^ std::bit_cast<std::uint64_t>(x[axis] + 0.0)) * 0x9e3779b97f4a7c15;  // + 0.0: -0 is 0
      bits ^= bits >> 32;
    }
    return bits;
  }

  std::vector<std::uint32_t> row_;
  std::vector<Vector3>& places_;
};

}  // namespace

TriangleEdges::TriangleEdges(std::span<const Triangle> triangles, const std::vector<bool>& left_out) {
  Numbering number(3 * triangles.size(), places_);
  const auto counts = [&](std::size_t t) { return left_out.empty() || !left_out[t]; };
  corners_.resize(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t c = 0; c < 3 && counts(t); ++c) corners_[t][c] = number.of(triangles[t].corner[c]);
  const auto for_each_edge = [&](auto&& visit) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
      for (std::size_t c = 0; c < 3 && counts(t); ++c) {
        const std::uint32_t a = corners_[t][c], b = corners_[t][(c + 1) % 3];
        visit(Edge{std::min(a, b), std::max(a, b), t, static_cast<std::uint8_t>(c), b < a});
      }
  };
  // By their first corner, and among the few of each by the second.
  std::vector<std::uint32_t> first(places_.size() + 1, 0);
  for_each_edge([&](const Edge& e) { ++first[e.from + 1]; });
  for (std::size_t n = 1; n < first.size(); ++n) first[n] += first[n - 1];
  edges_.resize(first.back());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for_each_edge([&](const Edge& e) { edges_[next[e.from]++] = e; });
  for (std::size_t n = 0; n + 1 < first.size(); ++n)
    std::sort(edges_.begin() + first[n], edges_.begin() + first[n + 1],
              [](const Edge& a, const Edge& b) { return std::tie(a.to, a.triangle) < std::tie(b.to, b.triangle); });
}

}  // namespace talus

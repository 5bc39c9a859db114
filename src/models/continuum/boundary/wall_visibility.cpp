// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/boundary/wall_visibility.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/cell_grid.hpp"

namespace talus::continuum {

namespace {

// Of the spacing.
constexpr double in_the_plane = 1e-3;         // a point of another part
constexpr double in_the_plane_of_own = 0.03;  // a point of the same part, which is curved or joined from small pieces
constexpr double at_the_point = 5e-3;         // the end of a line of sight
constexpr double below_foot = 0.25;  // points of a part that is neither convex nor concave which may lie behind it

std::uint64_t key_of(std::uint32_t part, std::uint32_t other) {
  return static_cast<std::uint64_t>(part) << 32 | other;
}

}  // namespace

WallVisibility::WallVisibility(const Surface& surface, std::span<const Vector3> place, std::span<const Vector3> normal,
                               std::span<const std::uint32_t> part, std::size_t compared, double spacing, double reach)
    : surface_(&surface),
      spacing_(spacing),
      seen_at_(place.begin(), place.end()),
      normal_(normal.begin(), normal.end()) {
  for (Vector3& x : seen_at_)
    if (const auto foot = surface.nearest(x, in_the_plane_of_own * spacing)) x = foot->place;
  const std::size_t first = place.size() - compared;
  const std::span<const Vector3> places = place.subspan(first);
  const CellGrid grid(places, reach);
  for (std::uint32_t p = 0; p < compared; ++p) {
    const std::uint32_t own = part[first + p];
    Side* side = nullptr;
    std::uint32_t of = 0;
    grid.for_each_candidate(places[p], [&](std::uint32_t q) {
      const Vector3 d = places[p] - places[q];
      if (p == q || dot(d, d) > reach * reach) return;
      const std::uint32_t other = part[first + q];
      if (!side || of != other) side = &side_[key_of(own, other)], of = other;  // those of a part stand together
      const double height = dot(normal[first + q], d) / spacing,
                   slack = own == other ? in_the_plane_of_own : in_the_plane;
      if (std::abs(height) > slack) *side = *side | (height > 0 ? Side::above : Side::below);
    });
  }
}

Side WallVisibility::side_of(std::uint32_t part, std::uint32_t other) const {
  const auto found = side_.find(key_of(part, other));
  return found == side_.end() ? Side::neither : found->second;
}

bool WallVisibility::is_hidden(const Vector3& x, std::uint32_t point, std::span<const std::uint32_t> near,
                               bool all) const {
  const Vector3& y = seen_at_[point];
  const double length = norm(y - x);
  if (!(length > at_the_point * spacing_)) return false;
  const Vector3 end = x + (1 - at_the_point * spacing_ / length) * (y - x);
  return all ? surface_->blocks(x, end, near) : surface_->blocks(x, end);
}

std::size_t WallVisibility::keep_visible(const Vector3& x, std::span<const PointsOfPart> parts, std::size_t own) const {
  const PointsOfPart& asked = parts[own];
  const auto may_hide = [&](const PointsOfPart& other) {
    const Side side = side_of(asked.part, other.part);
    return side != Side::neither && side != other.side;
  };
  const bool by_itself = may_hide(asked);
  bool by_others = false;
  for (std::size_t n = 0; n < parts.size(); ++n) by_others = by_others || (n != own && may_hide(parts[n]));
  if (!by_itself && !by_others) return asked.points.size();

  constexpr std::size_t most = 64;  // triangles that are tried one by one
  thread_local std::vector<std::uint32_t> near;
  double reach = 0;
  for (const std::uint32_t point : asked.points) reach = std::max(reach, norm(seen_at_[point] - x));
  const bool all = surface_->near(x, reach, most, near);
  const auto is_seen = [&](std::uint32_t point) {
    if (!by_others) {  // in front of the part's own nearest point, and turned as it is
      const Vector3 d = seen_at_[point] - asked.foot;
      const bool above = dot(normal_[point], x - seen_at_[point]) > 0;
      if (above == asked.above_nearest && dot(d, asked.normal) > -below_foot * spacing_) return true;
    }
    return !is_hidden(x, point, near, all);
  };
  return static_cast<std::size_t>(std::stable_partition(asked.points.begin(), asked.points.end(), is_seen) -
                                  asked.points.begin());
}

}  // namespace talus::continuum

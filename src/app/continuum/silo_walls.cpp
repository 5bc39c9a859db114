// SPDX-License-Identifier: Apache-2.0
/// Which of a vessel's upright walls hold a bed, and where they end.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/continuum/silo_shape.hpp"

namespace talus::app {

namespace {

using continuum::VesselPart;
using continuum::VesselShape;

constexpr double same_width = 0.1;  // of walls of one silo, relative

bool is_on_axis(const SiloPiece& a, const SiloPiece& b) {
  return std::hypot(a.axis.x - b.axis.x, a.axis.y - b.axis.y) < 0.25 * std::min(a.width, b.width);
}

bool is_as_wide(const SiloPiece& a, const SiloPiece& b) {
  return std::abs(a.width - b.width) <= same_width * std::max(a.width, b.width);
}

/// Of the section within walls the share that level walls close at a height.
double share_closed(const continuum::Layout& layout, const SiloPiece& wall, double height) {
  constexpr int rings = 4, angles = 16;
  constexpr double level = 0.9;
  const Surface& surface = layout.boundary->vessel();
  const Vector3 up{0, 0, 0.5 * layout.given.bed.spacing};
  int tried = 0, closed = 0;
  for (int k = 0; k < rings; ++k)
    for (int n = 0; n < angles; ++n) {
      const double r = 0.5 * wall.width * std::sqrt((k + 0.5) / rings),
                   angle = 2 * std::numbers::pi * (n + 0.3) / angles;
      const Vector3 place{wall.axis.x + r * std::cos(angle), wall.axis.y + r * std::sin(angle), height};
      if (!layout.boundary->domain().box().contains(place)) continue;
      ++tried;
      const auto crossing = surface.first_crossing(place + up, place - up);
      closed += crossing && std::abs(surface.normal(crossing->triangle).z) > level;
    }
  return tried > 0 ? static_cast<double>(closed) / tried : 0;
}

}  // namespace

const SiloPiece* SiloShape::upright_at(const Vector3& place) const {
  const auto is_about = [](const SiloPiece& piece, const Vector3& x) {
    return std::hypot(piece.axis.x - x.x, piece.axis.y - x.y) < 0.5 * piece.width;
  };
  const SiloPiece *found = nullptr, *any = nullptr;
  for (const SiloPiece& piece : pieces) {
    if (piece.is_hopper() || !(piece.top > place.z)) continue;
    if (!any) any = &piece;
    if (!is_about(piece, place)) continue;
    if (!found) {
      found = &piece;
      continue;
    }
    if (piece.bottom > std::max(place.z, found->bottom) || is_as_wide(piece, *found)) continue;
    // Of walls within others: those about an outlet; else the bed stands between both.
    const SiloPiece* const narrow = piece.width < found->width ? &piece : found;
    const auto& outlets = layout.vessel_outlets;
    if (std::none_of(outlets.begin(), outlets.end(), [&](const auto& o) { return is_about(*narrow, o.middle); }))
      return nullptr;
    found = narrow;
  }
  return found ? found : any;
}

double SiloShape::bottom_of(const SiloPiece& wall, double top) const {
  const continuum::Parameters& p = layout.given;
  double end = wall.bottom;
  for (std::size_t n = 0; n < pieces.size(); ++n)
    for (const SiloPiece& piece : pieces)
      if (!piece.is_hopper() && is_on_axis(piece, wall) && std::abs(piece.top - end) <= p.bed.spacing &&
          piece.bottom < end)
        end = piece.bottom;
  for (const SiloPiece& piece : pieces)
    if (piece.is_hopper() && is_on_axis(piece, wall) && is_as_wide(piece, wall) && piece.top < top)
      end = std::max(end, piece.top);
  for (const VesselPart& v : p.vessel) {
    const bool disc = v.shape == VesselShape::disc && v.along == continuum::Along::z,
               plate = v.shape == VesselShape::plate && v.first_edge[2] == 0 && v.second_edge[2] == 0;
    const double height = disc ? v.height : v.corner[2];
    if ((disc || plate) && height < top && height > end && share_closed(layout, wall, height) > 0.5) end = height;
  }
  return end;
}

std::vector<SiloShape::Ring> SiloShape::rings_above(const SiloPiece& wall, double height, double top) const {
  std::vector<const SiloPiece*> silo;
  for (const SiloPiece& piece : pieces)
    if (&piece == &wall ||
        (!piece.is_hopper() && is_on_axis(piece, wall) && is_as_wide(piece, wall) && piece.top > height))
      silo.push_back(&piece);
  std::stable_sort(silo.begin(), silo.end(),
                   [](const SiloPiece* a, const SiloPiece* b) { return a->bottom > b->bottom; });
  std::vector<Ring> rings;
  double above = top;
  for (const SiloPiece* const piece : silo) {
    const double end = piece == silo.back() ? height : std::max(height, piece->bottom);
    if (!(end < above)) continue;
    rings.push_back({piece->friction, above - end});
    above = end;
  }
  return rings;
}

}  // namespace talus::app

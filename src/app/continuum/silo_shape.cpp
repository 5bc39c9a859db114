// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/silo_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

namespace talus::app {

namespace {

using continuum::VesselPart;
using continuum::VesselShape;

constexpr std::size_t rays = 720;
constexpr double upright = 0.01;        // tangent of an angle that counts as none
constexpr double same_angle = 0.05;     // of tangents, relative
constexpr double levels_of_trial = 60;  // of the vessel's height
constexpr double least_height = 0.1;    // of a piece, over its width
constexpr std::size_t facets_of_round = 16;

/// Between two upright walls of a box along an axis, m: twice the way from a plane of symmetry to the one before it;
/// infinite where images stand before both. \param width between both walls
double free_width(const continuum::Layout& layout, int axis, double middle, double width) {
  const Box& box = layout.boundary->domain().box();
  const auto is_image = [&](int side) {
    const FaceKind kind = box.faces[static_cast<std::size_t>(2 * axis + side)];
    return kind == FaceKind::symmetry || kind == FaceKind::periodic;
  };
  const double low = middle - 0.5 * width, high = middle + 0.5 * width;
  const bool hides_low = is_image(0) && low < box.low[axis], hides_high = is_image(1) && high > box.high[axis];
  if (hides_low && hides_high) return std::numeric_limits<double>::infinity();
  return hides_low ? 2 * (high - box.low[axis]) : hides_high ? 2 * (box.high[axis] - low) : width;
}

std::optional<SiloPiece> piece_of(const continuum::Layout& layout, std::size_t n) {
  const VesselPart& v = layout.given.vessel[n];
  const bool is_box = v.shape == VesselShape::box;
  if (v.along != continuum::Along::z || (v.shape != VesselShape::cylinder && !is_box && !is_cone(v)))
    return std::nullopt;
  SiloPiece piece{.bottom = v.bottom,
                  .top = v.top,
                  .friction = friction_of(layout, v),
                  .axis = continuum::on_axis(layout.given, v),
                  .parts = {n}};
  if (is_box) {
    const double width = free_width(layout, 0, piece.axis.x, v.width),
                 depth = free_width(layout, 1, piece.axis.y, v.depth);
    const bool is_endless[] = {std::isinf(width), std::isinf(depth)};
    if (is_endless[0] && is_endless[1]) return std::nullopt;
    const double w = is_endless[0] ? v.width : width, d = is_endless[1] ? v.depth : depth;
    piece.area = w * d, piece.circumference = 2 * ((is_endless[1] ? 0 : w) + (is_endless[0] ? 0 : d));
    piece.width = std::min(width, depth);
    return piece;
  }
  const double radius = is_cone(v) ? v.upper_radius : v.radius;
  piece.area = std::numbers::pi * radius * radius, piece.circumference = 2 * std::numbers::pi * radius;
  piece.width = 2 * radius, piece.is_round = true;
  if (is_cone(v)) piece.tangent = tangent_of(v);
  return piece;
}

bool is_free_shape(const VesselPart& v) {
  return v.shape == VesselShape::plate || v.shape == VesselShape::pyramid || v.shape == VesselShape::stl;
}

/// Where a ray meets the boundary of the section.
struct Hit {
  Vector3 place;
  Vector3 normal;      ///< level, unit
  double tangent = 0;  ///< of the wall's angle with the vertical, above 0 where it narrows downwards
  double friction = 0;
  std::ptrdiff_t part = -1;  ///< of the vessel
  bool bears = false;        ///< a wall: not a plane of symmetry, not a periodic face
};

/// Nothing where it leaves through an open face, or meets walls of other shapes.
std::optional<Hit> meet(const continuum::Layout& layout, const Vector3& from, const Vector3& direction) {
  const Domain& domain = layout.boundary->domain();
  const continuum::Parameters& p = layout.given;
  double nearest = std::numeric_limits<double>::infinity();
  int face = -1;
  for (int axis = 0; axis < 2; ++axis)
    for (const int side : {0, 1}) {
      const double distance = (domain.box().bound(axis, side) - from[axis]) / direction[axis];
      if (distance > 0 && distance < nearest) nearest = distance, face = face_number(axis, side);
    }
  if (face < 0) return std::nullopt;
  Hit hit;
  hit.place = from + nearest * direction;
  const Surface& surface = layout.boundary->vessel();
  if (const auto crossing = surface.first_crossing(from, hit.place)) {
    const Triangle& triangle = surface.triangles()[crossing->triangle];
    if (!is_free_shape(p.vessel[triangle.patch])) return std::nullopt;
    Vector3 normal = surface.normal(crossing->triangle);
    if (dot(normal, direction) > 0) normal = -1.0 * normal;
    const double level = std::hypot(normal.x, normal.y);
    if (!(level > 0)) return std::nullopt;
    hit.place = from + crossing->at * nearest * direction;
    hit.normal = {normal.x / level, normal.y / level, 0};
    hit.tangent = normal.z / level;
    hit.part = static_cast<std::ptrdiff_t>(triangle.patch);
    hit.friction = friction_of(layout, p.vessel[triangle.patch]);
    hit.bears = true;
    return hit;
  }
  if (domain.box().faces[static_cast<std::size_t>(face)] == FaceKind::open) return std::nullopt;
  hit.normal = domain.normal(face);
  hit.bears = domain.is_solid(face);
  hit.friction = layout.boundary->patches()[static_cast<std::size_t>(face)].friction;
  return hit;
}

/// A place within the bed at a height: above the lowest outlet, somewhat towards the middle of the bed.
Vector3 place_within(const continuum::Layout& layout, double height) {
  const continuum::Extent x = continuum::bed_along_x(layout.given), y = continuum::bed_along_y(layout.given);
  Vector3 place{0.5 * (x.low + x.high), 0.5 * (y.low + y.high), height};
  if (!layout.vessel_outlets.empty()) {
    const Vector3& outlet = layout.vessel_outlets.front().middle;
    place = {outlet.x + 0.1 * (place.x - outlet.x), outlet.y + 0.1 * (place.y - outlet.y), height};
  }
  // Not through an edge of the triangles, and off planes of symmetry.
  const double off = 1e-3 * layout.given.bed.spacing;
  return {std::clamp(place.x + off, off, layout.given.box.width - off),
          std::clamp(place.y + 0.7 * off, off, layout.given.box.depth - off), height};
}

/// A straight part of the circumference, on one wall.
struct Chord {
  Vector3 from, to;
  double length = 0, tangent = 0, friction = 0;
};

/// Where the walls of two hits next to each other meet; half-way between hits of the same one.
Vector3 corner_between(const Hit& a, const Hit& b) {
  constexpr double parallel = 1e-9;
  const Vector3 along = b.place - a.place, middle = a.place + 0.5 * along;
  const double turn = a.normal.x * b.normal.y - a.normal.y * b.normal.x;
  if (std::abs(turn) < parallel) return middle;
  const double da = dot(a.normal, a.place), db = dot(b.normal, b.place);
  const Vector3 corner{(da * b.normal.y - db * a.normal.y) / turn, (db * a.normal.x - da * b.normal.x) / turn,
                       a.place.z};
  return norm(corner - middle) <= norm(along) ? corner : middle;
}

double distance_to(const Chord& c, const Vector3& x) {
  const Vector3 along = c.to - c.from;
  const double share = std::clamp(dot(x - c.from, along) / dot(along, along), 0.0, 1.0);
  return norm(x - (c.from + share * along));
}

/// Whether x is within the section, which is seen whole from a place in it.
bool is_within(const std::vector<Hit>& hits, const Vector3& place, const Vector3& x) {
  const double turn = std::atan2(x.y - place.y, x.x - place.x) / (2 * std::numbers::pi);
  const auto ray = static_cast<std::size_t>((turn - std::floor(turn)) * rays) % rays;
  return norm(x - place) <= std::min(norm(hits[ray].place - place), norm(hits[(ray + 1) % rays].place - place));
}

/// The largest circle between the chords whose middle is in the section: its middle, and the radius.
std::pair<Vector3, double> inscribed(const std::vector<Hit>& hits, const std::vector<Chord>& chords,
                                     const Vector3& place) {
  const auto room = [&](const Vector3& x) {
    double least = std::numeric_limits<double>::infinity();
    for (const Chord& c : chords) least = std::min(least, distance_to(c, x));
    return least;
  };
  std::pair<Vector3, double> best{place, room(place)};
  const auto attempt = [&](const Vector3& x) {
    if (const double radius = is_within(hits, place, x) ? room(x) : 0; radius > best.second * (1 + 1e-12)) {
      best = {x, radius};
      return true;
    }
    return false;
  };
  for (std::size_t ray = 0; ray < rays; ray += 20)
    for (const double share : {0.25, 0.5, 0.75, 0.999}) attempt(place + share * (hits[ray].place - place));
  for (double step = 0.25 * best.second; step > 1e-6 * best.second;) {
    bool better = false;
    for (const Vector3& to : {Vector3{1, 0, 0}, Vector3{-1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, -1, 0}})
      better = attempt(best.first + step * to) || better;
    if (!better) step *= 0.5;
  }
  return best;
}

/// Whether a piece goes on to a section: the same walls at the same angle, and as wide as that makes it.
bool goes_on(const SiloPiece& piece, const SiloPiece& section) {
  const double slack = std::max(upright, same_angle * piece.tangent);
  const double width = piece.width + 2 * piece.tangent * (section.top - piece.top);
  return piece.parts == section.parts && std::abs(section.tangent - piece.tangent) <= slack &&
         std::abs(section.width - width) <= same_angle * width;
}

/// Between a height where a piece is found and one where it is not: the last that has it.
double end_of(const continuum::Layout& layout, const SiloPiece& piece, double within, double beyond) {
  for (int n = 0; n < 30; ++n) {
    const double middle = 0.5 * (within + beyond);
    const auto section = section_by_rays(layout, middle);
    (section && goes_on(piece, *section) ? within : beyond) = middle;
  }
  return within;
}

void add_pieces_by_rays(const continuum::Layout& layout, std::vector<SiloPiece>& pieces) {
  const continuum::Parameters& p = layout.given;
  if (std::none_of(p.vessel.begin(), p.vessel.end(), is_free_shape)) return;
  const double low = layout.boundary->vessel().low().z, high = layout.boundary->vessel().high().z;
  const double step = (high - low) / levels_of_trial;
  std::vector<SiloPiece> found;
  for (double level = high - 0.5 * step; level > low; level -= step) {
    const auto section = section_by_rays(layout, level);
    if (!section || (!found.empty() && level > found.back().bottom)) continue;
    SiloPiece piece = *section;
    piece.top = end_of(layout, piece, level, std::min(high, level + step));
    piece.bottom = level;
    while (true) {
      const double next = piece.bottom - step;
      const auto below = next > low ? section_by_rays(layout, next) : std::nullopt;
      if (below && goes_on(*section, *below)) {
        piece.bottom = next;
        continue;
      }
      piece.bottom = end_of(layout, *section, piece.bottom, std::max(low, next));
      break;
    }
    // At its top a hopper is wider than where it was found.
    const double grown = (piece.width + 2 * piece.tangent * (piece.top - level)) / piece.width, s = piece.shape();
    piece.area *= std::pow(grown, s), piece.circumference *= std::pow(grown, s - 1), piece.width *= grown;
    found.push_back(piece);
  }
  for (SiloPiece& piece : found)
    if (piece.top - piece.bottom >= least_height * piece.width) pieces.push_back(std::move(piece));
}

}  // namespace

bool SiloPiece::has(std::size_t part) const {
  return std::find(parts.begin(), parts.end(), part) != parts.end();
}

SiloShape::SiloShape(const continuum::Layout& of) : layout(of) {
  for (std::size_t n = 0; n < of.given.vessel.size(); ++n)
    if (const auto piece = piece_of(of, n)) pieces.push_back(*piece);
  add_pieces_by_rays(of, pieces);
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const SiloPiece& a, const SiloPiece& b) { return a.bottom < b.bottom; });
}

const SiloPiece* SiloShape::of_part(std::size_t part, double height) const {
  const SiloPiece* nearest = nullptr;
  double least = layout.given.bed.spacing;
  for (const SiloPiece& piece : pieces)
    if (const double off = std::max({piece.bottom - height, height - piece.top, 0.0});
        piece.has(part) && off <= least && !(nearest && off == least))
      nearest = &piece, least = off;
  return nearest;
}

std::string SiloShape::name_of(const SiloPiece& piece) const {
  std::string names;
  for (const std::size_t part : piece.parts)
    names += (names.empty() ? "" : ", ") + continuum::name_of(layout.given, part);
  return names;
}

double friction_of(const continuum::Layout& layout, const VesselPart& v) {
  const auto part = static_cast<std::size_t>(&v - layout.given.vessel.data());
  return layout.boundary->patches()[layout.boundary->patch_of_part(part)].friction;
}

double bulk_density(const continuum::Parameters& p) {
  return p.bed.packing * p.grains.density;
}

double tangent_of(const VesselPart& cone) {
  return (cone.upper_radius - cone.lower_radius) / (cone.top - cone.bottom);
}

bool is_cone(const VesselPart& v) {
  return v.shape == VesselShape::cone && v.along == continuum::Along::z && v.upper_radius > v.lower_radius;
}

std::optional<SiloPiece> section_by_rays(const continuum::Layout& layout, double height) {
  const Vector3 place = place_within(layout, height);
  std::vector<Hit> hits;
  for (std::size_t n = 0; n < rays; ++n) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(n) / rays;
    const auto hit = meet(layout, place, {std::cos(angle), std::sin(angle), 0});
    if (!hit) return std::nullopt;
    hits.push_back(*hit);
  }
  SiloPiece piece;
  piece.bottom = piece.top = height;
  std::vector<Chord> chords;
  std::set<std::size_t> parts;
  std::size_t facets = 0;
  double inclined = 0, turned = 0;
  const auto add = [&](const Hit& hit, const Vector3& from, const Vector3& to) {
    const Vector3 a = from - place, b = to - place;
    piece.area += 0.5 * (a.x * b.y - a.y * b.x);
    const double length = norm(to - from);
    if (!hit.bears || !(length > 0)) return;
    chords.push_back({from, to, length, hit.tangent, hit.friction});
    if (hit.part >= 0) parts.insert(static_cast<std::size_t>(hit.part));
    if (std::abs(hit.tangent) > upright) inclined += length, turned += length * hit.tangent;
  };
  for (std::size_t n = 0; n < rays; ++n) {
    const Hit &a = hits[n], &b = hits[(n + 1) % rays];
    const Vector3 corner = corner_between(a, b);
    add(a, a.place, corner), add(b, corner, b.place);
    if (a.bears && b.bears && dot(a.normal, b.normal) < 1 - 1e-6) ++facets;
  }
  if (chords.empty() || parts.empty()) return std::nullopt;
  if (inclined > 0) {
    // Walls that narrow downwards at one angle; upright ones at their ends do not count.
    piece.tangent = turned / inclined;
    for (const Hit& hit : hits)
      if (hit.bears && std::abs(hit.tangent) > upright &&
          std::abs(hit.tangent - piece.tangent) > same_angle * std::abs(piece.tangent))
        return std::nullopt;
    if (!(piece.tangent > 0)) return std::nullopt;
    std::erase_if(chords, [](const Chord& c) { return std::abs(c.tangent) <= upright; });
  }
  for (const Chord& c : chords) piece.circumference += c.length, piece.friction += c.length * c.friction;
  piece.friction /= piece.circumference;
  const auto [middle, radius] = inscribed(hits, chords, place);
  piece.axis = middle, piece.width = 2 * radius;
  piece.is_round = facets >= facets_of_round;
  piece.parts.assign(parts.begin(), parts.end());
  return piece;
}

}  // namespace talus::app

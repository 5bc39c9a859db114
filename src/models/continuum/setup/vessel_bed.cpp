// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/vessel_bed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "physics/sph/wall_contact.hpp"

namespace talus::continuum {

namespace {

constexpr double golden = std::numbers::phi - 1;
constexpr double on_the_wall = 0.02;                    // in spacings
constexpr double around_seed = 1.5, above_gate = 0.01;  // in spacings
constexpr double min_level = 0.7;                       // of a level gate: the mean of its normals' |z|

/// Of a whole.
double share(double x) {
  return x - std::floor(x);
}

using Layer = VesselPlaces::Layer;
using Index = VesselPlaces::Index;

Layer layer_of_lattice(const Parameters& p, const Lattice& lattice) {
  Layer layer;
  for (std::int64_t j = 0; j < lattice.count[1]; ++j)
    for (std::int64_t i = 0; i < lattice.count[0]; ++i) {
      const auto number = [&](std::int64_t m, std::int64_t n) {
        return static_cast<std::uint32_t>(n * lattice.count[0] + m);
      };
      layer.places.push_back({lattice.corner.x + (static_cast<double>(i) + 0.5) * lattice.spacing.x,
                              lattice.corner.y + (static_cast<double>(j) + 0.5) * lattice.spacing.y, 0});
      layer.beside.emplace_back();
      for (const int step : {-1, 1}) {
        if (i + step >= 0 && i + step < lattice.count[0]) layer.beside.back().push_back(number(i + step, j));
        if (j + step >= 0 && j + step < lattice.count[1]) layer.beside.back().push_back(number(i, j + step));
      }
    }
  const VesselBounds around = bounds_of_vessel(p);
  Parameters without_walls = p;  // found from the middle that they leave where it is
  without_walls.bed.walls = nullptr;
  const Lattice whole = lattice_of(without_walls);
  std::array<std::int64_t, 2> n{};
  for (int axis = 0; axis < 2; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double low = whole.corner[axis], extent = static_cast<double>(whole.count[a]) * whole.spacing[axis];
    const double from = std::max(low, around.low[axis]), to = std::min(low + extent, around.high[axis]);
    const double middle = from < to ? 0.5 * (from + to) : low + 0.5 * extent;
    const double places = (middle - lattice.corner[axis]) / lattice.spacing[axis];
    n[a] = std::clamp<std::int64_t>(static_cast<std::int64_t>(places), 0, lattice.count[a] - 1);
  }
  layer.middle = static_cast<std::uint32_t>(n[1] * lattice.count[0] + n[0]);
  return layer;
}

/// Rings from the outside inwards, each about as wide as its places are apart along it: what is left at the axis is
/// a ring of one place in the sector, or few. Each begins elsewhere: places in rows would go down in rows.
Layer layer_of_rings(const Parameters& p, const Lattice& lattice, const Sector& sector) {
  const Extent x = bed_along_x(p);
  const double area = lattice.mass / (p.bed.packing * p.grains.density * lattice.spacing.z), apart = std::sqrt(area);
  const double angle = 2 * std::numbers::pi / sector.copies(), of_place = 2 * area / angle;  // of the squares of radii
  const double squared = 0.25 * (x.high - x.low) * (x.high - x.low);
  Layer layer;
  std::vector<std::int64_t> count, first;
  for (std::int64_t left = std::max<std::int64_t>(1, std::llround(squared / of_place)); left > 0;) {
    const double outer = std::sqrt(of_place * static_cast<double>(left));
    const std::int64_t wanted = std::llround(angle * (outer - 0.5 * apart) / apart);
    const std::int64_t own = std::clamp<std::int64_t>(wanted, 1, left);
    const double radius = std::sqrt(of_place * (static_cast<double>(left) - 0.5 * static_cast<double>(own)));
    first.push_back(static_cast<std::int64_t>(layer.places.size()));
    count.push_back(own);
    const double begin = share(golden * static_cast<double>(count.size()));
    for (std::int64_t n = 0; n < own; ++n) {
      layer.places.push_back(sector.axis() + Vector3{radius, 0, 0});
      layer.azimuth.push_back((static_cast<double>(n) + begin) / static_cast<double>(own));
    }
    left -= own;
  }
  const auto rings = static_cast<std::int64_t>(count.size());
  for (std::int64_t r = 0; r < rings; ++r) {
    const auto at = [](const std::vector<std::int64_t>& of, std::int64_t ring) {
      return of[static_cast<std::size_t>(ring)];
    };
    for (std::int64_t n = 0; n < at(count, r); ++n) {
      layer.beside.emplace_back();
      const auto add = [&](std::int64_t ring, std::int64_t place) {
        layer.beside.back().push_back(static_cast<std::uint32_t>(at(first, ring) + place));
      };
      for (const int step : {-1, 1}) {
        if (n + step >= 0 && n + step < at(count, r)) add(r, n + step);
        if (r + step >= 0 && r + step < rings) add(r + step, (2 * n + 1) * at(count, r + step) / (2 * at(count, r)));
      }
    }
  }
  layer.middle = static_cast<std::uint32_t>(layer.places.size() - 1);
  return layer;
}

}  // namespace

std::vector<LevelOpening> level_openings(const Layout& layout) {
  const Parameters& p = layout.given;
  std::vector<LevelOpening> openings;
  for (std::size_t n = 0; n < p.vessel.size(); ++n) {
    if (!p.vessel[n].gate) continue;
    const VesselBounds bounds = bounds_of(p, n);
    double area = 0, level = 0;
    Vector3 middle;
    for (const Triangle& t : triangles_of(p, n)) {
      const double own = norm(t.area());
      area += own, level += std::abs(t.area().z), middle += own * t.middle();
    }
    if (!(level > min_level * area)) continue;
    openings.push_back({.name = name_of(p, n),
                        .middle = (1 / area) * middle,
                        .low = bounds.low,
                        .high = bounds.high,
                        .is_gate = true});
  }
  if (!openings.empty()) return openings;
  if (!layout.vessel_outlets.empty()) {
    const VesselOutlet& outlet = layout.vessel_outlets.front();
    const Vector3 half{0.5 * outlet.width, 0.5 * outlet.depth, 0};
    openings.push_back({.name = "outlet",
                        .middle = outlet.middle,
                        .low = outlet.middle - half,
                        .high = outlet.middle + half,
                        .is_gate = false});
  }
  return openings;
}

VesselPlaces::VesselPlaces(const Layout& of_case)
    : layout(of_case),
      lattice(layout.lattice),
      surface(layout.boundary->vessel()),
      domain(layout.boundary->domain()),
      layer(domain.sector() ? layer_of_rings(layout.given, lattice, *domain.sector())
                            : layer_of_lattice(layout.given, lattice)),
      layers(static_cast<std::size_t>(lattice.count[2])),
      taken(layer.places.size() * layers) {}

Vector3 VesselPlaces::at(const Index& n) const {
  Vector3 x = layer.places[n.place];
  if (!layer.azimuth.empty()) {  // nor in rows from layer to layer
    const Sector& sector = *domain.sector();
    const double azimuth = 2 * std::numbers::pi / sector.copies() *
                           share(layer.azimuth[n.place] + golden * golden * static_cast<double>(n.layer));
    const double radius = sector.radius(x);
    x = sector.axis() + Vector3{radius * std::cos(azimuth), radius * std::sin(azimuth), 0};
  }
  x.z = lattice.corner.z + (static_cast<double>(n.layer) + 0.5) * lattice.spacing.z;
  return x;
}

bool VesselPlaces::is_clear(const Vector3& x) const {
  return !surface.nearest(x, on_the_wall * layout.given.bed.spacing) &&
         !domain.is_near_wall(x, 0.25 * layout.given.bed.spacing);
}

Vector3 VesselPlaces::moved_off(const Vector3& x) const {
  const double room = sph::contact_distance * layout.given.bed.spacing;
  const auto foot = surface.nearest(x, room);
  return foot ? foot->place + (room / foot->distance) * (x - foot->place) : x;
}

bool VesselPlaces::is_hidden(const Vector3& a, const Vector3& b) const {
  return surface.blocks(a, b) || domain.blocks(a, b);
}

std::optional<Index> VesselPlaces::visible_from(const Vector3& x) const {
  const auto& sector = domain.sector();
  const double reach = around_seed * layout.given.bed.spacing;
  std::vector<std::pair<double, std::uint32_t>> near;  // as they are seen from above
  for (std::uint32_t n = 0; n < layer.places.size(); ++n) {
    const Vector3 d = layer.places[n] - x;
    const double apart = sector ? std::abs(sector->radius(layer.places[n]) - sector->radius(x)) : std::hypot(d.x, d.y);
    if (apart < reach) near.emplace_back(apart, n);
  }
  std::sort(near.begin(), near.end());
  const auto in_layer = [&](std::size_t k) -> std::optional<Index> {
    for (const auto& [apart, place] : near) {
      const Vector3 y = at({place, k});
      Vector3 from = x;
      if (sector) {  // wherever a ring's place stands along its ring
        const double radius = sector->radius(y), share_of_radius = radius > 0 ? sector->radius(x) / radius : 0;
        from = sector->axis() + share_of_radius * (y - sector->axis());
        from.z = x.z;
      }
      if (is_clear(y) && !is_hidden(from, y)) return Index{place, k};
    }
    return std::nullopt;
  };
  const double above_bottom = std::floor((x.z - lattice.corner.z) / lattice.spacing.z);
  const auto own = static_cast<std::size_t>(std::clamp(above_bottom, 0.0, static_cast<double>(layers) - 1));
  for (std::size_t k = own; k < layers; ++k)
    if (const auto found = in_layer(k)) return found;
  return own > 0 ? in_layer(own - 1) : std::nullopt;
}

std::vector<Index> VesselPlaces::seeds() const {
  std::vector<Index> seeds;
  if (layers == 0) return seeds;
  const auto add = [&](const Vector3& x) {
    if (const auto seen = visible_from(x)) seeds.push_back(*seen);
  };
  if (const auto& inside = layout.given.bed.inside) {
    add({(*inside)[0], (*inside)[1], (*inside)[2]});
    return seeds;
  }
  for (const LevelOpening& opening : level_openings(layout))
    add(opening.middle + Vector3{0, 0, above_gate * layout.given.bed.spacing});
  if (!seeds.empty()) return seeds;
  if (const Index top{layer.middle, layers - 1}; is_clear(at(top))) seeds.push_back(top);
  return seeds;
}

void VesselPlaces::fill() {
  std::vector<Index> border;
  const auto take = [&](const Index& n) {
    taken[number(n)] = 1;
    border.push_back(n);
  };
  for (const Index& seed : seeds())
    if (!taken[number(seed)]) take(seed);
  while (!border.empty()) {
    const Index n = border.back();
    border.pop_back();
    const Vector3 x = at(n);
    for_each_beside(n, [&](const Index& next) {
      if (taken[number(next)]) return;
      const Vector3 y = at(next);
      if (is_clear(y) && !is_hidden(x, y)) take(next);
    });
  }
}

std::vector<Vector3> bed_in_vessel(const Layout& layout) {
  VesselPlaces places(layout);
  places.fill();
  std::vector<Vector3> positions;
  for (Index n{0, 0}; n.layer < places.layers; ++n.layer)
    for (n.place = 0; n.place < places.layer.places.size(); ++n.place)
      if (places.taken[places.number(n)]) positions.push_back(places.moved_off(places.at(n)));
  return positions;
}

}  // namespace talus::continuum

// SPDX-License-Identifier: Apache-2.0
/// The bed in a vessel.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "models/continuum/layout.hpp"
#include "models/continuum/parameters.hpp"
#include "models/continuum/vessel.hpp"
#include "physics/sph/wall_contact.hpp"

namespace talus::continuum {

namespace {

constexpr double golden = std::numbers::phi - 1;
constexpr double on_the_wall = 0.02;  // in spacings

/// Of a whole.
double share(double x) {
  return x - std::floor(x);
}

/// The places of a layer, as they are seen from above, and which stand beside each.
struct Layer {
  std::vector<Vector3> places;
  std::vector<double> azimuth;  ///< of the places of rings, as a share of the sector's angle
  std::vector<std::vector<std::uint32_t>> beside;
  std::uint32_t middle = 0;  ///< of what the vessel takes of the layer
};

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
  std::array<std::int64_t, 2> n{};
  for (int axis = 0; axis < 2; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double low = lattice.corner[axis], extent = static_cast<double>(lattice.count[a]) * lattice.spacing[axis];
    const double from = std::max(low, around.low[axis]), to = std::min(low + extent, around.high[axis]);
    const double middle = from < to ? 0.5 * (from + to) : low + 0.5 * extent;
    n[a] = std::clamp<std::int64_t>(static_cast<std::int64_t>((middle - low) / lattice.spacing[axis]), 0,
                                    lattice.count[a] - 1);
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

/// The places of all layers and which of them hold particles, layer by layer.
struct Places {
  const Parameters& parameters;
  Lattice lattice = lattice_of(parameters);
  Surface surface = surface_of(parameters);
  Domain domain = domain_of(parameters);
  Layer layer =
      domain.sector() ? layer_of_rings(parameters, lattice, *domain.sector()) : layer_of_lattice(parameters, lattice);
  std::size_t layers = static_cast<std::size_t>(lattice.count[2]);
  std::vector<char> taken = std::vector<char>(layer.places.size() * layers);

  struct Index {
    std::uint32_t place;
    std::size_t layer;
  };
  std::size_t number(const Index& n) const { return n.layer * layer.places.size() + n.place; }
  Vector3 at(const Index& n) const {
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
  bool is_clear(const Vector3& x) const {
    return !surface.nearest(x, on_the_wall * parameters.bed.spacing) &&
           !domain.is_near_wall(x, 0.25 * parameters.bed.spacing);
  }
  /// Farther from the wall, if it is too near.
  Vector3 moved_off(const Vector3& x) const {
    const double room = sph::contact_distance * parameters.bed.spacing;
    const auto foot = surface.nearest(x, room);
    return foot ? foot->place + (room / foot->distance) * (x - foot->place) : x;
  }
  bool is_hidden(const Vector3& a, const Vector3& b) const { return surface.blocks(a, b) || domain.blocks(a, b); }
};

}  // namespace

std::vector<Vector3> bed_in_vessel(const Parameters& p) {
  Places places{p};
  std::vector<Places::Index> border;
  const auto take = [&](const Places::Index& n) {
    places.taken[places.number(n)] = 1;
    border.push_back(n);
  };
  if (const Places::Index top{places.layer.middle, places.layers - 1}; places.is_clear(places.at(top))) take(top);
  while (!border.empty()) {
    const Places::Index n = border.back();
    border.pop_back();
    const Vector3 x = places.at(n);
    const auto offer = [&](const Places::Index& next) {
      if (places.taken[places.number(next)]) return;
      const Vector3 y = places.at(next);
      if (places.is_clear(y) && !places.is_hidden(x, y)) take(next);
    };
    for (const std::uint32_t place : places.layer.beside[n.place]) offer({place, n.layer});
    if (n.layer > 0) offer({n.place, n.layer - 1});
    if (n.layer + 1 < places.layers) offer({n.place, n.layer + 1});
  }
  std::vector<Vector3> positions;
  for (Places::Index n{0, 0}; n.layer < places.layers; ++n.layer)
    for (n.place = 0; n.place < places.layer.places.size(); ++n.place)
      if (places.taken[places.number(n)]) positions.push_back(places.moved_off(places.at(n)));
  return positions;
}

}  // namespace talus::continuum

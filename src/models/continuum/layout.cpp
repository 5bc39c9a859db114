// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "models/continuum/parameters.hpp"

namespace talus::continuum {

namespace {

constexpr std::int64_t most_along_an_axis = 1'000'000'000'000;  // far beyond what check() lets pass
constexpr double most_places_looked_at = 1e6;                   // to count the particles of a bed

Panel panel_between(std::string name, double x0, double z0, double x1, double z1) {
  return {.name = std::move(name), .from = {x0, 0, z0}, .to = {x1, 0, z1}, .openings = {}};
}

std::vector<Panel> panels_of(const Parameters& p) {
  std::vector<Panel> panels;
  const bool gated = p.gate.opens != GateOpens::from_the_start;
  if (const auto outlet = outlet_of(p); outlet && p.wedge.half_angle) {
    const double top = outlet->height + outlet->left / std::tan(*p.wedge.half_angle);
    panels.push_back(panel_between("wedge_left", outlet->left, outlet->height, 0, top));
    panels.push_back(panel_between("wedge_right", outlet->right, outlet->height, p.box.width, top));
    if (gated && p.wedge.outlet > 0) {
      panels.push_back(panel_between("wedge_gate", outlet->left, outlet->height, outlet->right, outlet->height));
      // Its ends are the ends of the walls: all of it goes.
      panels.back().openings.push_back({.begin = -p.box.width, .end = 2 * p.box.width, .shut = true});
    }
  }
  if (p.plates.empty()) return panels;
  if (p.plate.height) {
    Panel plate = panel_between("plate", 0, *p.plate.height, p.box.width, *p.plate.height);
    if (const auto slit = outlet_of(p))
      plate.openings.push_back({.begin = slit->left, .end = slit->right, .shut = gated});
    panels.insert(panels.begin(), std::move(plate));
  }
  for (std::size_t n = 0; n < p.plates.size(); ++n) {
    const auto& given = p.plates[n];
    Panel plate =
        panel_between(fmt::format("plates_{}", n + 1), given.from[0], given.from[1], given.to[0], given.to[1]);
    // The rim of an opening is solid: one that ends where the plate does has none there.
    const double length = plate.length();
    for (std::size_t k = 0; k + 1 < given.openings.size(); k += 2)
      plate.openings.push_back({.begin = given.openings[k] > 0 ? given.openings[k] : -length,
                                .end = given.openings[k + 1] < length ? given.openings[k + 1] : 2 * length,
                                .shut = given.opens_after && (gated || *given.opens_after > 0),
                                .opens_after = given.opens_after.value_or(0)});
    panels.push_back(std::move(plate));
  }
  return panels;
}

}  // namespace

Extent bed_along_x(const Parameters& p) {
  return {p.bed.left.value_or(0), p.bed.right.value_or(p.box.width)};
}

double bed_bottom(const Parameters& p) {
  return p.bed.bottom.value_or(p.wedge.half_angle ? p.wedge.height : p.plate.height.value_or(0));
}

std::optional<Outlet> outlet_of(const Parameters& p) {
  if (p.wedge.half_angle)
    return Outlet{p.wedge.height, 0.5 * (p.box.width - p.wedge.outlet), 0.5 * (p.box.width + p.wedge.outlet)};
  if (p.plate.height && p.plate.slit_left && p.plate.slit_right)
    return Outlet{*p.plate.height, *p.plate.slit_left, *p.plate.slit_right};
  return std::nullopt;
}

Domain domain_of(const Parameters& p) {
  const Box box{.low = {0, 0, 0},
                .high = {p.box.width, p.box.depth, p.box.height},
                .faces = {p.box.left, p.box.right, p.box.front, p.box.rear, p.box.floor, p.box.top}};
  if (std::vector<Panel> panels = panels_of(p); !panels.empty()) return {box, {}, std::move(panels)};
  std::vector<Plate> plates;
  if (p.plate.height) {
    Plate plate{.axis = 2, .position = *p.plate.height, .openings = {}};
    if (p.plate.slit_left && p.plate.slit_right) {
      // The rim of an opening is solid: one that ends at a face has none there, nor at front and rear.
      const double left = *p.plate.slit_left > 0 ? *p.plate.slit_left : -p.box.width;
      const double right = *p.plate.slit_right < p.box.width ? *p.plate.slit_right : 2 * p.box.width;
      plate.openings.push_back({.low = {left, -p.box.depth, 0},
                                .high = {right, 2 * p.box.depth, 0},
                                .shut = p.gate.opens != GateOpens::from_the_start});
    }
    plates.push_back(std::move(plate));
  }
  return {box, std::move(plates)};
}

Lattice lattice_of(const Parameters& p) {
  const Extent x = bed_along_x(p);
  const Vector3 extent{x.high - x.low, p.box.depth, p.bed.height};
  Lattice lattice{.corner = {x.low, 0, bed_bottom(p)}, .spacing = {}, .count = {}, .mass = 0};
  for (int axis = 0; axis < 3; ++axis) {
    const double spacings = extent[axis] / p.bed.spacing;
    const auto count = spacings < most_along_an_axis ? std::max<std::int64_t>(1, std::llround(spacings))
                                                     : std::int64_t{most_along_an_axis};
    lattice.count[static_cast<std::size_t>(axis)] = count;
    lattice.spacing[axis] = extent[axis] / static_cast<double>(count);
  }
  lattice.mass = p.bed.packing * p.grains.density * lattice.spacing.x * lattice.spacing.y * lattice.spacing.z;
  return lattice;
}

namespace {

/// The places of the lattice and which of them hold particles: plates go through the whole depth, so all places along y
/// are alike.
struct Bed {
  const Parameters& parameters;
  Lattice lattice = lattice_of(parameters);
  Domain domain = domain_of(parameters);
  Vector3 top = at(0.5 * static_cast<double>(lattice.count[0] - 1), 0, static_cast<double>(lattice.count[2] - 1));

  Vector3 at(double i, double j, double k) const {
    return lattice.corner +
           Vector3{(i + 0.5) * lattice.spacing.x, (j + 0.5) * lattice.spacing.y, (k + 0.5) * lattice.spacing.z};
  }
  bool holds(const Vector3& x) const {
    return domain.panels().empty() ||
           (!domain.is_near_panel(x, 0.25 * parameters.bed.spacing) && !domain.blocks(x, top));
  }
};

}  // namespace

std::vector<Vector3> bed_positions(const Parameters& p) {
  const Bed bed{p};
  const auto& count = bed.lattice.count;
  std::vector<Vector3> positions;
  for (std::int64_t k = 0; k < count[2]; ++k)
    for (std::int64_t j = 0; j < count[1]; ++j)
      for (std::int64_t i = 0; i < count[0]; ++i)
        if (const Vector3 x = bed.at(double(i), double(j), double(k)); bed.holds(x)) positions.push_back(x);
  return positions;
}

double places_of(const Lattice& lattice) {
  return static_cast<double>(lattice.count[0]) * static_cast<double>(lattice.count[1]) *
         static_cast<double>(lattice.count[2]);
}

double bed_count(const Parameters& p) {
  const Bed bed{p};
  const auto& count = bed.lattice.count;
  if (bed.domain.panels().empty()) return places_of(bed.lattice);
  const double layer = static_cast<double>(count[0]) * static_cast<double>(count[2]);
  const auto stride = static_cast<std::int64_t>(std::ceil(std::sqrt(std::max(1.0, layer / most_places_looked_at))));
  double held = 0, looked_at = 0;
  for (std::int64_t k = stride / 2; k < count[2]; k += stride)
    for (std::int64_t i = stride / 2; i < count[0]; i += stride, ++looked_at)
      held += bed.holds(bed.at(double(i), 0, double(k))) ? 1 : 0;
  return looked_at > 0 ? std::round(held / looked_at * layer) * static_cast<double>(count[1]) : 0;
}

}  // namespace talus::continuum

// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/inlets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/unit.hpp"
#include "models/continuum/setup/layout.hpp"
#include "models/continuum/step.hpp"
#include "numerics/sph/cubic_spline.hpp"
#include "physics/sph/wall_contact.hpp"

namespace talus::continuum {

namespace {

constexpr double max_along_side = 1e4;  // places

/// Of the lattice, without regard to walls.
std::vector<Vector3> lattice_in(const Parameters& p, const Inlet& inlet) {
  const double spacing = p.bed.spacing;
  const bool round = inlet.shape == InletShape::disc;
  const auto count = [&](double extent) {
    return std::max<std::int64_t>(1, std::llround(std::min(max_along_side, extent / spacing)));
  };
  const std::int64_t columns = count(round ? 2 * inlet.radius : inlet.width);
  const std::int64_t rows = count(round ? 2 * inlet.radius : inlet.depth);
  std::vector<Vector3> places;
  for (std::int64_t j = 0; j < rows; ++j)
    for (std::int64_t i = 0; i < columns; ++i) {
      const double x = (static_cast<double>(i) - 0.5 * static_cast<double>(columns - 1)) * spacing;
      const double y = (static_cast<double>(j) - 0.5 * static_cast<double>(rows - 1)) * spacing;
      if (!round || x * x + y * y <= inlet.radius * inlet.radius)
        places.push_back({inlet.centre[0] + x, inlet.centre[1] + y, inlet.centre[2]});
    }
  return places;
}

}  // namespace

std::string inlet_key(std::size_t n, std::string_view name) {
  return fmt::format("inlet.{}.{}", n + 1, name);
}

std::vector<std::size_t> inlets_after(const Parameters& p, double end) {
  std::vector<std::size_t> late;
  for (std::size_t n = 0; n < p.inlets.size(); ++n) {
    const bool from_gate = p.inlets[n].clock == InletClock::gate;
    if (!from_gate && p.gate.opens == GateOpens::when_settled) continue;  // when is not known
    const double opened = !from_gate && p.gate.opens == GateOpens::at_time ? p.gate.time : 0;
    if (p.inlets[n].from >= opened + end) late.push_back(n);
  }
  return late;
}

std::vector<std::size_t> inlets_past_vessel(const Layout& layout) {
  const Parameters& p = layout.given;
  std::vector<std::size_t> past;
  if (p.vessel.empty() || p.box.floor != FaceKind::open) return past;
  constexpr std::size_t max_paths = 100;
  constexpr double segment = 4;  // of a path, in spacings
  const Surface& surface = layout.boundary->vessel();
  for (std::size_t n = 0; n < p.inlets.size(); ++n) {
    const Vector3 start{p.inlets[n].velocity[0], p.inlets[n].velocity[1], p.inlets[n].velocity[2]};
    const std::vector<Vector3> places = lattice_in(p, p.inlets[n]);
    const std::size_t stride = 1 + places.size() / max_paths;
    std::size_t paths = 0, free = 0;
    for (std::size_t i = 0; i < places.size(); i += stride, ++paths) {
      Vector3 x = places[i], v = start;
      bool meets = false;
      while (!meets && x.z >= surface.low().z) {
        const double time = segment * p.bed.spacing / norm(v);
        const Vector3 next = x + time * v;
        meets = surface.blocks(x, next);
        x = next, v.z -= p.gravity.acceleration * time;
      }
      if (!meets) ++free;
    }
    if (2 * free > paths) past.push_back(n);
  }
  return past;
}

InletLayer layer_of(const Layout& layout, const Inlet& inlet) {
  const Parameters& p = layout.given;
  const Surface& surface = layout.boundary->vessel();
  const Domain& domain = layout.boundary->domain();
  const double mass = layout.lattice.mass;
  InletLayer layer;
  const double room = sph::contact_distance * p.bed.spacing;
  for (const Vector3& x : lattice_in(p, inlet))
    if (!surface.nearest(x, room) && !domain.is_near_wall(x, room)) layer.places.push_back(x);
  layer.interval = static_cast<double>(layer.places.size()) * mass / inlet.rate;
  // Continuity keeps what separates a density from the kernel's sum (begin_densities), so that grains come in with
  // that of the stream, which goes on above them.
  const double bed = p.bed.packing * p.grains.density;
  const double h = p.sph.smoothing_ratio * sph::smoothing_length(mass, bed);
  const Vector3 step = layer.interval * Vector3{inlet.velocity[0], inlet.velocity[1], inlet.velocity[2]};
  const int layers = std::min(100, static_cast<int>(std::ceil(sph::support * h / std::max(norm(step), 1e-3 * h))));
  for (const Vector3& x : layer.places) {
    double sum = 0;
    for (int k = -layers; k <= layers; ++k)
      for (const Vector3& y : layer.places) sum += mass * sph::cubic_spline(norm(x - y - double(k) * step), h);
    layer.density.push_back(is_loose_where_free(p) ? std::min(bed, sum) : bed);
  }
  return layer;
}

std::vector<Problem> check_inlets(const Layout& layout) {
  const Parameters& p = layout.given;
  std::vector<Problem> problems;
  const auto refuse = [&](std::string key, std::string what, std::string allowed) {
    problems.push_back({.key = std::move(key), .what = std::move(what), .allowed = std::move(allowed)});
  };
  const bool sized = p.bed.spacing > 0 && p.box.width > 0 && p.box.depth > 0 && p.box.height > 0 &&
                     (p.bed.height > 0 || layout.has_no_bed());
  for (std::size_t n = 0; n < p.inlets.size(); ++n) {
    const Inlet& inlet = p.inlets[n];
    const auto& x = inlet.centre;
    const bool inside =
        x[0] > 0 && x[0] < p.box.width && x[1] > 0 && x[1] < p.box.depth && x[2] > 0 && x[2] < p.box.height;
    if (!inside) refuse(inlet_key(n, "centre"), "is not within the box", "a place within it");
    if (p.removal.below && x[2] <= *p.removal.below)
      refuse(inlet_key(n, "centre"),
             fmt::format("is {:.4g} mm high, and what is below {:.4g} mm is taken away at once", x[2] / millimetre,
                         *p.removal.below / millimetre),
             "a place above removal.below");
    if (!(inlet.velocity[2] < 0)) refuse(inlet_key(n, "velocity"), "is not downwards", "a z below 0 m/s");
    if (inlet.to && !(*inlet.to > inlet.from))
      refuse(inlet_key(n, "to"), fmt::format("{:g} s is not after `from`", *inlet.to), "a later time");
    if (!inlet.to && inlet.clock == InletClock::start && p.gate.opens == GateOpens::when_settled)
      refuse(inlet_key(n, "to"), "is not given: the bed would never settle", "a time, or clock = \"gate\"");
    if (!inside || !(inlet.velocity[2] < 0) || !sized) continue;
    const double mass = layout.lattice.mass;
    const InletLayer layer = layer_of(layout, inlet);
    const double most = static_cast<double>(layer.places.size()) * mass * -inlet.velocity[2] / p.bed.spacing;
    if (layer.places.empty())
      refuse(inlet_key(n, "centre"), "leaves no place for grains between the walls", "a place apart from walls");
    else if (!(inlet.rate <= most * (1 + 1e-9)))
      refuse(inlet_key(n, "rate"),
             fmt::format(
                 "{:.4g} kg/s do not fit through {:.4g} mm2 at that speed", inlet.rate,
                 static_cast<double>(layer.places.size()) * p.bed.spacing * p.bed.spacing / (millimetre * millimetre)),
             fmt::format("at most {:.4g} kg/s", most));
  }
  if (p.air.enabled && (!p.inlets.empty() || p.removal.is_any()))
    refuse("air.enabled", "with air grains neither come in nor are taken away yet", "false with inlets or removal");
  return problems;
}

}  // namespace talus::continuum

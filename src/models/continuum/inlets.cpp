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

/// Along an axis: how much faces that mirror cut off at either end.
struct Cut {
  double low = 0, high = 0;  ///< m
};

double extent_along(const Inlet& inlet, int axis) {
  return inlet.shape == InletShape::disc ? 2 * inlet.radius : axis == 0 ? inlet.width : inlet.depth;
}

Cut cut_along(const Box& box, const Inlet& inlet, int axis) {
  const double half = 0.5 * extent_along(inlet, axis), centre = inlet.centre[static_cast<std::size_t>(axis)];
  const auto beyond = [&](int side, double distance) {
    return is_mirror(box.face(axis, side)) ? std::max(0.0, distance) : 0.0;
  };
  return {beyond(0, box.low[axis] - (centre - half)), beyond(1, centre + half - box.high[axis])};
}

/// Of the lattice, without regard to walls, in what faces leave of the window: beyond them places would be those of
/// images. Across a periodic box no more than fit between its faces.
std::vector<Vector3> lattice_in(const Layout& layout, const Inlet& inlet) {
  const double spacing = layout.given.bed.spacing;
  const Box& box = layout.boundary->domain().box();
  std::array<std::vector<double>, 2> along;  // from the centre, m
  for (int axis = 0; axis < 2; ++axis) {
    const auto [low, high] = cut_along(box, inlet, axis);
    double spacings = std::min(max_along_side, (extent_along(inlet, axis) - low - high) / spacing);
    if (box.is_periodic(axis)) spacings = std::min(spacings, std::floor(box.extent(axis) / spacing * (1 + 1e-9)));
    const std::int64_t count = std::max<std::int64_t>(1, std::llround(spacings));
    for (std::int64_t i = 0; i < count; ++i)
      along[static_cast<std::size_t>(axis)].push_back(
          0.5 * (low - high) + (static_cast<double>(i) - 0.5 * static_cast<double>(count - 1)) * spacing);
  }
  std::vector<Vector3> places;
  for (const double y : along[1])
    for (const double x : along[0])
      if (inlet.shape != InletShape::disc || x * x + y * y <= inlet.radius * inlet.radius)
        places.push_back({inlet.centre[0] + x, inlet.centre[1] + y, inlet.centre[2]});
  return places;
}

/// Whether a place is so near to a face that it and its image press on each other: nearer than a lattice of whole
/// spacings in a window ends at its edge.
bool is_at_face(const Box& box, const Vector3& x, double spacing) {
  constexpr double least = 0.25 * (1 - 1e-9);  // in spacings
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side)
      if (is_mirror(box.face(axis, side)) &&
          std::abs(x[axis] - box.bound(axis, side)) < std::min(least * spacing, 0.49 * box.extent(axis)))
        return true;
  return false;
}

}  // namespace

std::string inlet_key(std::size_t n, std::string_view name) {
  return fmt::format("inlet.{}.{}", n + 1, name);
}

std::optional<CutWindow> cut_window(const Layout& layout, const Inlet& inlet) {
  constexpr double least = 1e-6;  // of the window
  const Box& box = layout.boundary->domain().box();
  CutWindow window{.width = extent_along(inlet, 0), .depth = extent_along(inlet, 1)};
  bool is_cut = false;
  for (int axis = 0; axis < 2; ++axis) {
    const Cut cut = cut_along(box, inlet, axis);
    const double notable = least * extent_along(inlet, axis);
    const auto cuts = [&](int side, double off) {
      is_cut = is_cut || off > notable;
      window.by_wall = window.by_wall || (off > notable && box.face(axis, side) != FaceKind::symmetry);
    };
    cuts(0, cut.low), cuts(1, cut.high);
    (axis == 0 ? window.width : window.depth) -= cut.low + cut.high;
  }
  return is_cut ? std::optional(window) : std::nullopt;
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
    const std::vector<Vector3> places = lattice_in(layout, p.inlets[n]);
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
  for (const Vector3& x : lattice_in(layout, inlet))
    if (!surface.nearest(x, room) && !domain.is_near_wall(x, room) && !is_at_face(domain.box(), x, p.bed.spacing))
      layer.places.push_back(x);
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
        x[0] >= 0 && x[0] <= p.box.width && x[1] >= 0 && x[1] <= p.box.depth && x[2] > 0 && x[2] < p.box.height;
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
                 "{:.4g} kg/s do not fit through {:.4g} mm2{} at that speed", inlet.rate,
                 static_cast<double>(layer.places.size()) * p.bed.spacing * p.bed.spacing / (millimetre * millimetre),
                 cut_window(layout, inlet) ? ", what faces of the box leave of the window," : ""),
             fmt::format("at most {:.4g} kg/s", most));
  }
  if (p.air.enabled && (!p.inlets.empty() || p.removal.is_any()))
    refuse("air.enabled", "with air grains neither come in nor are taken away yet", "false with inlets or removal");
  return problems;
}

}  // namespace talus::continuum

// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/population.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/exact_sum.hpp"
#include "models/continuum/columns.hpp"
#include "numerics/cell_grid.hpp"

namespace talus::continuum {

namespace {

constexpr double room_between = 0.8;  // particles that come in and those that are there, in spacings
constexpr double beyond_faces = 2;    // in spacings
constexpr std::int64_t tag_of_inlets = -1;

bool has_room(const Parameters& p, const State& s, const Share& share, const InletLayer& layer, const Vector3& moved) {
  const double fine = p.bed.spacing;
  Vector3 low = layer.places.front(), high = low;
  for (const Vector3& x : layer.places)
    for (int axis = 0; axis < 3; ++axis)
      low[axis] = std::min(low[axis], x[axis]), high[axis] = std::max(high[axis], x[axis]);
  bool has_room = true;
  for (std::size_t i = 0; i < s.position.size() && has_room; ++i) {
    if (!share.owns(i)) continue;
    const Vector3 x = s.position[i] - moved;
    const double room = room_between * 0.5 * (fine + fine * std::cbrt(s.mass_of(i) / s.mass));
    bool near = true;
    for (int axis = 0; axis < 3; ++axis) near = near && x[axis] > low[axis] - room && x[axis] < high[axis] + room;
    if (!near) continue;
    for (const Vector3& place : layer.places) has_room = has_room && !(dot(x - place, x - place) < room * room);
  }
  return all_of(share.ranks(), has_room);
}

/// The first process adds the layer; the particles go to their owners when lists are built.
void add(State& s, Share& share, const InletLayer& layer, const Vector3& velocity, const Vector3& moved) {
  const std::size_t before = s.position.size(), count = layer.places.size();
  if (share.ranks().is_first()) resize_columns(s, before + count);
  for (std::size_t i = before; i < s.position.size(); ++i) {
    const std::size_t n = i - before;
    s.position[i] = layer.places[n] + moved;
    s.velocity[i] = velocity;
    s.density[i] = layer.density[n];
    if (s.has.mass_ratio) s.mass_ratio[i] = 1;
    s.identity[i] = static_cast<std::int64_t>(s.population.next_identity + n);
    if (s.has.tag) s.tag[i] = tag_of_inlets;
    if (s.has.reset_position) s.reset_position[i] = s.position[i];
  }
  share.add(count);
  s.population.next_identity += count;
  s.population.fed += count;
  s.population.fed_momentum += (s.mass * static_cast<double>(count)) * velocity;
}

bool is_outside(const Parameters& p, const Box& box, const Vector3& x) {
  if (p.removal.below && x.z < *p.removal.below) return true;
  if (!p.removal.outside) return false;
  for (int axis = 0; axis < 3; ++axis)
    if (x[axis] < box.low[axis] - beyond_faces * p.bed.spacing ||
        x[axis] > box.high[axis] + beyond_faces * p.bed.spacing)
      return true;
  return false;
}

}  // namespace

void fit(const Parameters& p, const State& s, Workspace& w) {
  const std::size_t count = s.position.size();
  w.position.resize(count);
  w.smoothing_length.resize(count);
  if (p.integration.method != Method::runge_kutta) return;
  w.velocity.resize(count);
  w.density.resize(count);
  w.midpoint_smoothing_length.resize(count);
  w.columns = s.material;
}

Population initial_population(const Layout& layout, std::size_t particles) {
  const Parameters& p = layout.given;
  Population population;
  population.is_active = !p.inlets.empty() || p.removal.is_any() || has_several_masses(p);
  population.next_identity = particles;
  for (const Inlet& inlet : p.inlets)
    population.next_layer.push_back(inlet.from + 0.5 * layer_of(layout, inlet).interval);
  return population;
}

bool feed(const Parameters& p, State& s, Workspace& w) {
  bool fed = false;
  for (std::size_t n = 0; n < p.inlets.size(); ++n) {
    const Inlet& inlet = p.inlets[n];
    if (inlet.clock == InletClock::gate && s.gate_time < 0) continue;
    const double now = inlet.clock == InletClock::gate ? s.time - s.gate_time : s.time;
    const Vector3 velocity{inlet.velocity[0], inlet.velocity[1], inlet.velocity[2]};
    double& next = s.population.next_layer[n];
    while (now >= next && next <= inlet.end()) {
      const InletLayer& layer = w.inlets[n];
      const Vector3 moved = (now - next) * velocity;
      if (!has_room(p, s, w.share, layer, moved)) {
        next = now;
        break;
      }
      add(s, w.share, layer, velocity, moved);
      next += layer.interval;
      fed = true;
    }
  }
  if (fed) fit(p, s, w);
  return fed;
}

bool remove_particles(const Parameters& p, State& s, Workspace& w) {
  if (!p.removal.is_any()) return false;
  std::vector<std::uint32_t> left;
  const FixedPoint point(s.impulse_unit);
  FixedVector taken;
  std::uint64_t units = 0;  // of mass
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    if (is_outside(p, w.boundary.domain().box(), s.position[i])) {
      taken.add(point, s.mass_of(i) * s.velocity[i]);
      units += s.units_of(i);
    } else {
      left.push_back(static_cast<std::uint32_t>(i));
    }
  }
  sum_up(w.share.ranks(), std::span(&taken, 1));
  const std::size_t gone = w.share.is_all() ? s.position.size() - left.size() : w.share.remove(left);
  s.population.removed_momentum += taken.value(point);
  if (gone == 0) return false;
  s.population.removed += sum_of(w.share.ranks(), units);
  select(s, left);
  fit(p, s, w);
  return true;
}

bool has_emptied(const Parameters& p, const State& s, std::size_t particles) {
  if (particles > 0 || s.population.removed == 0) return false;
  for (std::size_t n = 0; n < p.inlets.size(); ++n) {
    const bool waits = p.inlets[n].clock == InletClock::gate && s.gate_time < 0;
    if (waits || s.population.next_layer[n] <= p.inlets[n].end()) return false;
  }
  return true;
}

double mass_to_come(const Parameters& p, double end, double gate) {
  double mass = 0;
  for (const Inlet& inlet : p.inlets) {
    const double last = inlet.clock == InletClock::gate ? end : gate + end;
    mass += inlet.rate * std::max(0.0, std::min(inlet.end(), last) - inlet.from);
  }
  return mass;
}

void sort_for_locality(State& state, Share& share, double cell_size) {
  if (share.is_all())
    select(state, spatial_order(state.position, cell_size));
  else
    share.sort(state, cell_size);
}

}  // namespace talus::continuum

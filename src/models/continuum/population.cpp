// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/population.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "base/exact_sum.hpp"
#include "numerics/cell_grid.hpp"

namespace talus::continuum {

namespace {

constexpr double room_between = 0.8;  // particles that come in and those that are there, in spacings
constexpr double beyond_faces = 2;    // in spacings
constexpr std::int64_t tag_of_inlets = -1;

/// Gives every column of particles one entry for each of `order`, those of these particles.
void select(State& state, const std::vector<std::uint32_t>& order) {
  const auto take = [&]<class Member>(const FieldInfo& field, Member& column) {
    if constexpr (!std::is_arithmetic_v<Member>) {
      if (!field.of_particles || column.empty()) return;
      Member kept(order.size());
      for (std::size_t n = 0; n < order.size(); ++n) kept[n] = column[order[n]];
      column = std::move(kept);
    }
  };
  for_each_field(take, state);
}

/// Makes every column of particles so long; new entries are zero.
void lengthen(State& state, std::size_t count) {
  const auto resize = [&]<class Member>(const FieldInfo& field, Member& column) {
    if constexpr (!std::is_arithmetic_v<Member>)
      if (field.of_particles) column.resize(count);
  };
  for_each_field(resize, state);
}

/// The workspace for as many particles as the state has.
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

bool has_room(const Parameters& p, const State& s, const InletLayer& layer, const Vector3& moved) {
  const double room = room_between * p.bed.spacing;
  Vector3 low = layer.places.front(), high = low;
  for (const Vector3& x : layer.places)
    for (int axis = 0; axis < 3; ++axis)
      low[axis] = std::min(low[axis], x[axis]), high[axis] = std::max(high[axis], x[axis]);
  for (const Vector3& at : s.position) {
    const Vector3 x = at - moved;
    bool near = true;
    for (int axis = 0; axis < 3; ++axis) near = near && x[axis] > low[axis] - room && x[axis] < high[axis] + room;
    if (!near) continue;
    for (const Vector3& place : layer.places)
      if (dot(x - place, x - place) < room * room) return false;
  }
  return true;
}

void add(State& s, const InletLayer& layer, const Vector3& velocity, const Vector3& moved) {
  const std::size_t before = s.position.size(), count = before + layer.places.size();
  lengthen(s, count);
  for (std::size_t n = 0; n < layer.places.size(); ++n) {
    const std::size_t i = before + n;
    s.position[i] = layer.places[n] + moved;
    s.velocity[i] = velocity;
    s.density[i] = layer.density[n];
    s.identity[i] = static_cast<std::int64_t>(s.population.next_identity++);
    if (s.has.tag) s.tag[i] = tag_of_inlets;
    if (s.has.reset_position) s.reset_position[i] = s.position[i];
  }
  s.population.fed += layer.places.size();
  s.population.fed_momentum += (s.mass * static_cast<double>(layer.places.size())) * velocity;
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

Population initial_population(const Layout& layout, std::size_t particles) {
  const Parameters& p = layout.given;
  Population population;
  population.is_active = !p.inlets.empty() || p.removal.is_any();
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
      if (!has_room(p, s, layer, moved)) {
        next = now;
        break;
      }
      add(s, layer, velocity, moved);
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
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    if (is_outside(p, w.boundary.domain().box(), s.position[i]))
      taken.add(point, s.mass * s.velocity[i]);
    else
      left.push_back(static_cast<std::uint32_t>(i));
  }
  const std::size_t gone = s.position.size() - left.size();
  s.population.removed_momentum += taken.value(point);
  if (gone == 0) return false;
  s.population.removed += gone;
  select(s, left);
  fit(p, s, w);
  return true;
}

bool has_emptied(const Parameters& p, const State& s) {
  if (!s.position.empty() || s.population.removed == 0) return false;
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

void sort_for_locality(State& state, double cell_size) {
  select(state, spatial_order(state.position, cell_size));
}

}  // namespace talus::continuum

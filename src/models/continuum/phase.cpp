// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/step.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"

namespace talus::continuum {

namespace {

/// What lay on a gate that has gone faces nothing: its kernel's sum loses the gate's images, and its density with it; a
/// gate that is there again hides what has passed it. The step's velocity gradients are still to be used, and go with
/// the particles.
void move_gates(ThreadTeam& team, const Parameters& p, State& s, Workspace& w) {
  const double time = s.time - s.gate_time;
  if (!w.boundary.has_gates_due(time)) return;
  const bool in_vessel = w.boundary.vessel_has_gates_due(time);
  evaluate(team, p, s, w);
  std::vector<double> before = w.rates.kernel_density;
  w.boundary.move_gates(time);
  if (in_vessel) {  // who was hidden by the gate is a neighbour now, and the reverse
    std::vector<std::vector<double>*> carried{&before};
    for (std::vector<double>& component : w.rates.velocity_gradient.component) carried.push_back(&component);
    for (std::vector<double>* const column : carried) w.share.keep_owned(*column);
    drop_halo(p, s, w);
    set_list_reference(p, s, w);
    build_lists(team, p, s, w, carried);
  }
  if (!is_loose_where_free(p)) return;
  evaluate(team, p, s, w);
  for_each(team, s.density.size(), [&](std::size_t i) { s.density[i] += w.rates.kernel_density[i] - before[i]; });
}

/// How many are beside or below the box around the vessel; those past a periodic face come back at the next list build.
std::size_t outside_vessel(const Parameters& p, const std::vector<Vector3>& position, const Share& share) {
  VesselBounds room{{0, 0, 0}, {p.box.width, p.box.depth, p.box.height}};
  if (!p.vessel.empty()) {
    const VesselBounds vessel = bounds_of_vessel(p);
    for (int axis = 0; axis < 3; ++axis)
      room.low[axis] = std::max(room.low[axis], vessel.low[axis]),
      room.high[axis] = std::min(room.high[axis], vessel.high[axis]);
  }
  const bool ends_along_x = p.box.left != FaceKind::periodic, ends_along_y = p.box.front != FaceKind::periodic;
  std::size_t outside = 0;
  for (std::size_t i = 0; i < position.size(); ++i) {
    const Vector3& x = position[i];
    outside += share.owns(i) && ((ends_along_x && (x.x < room.low.x || x.x > room.high.x)) ||
                                 (ends_along_y && (x.y < room.low.y || x.y > room.high.y)) || x.z < room.low.z);
  }
  return outside;
}

/// How many have left it since the start, those that were taken away among them.
std::size_t left_vessel(const Layout& layout, const State& s, const Share& share) {
  const std::size_t before = outside_vessel(layout.given, bed_positions(layout), Share(one_process())),
                    now = sum_of(share.ranks(), outside_vessel(layout.given, s.position, share));
  const double removed = static_cast<double>(s.population.removed) * (s.mass_unit() / s.mass);
  return (now > before ? now - before : 0) + static_cast<std::size_t>(removed);
}

}  // namespace

void begin_densities(ThreadTeam& team, const Setup& setup, State& s, Workspace& w) {
  const Parameters& p = setup.given;
  if (!is_loose_where_free(p)) return;
  // Particles of a file keep the densities that it gives them.
  const std::size_t given = p.bed.given ? p.bed.given->density.size() : 0;
  evaluate(team, p, s, w);
  const double bed = setup.density;
  for_each(team, s.density.size(), [&](std::size_t i) {
    if (static_cast<std::size_t>(s.identity[i]) >= given) s.density[i] = std::min(bed, w.rates.kernel_density[i]);
  });
  update_smoothing_lengths(team, s, w);
  find_neighbours(team, p, s, w);
}

std::uint64_t count_moving(ThreadTeam& team, const Setup& setup, const Share& share, const State& s) {
  const double limit = setup.scales.settled_speed * setup.scales.settled_speed;
  return reduce(
      team, s.velocity.size(), std::uint64_t{0},
      [&](std::size_t i) { return std::uint64_t{dot(s.velocity[i], s.velocity[i]) >= limit && share.owns(i)}; },
      [](std::uint64_t a, std::uint64_t b) { return a + b; });
}

void update_phase(ThreadTeam& team, const Setup& setup, std::uint64_t moving, State& s, Workspace& w) {
  const Parameters& p = setup.given;
  const TimeScales& scales = setup.scales;
  const std::size_t count = w.share.of_all(s.velocity.size());
  const bool quiet = s.time >= setup.loading.time() && 100 * moving <= count;
  if (!quiet) s.quiet_time = -1;
  if (quiet && s.quiet_time < 0) s.quiet_time = s.time;
  if (s.gate_time >= 0) return move_gates(team, p, s, w);
  const bool settled = quiet && !is_being_filled(p.inlets, s.time) && s.time - s.quiet_time >= scales.settled_duration;
  if (p.gate.opens == GateOpens::at_time ? s.time >= p.gate.time : settled) {
    s.gate_time = s.time;
    w.share.join_window(s.wall_loads);
    begin_flow(w.load_fields, s.time, s.wall_loads);
    move_gates(team, p, s, w);
  } else if (p.gate.opens == GateOpens::when_settled && s.time > scales.settling_limit) {
    const std::size_t left = left_vessel(setup, s, w.share);
    const std::string gone = left > 0 ? fmt::format(", {} have left the vessel", left) : "";
    const std::string leak = left > 0 ? "first a wall, lid or gate where the vessel is open (talus check names rims of "
                                        "STL files below the top of the bed); then "
                             : p.gravity.tilt > 0
                                 ? "where it flows down the incline gate.opens = \"from-the-start\"; else "
                                 : "";
    throw NumericalError({.what = fmt::format("the bed is still moving after {:.3g} s", s.time),
                          .term = fmt::format("{} of {} particles are faster than settle.speed{}", moving, count, gone),
                          .place = "the bed",
                          .step = s.step,
                          .time = s.time,
                          .advice = leak +
                                    "a shorter settle.damping_time, a larger settle.speed or settle.max_time; along "
                                    "inclined walls, walls.friction_from = \"start\""});
  }
}

}  // namespace talus::continuum

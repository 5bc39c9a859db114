// SPDX-License-Identifier: Apache-2.0
/// The answers about a vessel in space: the third part of the list of hopper_measures.cpp.
#include <cmath>
#include <numbers>
#include <optional>

#include "analysis/discharge.hpp"
#include "analysis/hopper_estimators.hpp"
#include "analysis/particle_field.hpp"
#include "analysis/statistics.hpp"
#include "analysis/wall_loads.hpp"

namespace talus::hopper {

namespace {

using Run = HopperRun;
using Row = Measure<Run>;

constexpr double hardly = 0.1;  // of the mean speed: what is slower rests

bool vessel(const Run& run) {
  return !run.setting.section.empty();
}
bool vessel_with_outlet(const Run& run) {
  return vessel(run) && run.setting.shape.outlet.has_value();
}
bool vessel_with_slit(const Run& run) {
  return vessel_with_outlet(run) && run.setting.outlet_length > 0;
}

bool cone(const Run& run) {
  return !std::isnan(run.setting.mass_flow_half_angle);
}

bool has_upright_walls(const Run& run) {
  for (const BandOfWall& band : run.setting.bands)
    if (band.is_upright()) return true;
  return false;
}

bool outlet(const Run& run) {
  return run.setting.shape.outlet.has_value();
}
/// As a chute or a belt does.
bool passes_grains_on(const Run& run) {
  if (!vessel(run) || outlet(run) || !run.series.has("removed_mass")) return false;
  const auto removed = run.series.column("removed_mass");
  return !removed.empty() && removed.back() > 0;
}
bool hand_formula(const Run& run) {
  return outlet(run) && run.setting.hand_discharge > 0;
}
bool bed_and_hand_formula(const Run& run) {
  return hand_formula(run) && run.setting.particles > 0;
}

/// Upward force of all walls on the settled bed over its weight, less 1.
double balance_at_rest(const Run& run, const Window&) {
  const double weight = run.setting.mass() * run.setting.gravity;
  return weight_balance_error(run.series, weight, run.gate_time - averages(run).load, run.gate_time);
}

/// The last snapshot before the gate opened; nothing without one.
std::optional<std::size_t> settled_snapshot(const Run& run) {
  const std::vector<double>& time = run.snapshots.time();
  if (time.empty() || time.front() > averages(run).load) return std::nullopt;
  std::size_t last = 0;
  for (std::size_t n = 0; n < time.size(); ++n)
    if (time[n] <= 0) last = n;
  return last;
}

double settled(const Run& run, Number number) {
  const auto last = settled_snapshot(run);
  return last ? run.snapshots.value(*last, number) : no_value;
}

/// Whether walls bear as much at the last snapshot before the gate opened as when it opened: the bed may still be
/// getting its weight.
bool is_settled_bed_loaded(const Run& run) {
  constexpr double slack = 0.05;
  const auto last = settled_snapshot(run);
  if (!last) return false;
  const double weight = run.setting.mass() * run.setting.gravity, load = averages(run).load;
  const auto borne = [&](double until) { return 1 + weight_balance_error(run.series, weight, until - load, until); };
  const double at_opening = borne(run.gate_time), then = borne(run.gate_time + run.snapshots.time()[*last]);
  return std::abs(then - at_opening) <= slack * std::abs(at_opening);
}

/// Whether walls and floor bear the bed, before the gate opened or, where it had no time to settle, after: not if it
/// falls.
bool is_borne(const Run& run) {
  constexpr double enough = 0.5;
  const double weight = run.setting.mass() * run.setting.gravity, load = averages(run).load;
  const auto borne = [&](double from) { return 1 + weight_balance_error(run.series, weight, from, from + load); };
  const double before = borne(run.gate_time - load), after = borne(run.gate_time);
  return before >= enough || after >= enough || (std::isnan(before) && std::isnan(after));
}

/// Of the grains that rest: a stream from an inlet falls faster.
double top_of_bed(const HopperSnapshot& s) {
  const double fast = std::sqrt(s.setting.gravity * s.shape().spacing);
  const auto position = s.now.positions(), velocity = s.now.vectors("velocity");
  std::vector<double> heights;
  for (std::size_t i = 0; i < position.size(); ++i)
    if (!(norm(velocity[i]) > fast)) heights.push_back(position[i].z);
  return heights.empty() ? no_value : quantile(heights, 0.995) + 0.5 * s.shape().spacing;
}

/// Whether a band of the walls is upright, in the bed, and the bed reaches its top.
bool is_filled(const BandOfWall& band, double top) {
  return band.is_upright() && !band.is_bare && band.high <= top && band.area > 0;
}

/// Sum over the filled bands of their area times the mean vertical stress of the bed at their heights, N.
double vertical_force_beside_walls(const HopperSnapshot& s) {
  const double top = top_of_bed(s);
  double force = 0;
  for (const BandOfWall& band : s.setting.bands)
    if (is_filled(band, top))
      force += band.area * mean_between(s.now.positions(), s.now.scalars("stress_zz"), band.low, band.high);
  return force;
}

}  // namespace

double settled_top(const HopperRun& run) {
  return is_borne(run) ? settled(run, top_of_bed) : no_value;
}

double wall_pressure_ratio(const HopperRun& run, const Window&) {
  const double top = settled_top(run);
  double of_walls = 0;
  for (const BandOfWall& band : run.setting.bands)
    if (is_filled(band, top))
      of_walls +=
          band.area * load_of(run.series, band, run.gate_time, 0, 0, run.setting.averaging_time).pressure_at_rest;
  const double of_bed = is_settled_bed_loaded(run) ? settled(run, vertical_force_beside_walls) : no_value;
  return of_bed > 0 ? of_walls / of_bed : no_value;
}

double mean_speed_above(double height, const Snapshot& now, std::span<const double> speed) {
  const auto positions = now.positions();
  const MassRatios ratios = now.mass_ratios();
  double sum = 0, mass = 0;
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (positions[i].z >= height && std::isfinite(speed[i])) sum += ratios[i] * speed[i], mass += ratios[i];
  return sum / mass;
}

namespace {

/// Packing above the outlet, in the n-th layer as high as it is wide, from 0: in its own width, or beside it, up to
/// twice that width.
double packing_above_outlet(const HopperSnapshot& s, int layer, bool beside) {
  const HopperShape& shape = s.shape();
  const HopperSetting& of = s.setting;
  if (!shape.outlet || !(of.outlet_width > 0)) return no_value;
  const double height = of.outlet_width, half_width = 0.5 * (shape.outlet->right - shape.outlet->left);
  const Vector3 middle{shape.outlet->left + half_width, of.section.empty() ? 0.5 * shape.depth : of.middle, 0};
  const double from = beside ? half_width : 0, to = beside ? 2 * half_width : half_width;
  double inside = 0;
  const auto positions = s.now.positions();
  const MassRatios ratios = s.now.mass_ratios();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vector3& x = positions[i];
    const double sideways = std::abs(x.x - middle.x), along = std::abs(x.y - middle.y);
    const double up = x.z - shape.outlet->height - layer * height;
    if (up < 0 || up > height) continue;
    const double distance = of.outlet_is_round ? std::hypot(sideways, along) : sideways;
    if (distance >= from && distance <= to && (of.outlet_is_round || along <= 0.5 * of.outlet_depth))
      inside += ratios[i];
  }
  // Planes of symmetry through the outlet leave a part of its grains.
  const Box& box = of.domain.box();
  const auto share = [&](int axis, double half) {
    return (std::min(box.high[axis], middle[axis] + half) - std::max(box.low[axis], middle[axis] - half)) / (2 * half);
  };
  const double area = (of.outlet_is_round ? std::numbers::pi * (to * to - from * from) * share(1, to)
                                          : 2 * (to - from) * of.outlet_depth * share(1, 0.5 * of.outlet_depth)) *
                      share(0, to);
  return inside * of.particle_mass / (of.grain_density * area * height);
}

/// So high above the outlet its width is empty, while grains stand beside it.
double rathole_height(const HopperSnapshot& s) {
  const double least = 0.3 * s.setting.bed_packing, width = s.setting.outlet_width;
  if (!s.shape().outlet || !(width > 0)) return no_value;
  int high = 0;
  for (int layer = 0; s.shape().outlet->height + layer * width < s.shape().height; ++layer) {
    if (!(packing_above_outlet(s, layer, false) < least)) break;
    if (packing_above_outlet(s, layer, true) >= least) high = layer + 1;
  }
  return high * width;
}

}  // namespace

double outlet_packing(const HopperSnapshot& s) {
  return packing_above_outlet(s, 0, false);
}

double share_in_motion(const HopperRun& run, const Window& window) {
  const Curve share = discharged_share(run);
  const double from = first_time_at_or_below(scaled(share, -1), -share_of_regime);
  const std::vector<double>& time = run.snapshots.time();
  if (!std::isfinite(from) || time.empty()) return no_value;
  const double at = std::max(from, window.at.value_or(run.end()));
  const std::size_t nearest = nearest_point(time, std::min(at, run.end()));
  return time[nearest] > flow_end(run).stop_time ? no_value : run.snapshots.value(nearest, share_that_moves);
}

double share_that_moves(const HopperSnapshot& s) {
  const Snapshot* before = s.before ? s.before() : nullptr;
  if (!before || !s.shape().outlet) return no_value;
  const std::vector<double> speed = mean_speeds(*before, s.now, s.setting.computed);
  const auto positions = s.now.positions();
  const MassRatios ratios = s.now.mass_ratios();
  const double outlet = s.shape().outlet->height, rests = hardly * mean_speed_above(outlet, s.now, speed);
  double above = 0, moving = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    // The speed of what has come in or split since the last snapshot is not known.
    if (positions[i].z < outlet || !std::isfinite(speed[i])) continue;
    above += ratios[i];
    if (speed[i] > rests) moving += ratios[i];
  }
  return above > 0 ? moving / above : no_value;
}

std::vector<Row> hopper_vessel_measures() {
  return {
      Row("discharge_steady", "kg/s",
          "mean of Q over the longest stretch of means over T, five at least, that lie within 10 % of their own mean, "
          "between 10 % and 70 % discharged; none where less than 5 % of the bed leaves within it",
          {[](const Run& r, const Window&) { return steady_discharge(r).value; }}, {outlet}),
      Row("discharge_steady_error", "kg/s",
          "half width of the 95 % interval of that mean, by Student's t of the means of blocks, five at least, each "
          "longer than the correlation time; none where the stretch is too short for that",
          {[](const Run& r, const Window&) { return steady_discharge(r).error; }}, {outlet}),
      Row("discharge_steady_from", "s", "where that stretch begins",
          {[](const Run& r, const Window&) { return steady_discharge(r).from; }}, {outlet}),
      Row("discharge_steady_to", "s", "where it ends",
          {[](const Run& r, const Window&) { return steady_discharge(r).to; }}, {outlet}),
      Row("discharge_steady_per_length", "kg/(s m)", "discharge_steady over the length of the slit",
          {[](const Run& r, const Window&) { return steady_discharge(r).value / r.setting.outlet_length; }},
          {vessel_with_slit}),
      Row("throughput", "kg/s",
          "of a chute or a belt, without an outlet: mean rate at which grains are taken away, over the longest stretch "
          "of means over T, five at least, that lie within 10 % of their own mean",
          {[](const Run& r, const Window&) { return steady_throughput(r).value; }}, {passes_grains_on}),
      Row("throughput_error", "kg/s", "as discharge_steady_error",
          {[](const Run& r, const Window&) { return steady_throughput(r).error; }}, {passes_grains_on}),
      Row("emptying_time", "s", "first time from the opening of the gate at which 99 % of M is below the outlet",
          {[](const Run& r, const Window&) {
            Curve left = discharged_share(r);
            for (double& share : left.value) share = 1 - share;
            return first_time_at_or_below(left, 0.01);
          }},
          {outlet}),
      Row("emptying_time_by_hand", "s", "0.99 M by discharge_rate_beverloo with gates open, without start and end",
          {[](const Run& r, const Window&) { return r.setting.hand_emptying_time; }}, {bed_and_hand_formula}),
      Row("share_that_moves", "1",
          "share by mass of particles above the outlet that are faster than a tenth of their mean; speed: displacement "
          "since the snapshot about T before, over the time between. From 0.99 on mass flow, below that funnel flow; "
          "none before 10 % have been discharged, or where the flow had stopped",
          {share_in_motion, share_that_moves}, {vessel_with_outlet, while_it_flows}),
      Row("residual_mass", "kg", "mass above the outlet at the end",
          {[](const Run& r, const Window&) { return flow_end(r).left; }}, {outlet}),
      Row("flow_stop_time", "s",
          "time of the last outflow from the opening of the gate on, where over three (D/g)^½ before the end of the "
          "run "
          "less than a hundredth of the discharge passed; none where it flows at the end, or nothing has passed",
          {[](const Run& r, const Window&) { return flow_end(r).stop_time; }}, {outlet}),
      Row("outlet_packing", "1",
          "packing in the space of the outlet's width and as high above it, at the end: of an arch that stands there, "
          "0.3 of the bed's at least",
          at(outlet_packing), {outlet}),
      Row("rathole_height", "m",
          "height above the outlet up to which its width is empty, at the end, and grains stand beside it, up to twice "
          "that "
          "width; in layers as high as the outlet is wide, with less and with more than 0.3 of the bed's packing",
          at(rathole_height), {outlet}),
      Row("mass_flow_half_angle_jenike", "deg",
          "half angle, from the vertical, up to which a cone empties in mass flow, analytical estimate: 90° − ½ "
          "acos((1 − sin φ)/(2 "
          "sin φ)) − ½ (φ_w + asin(sin φ_w/sin φ)) (Jenike 1961), φ = asin M of the grains' friction M, their angle in "
          "plane strain, φ_w = atan μ of the cone's wall",
          {[](const Run& r, const Window&) { return r.setting.mass_flow_half_angle * 180 / std::numbers::pi; }},
          {cone}),
      Row("wall_pressure_ratio", "1",
          "K: stress across the upright walls, from their impulses over T before the gate opened, over the mean "
          "τ_zz of the bed at the same heights, in the last snapshot before; none if walls bore another load then",
          {wall_pressure_ratio}, {has_upright_walls}),
      Row("weight_balance_error_at_rest", "1",
          "upward force of all walls, from their impulses over T before the gate opened, over M g, less 1",
          {balance_at_rest}, {vessel}),
  };
}

}  // namespace talus::hopper

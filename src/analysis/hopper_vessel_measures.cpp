// SPDX-License-Identifier: Apache-2.0
/// The answers about a vessel in space: the third part of the list of hopper_measures.cpp.
#include <cmath>
#include <numbers>

#include "analysis/discharge.hpp"
#include "analysis/displacement.hpp"
#include "analysis/hopper_estimators.hpp"
#include "analysis/plateau.hpp"
#include "analysis/statistics.hpp"
#include "analysis/wall_loads.hpp"

namespace talus::hopper {

namespace {

using Run = HopperRun;
using Row = Measure<Run>;

constexpr double none = Run::none;
constexpr double plateau_mean = 20e-3, plateau_spread = 0.1, load_time = 20e-3;
constexpr double hardly = 0.1;  // of the mean speed: what is slower rests

bool vessel(const Run& run) {
  return !run.setting.section.empty();
}
bool vessel_with_outlet(const Run& run) {
  return vessel(run) && run.setting.shape.plate.has_value();
}
bool vessel_with_hand_formula(const Run& run) {
  return vessel_with_outlet(run) && run.setting.hand_discharge > 0;
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

Plateau plateau(const Run& run) {
  return find_plateau(passed_mass(run), plateau_mean, plateau_spread, 0, run.end());
}

/// Upward force of all walls on the settled bed over its weight, less 1.
double balance_at_rest(const Run& run, const Place&, const Window&) {
  const double weight = run.setting.mass() * run.setting.gravity;
  return weight_balance_error(run.series, weight, run.gate_time - load_time, run.gate_time);
}

/// A number of the last snapshot before the gate opened.
double settled(const Run& run, Number number, const Place& place) {
  const std::vector<double>& time = run.snapshots.time();
  if (time.empty() || time.front() > load_time) return none;
  std::size_t last = 0;
  for (std::size_t n = 0; n < time.size(); ++n)
    if (time[n] <= 0) last = n;
  return run.snapshots.value(last, number, place);
}

double vertical_stress(const HopperSnapshot& s, const Place& place) {
  return mean_between(s.now.positions(), s.now.scalars("stress_zz"), length_of(place, "from"), length_of(place, "to"));
}

double top_of_bed(const HopperSnapshot& s, const Place&) {
  std::vector<double> heights;
  for (const Vector3& x : s.now.positions()) heights.push_back(x.z);
  return heights.empty() ? none : quantile(heights, 0.995) + 0.5 * s.shape().spacing;
}

}  // namespace

double settled_top(const HopperRun& run) {
  return settled(run, top_of_bed, {});
}

double wall_pressure_ratio(const HopperRun& run, const Place&, const Window&) {
  const double top = settled_top(run);
  double of_walls = 0, of_bed = 0;
  for (const BandOfWall& band : run.setting.bands) {
    if (!band.is_upright() || !(band.high <= top) || !(band.area > 0)) continue;
    of_walls += band.area * load_of(run.series, band, run.gate_time, 0, 0).pressure_at_rest;
    of_bed += band.area * settled(run, vertical_stress, {{"from", band.low}, {"to", band.high}});
  }
  return of_bed > 0 ? of_walls / of_bed : none;
}

double mean_speed_above(double height, std::span<const Vector3> positions, std::span<const double> speed) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (positions[i].z >= height && std::isfinite(speed[i])) sum += speed[i], ++count;
  return sum / count;
}

double share_that_moves(const HopperSnapshot& s, const Place&) {
  const Snapshot* before = s.before ? s.before() : nullptr;
  if (!before || !s.shape().plate) return none;
  const std::vector<double> speed = mean_speeds(*before, s.now);
  const auto positions = s.now.positions();
  const double outlet = s.shape().plate->height, rests = hardly * mean_speed_above(outlet, positions, speed);
  double above = 0, moving = 0;
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (positions[i].z >= outlet) ++above, moving += speed[i] > rests;
  return above > 0 ? moving / above : none;
}

std::vector<Row> hopper_vessel_measures() {
  return {
      Row("discharge_steady", "kg/s",
          "mean of Q over the longest stretch of 20 ms means, five at least, that lie within 10 % of their own mean, "
          "from half of the largest on",
          {[](const Run& r, const Place&, const Window&) { return plateau(r).value; }}, {{vessel_with_outlet}}),
      Row("discharge_steady_error", "kg/s",
          "two standard errors of that mean; where neighbouring means are alike, of as many as are independent",
          {[](const Run& r, const Place&, const Window&) { return plateau(r).error; }}, {{vessel_with_outlet}}),
      Row("discharge_steady_from", "s", "where that stretch begins",
          {[](const Run& r, const Place&, const Window&) { return plateau(r).from; }}, {{vessel_with_outlet}}),
      Row("discharge_steady_to", "s", "where it ends",
          {[](const Run& r, const Place&, const Window&) { return plateau(r).to; }}, {{vessel_with_outlet}}),
      Row("discharge_steady_per_length", "kg/(s m)", "discharge_steady over the length of the slit",
          {[](const Run& r, const Place&, const Window&) { return plateau(r).value / r.setting.outlet_length; }},
          {{vessel_with_slit}}),
      Row("emptying_time", "s", "first time from the opening of the gate at which 99 % of M is below the outlet",
          {[](const Run& r, const Place&, const Window&) {
            Curve left = discharged_share(r);
            for (double& share : left.value) share = 1 - share;
            return first_time_at_or_below(left, 0.01);
          }},
          {{vessel_with_outlet}}),
      Row("emptying_time_by_hand", "s", "0.99 M over discharge_rate_beverloo, without start and end",
          {[](const Run& r, const Place&, const Window&) {
            return 0.99 * r.setting.mass() / r.setting.hand_discharge;
          }},
          {{vessel_with_hand_formula}}),
      Row("share_that_moves", "1",
          "share of the particles above the outlet that are faster than a tenth of their mean; speed: displacement "
          "since the snapshot about 20 ms before, over the time between. From 0.99 on it is mass flow, below that "
          "funnel flow",
          at(share_that_moves), {{vessel_with_outlet, while_it_flows}}),
      Row("mass_flow_half_angle_jenike", "deg",
          "half angle, from the vertical, up to which a cone empties in mass flow by hand: 90° − ½ acos((1 − sin φ)/(2 "
          "sin φ)) − ½ (φ_w + asin(sin φ_w/sin φ)) (Jenike 1961), φ = asin M of the grains' friction M, their angle in "
          "plane strain, φ_w = atan μ of the cone's wall",
          {[](const Run& r, const Place&, const Window&) {
            return r.setting.mass_flow_half_angle * 180 / std::numbers::pi;
          }},
          {{cone}}),
      Row("wall_pressure_ratio", "1",
          "K: stress across the upright walls, from their impulses over 20 ms before the gate opened, over the mean "
          "τ_zz of the bed at the same heights, in the last snapshot before",
          {wall_pressure_ratio}, {{has_upright_walls}}),
      Row("weight_balance_error_at_rest", "1",
          "upward force of all walls, from their impulses over 20 ms before the gate opened, over M g, less 1",
          {balance_at_rest}, {{vessel}}),
  };
}

}  // namespace talus::hopper

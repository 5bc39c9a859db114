// SPDX-License-Identifier: Apache-2.0
#include "analysis/hopper_estimators.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "analysis/discharge.hpp"
#include "analysis/particle_field.hpp"
#include "analysis/statistics.hpp"
#include "analysis/wall_loads.hpp"

namespace talus::hopper {

namespace {

constexpr double nearly_all = 0.999, most = 0.95;
constexpr double min_slope_in_spacings = 10;

std::vector<bool> without_nan(std::vector<bool> taken, std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i) taken[i] = taken[i] && !std::isnan(values[i]);
  return taken;
}

// Of the averaging time: length and interval of the means whose maximum is sought, interval of data of which periods
// are, and the periods (the paper's: 6 ms, 0.2 ms; 5000 a second; 2 to 20 ms).
constexpr double extreme_mean = 0.3, extreme_every = 0.01, interval_of_data = 0.01, min_period = 0.1;
constexpr double begins_to_flow = 0.1, half = 0.5;  // of what passes the outlet
constexpr double plateau_spread = 0.1;

double end_of(const Window& window, const HopperRun& run) {
  return std::min(window.to, run.end());
}

/// The time that a window names, or the end; nan if the run ended before it, but for a few steps.
double time_of(const Window& window, const HopperRun& run) {
  const double at = window.at.value_or(Window::end_of_run), end = run.end();
  return at > end + averages(run).trend && !std::isinf(at) ? no_value : std::min(at, end);
}

std::vector<double> within(Number number, const HopperRun& run, const Window& window) {
  return part(run.curve(number), window.from, window.to).value;
}

/// A hundred data of the discharge in T over the window, or as much of it as the run covers; none if that is not half.
Curve fluctuating_discharge(const HopperRun& run, const Window& window) {
  const Curve curve = run.curve("discharge_rate");
  if (!covers(curve, window.from, 0.5 * (window.from + window.to))) return {};
  return at_equal_times(curve, 1 / (interval_of_data * run.setting.averaging_time), window.from,
                        std::min(window.to, curve.time.back()));
}

double first_time_at_or_above(const Curve& curve, double level) {
  return first_time_at_or_below(scaled(curve, -1), -level);
}

}  // namespace

double mass(const HopperSnapshot& s) {
  const MassRatios ratios = s.now.mass_ratios();
  double of_finest = 0;
  for (std::size_t i = 0; i < s.now.size(); ++i) of_finest += ratios[i];
  return of_finest * s.setting.particle_mass;
}

const FreeSurface& surface_in(const HopperSnapshot& s, Where where) {
  return where == Where::bin ? s.surfaces().bin : s.surfaces().hopper;
}

ReposeAngle repose_in(const HopperSnapshot& s, Where where) {
  const double least = min_slope_in_spacings * s.shape().spacing;
  return repose_angle(heap_slopes(surface_in(s, where), least, s.setting.tilt), s.shape().middle());
}

double quiescent_speed(const HopperSnapshot& s) {
  const Snapshot* before = s.before ? s.before() : nullptr;
  if (!before) return no_value;
  const std::vector<double> speed = mean_speeds(*before, s.now, s.setting.computed);
  return quantile_of(speed, without_nan(s.deep(), speed), most);
}

double packing_max(const HopperSnapshot& s) {
  return quantile(s.now.scalars("packing"), nearly_all);
}

double density_drift(const HopperSnapshot& s) {
  return talus::density_drift(s.now.scalars("density"), s.now.scalars("packing"), s.setting.grain_density, s.deep());
}

double stress_ratio(const HopperSnapshot& s) {
  return talus::stress_ratio(s.now, quasistatic_particles(s.now, s.inertial()));
}

double inertial_share(const HopperSnapshot& s) {
  return talus::inertial_share(s.inertial(), above_outlet(s.now.positions(), s.shape()), s.now.mass_ratios());
}

double left_right_imbalance(const HopperSnapshot& s) {
  double difference = 0;
  const auto positions = s.now.positions();
  const MassRatios ratios = s.now.mass_ratios();
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (positions[i].z < s.shape().bin().top)
      difference += positions[i].x < s.shape().middle() ? -ratios[i] : ratios[i];
  return std::abs(difference) / s.setting.particles;
}

Window while_it_flows(const HopperRun& run) {
  const Curve mass = discharged_mass(run);
  const double all = mass.value.empty() ? 0 : mass.value.back();
  if (!(all > 0)) return {.at = 0.5 * run.end(), .from = 0.5 * run.end(), .to = run.end()};
  const double from = first_time_at_or_above(mass, begins_to_flow * all), to = first_time_at_or_above(mass, half * all);
  return {.at = 0.5 * (from + to), .from = from, .to = to};
}

namespace {

/// M and what has come in, kg.
double mass_at_end(const HopperRun& run) {
  const Curve fed = run.curve("fed_mass");
  return run.setting.mass() + (fed.value.empty() ? 0 : fed.value.back());
}

}  // namespace

FlowEnd flow_end(const HopperRun& run) {
  constexpr double hardly = 0.01, emptied = 0.99, rest = 3;  // rest: of the time scale
  const Curve mass = discharged_mass(run), share = discharged_share(run);
  if (mass.value.empty()) return {};
  const double end = run.end(), length = std::min(run.setting.time_scale, 0.25 * end);
  const auto at_end = [](const Curve& curve) { return curve.value.back(); };
  const double passed = at_end(mass);
  FlowEnd flow{.discharged = at_end(share), .left = std::max(0.0, mass_at_end(run) - passed)};
  if (!(passed > 0) || !(length > 0)) return flow;
  const Curve means = mean_rates(mass, length, 0.25 * length, 0, end);
  double largest = run.setting.hand_discharge;
  for (const double mean : means.value) largest = std::max(largest, mean);
  double last = 0;  // end of the last window through which grains passed
  for (std::size_t n = 0; n < means.value.size(); ++n)
    if (means.value[n] > hardly * largest) last = std::min(end, means.time[n] + 0.5 * length);
  if (!(last > 0)) return flow;
  flow.state = flow.discharged >= emptied ? FlowState::has_emptied : FlowState::flows;
  if (end - last < rest * run.setting.time_scale) return flow;
  if (flow.state == FlowState::flows) flow.state = FlowState::has_stopped;
  flow.stop_time = first_time_at_or_above(mass, value_at(mass, std::max(last, mass.time.front())));
  return flow;
}

Plateau steady_discharge(const HopperRun& run) {
  const Curve share = discharged_share(run);
  if (share.value.empty()) return {};
  const double from = first_time_at_or_above(share, steady_from);
  if (!std::isfinite(from)) return {};
  // A vessel that is fed stays full: its share discharged says nothing of its height.
  const bool is_fed = mass_at_end(run) > run.setting.mass();
  const double low = is_fed ? no_value : first_time_at_or_above(share, steady_to);
  const Curve passed = passed_mass(run);
  const Plateau found =
      find_plateau(passed, run.setting.averaging_time, plateau_spread, from, std::isfinite(low) ? low : run.end());
  if (!std::isfinite(found.value)) return found;
  return found.value * (found.to - found.from) >= steady_least * mass_at_end(run) ? found : Plateau{};
}

Plateau steady_throughput(const HopperRun& run) {
  const Curve removed = run.curve("removed_mass");
  return find_plateau(removed, run.setting.averaging_time, plateau_spread, removed.time.front(), run.end());
}

double value_at_window(Number number, const HopperRun& run, const Window& window) {
  const std::vector<double>& time = run.snapshots.time();
  if (time.empty()) return no_value;
  const double at = window.at.value_or(Window::end_of_run), last = time.back();
  if (std::isinf(at)) return run.snapshots.value(time.size() - 1, number);
  const double interval = time.size() > 1 ? last - time[time.size() - 2] : 0;
  return at > last + 0.5 * interval ? no_value : run.snapshots.value(nearest_point(time, at), number);
}

Estimator<HopperRun> at(Number number) {
  return {[=](const HopperRun& run, const Window& w) { return value_at_window(number, run, w); }, number};
}

Estimator<HopperRun> max_of(Number number) {
  return {[=](const HopperRun& run, const Window& w) { return quantile(within(number, run, w), 1); }, number};
}

Estimator<HopperRun> mean_of(Number number) {
  return {[=](const HopperRun& run, const Window& w) { return mean(within(number, run, w)); }, number};
}

double period_of_discharge(const HopperRun& run, const Window& window) {
  const Curve part = fluctuating_discharge(run, window);
  const double longest = run.setting.averaging_time;
  return part.time.empty() ? no_value : dominant_period(part, min_period * longest, longest);
}

double crossing_period_of_discharge(const HopperRun& run, const Window& window) {
  return crossing_period(
      about_running_mean(fluctuating_discharge(run, window), averages(run).largest, window.from, window.to));
}

MaxMean max_discharge(const HopperRun& run, const Window& window) {
  const Averages of = averages(run);
  const Curve means = mean_rates(passed_mass(run), of.largest, of.max_every, window.from, end_of(window, run));
  if (means.time.empty()) return {};
  const Extremes found = extremes(means);
  return {found.max, found.max_time};
}

double extreme_time(const Curve& cumulative, const HopperRun& run, const Window& window) {
  const double length = extreme_mean * run.setting.averaging_time, every = extreme_every * run.setting.averaging_time;
  return first_maximum_time(mean_rates(cumulative, length, every, window.from, end_of(window, run)), length);
}

double share_at(const HopperRun& run, const Window& window) {
  const Curve share = discharged_share(run);
  const double at = time_of(window, run);
  return covers(share, at, at) ? value_at(share, at) : no_value;
}

double floor_arrival(const HopperRun& run, const Window&) {
  return first_time_at_or_above(run.curve("mass_near_floor"), 1e-3 * run.setting.mass());
}

double settled_force(const HopperRun& run) {
  double force = 0;
  for (const std::string& wall : walls_of(run.series))
    if (wall == "floor" || wall == "plate")
      force -= wall_force(run.series, wall, run.gate_time - averages(run).load, run.gate_time).z;
  return force;
}

double settled_stress_ratio(const HopperRun& run, const Window&) {
  const std::vector<double>& time = run.snapshots.time();
  std::size_t settled = 0;
  for (std::size_t n = 0; n < time.size(); ++n)
    if (time[n] <= 0) settled = n;
  return !time.empty() && time[settled] <= averages(run).load ? run.snapshots.value(settled, stress_ratio) : no_value;
}

namespace {

/// Of all grains in the middle of a stretch of time, N.
double weight_between(const HopperRun& run, double from, double to) {
  double mass = run.setting.mass();
  for (const auto& [column, sign] : {std::pair{"fed_mass", 1.0}, std::pair{"removed_mass", -1.0}})
    if (const Curve curve = run.curve(column); !curve.time.empty())
      mass +=
          sign * value_at(curve, std::clamp(0.5 * (from + to) - run.gate_time, curve.time.front(), curve.time.back()));
  return mass * run.setting.gravity;
}

}  // namespace

double balance_error(const HopperRun& run, const Window& window) {
  const double to = run.gate_time + time_of(window, run), from = to - averages(run).load;
  return weight_balance_error(run.series, weight_between(run, from, to), from, to);
}

double share_on_air(const HopperRun& run, const Window& window) {
  const double to = run.gate_time + time_of(window, run), from = to - averages(run).load;
  return wall_force(run.series, "air", from, to).z / weight_between(run, from, to);
}

double pressure_range_of_air(const HopperRun& run, const Window& window) {
  const double to = time_of(window, run), from = to - averages(run).load;
  const auto mean = [&](const char* column) {
    const std::vector<double> values = part(run.curve(column), from, to).value;
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  };
  return mean("air_pressure_max") - mean("air_pressure_min");
}

}  // namespace talus::hopper

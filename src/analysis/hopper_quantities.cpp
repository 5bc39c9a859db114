// SPDX-License-Identifier: Apache-2.0
#include "analysis/hopper_quantities.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>

#include "analysis/discharge.hpp"
#include "analysis/spectrum.hpp"
#include "analysis/statistics.hpp"
#include "analysis/wall_loads.hpp"

namespace talus {

namespace {

constexpr double none = HopperFrame::none;

// Lengths of means, estimator.discharge_rate: one printed period, a load cell's sampling, the largest rate.
constexpr double extreme_mean = 6e-3, extreme_every = 0.2e-3;
constexpr double trend_mean = 10e-3;
constexpr double largest_mean = 20e-3, largest_every = 1e-3;
constexpr double load_time = 20e-3;
constexpr double period_rate = 5000;  // 1/s, of the data
constexpr double shortest_period = 2e-3, longest_period = 20e-3;
constexpr double begins_to_incline = 1;  // deg
constexpr double repose_printed = 30;    // deg

double end_of(const Window& window, const HopperRun& run) {
  return std::min(window.to, run.end());
}

/// The time that a window names, or the end; nan if the run ended before it, but for a few steps.
double time_of(const Window& window, const HopperRun& run) {
  const double at = window.at.value_or(Window::end_of_run), end = run.end();
  return at > end + trend_mean && !std::isinf(at) ? none : std::min(at, end);
}

/// The frame nearest the window's time, of two the earlier; null if the run ended more than half a frame before.
const HopperFrame* frame_at(const HopperRun& run, const Window& window) {
  std::vector<double> time;
  for (const HopperFrame& frame : run.frames) time.push_back(frame.time);
  if (time.empty()) return nullptr;
  const double at = window.at.value_or(Window::end_of_run), last = time.back();
  if (std::isinf(at)) return &run.frames.back();
  const double interval = time.size() > 1 ? last - time[time.size() - 2] : 0;
  if (at > last + 0.5 * interval) return nullptr;
  return &run.frames[nearest_point(time, at)];
}

double at_frame(double HopperFrame::*number, const HopperRun& run, const Window& window) {
  const HopperFrame* frame = frame_at(run, window);
  return frame ? frame->*number : none;
}

std::vector<double> of_frames(double HopperFrame::*number, const HopperRun& run, const Window& window) {
  return part(run.curve(number), window.from, window.to).value;
}

double largest_of_frames(double HopperFrame::*number, const HopperRun& run, const Window& window) {
  return quantile(of_frames(number, run, window), 1);
}

double mean_of_frames(double HopperFrame::*number, const HopperRun& run, const Window& window) {
  return mean(of_frames(number, run, window));
}

/// The largest of the 20 ms means of the discharge, and its time.
struct LargestMean {
  double value = none, time = none;
};
LargestMean largest_discharge(const HopperRun& run, const Window& window) {
  const Curve means = mean_rates(passed_mass(run), largest_mean, largest_every, window.from, end_of(window, run));
  if (means.time.empty()) return {};
  const Extremes found = extremes(means);
  return {found.largest, found.largest_time};
}

double extreme_time(const Curve& cumulative, const HopperRun& run, const Window& window) {
  return first_maximum_time(mean_rates(cumulative, extreme_mean, extreme_every, window.from, end_of(window, run)),
                            extreme_mean);
}

double discharge_fall(const HopperRun& run, const Window& window) {
  const Curve passed = passed_mass(run);
  return mean_rate(passed, window.from, window.to) - mean_rate(passed, 2 * window.from - window.to, window.from);
}

/// The curve up to its first value after `from` that is not finite: the place has run empty.
Curve while_there_are_grains(Curve curve, double from) {
  std::size_t n = 0;
  while (n < curve.time.size() && (curve.time[n] <= from || std::isfinite(curve.value[n]))) ++n;
  curve.time.resize(n);
  curve.value.resize(n);
  return curve;
}

/// Of the window, or of as much of it as there are grains at the place: at least half.
double period(const Curve& whole, const Window& window) {
  const Curve curve = while_there_are_grains(whole, window.from);
  if (!covers(curve, window.from, 0.5 * (window.from + window.to))) return none;
  const double to = std::min(window.to, curve.time.back());
  return dominant_period(at_equal_times(curve, period_rate, window.from, to), shortest_period, longest_period);
}

double share_at(const HopperRun& run, const Window& window) {
  const Curve share = discharged_share(run);
  const double at = time_of(window, run);
  return covers(share, at, at) ? value_at(share, at) : none;
}

double first_time_at_or_above(const Curve& curve, double level) {
  return first_time_at_or_below(scaled(curve, -1), -level);
}

/// Force on the bed's ground, plate and floor together, over 20 ms before the gate opened; upwards on the grains, N.
double settled_force(const HopperRun& run) {
  double force = 0;
  for (const std::string& wall : walls_of(run.series))
    if (wall == "floor" || wall == "plate")
      force -= wall_force(run.series, wall, run.gate_time - load_time, run.gate_time).z;
  return force;
}

/// The last frame before the gate opened, or at its opening.
double settled_stress_ratio(const HopperRun& run) {
  const HopperFrame* settled = nullptr;
  for (const HopperFrame& frame : run.frames)
    if (frame.time <= 0 || !settled) settled = &frame;
  return settled && settled->time <= load_time ? settled->stress_ratio : none;
}

double balance_error(const HopperRun& run, const Window& window) {
  const double to = run.gate_time + time_of(window, run);
  return weight_balance_error(run.series, run.setting.mass() * run.setting.gravity, to - load_time, to);
}

/// Means over 10 ms of a curve that has data now and then.
std::vector<double> coarse_means(const Curve& curve) {
  std::map<long, std::vector<double>> groups;
  for (std::size_t n = 0; n < curve.time.size(); ++n)
    groups[std::lround(std::floor(curve.time[n] / trend_mean))].push_back(curve.value[n]);
  std::vector<double> means;
  for (const auto& [group, values] : groups) means.push_back(mean(values));
  return means;
}

double largest_fall_of_surface(const HopperRun& run) {
  const Curve angle = run.curve(&HopperFrame::surface_angle_hopper);
  std::size_t first = 0;
  while (first < angle.value.size() && angle.value[first] <= begins_to_incline) ++first;
  if (first == angle.value.size()) return none;
  double largest = angle.value[first], fall = 0;
  for (const double mean : coarse_means(part(angle, angle.time[first], Window::end_of_run))) {
    largest = std::max(largest, mean);
    fall = std::max(fall, largest - mean);
  }
  return fall;
}

/// Of the angles of repose of bin and hopper, the one nearer to the printed one, or the other.
double repose(const HopperRun& run, const Window& window, bool nearer) {
  const double bin = at_frame(&HopperFrame::repose_angle_bin, run, window);
  const double hopper = at_frame(&HopperFrame::repose_angle_hopper, run, window);
  if (std::isnan(bin) || std::isnan(hopper)) return nearer ? std::fmax(bin, hopper) : none;
  const bool bin_is_nearer = std::abs(bin - repose_printed) <= std::abs(hopper - repose_printed);
  return bin_is_nearer == nearer ? bin : hopper;
}

double narrowing(const HopperRun& run, const Window& window) {
  return mean_of_frames(&HopperFrame::stream_width_below, run, window) /
         mean_of_frames(&HopperFrame::stream_width_above, run, window);
}

/// Product of the circulations left and right over the sum of their squares: below 0 for a pair that turns against each
/// other.
double vortex_product(double HopperFrame::*left, double HopperFrame::*right, const HopperRun& run,
                      const Window& window) {
  const double a = at_frame(left, run, window), b = at_frame(right, run, window);
  return a * b / (a * a + b * b);
}

/// Sign of the product of the left half of the hopper's circulation at the window's ends: below 0 where it has turned.
double vortex_reversal(const HopperRun& run, const Window& window) {
  const auto at = [&](double time) { return at_frame(&HopperFrame::air_circulation_hopper_left, run, {.at = time}); };
  const double product = at(window.from) * at(window.to);
  return product / std::abs(product);
}

using OfRun = std::function<double(const HopperRun&, const Window&)>;

OfRun at(double HopperFrame::*number) {
  return [number](const HopperRun& run, const Window& window) { return at_frame(number, run, window); };
}
OfRun largest(double HopperFrame::*number) {
  return [number](const HopperRun& run, const Window& window) { return largest_of_frames(number, run, window); };
}
OfRun period_of(std::string_view column) {
  return [column](const HopperRun& run, const Window& window) { return period(run.curve(column), window); };
}

const std::map<std::string_view, OfRun>& quantities_of_a_run() {
  using Run = const HopperRun&;
  using In = const Window&;
  static const std::map<std::string_view, OfRun> all = {
      {"discharge_rate_plateau", [](Run r, In w) { return mean_rate(passed_mass(r), w.from, w.to); }},
      {"discharge_rate_drift", [](Run r, In w) { return drift(passed_mass(r), trend_mean, w.from, w.to); }},
      {"discharge_rate_fall", discharge_fall},
      {"discharge_rate_extreme_time", [](Run r, In w) { return extreme_time(passed_mass(r), r, w); }},
      {"discharge_rate_max", [](Run r, In w) { return largest_discharge(r, w).value; }},
      {"discharge_rate_max_time", [](Run r, In w) { return largest_discharge(r, w).time; }},
      {"slit_velocity_extreme_time",
       [](Run r, In w) { return extreme_time(integral(scaled(r.curve("slit_velocity"), -1)), r, w); }},
      {"slit_velocity_fluctuation",
       [](Run r, In w) { return fluctuation(r.curve("slit_velocity"), largest_mean, w.from, w.to); }},
      {"discharged_fraction_400ms", share_at},
      {"residual_fraction", [](Run r, In w) { return 1 - share_at(r, w); }},
      {"floor_arrival_first_time", [](Run r, In) { return first_time_at_or_below(r.curve("lowest_z"), 1e-3); }},
      {"floor_arrival_time",
       [](Run r, In) { return first_time_at_or_above(r.curve("mass_near_floor"), 1e-3 * r.setting.mass()); }},
      {"quiescent_speed", at(&HopperFrame::quiescent_speed)},
      {"repose_angle_bin", at(&HopperFrame::repose_angle_bin)},
      {"repose_angle_bin_steepest", at(&HopperFrame::repose_angle_bin_steepest)},
      {"repose_angle_hopper", at(&HopperFrame::repose_angle_hopper)},
      {"repose_angle_hopper_steepest", at(&HopperFrame::repose_angle_hopper_steepest)},
      {"repose_angle_nearer", [](Run r, In w) { return repose(r, w, true); }},
      {"repose_angle_other", [](Run r, In w) { return repose(r, w, false); }},
      {"surface_slope_500ms", at(&HopperFrame::surface_angle_bin)},
      {"surface_slope", [](Run r, In w) { return mean_of_frames(&HopperFrame::surface_angle_hopper, r, w); }},
      {"hopper_velocity", at(&HopperFrame::hopper_velocity)},
      {"hopper_packing", at(&HopperFrame::hopper_packing)},
      {"surface_swelling", [](Run r, In w) { return mean_of_frames(&HopperFrame::surface_swelling, r, w); }},
      {"surface_angle_largest_fall", [](Run r, In) { return largest_fall_of_surface(r); }},
      {"surface_angle_end_difference",
       [](Run r, In w) {
         return at_frame(&HopperFrame::surface_angle_hopper, r, w) - at_frame(&HopperFrame::repose_angle_hopper, r, w);
       }},
      {"weight_balance_error", balance_error},
      {"floor_stress_settled",
       [](Run r, In) {
         return settled_force(r) / (r.setting.shape.width * r.setting.shape.depth * r.setting.stress_share);
       }},
      {"floor_stress_error", [](Run r, In) { return settled_force(r) / (r.setting.mass() * r.setting.gravity) - 1; }},
      {"period_discharge", period_of("discharge_rate")},
      {"period_density", period_of("probe_density")},
      {"period_velocity", period_of("probe_velocity")},
      {"period_stress", period_of("probe_stress")},
      {"period_strain", period_of("probe_strain")},
      {"stress_ratio_flow", at(&HopperFrame::stress_ratio)},
      {"stress_ratio_settled", [](Run r, In) { return settled_stress_ratio(r); }},
      {"inertial_share", at(&HopperFrame::inertial_share)},
      {"velocity_gradient_shear_max", largest(&HopperFrame::velocity_gradient_shear_max)},
      {"velocity_gradient_normal_max", largest(&HopperFrame::velocity_gradient_normal_max)},
      {"velocity_gradient_shear_percentile", largest(&HopperFrame::velocity_gradient_shear_percentile)},
      {"velocity_gradient_normal_percentile", largest(&HopperFrame::velocity_gradient_normal_percentile)},
      {"stream_narrowing", narrowing},
      {"stream_packing", at(&HopperFrame::stream_packing)},
      {"stream_stripes", at(&HopperFrame::stream_stripes)},
      {"corner_packing_ratio_hopper", at(&HopperFrame::corner_packing_ratio_hopper)},
      {"corner_packing_ratio_bin", at(&HopperFrame::corner_packing_ratio_bin)},
      {"left_right_imbalance", at(&HopperFrame::left_right_imbalance)},
      {"packing_max", largest(&HopperFrame::packing_max)},
      {"packing_max_outside_impact", largest(&HopperFrame::packing_max_outside_impact)},
      {"density_drift", largest(&HopperFrame::density_drift)},
      {"drag_to_weight", at(&HopperFrame::drag_to_weight)},
      {"air_pressure_drop_height", at(&HopperFrame::air_pressure_drop_height)},
      {"air_pressure_outside_inside", at(&HopperFrame::air_pressure_outside_inside)},
      {"air_velocity_within_plug", at(&HopperFrame::air_velocity_within_plug)},
      {"air_velocity_beside_plug", at(&HopperFrame::air_velocity_beside_plug)},
      {"air_velocity_slowness", at(&HopperFrame::air_velocity_slowness)},
      {"air_vortex_product_bin",
       [](Run r, In w) {
         return vortex_product(&HopperFrame::air_circulation_bin_left, &HopperFrame::air_circulation_bin_right, r, w);
       }},
      {"air_vortex_product_hopper",
       [](Run r, In w) {
         return vortex_product(&HopperFrame::air_circulation_hopper_left, &HopperFrame::air_circulation_hopper_right, r,
                               w);
       }},
      {"air_vortex_reversal_hopper", vortex_reversal},
      {"particle_reynolds_max",
       [](Run r, In w) { return quantile(part(r.curve("particle_reynolds_max"), w.from, w.to).value, 1); }},
      {"mass_error", [](Run r, In w) { return std::abs(at_frame(&HopperFrame::mass, r, w) / r.setting.mass() - 1); }},
      {"momentum_error", [](Run r, In) { return momentum_error(r.series); }},
      {"wall_seconds", [](Run r, In) { return r.wall_seconds; }},
  };
  return all;
}

}  // namespace

double hopper_quantity(std::string_view name, const HopperRun& run, const Window& window) {
  const auto found = quantities_of_a_run().find(name);
  if (found == quantities_of_a_run().end())
    throw std::out_of_range("'" + std::string(name) + "' is no quantity of a run from a hopper");
  return found->second(run, window);
}

Curve discharged_mass(const HopperRun& run) {
  return run.curve("discharged_mass");
}

Curve passed_mass(const HopperRun& run) {
  return integral(run.curve("discharge_rate"));
}

Curve discharged_share(const HopperRun& run) {
  return scaled(discharged_mass(run), 1 / run.setting.mass());
}

}  // namespace talus

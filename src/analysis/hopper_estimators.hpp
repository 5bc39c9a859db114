// SPDX-License-Identifier: Apache-2.0
/// How the measures of grains in a vessel are made from a run: of its series, or of the numbers of its snapshots.
#pragma once

#include "analysis/hopper_numbers.hpp"
#include "analysis/plateau.hpp"

namespace talus::hopper {

using Number = HopperRun::Numbers::Number;

/// Lengths of averages, s, of T = analysis.averaging_time (the paper's T is 20 ms: estimator.discharge_rate).
struct Averages {
  double largest;        ///< T: of the largest rate
  double largest_every;  ///< T/20
  double trend;          ///< T/2
  double curve_every;    ///< T/4: of a curve of averages over T
  double load;           ///< T
};
inline Averages averages(const HopperRun& run) {
  const double t = run.setting.averaging_time;
  return {.largest = t, .largest_every = 0.05 * t, .trend = 0.5 * t, .curve_every = 0.25 * t, .load = t};
}

inline const std::vector<std::string_view> across{"height", "left", "right"}, beside{"from", "to"};

/// From when a tenth of what passes the outlet in all has passed it until when half of it has; the time in the middle.
/// Where nothing passes: half of the run.
Window while_it_flows(const HopperRun& run);

/// Of M and what has come in since, from which a regime of the flow shows: before that only what stood above the outlet
/// has left. A tenth is some ten outlets' worth in a usual silo.
inline constexpr double share_of_regime = 0.1;

/// How the flow through the outlet has gone to the end of the run.
enum class FlowState {
  has_not_started,  ///< nothing has passed
  flows,            ///< at the end
  has_emptied,      ///< 99 % have passed
  has_stopped       ///< the rest stays
};
struct FlowEnd {
  FlowState state = FlowState::has_not_started;
  double discharged = 0;               ///< of M and what has come in since, 1
  double left = 0;                     ///< above the outlet at the end, kg
  double stop_time = HopperRun::none;  ///< of the last outflow, where it has stopped or emptied, s
};
/// The flow has stopped if over three (D/g)^½ before the end, in each (D/g)^½ of them, less passed than a hundredth of
/// the larger of its largest mean over as long and the analytical estimate. \pre the run has an outlet
FlowEnd flow_end(const HopperRun& run);

/// The discharge while it is steady, found between two shares discharged (steady_from, steady_to): before, the flow
/// begins; after, the bed is so low that the rate falls with it (in a silo whose outlet is a tenth of its height, at a
/// height of two outlets). Nan where less than `steady_least` of the bed leaves within the stretch found.
Plateau steady_discharge(const HopperRun& run);
inline constexpr double steady_from = 0.1, steady_to = 0.7, steady_least = 0.05;

/// The number in the snapshot nearest the window's time, of two the earlier; nan if the run ended more than half an
/// interval before.
double value_at_window(Number number, const HopperRun& run, const Place& place, const Window& window);

Estimator<HopperRun> at(Number number);          ///< value_at_window()
Estimator<HopperRun> largest_of(Number number);  ///< over the snapshots in the window
Estimator<HopperRun> mean_of(Number number);     ///< the same
/// Of a column, over the window or as much of it as there are grains at the place, at least half.
Estimator<HopperRun> period_of(std::string_view column);
/// The mean time between the up-crossings of its centred mean over T, of the same.
Estimator<HopperRun> crossing_period_of(std::string_view column);
/// Product of the circulations left and right over the sum of their squares: below 0 for a pair that turns against each
/// other.
template <Where where, Cells cells = Cells::open>
double vortex_product(const HopperRun& run, const Place& place, const Window& window) {
  const double a = value_at_window(air_circulation<where, Half::left, cells>, run, place, window);
  const double b = value_at_window(air_circulation<where, Half::right, cells>, run, place, window);
  return a * b / (a * a + b * b);
}
/// Sign of the product of two circulations of the hopper's left half: in its open cells at the window's end, and in
/// those cells at the window's beginning. Below 0 where the vortex has turned.
template <Cells cells = Cells::open>
double vortex_reversal(const HopperRun& run, const Place& place, const Window& window) {
  const double before =
      value_at_window(air_circulation<Where::hopper, Half::left, cells>, run, place, {.at = window.from});
  const double after = value_at_window(air_circulation<Where::hopper, Half::left>, run, place, {.at = window.to});
  return before * after / std::abs(before * after);
}
/// Width of the stream below over that above, means over the window.
double narrowing(const HopperRun& run, const Place& place, const Window& window);

/// Slope of the line through foot_reach() against time while it is between `from` and `to`; nan of fewer than three.
double foot_speed(const HopperRun& run, const Place& place, const Window& window);

struct LargestMean {
  double value = HopperRun::none, time = HopperRun::none;
};
/// The largest of the means over T of the discharge, and its time.
LargestMean largest_discharge(const HopperRun& run, const Window& window);
/// Mean discharge over the window, over the largest mean over as long a time.
double discharge_share_of_largest(const HopperRun& run, const Place& place, const Window& window);
/// First maximum of the means over 0.3 T of what the curve is the integral of.
double extreme_time(const Curve& cumulative, const HopperRun& run, const Window& window);
double discharge_fall(const HopperRun& run, const Place& place, const Window& window);
double share_at(const HopperRun& run, const Place& place, const Window& window);
double floor_arrival(const HopperRun& run, const Place& place, const Window& window);
/// Force on the bed's ground, plate and floor together, over T before the gate opened; upwards on the grains, N.
double settled_force(const HopperRun& run);
/// Of the last snapshot before the gate opened, or at its opening.
double settled_stress_ratio(const HopperRun& run, const Place& place, const Window& window);
double balance_error(const HopperRun& run, const Place& place, const Window& window);
/// Largest by which an angle lies below an earlier value of itself, once it has passed 1 degree. \param length of means
double largest_fall(const Curve& angle, double length);
template <double (*angle_of)(const HopperSnapshot&, const Place&)>
double largest_fall_of(const HopperRun& run, const Place& place, const Window&) {
  return largest_fall(run.curve(angle_of, place), averages(run).trend);
}
/// An angle less that of the heaps that stay in the hopper.
template <double (*angle_of)(const HopperSnapshot&, const Place&)>
double above_repose(const HopperRun& run, const Place& place, const Window& window) {
  return value_at_window(angle_of, run, place, window) -
         value_at_window(repose_angle_in<Where::hopper, &ReposeAngle::mean>, run, place, window);
}
/// Of the angles of repose of bin and hopper, the one nearer to 30 degrees, or the other.
double repose(const HopperRun& run, const Window& window, bool nearer);

/// Those measures of hopper_measures() that count mass.
std::vector<Measure<HopperRun>> hopper_mass_measures();
/// Those that need the air.
std::vector<Measure<HopperRun>> hopper_air_measures();
/// Those of a vessel in space.
std::vector<Measure<HopperRun>> hopper_vessel_measures();

/// Mean speed of the particles at the height and above. \param speed of each, nan where not known; those do not count.
/// \returns nan without any
double mean_speed_above(double height, std::span<const Vector3> positions, std::span<const double> speed);
/// The stress across the upright walls of the settled bed over its vertical stress there, of the bands that it fills;
/// nan without such walls, or without a snapshot of it.
double wall_pressure_ratio(const HopperRun& run, const Place& place, const Window& window);
/// Height of the settled bed: half a spacing above its 99.5th percentile, m; nan without a snapshot of it.
double settled_top(const HopperRun& run);
/// Share of the particles above the outlet that move; nan without a snapshot before.
double share_that_moves(const HopperSnapshot& s, const Place& place);
/// The same at the time of the window, but not before `share_of_regime` has left; nan where the flow had stopped then.
double share_in_motion(const HopperRun& run, const Place& place, const Window& window);
/// Packing of the space of the outlet's width and as high above it.
double outlet_packing(const HopperSnapshot& s, const Place& place);

// Two runs, one of each variant.
using Pair = std::span<const std::vector<HopperRun>>;
std::optional<double> ratio_at_largest(Pair runs, const Window& window);
std::optional<double> share_of_larger(Pair runs, const Window& window);
std::optional<double> largest_share_difference(Pair runs, const Window& window);

}  // namespace talus::hopper

// SPDX-License-Identifier: Apache-2.0
/// How the measures of grains in a vessel are made from a run: of its series, or of the numbers of its snapshots, which
/// come first. SI, angles in degrees; nan where a number has no meaning. Estimators: validation/yuu2011/reference.toml.
#pragma once

#include <numbers>

#include "analysis/discharge.hpp"
#include "analysis/hopper.hpp"

namespace talus::hopper {

// Numbers of one snapshot.
enum class Where { bin, hopper };                                     ///< below the outlet, and above it
const FreeSurface& surface_in(const HopperSnapshot& s, Where where);  ///< empty if there is no hopper
ReposeAngle repose_in(const HopperSnapshot& s, Where where);

template <Where where>
double surface_angle_in(const HopperSnapshot& s) {
  return surface_angle(surface_in(s, where), s.shape().middle(), s.setting.tilt) / (std::numbers::pi / 180);
}
template <Where where, double ReposeAngle::*angle>
double repose_angle_in(const HopperSnapshot& s) {
  return repose_in(s, where).*angle / (std::numbers::pi / 180);
}
template <double GradientSizes::*size>
double gradient(const HopperSnapshot& s) {
  return s.gradient_sizes().*size;
}
double mass(const HopperSnapshot& s);  ///< of all particles
double quiescent_speed(const HopperSnapshot& s);
double packing_max(const HopperSnapshot& s);
double density_drift(const HopperSnapshot& s);
double stress_ratio(const HopperSnapshot& s);
double inertial_share(const HopperSnapshot& s);
double left_right_imbalance(const HopperSnapshot& s);

using Number = HopperRun::Numbers::Number;

/// Lengths of averages, s, of T = analysis.averaging_time (the paper's T is 20 ms: estimator.discharge_rate).
struct Averages {
  double largest;      ///< T: of the largest rate
  double max_every;    ///< T/20
  double trend;        ///< T/2
  double curve_every;  ///< T/4: of a curve of averages over T
  double load;         ///< T
};
inline Averages averages(const HopperRun& run) {
  const double t = run.setting.averaging_time;
  return {.largest = t, .max_every = 0.05 * t, .trend = 0.5 * t, .curve_every = 0.25 * t, .load = t};
}

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
  double discharged = 0;        ///< of M and what has come in since, 1
  double left = 0;              ///< above the outlet at the end, kg
  double stop_time = no_value;  ///< of the last outflow, where it has stopped or emptied, s
};
/// The flow has stopped if over three (D/g)^½ before the end, in each (D/g)^½ of them, less passed than a hundredth of
/// the larger of its largest mean over as long and the analytical estimate. \pre the run has an outlet
FlowEnd flow_end(const HopperRun& run);

/// The discharge while it is steady, found between two shares discharged (steady_from, steady_to): before, the flow
/// begins; after, the bed is so low that the rate falls with it (in a silo whose outlet is a tenth of its height, at a
/// height of two outlets). Nan where less than `steady_least` of the bed leaves within the stretch found.
Plateau steady_discharge(const HopperRun& run);
inline constexpr double steady_from = 0.1, steady_to = 0.7, steady_least = 0.05;

/// Of what is taken away while it is steady, as behind a chute or a belt: the same from the start to the end of the
/// run. \pre the series has removed_mass
Plateau steady_throughput(const HopperRun& run);

/// The number in the snapshot nearest the window's time, of two the earlier; nan if the run ended more than half an
/// interval before.
double value_at_window(Number number, const HopperRun& run, const Window& window);

Estimator<HopperRun> at(Number number);       ///< value_at_window()
Estimator<HopperRun> max_of(Number number);   ///< over the snapshots in the window
Estimator<HopperRun> mean_of(Number number);  ///< the same
/// Of the discharge, over the window or as much of it as the run covers, at least half.
double period_of_discharge(const HopperRun& run, const Window& window);
/// The mean time between the up-crossings of its centred mean over T, of the same.
double crossing_period_of_discharge(const HopperRun& run, const Window& window);

struct MaxMean {
  double value = no_value, time = no_value;
};
/// The largest of the means over T of the discharge, and its time.
MaxMean max_discharge(const HopperRun& run, const Window& window);
/// First maximum of the means over 0.3 T of what the curve is the integral of.
double extreme_time(const Curve& cumulative, const HopperRun& run, const Window& window);
double share_at(const HopperRun& run, const Window& window);
double floor_arrival(const HopperRun& run, const Window& window);
/// Force on the bed's ground, plate and floor together, over T before the gate opened; upwards on the grains, N.
double settled_force(const HopperRun& run);
/// Of the last snapshot before the gate opened, or at its opening.
double settled_stress_ratio(const HopperRun& run, const Window& window);
double share_on_air(const HopperRun& run, const Window& window);
double pressure_range_of_air(const HopperRun& run, const Window& window);
double balance_error(const HopperRun& run, const Window& window);
/// Those measures of hopper_measures() that are of a vessel in space.
std::vector<Measure<HopperRun>> hopper_vessel_measures();

/// Mean speed, by mass, of the particles at the height and above. \param speed of each, nan where not known; those do
/// not count. \returns nan without any
double mean_speed_above(double height, const Snapshot& now, std::span<const double> speed);
/// The stress across the upright walls of the settled bed over its vertical stress there, of the bands that it fills;
/// nan without such walls, or without a snapshot of it.
double wall_pressure_ratio(const HopperRun& run, const Window& window);
/// Height of the settled bed: half a spacing above its 99.5th percentile, m; nan without a snapshot of it, or if it
/// falls.
double settled_top(const HopperRun& run);
/// Share of the particles above the outlet that move; nan without a snapshot before.
double share_that_moves(const HopperSnapshot& s);
/// The same at the time of the window, but not before `share_of_regime` has left; nan where the flow had stopped then.
double share_in_motion(const HopperRun& run, const Window& window);
/// Packing of the space of the outlet's width and as high above it.
double outlet_packing(const HopperSnapshot& s);

}  // namespace talus::hopper

// SPDX-License-Identifier: Apache-2.0
/// A run of grains from a hopper into a bin as Yuu & Umekage (2011) look at it: its series, and the numbers of each
/// snapshot. Estimators: validation/yuu2011/reference.toml. A box without a plate is a bin alone.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "analysis/curve.hpp"
#include "analysis/hopper_regions.hpp"
#include "numerics/geometry/domain.hpp"
#include "numerics/series.hpp"
#include "numerics/snapshot.hpp"

namespace talus {

/// What the case says. SI.
struct HopperSetting {
  HopperShape shape;
  Domain domain;             ///< as at the start: the gate shut
  double particle_mass = 0;  ///< kg
  double particles = 0;      ///< at the start
  double grain_density = 0, grain_diameter = 0, gravity = 0;
  std::optional<double> smoothing_length = {};  ///< of all particles; left out: of each from its density
  bool air = false;
  double stress_share = 1;  ///< of the stress, that moves grains and loads walls: 1 - Phi in Eq. 17 as printed

  double mass() const { return particles * particle_mass; }
};

/// Edge of the cells in which values at places are taken: those of the paper's air.
inline constexpr double hopper_cell = 1.25e-3;

/// Numbers of one snapshot; nan where they have no meaning. Lengths in m, angles in degrees.
struct HopperFrame {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  double time = 0;  ///< from the opening of the gate, s
  double surface_angle_hopper = none, surface_angle_bin = none;
  double surface_swelling = none;
  double repose_angle_bin = none, repose_angle_bin_steepest = none;
  double repose_angle_hopper = none, repose_angle_hopper_steepest = none;
  double quiescent_speed = none;  ///< m/s
  double packing_max = none, packing_max_outside_impact = none;
  double density_drift = none;
  double stress_ratio = none;
  double inertial_share = none;
  double velocity_gradient_shear_max = none, velocity_gradient_shear_percentile = none;
  double velocity_gradient_normal_max = none, velocity_gradient_normal_percentile = none;
  double stream_width_above = none, stream_width_below = none;  ///< close below the slit, and half-way to the floor
  double stream_packing = none, stream_stripes = none;
  double corner_packing_ratio_hopper = none, corner_packing_ratio_bin = none;
  double hopper_velocity = none, hopper_packing = none;  ///< u_z in m/s
  double left_right_imbalance = none;
  double mass = none;  ///< of all particles, kg
  // Of the air, hopper_air.hpp; velocities along z.
  double drag_to_weight = none;
  double air_pressure_drop_height = none, air_pressure_outside_inside = none;
  double air_velocity_within_plug = none, air_velocity_beside_plug = none, air_velocity_slowness = none;
  double air_circulation_bin_left = none, air_circulation_bin_right = none;  ///< m^2/s
  double air_circulation_hopper_left = none, air_circulation_hopper_right = none;
};

/// The numbers of a frame by name; those that quantities.hpp lists mean what it says there.
inline constexpr struct {
  std::string_view name, unit;
  double HopperFrame::*number;
} hopper_frame_numbers[] = {
    {"time", "s", &HopperFrame::time},
    {"surface_angle_hopper", "deg", &HopperFrame::surface_angle_hopper},
    {"surface_angle_bin", "deg", &HopperFrame::surface_angle_bin},
    {"surface_swelling", "m", &HopperFrame::surface_swelling},
    {"repose_angle_bin", "deg", &HopperFrame::repose_angle_bin},
    {"repose_angle_bin_steepest", "deg", &HopperFrame::repose_angle_bin_steepest},
    {"repose_angle_hopper", "deg", &HopperFrame::repose_angle_hopper},
    {"repose_angle_hopper_steepest", "deg", &HopperFrame::repose_angle_hopper_steepest},
    {"quiescent_speed", "m/s", &HopperFrame::quiescent_speed},
    {"packing_max", "1", &HopperFrame::packing_max},
    {"packing_max_outside_impact", "1", &HopperFrame::packing_max_outside_impact},
    {"density_drift", "1", &HopperFrame::density_drift},
    {"stress_ratio", "1", &HopperFrame::stress_ratio},
    {"inertial_share", "1", &HopperFrame::inertial_share},
    {"velocity_gradient_shear_max", "1", &HopperFrame::velocity_gradient_shear_max},
    {"velocity_gradient_shear_percentile", "1", &HopperFrame::velocity_gradient_shear_percentile},
    {"velocity_gradient_normal_max", "1", &HopperFrame::velocity_gradient_normal_max},
    {"velocity_gradient_normal_percentile", "1", &HopperFrame::velocity_gradient_normal_percentile},
    {"stream_width_above", "m", &HopperFrame::stream_width_above},
    {"stream_width_below", "m", &HopperFrame::stream_width_below},
    {"stream_packing", "1", &HopperFrame::stream_packing},
    {"stream_stripes", "1", &HopperFrame::stream_stripes},
    {"corner_packing_ratio_hopper", "1", &HopperFrame::corner_packing_ratio_hopper},
    {"corner_packing_ratio_bin", "1", &HopperFrame::corner_packing_ratio_bin},
    {"hopper_velocity", "m/s", &HopperFrame::hopper_velocity},
    {"hopper_packing", "1", &HopperFrame::hopper_packing},
    {"left_right_imbalance", "1", &HopperFrame::left_right_imbalance},
    {"mass", "kg", &HopperFrame::mass},
    {"drag_to_weight", "1", &HopperFrame::drag_to_weight},
    {"air_pressure_drop_height", "m", &HopperFrame::air_pressure_drop_height},
    {"air_pressure_outside_inside", "Pa", &HopperFrame::air_pressure_outside_inside},
    {"air_velocity_within_plug", "m/s", &HopperFrame::air_velocity_within_plug},
    {"air_velocity_beside_plug", "m/s", &HopperFrame::air_velocity_beside_plug},
    {"air_velocity_slowness", "1", &HopperFrame::air_velocity_slowness},
    {"air_circulation_bin_left", "m2/s", &HopperFrame::air_circulation_bin_left},
    {"air_circulation_bin_right", "m2/s", &HopperFrame::air_circulation_bin_right},
    {"air_circulation_hopper_left", "m2/s", &HopperFrame::air_circulation_hopper_left},
    {"air_circulation_hopper_right", "m2/s", &HopperFrame::air_circulation_hopper_right},
};

/// The packing section of a snapshot, cells of h by h/2, and the free surfaces in it.
struct HopperView {
  Section packing;
  HopperSurfaces surfaces;
};
HopperView hopper_view(const Snapshot& snapshot, const HopperSetting& setting, bool gate_is_open);

/// \param snapshot with the columns position, velocity, density, packing, shear_rate, stress_xx, stress_yy, stress_zz
/// \param before an earlier snapshot, about 20 ms before, over which speeds are means; null: there is none
/// \param gate_time when the gate opened, in the run's time, s
HopperFrame hopper_frame(const Snapshot& snapshot, const Snapshot* before, const HopperSetting& setting,
                         double gate_time);

struct HopperRun {
  HopperSetting setting;
  /// In the run's time: the columns of app/continuum/hopper_observers.hpp and the model's impulses.
  Series series;
  double gate_time = 0;                     ///< in the run's time, s; its end if the gate never opened
  std::vector<HopperFrame> frames = {};     ///< rising in time
  double wall_seconds = HopperFrame::none;  ///< of the whole run

  double end() const;  ///< from the opening of the gate, s
  /// A column of the series against the time from the gate's opening; without points if there is none.
  Curve curve(std::string_view column) const;
  /// A number of the frames from the gate's opening on; frames without one are left out.
  Curve curve(double HopperFrame::*number) const;
};

/// When the gate opened: the column gate_time of a series is below 0 until then. The series' last time if it never did.
double gate_time_of(const Series& series);

}  // namespace talus

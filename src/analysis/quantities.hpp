// SPDX-License-Identifier: Apache-2.0
/// The names of the numbers that describe a run, each defined once: they stand in summary.json, in tables and in the
/// reference files of validation/. In full, with windows: docs/quantities.md.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace talus {

struct QuantityDefinition {
  std::string_view name;
  std::string_view unit;  ///< SI; "deg" for angles, "1" for numbers
  std::string_view text;
};

inline constexpr auto quantities = std::to_array<QuantityDefinition>({
    {"front_speed_max", "1", "largest front speed over v_s, each over 0.25 a/v_s"},
    {"front_speed_min", "1", "least front speed over v_s, each over 0.25 a/v_s"},
    {"front_speed_end", "1", "front speed over v_s at the end of the run"},
    {"front_speed_max_time", "1", "time of the largest front speed, in a/v_s"},
    {"front_speed_rise", "1", "largest front speed over the first one"},
    {"front_speed_fall", "1", "largest front speed over the last one"},
    {"front_speed_slope_early", "1", "trend of the front speed in the first half of the run, in v_s per a/v_s"},
    {"front_speed_slope_change", "1", "trend in the second half less that in the first, in v_s per a/v_s"},
    {"front_speed_spread", "1", "standard deviation of the front speed between members over its mean, mean over time"},
    {"head_count", "1", "number of heads"},
    {"head_particles", "1", "grains of the largest head"},
    {"head_width", "m", "width of the largest head across the slope"},
    {"head_thickness", "m", "thickness of the largest head's layer at its centre"},
    {"head_aspect_ratio", "1", "width over thickness of the largest head, mean over a window"},
    {"head_aspect_ratio_min", "1", "least width over thickness of the largest head"},
    {"head_aspect_ratio_max", "1", "largest width over thickness of the largest head"},
    {"head_concavity", "1", "how far the head's rear is ahead at its centre of its two sides, over the thickness"},
    {"head_curl_left", "1", "mean curl of the velocity in the left half of the head, in v_s/a"},
    {"head_curl_right", "1", "mean curl of the velocity in the right half of the head, in v_s/a"},
    {"head_rear_relative_velocity", "1", "how much faster than the front the head's central rear runs, over v_s"},
    {"head_front_outward_velocity", "1", "velocity away from the centre line in the head's front half, over v_s"},
    {"head_particles_first", "1", "share of the grains in the largest head at the first data"},
    {"head_particles_half_time", "1", "time at which the largest head holds half of the grains, in a/v_s"},
    {"head_particles_trend", "1", "rank correlation of the largest head's grains with time"},
    {"head_particles_front_speed_correlation", "1",
     "rank correlation of the largest head's grains with the front speed, from its largest value on"},
    {"head_particles_front_speed_correlation_all", "1", "the same over the whole run"},
    {"head_width_normality_p_value", "1", "Anderson-Darling test of the widths of all heads"},
    {"head_width_skewness", "1", "skewness of the widths of all heads"},
    {"head_width_median_spread", "1", "range of the radii's median widths (in a) over their mean"},
    {"head_width_line_origin_r_squared", "1", "R² of the mean width's line against the radius, through the origin"},
    {"head_width_line_r_squared", "1", "R² of the mean width's line against the radius"},
    {"frontal_angle", "deg", "angle of the front against the slope behind it"},
    {"frontal_angle_first", "deg", "frontal angle at the first data"},
    {"frontal_angle_spread_ratio", "1", "spread of the frontal angle between members, last quarter over first"},
    {"front_rear_thickness_ratio", "1", "thickness of the head over the median thickness of the rear half"},
    {"head_upper_relative_velocity", "1", "how much faster than the front the upper head runs, over v_s"},
    {"head_lower_relative_velocity", "1", "how much faster than the front the lower head runs, over v_s"},
    {"tail_relative_velocity", "1", "how much faster than the front the tail runs, over v_s"},
    {"displacement_spread", "1", "largest difference of a grain's displacement from the mean, along x, over the mean"},
    {"displacement_lateral", "1", "largest difference of a grain's displacement from the mean, along y, over a"},
    {"fall_speed_start", "1", "mean speed along gravity of a cloud in free space at the start, over v_s"},
    {"fall_speed_end", "1", "the same at the end, of the grains that have not leaked"},
    {"leaked_fraction", "1", "share of the grains more than two initial radii behind the median of a falling cloud"},
    {"axial_density", "1", "grains near the axis of a falling cloud over those of an even disc; below 1: a torus"},
    {"flatness", "1", "lateral over vertical extent of a falling cloud, 1 for a sphere"},
    {"contact_weight_ratio", "1", "contact force at an overlap of 0.01 a over a grain's weight (gamma)"},
    {"overlap_max", "1", "largest overlap over a"},
    {"floor_stress_settled", "Pa", "force of the settled bed on its ground over the area"},
    {"floor_stress_error", "1", "the same over the bed's weight by area, less 1"},
    {"stress_ratio_settled", "1", "horizontal over vertical stress in the settled bed, weighted with the latter"},
    {"stress_ratio_flow", "1", "the same of the quasi-static grains during the flow"},
    {"discharge_rate_plateau", "kg/s", "mean discharge through the slit over the plateau"},
    {"discharge_rate_drift", "1", "change of the discharge over the window, over its mean"},
    {"discharge_rate_fall", "kg/s", "mean discharge over the window less that over as long a time before"},
    {"discharge_rate_extreme_time", "s", "time of the discharge's first maximum, 6 ms means"},
    {"discharge_rate_max", "kg/s", "largest 20 ms mean of the discharge"},
    {"discharge_rate_max_time", "s", "its time"},
    {"discharge_rate_max_ratio", "1", "largest 20 ms mean of the discharge of one run over that of another"},
    {"discharge_rate_ratio_at_max", "1", "ratio of the discharges of two runs at the time of the first one's largest"},
    {"discharge_rate_share_larger", "1", "share of the time in which the first of two runs discharges more"},
    {"discharge_resolution_difference", "1", "largest difference of the discharged shares of two runs at equal times"},
    {"slit_velocity_extreme_time", "s", "time of the first maximum of the downward velocity in the slit, 6 ms means"},
    {"slit_velocity_fluctuation", "m/s", "standard deviation of the velocity in the slit about its 20 ms mean"},
    {"slit_velocity_fluctuation_ratio", "1", "the same of one run over that of another"},
    {"floor_arrival_time", "s", "when 0.1 % of the mass is within one spacing of the floor"},
    {"floor_arrival_first_time", "s", "when the first particle is below 1 mm"},
    {"discharged_fraction_400ms", "1", "share of the mass below the plate 0.4 s after the opening"},
    {"residual_fraction", "1", "share of the mass above the plate at the end"},
    {"left_right_imbalance", "1", "difference of the masses left and right in the bin, over the total"},
    {"repose_angle_bin", "deg", "angle of the heap in the bin, left and right averaged"},
    {"repose_angle_bin_steepest", "deg", "angle of its steepest slope"},
    {"repose_angle_hopper", "deg", "angle of the heaps that stay in the hopper, left and right averaged"},
    {"repose_angle_hopper_steepest", "deg", "angle of their steepest slope"},
    {"repose_angle_nearer", "deg", "of the angles of repose in bin and hopper the one nearer to 30 degrees"},
    {"repose_angle_other", "deg", "the other one"},
    {"surface_slope", "deg", "mean slope of the hopper's free surface over the window"},
    {"surface_slope_difference", "deg", "the same of one run less that of another"},
    {"surface_slope_500ms", "deg", "mean slope of the bin's free surface 0.5 s after the opening"},
    {"surface_slope_500ms_difference", "deg", "the same of one run less that of another"},
    {"surface_swelling", "m", "height of the hopper's surface in the middle above that 20 mm beside it"},
    {"surface_angle_largest_fall", "deg", "largest fall of the hopper's surface angle below an earlier value"},
    {"surface_angle_end_difference", "deg", "the hopper's surface angle at the end less its angle of repose"},
    {"weight_balance_error", "1", "upward force of all walls over the weight, less 1"},
    {"quiescent_speed", "m/s", "95th percentile of the mean speeds deeper than three spacings"},
    {"packing_max", "1", "99.9th percentile of the packing, largest over time"},
    {"packing_max_outside_impact", "1", "the same farther than 20 mm from where the stream strikes"},
    {"density_drift", "1", "mean difference of the density by continuity from the kernel's, largest over time"},
    {"period_discharge", "s", "period of the discharge's fluctuation"},
    {"period_density", "s", "period of the density's fluctuation above the slit"},
    {"period_velocity", "s", "period of the velocity's fluctuation above the slit"},
    {"period_stress", "s", "period of the vertical stress's fluctuation above the slit"},
    {"period_strain", "s", "period of the strain's fluctuation above the slit"},
    {"period_stiffness_ratio", "1", "period of the discharge of a stiffened run over that of the other"},
    {"inertial_share", "1", "share of the grains above the plate with an inertial number below 0.01"},
    {"velocity_gradient_shear_max", "1", "largest du_i/dx_j, i != j, times (D/g)^(1/2)"},
    {"velocity_gradient_normal_max", "1", "largest du_i/dx_i times (D/g)^(1/2)"},
    {"velocity_gradient_shear_percentile", "1", "99.9th percentile in place of the largest"},
    {"velocity_gradient_normal_percentile", "1", "99.9th percentile in place of the largest"},
    {"hopper_velocity", "m/s", "mean vertical velocity 20 mm above the slit"},
    {"hopper_velocity_ratio", "1", "the same of one run over that of another"},
    {"hopper_packing", "1", "mean packing 20 mm above the slit"},
    {"hopper_packing_ratio", "1", "the same of one run over that of another"},
    {"stream_narrowing", "1", "width of the stream half-way to the floor over that close below the slit"},
    {"stream_packing", "1", "mean packing of the stream below the slit"},
    {"stream_stripes", "1", "standard deviation of the packing along the stream over its mean"},
    {"corner_packing_ratio_hopper", "1", "packing in the hopper's bottom corners over that of the layer"},
    {"corner_packing_ratio_bin", "1", "packing in the bin's bottom corners over that of the layer"},
    {"momentum_error", "1", "momentum that the impulses of walls and gravity do not explain, over gravity's impulse"},
    {"mass_error", "1", "mass lost or won over the mass at the start"},
});

/// The quantity of that name; nullptr if there is none.
constexpr const QuantityDefinition* find_quantity(std::string_view name) {
  const auto found = std::find_if(quantities.begin(), quantities.end(),
                                  [&](const QuantityDefinition& quantity) { return quantity.name == name; });
  return found == quantities.end() ? nullptr : &*found;
}

}  // namespace talus

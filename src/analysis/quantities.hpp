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
});

/// The quantity of that name; nullptr if there is none.
constexpr const QuantityDefinition* find_quantity(std::string_view name) {
  const auto found = std::find_if(quantities.begin(), quantities.end(),
                                  [&](const QuantityDefinition& quantity) { return quantity.name == name; });
  return found == quantities.end() ? nullptr : &*found;
}

}  // namespace talus

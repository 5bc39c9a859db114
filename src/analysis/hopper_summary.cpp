// SPDX-License-Identifier: Apache-2.0
#include "analysis/hopper_quantities.hpp"
#include "analysis/quantities.hpp"

namespace talus {

std::vector<NamedValue> hopper_summary(const HopperRun& run) {
  constexpr double end = Window::end_of_run;
  struct Entry {
    std::string_view name;
    Window window = {};
    bool of_slit = true;
    bool of_air = false;
  };
  const Window periods{.at = {}, .from = 0.05, .to = 0.3};
  const std::vector<Entry> entries = {
      {"floor_stress_settled", {}, false},
      {"stress_ratio_settled", {}, false},
      {"stress_ratio_flow", {.at = 0.2}, false},
      {"discharge_rate_plateau", {.at = {}, .from = 0.05, .to = run.setting.air ? 0.33 : 0.2}},
      {"discharge_rate_extreme_time", {.at = {}, .from = 0, .to = 0.1}},
      {"slit_velocity_extreme_time", {.at = {}, .from = 0, .to = 0.1}},
      {"floor_arrival_time"},
      {"floor_arrival_first_time"},
      {"discharged_fraction_400ms", {.at = 0.4}},
      {"residual_fraction", {.at = end}},
      {"left_right_imbalance", {.at = end}, false},
      {"repose_angle_bin", {.at = end}, false},
      {"repose_angle_bin_steepest", {.at = end}, false},
      {"repose_angle_hopper", {.at = end}},
      {"repose_angle_hopper_steepest", {.at = end}},
      {"surface_slope_500ms", {.at = 0.5}, false},
      {"weight_balance_error", {.at = end}, false},
      {"quiescent_speed", {.at = end}, false},
      {"packing_max_outside_impact", {}},
      {"packing_max", {}, false},
      {"density_drift", {}, false},
      {"period_discharge", periods},
      {"period_density", periods},
      {"period_velocity", periods},
      {"period_stress", periods},
      {"period_strain", periods},
      {"inertial_share", {.at = 0.2}, false},
      {"stream_narrowing", {.at = {}, .from = 0.2, .to = 0.3}},
      {"drag_to_weight", {.at = 0.2}, true, true},
      {"air_pressure_drop_height", {.at = 0.2}, true, true},
      {"air_pressure_outside_inside", {.at = 0.2}, true, true},
      {"air_velocity_within_plug", {.at = 0.2}, true, true},
      {"air_velocity_beside_plug", {.at = 0.2}, true, true},
      {"air_velocity_slowness", {.at = 0.2}, true, true},
      {"air_vortex_product_bin", {.at = 0.17}, true, true},
      {"air_vortex_product_hopper", {.at = 0.17}, true, true},
      {"air_vortex_reversal_hopper", {.at = {}, .from = 0.17, .to = 1}, true, true},
      {"particle_reynolds_max", {}, false, true},
      {"momentum_error", {}, false},
      {"mass_error", {.at = end}, false},
  };
  std::vector<NamedValue> summary;
  for (const Entry& entry : entries) {
    if (entry.of_slit && !run.setting.shape.plate) continue;
    if (entry.of_air && !run.setting.air) continue;
    summary.push_back({std::string(entry.name), std::string(find_quantity(entry.name)->unit),
                       hopper_quantity(entry.name, run, entry.window)});
  }
  return summary;
}

}  // namespace talus

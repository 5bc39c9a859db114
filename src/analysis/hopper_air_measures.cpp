// SPDX-License-Identifier: Apache-2.0
/// The measures of the air in a vessel: the second part of the list of hopper_measures.cpp.
#include "analysis/hopper_estimators.hpp"
#include "analysis/statistics.hpp"

namespace talus::hopper {

namespace {

using Run = HopperRun;
using Row = Measure<Run>;

bool air(const Run& run) {
  return run.setting.air;
}

}  // namespace

std::vector<Row> hopper_air_measures() {
  return {
      Row("drag_to_weight", "1",
          "upward drag of the air on the grains (Eq. 20, without the pressure's part) over their weight, of the cells "
          "of "
          "the air's grid from `left` to `right` at `height`",
          at(drag_to_weight), {}, across),
      Row("air_pressure_drop_height", "m",
          "z of the largest size of dP/dz (central differences) at `x`, from `from` to `to`",
          at(air_pressure_drop_height), {}, {"x", "from", "to"}),
      Row("air_pressure_gradient_at_drop", "Pa/m", "dP/dz at air_pressure_drop_height",
          at(air_pressure_gradient_at_drop), {}, {"x", "from", "to"}),
      Row("air_pressure_outside_inside", "Pa",
          "at `height` the mean pressure where packing < 0.01, less the mean where packing > 0.1",
          at(air_pressure_outside_inside), {}, {"height"}),
      Row("air_velocity_within_plug", "m/s",
          "mean u_z of the air at `height` where the grains' −u_z is above half its largest value there",
          at(air_velocity_within_plug), {}, {"height"}),
      Row("air_velocity_beside_plug", "m/s",
          "largest mean u_z of the air over five cells at `height` beside the grains of air_velocity_within_plug",
          at(air_velocity_beside_plug), {}, {"height"}),
      Row("air_velocity_slowness", "1", "speed of the air within the moving grains over that of the grains",
          at(air_velocity_slowness), {}, {"height"}),
      Row("air_vortex_product_bin", "1",
          "circulation of the left half of the bin times that of the right one over the sum of their squares; "
          "circulation: integral of ∂u_x/∂z − ∂u_z/∂x over the cells with packing below 0.01",
          {vortex_product<Where::bin>}),
      Row("air_vortex_product_hopper", "1", "air_vortex_product_bin of the two halves of the hopper",
          {vortex_product<Where::hopper>}),
      Row("air_vortex_product_bed", "1",
          "air_vortex_product_hopper over the cells with packing above 0.1: within the grains",
          {vortex_product<Where::hopper, Cells::filled>}),
      Row("air_vortex_reversal_hopper", "1",
          "circulation of the hopper's left half at the beginning of the window times that at its end, over its size",
          {vortex_reversal<>}),
      Row("air_vortex_reversal_bed", "1",
          "circulation within the grains of the hopper's left half at the beginning of the window times that above "
          "them "
          "at its end, over its size",
          {vortex_reversal<Cells::filled>}),
      Row("particle_reynolds_max", "1",
          "largest D |u − u_p| ρ/μ of a grain at any step of the air since the start; the slip of a particle is the "
          "mean "
          "of the cells that it overlaps",
          {[](const Run& r, const Place&, const Window& w) {
            return quantile(part(r.curve("particle_reynolds_max"), w.from, w.to).value, 1);
          }},
          {{air}})};
}

}  // namespace talus::hopper

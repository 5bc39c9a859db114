// SPDX-License-Identifier: Apache-2.0
/// The list of measures of grains in a vessel; those of the mass stand in hopper_mass_measures.cpp, of the air in
/// hopper_air_measures.cpp, of a vessel in space in hopper_vessel_measures.cpp. A row: name, unit, what it means, how
/// it is made; the lengths that it takes from a place; where a summary lists it.
#include "analysis/discharge.hpp"
#include "analysis/hopper_estimators.hpp"
#include "analysis/statistics.hpp"
#include "analysis/wall_loads.hpp"

namespace talus {

namespace {

using namespace hopper;
using Run = HopperRun;
using Row = Measure<Run>;

// Where a summary lists a measure.
bool always(const Run&) {
  return true;
}
bool level_ground(const Run& run) {
  return run.setting.level_ground;
}
bool gravity(const Run& run) {
  return run.setting.gravity > 0;
}
bool outlet(const Run& run) {
  return run.setting.shape.plate.has_value();
}
bool hand_formula(const Run& run) {
  return run.setting.hand_discharge > 0;
}
bool bin(const Run& run) {
  return run.setting.has_floor && run.setting.shape.bin().top > 0;
}
bool outlet_and_bin(const Run& run) {
  return outlet(run) && bin(run);
}

const std::vector<Row> of_grains = {
    Row("floor_stress_settled", "Pa",
        "upward force of floor and plate on the settled bed over the area of the box, over T before the gate "
        "opens; "
        "with `sph.stress_form = \"printed\"`, where the grains feel 1 - Φ of their stress (Eq. 17), that over the "
        "bed's packing: the stress itself",
        {[](const Run& r, const Place&, const Window&) {
          return settled_force(r) / (r.setting.shape.width * r.setting.shape.depth * r.setting.stress_share);
        }},
        {{level_ground}}),
    Row("floor_stress_error", "1", "force on the floor as in floor_stress_settled, over M g, less 1",
        {[](const Run& r, const Place&, const Window&) {
          return settled_force(r) / (r.setting.mass() * r.setting.gravity) - 1;
        }},
        {{level_ground}}),
    Row("stress_ratio_settled", "1",
        "Σ τ_xx over Σ τ_zz of the particles with packing above 0.55, inertial number below 10⁻³ and τ_zz above 50 Pa, "
        "in the last snapshot before the gate opens",
        {settled_stress_ratio}, {{always}}),
    Row("stress_ratio_flow", "1", "the same while it flows", at(stress_ratio), {{always, while_it_flows}}),
    Row("stress_ratio_where_dense", "1",
        "Σ τ_xx over Σ τ_zz of the particles with packing above 0.5, where stresses act", at(stress_ratio_where_dense)),
    Row("discharge_rate_plateau", "kg/s", "mean of Q over the window",
        {[](const Run& r, const Place&, const Window& w) { return mean_rate(passed_mass(r), w.from, w.to); }},
        {{outlet, while_it_flows}}),
    Row("discharge_rate_beverloo", "kg/s",
        "discharge through an outlet of the case's size in a flat bottom by hand. Round: C ρ_b g^½ (D − k d)^(5/2) "
        "(Beverloo et al. 1961), C = 0.58, k = 1.5, times (tan θ)^(−0.35) in a cone of half angle θ below 45 degrees "
        "(Rose & Tanaka 1959). Rectangular: (4 C/π) ρ_b A (g D_h)^½, D_h the hydraulic diameter (Nedderman et al. "
        "1982); of a slit in a plate 1.04 ρ_b g^½ (W − k d)^(3/2) for each length",
        {[](const Run& r, const Place&, const Window&) { return r.setting.hand_discharge; }}, {{hand_formula}}),
    Row("discharge_rate_drift", "1",
        "slope of the line through the means of Q over T/2 times the length of the window, over their mean",
        {[](const Run& r, const Place&, const Window& w) {
          return drift(passed_mass(r), averages(r).trend, w.from, w.to);
        }}),
    Row("discharge_rate_fall", "kg/s", "mean of Q over the window less that over as long a time before",
        {discharge_fall}),
    Row("discharge_rate_extreme_time", "s",
        "centre of the first mean of Q over 0.3 T (one every T/100) that is the largest within 0.3 T before and after",
        {[](const Run& r, const Place&, const Window& w) { return extreme_time(passed_mass(r), r, w); }}, {{outlet}}),
    Row("discharge_rate_max", "kg/s", "largest mean of Q over T, one every T/20",
        {[](const Run& r, const Place&, const Window& w) { return largest_discharge(r, w).value; }}, {{outlet}}),
    Row("discharge_rate_max_time", "s", "its centre",
        {[](const Run& r, const Place&, const Window& w) { return largest_discharge(r, w).time; }}, {{outlet}}),
    Row("discharge_rate_share_of_largest", "1", "mean of Q over the window, over the largest mean over as long a time",
        {discharge_share_of_largest}),
    Row("slit_velocity_extreme_time", "s", "as discharge_rate_extreme_time, of −u_z in the middle of the outlet",
        {[](const Run& r, const Place&, const Window& w) {
          return extreme_time(integral(scaled(r.curve("slit_velocity"), -1)), r, w);
        }},
        {{outlet}}),
    Row("slit_velocity_fluctuation", "m/s",
        "standard deviation of u_z in the middle of the outlet about its centred mean over T",
        {[](const Run& r, const Place&, const Window& w) {
          return fluctuation(r.curve("slit_velocity"), averages(r).largest, w.from, w.to);
        }}),
    Row("floor_arrival_time", "s", "first time at which 0.1 % of M is within h of the floor", {floor_arrival},
        {{outlet_and_bin}}),
    Row("floor_arrival_first_time", "s", "first time at which a particle's centre is lower than `height`",
        {[](const Run& r, const Place& p, const Window&) {
          return first_time_at_or_below(r.curve("lowest_z"), length_of(p, "height"));
        }},
        {}, {"height"}),
    Row("discharged_fraction", "1", "share of M below the outlet", {share_at}, {{outlet}}),
    Row("residual_fraction", "1", "share of M above the outlet",
        {[](const Run& r, const Place& p, const Window& w) { return 1 - share_at(r, p, w); }}, {{outlet}}),
    Row("left_right_imbalance", "1", "difference of the masses left and right in the bin, over M",
        at(left_right_imbalance), {{bin}}),
    Row("repose_angle_bin", "deg",
        "angle of repose in the bin. Surface: packing 0.3, mean over y, one height each h. Slope: rises or falls all "
        "along (5-point mean), longer than 10 h; the line through its middle 80 %. Mean of the longest slopes left and "
        "right of the middle",
        at(repose_angle_in<Where::bin, &ReposeAngle::mean>), {{bin}}),
    Row("repose_angle_bin_steepest", "deg", "the steepest slope in the bin",
        at(repose_angle_in<Where::bin, &ReposeAngle::steepest>), {{bin}}),
    Row("repose_angle_hopper", "deg", "as repose_angle_bin, of the heaps that stay in the hopper",
        at(repose_angle_in<Where::hopper, &ReposeAngle::mean>), {{outlet}}),
    Row("repose_angle_hopper_steepest", "deg", "the steepest slope in the hopper",
        at(repose_angle_in<Where::hopper, &ReposeAngle::steepest>), {{outlet}}),
    Row("repose_angle_nearer", "deg", "of bin and hopper the angle of repose nearer to 30 degrees",
        {[](const Run& r, const Place&, const Window& w) { return repose(r, w, true); }}),
    Row("repose_angle_other", "deg", "of bin and hopper the angle of repose farther from 30 degrees",
        {[](const Run& r, const Place&, const Window& w) { return repose(r, w, false); }}),
    Row("surface_angle_bin", "deg",
        "slope of the bin's surface as a whole: angle of the mean size of the slopes of two lines, through its left "
        "and its right half",
        at(surface_angle_in<Where::bin>), {{bin}}),
    Row("surface_angle_hopper", "deg",
        "slope of the hopper's surface as a whole: angle of the mean size of the slopes of two lines, through its left "
        "and its right half, mean over the window",
        mean_of(surface_angle_in<Where::hopper>), {{outlet, while_it_flows}}),
    Row("surface_height_bin", "m",
        "mean height of the bin's surface (as in repose_angle_bin) at distances between `from` and `to` from the "
        "middle, left and right together",
        at(surface_height_in<Where::bin>), {}, beside),
    Row("surface_height_hopper", "m",
        "mean height of the hopper's surface (as in repose_angle_hopper) at distances between `from` and `to` from the "
        "middle, left and right together",
        at(surface_height_in<Where::hopper>), {}, beside),
    Row("surface_outward_angle_bin", "deg",
        "angle at which the bin's surface falls towards the walls between distances `from` and `to` from the middle: "
        "of the mean of the slopes of two lines, left and right; negative where it rises towards them",
        at(surface_outward_angle_in<Where::bin>), {}, beside),
    Row("surface_inward_angle_hopper", "deg",
        "angle at which the hopper's surface falls towards the middle between distances `from` and `to` from it: of "
        "the mean of the slopes of two lines, left and right; negative where it falls towards the walls",
        at(surface_inward_angle_hopper), {}, beside),
    Row("surface_inward_angle_largest_fall", "deg", "as surface_angle_largest_fall, of surface_inward_angle_hopper",
        {largest_fall_of<surface_inward_angle_hopper>}, {}, beside),
    Row("surface_inward_angle_end_difference", "deg", "surface_inward_angle_hopper less repose_angle_hopper",
        {above_repose<surface_inward_angle_hopper>}, {}, beside),
    Row("swelling_above_flanks", "m",
        "height of the hopper's surface in the middle, mean over `width`, less where the lines through it between "
        "distances `from` and `to` from the middle, prolonged, have it, mean over the window",
        mean_of(swelling_above_flanks), {}, {"from", "to", "width"}),
    Row("foot_speed", "m/s",
        "slope of the line through the foot's reach, one each snapshot, against time, while it is between `from` and "
        "`to`; reach: distance from the middle, mean of left and right, at which the mean packing of the lowest "
        "`height` of the bin passes 0.15",
        {foot_speed}, {}, {"height", "from", "to"}),
    Row("surface_swelling", "m",
        "height of the hopper's surface in the middle less that `beside` it, means over `width`, mean over the window",
        mean_of(surface_swelling), {}, {"beside", "width"}),
    Row("surface_angle_largest_fall", "deg",
        "largest by which surface_angle_hopper lies below an earlier value, means over T/2, once it has passed 1 "
        "degree",
        {largest_fall_of<surface_angle_in<Where::hopper>>}),
    Row("surface_angle_end_difference", "deg", "surface_angle_hopper less repose_angle_hopper",
        {above_repose<surface_angle_in<Where::hopper>>}),
    Row("weight_balance_error", "1", "upward force of all walls, from their impulses over T, over M g, less 1",
        {balance_error}, {{always}}),
    Row("quiescent_speed", "m/s",
        "95th percentile of the speeds of the particles deeper than 3 h below the surface, and not within 3 h of the "
        "outlet; speed: displacement since the snapshot about T before, over the time between",
        at(quiescent_speed), {{always}}),
    Row("packing_max", "1", "99.9th percentile of the particles' packing, largest over the snapshots",
        largest_of(packing_max), {{always}}),
    Row("packing_max_outside_impact", "1",
        "99.9th percentile of the packing of the particles farther than `distance` from where the stream strikes the "
        "bin's surface, largest over the snapshots; of a part "
        "of the particles, so that it may be above packing_max",
        largest_of(packing_max_outside_impact), {}, {"distance"}),
    Row("density_drift", "1",
        "mean of |density by continuity over the kernel's − 1| deeper than 3 h, largest over the snapshots",
        largest_of(density_drift), {{always}}),
    Row("period_discharge", "s",
        "Q at a hundred values in T, line removed, Hann window, zero-padded four times: period of the highest peak of "
        "the power between T/10 and T",
        period_of("discharge_rate"), {{outlet, while_it_flows}}),
    Row("period_density", "s",
        "period of ρ_b an eighth of its width above the middle of the outlet, from its spectrum as in period_discharge",
        period_of("probe_density")),
    Row("period_velocity", "s",
        "period of u_z an eighth of its width above the middle of the outlet, from its spectrum as in period_discharge",
        period_of("probe_velocity")),
    Row("period_stress", "s",
        "period of τ_zz an eighth of its width above the middle of the outlet, from its spectrum as in "
        "period_discharge",
        period_of("probe_stress")),
    Row("period_strain", "s",
        "period of the strain that the law remembers an eighth of its width above the middle of the outlet, from its "
        "spectrum as in "
        "period_discharge",
        period_of("probe_strain")),
    Row("crossing_period_discharge", "s",
        "Q less its centred mean over T, a hundred values in T: mean time between its passages upwards through 0",
        crossing_period_of("discharge_rate"), {{outlet, while_it_flows}}),
    Row("crossing_period_density", "s",
        "ρ_b an eighth of its width above the middle of the outlet less its centred mean over T: mean time between its "
        "passages upwards "
        "through 0, as in crossing_period_discharge",
        crossing_period_of("probe_density")),
    Row("crossing_period_velocity", "s",
        "u_z an eighth of its width above the middle of the outlet less its centred mean over T: mean time between its "
        "passages upwards "
        "through 0, as in crossing_period_discharge",
        crossing_period_of("probe_velocity")),
    Row("crossing_period_stress", "s",
        "τ_zz an eighth of its width above the middle of the outlet less its centred mean over T: mean time between "
        "its passages upwards "
        "through 0, as in crossing_period_discharge",
        crossing_period_of("probe_stress")),
    Row("crossing_period_strain", "s",
        "the strain that the law remembers an eighth of its width above the middle of the outlet less its centred mean "
        "over T: mean time "
        "between its passages upwards through 0, as in crossing_period_discharge",
        crossing_period_of("probe_strain")),
    Row("inertial_share_of_bearing", "1",
        "share with I below 10⁻² of the particles that bear a pressure and are not below the outlet, mean over the "
        "window",
        mean_of(inertial_share_of_bearing)),
    Row("inertial_share_of_bearing_in_shear", "1",
        "as inertial_share_of_bearing, with the largest |∂u_i/∂x_j + ∂u_j/∂x_i|, i ≠ j, for γ̇",
        mean_of(inertial_share_of_bearing_in_shear)),
    Row("inertial_share", "1",
        "share of the particles above the outlet with I = γ̇ D √(ρ_p/p) below 10⁻²; without pressure I is infinite",
        at(inertial_share), {{always, while_it_flows}}),
    Row("velocity_gradient_shear_max", "1",
        "(D/g)^½ times the largest |∂u_i/∂x_j|, i ≠ j, of the particles with packing above 0.5, corrected gradient, "
        "largest over the snapshots",
        largest_of(gradient<&GradientSizes::shear_max>), {{gravity}}),
    Row("velocity_gradient_normal_max", "1",
        "(D/g)^½ times the largest |∂u_i/∂x_i| of the particles with packing above 0.5, corrected gradient, largest "
        "over the snapshots",
        largest_of(gradient<&GradientSizes::normal_max>), {{gravity}}),
    Row("velocity_gradient_shear_percentile", "1",
        "as velocity_gradient_shear_max, the 99.9th percentile over the particles in place of the largest",
        largest_of(gradient<&GradientSizes::shear_percentile>)),
    Row("velocity_gradient_normal_percentile", "1",
        "as velocity_gradient_normal_max, the 99.9th percentile over the particles in place of the largest",
        largest_of(gradient<&GradientSizes::normal_percentile>)),
    Row("cell_gradient_shear_max", "1",
        "(D/g)^½ times the largest |∂u_x/∂z| or |∂u_z/∂x| above the outlet, central differences of velocities averaged "
        "over cells of three quarters of a spacing with packing above 0.5, largest over the snapshots",
        largest_of(cell_gradient<&GradientSizes::shear_max>)),
    Row("cell_gradient_normal_max", "1", "as cell_gradient_shear_max, of |∂u_x/∂x| or |∂u_z/∂z|",
        largest_of(cell_gradient<&GradientSizes::normal_max>)),
    Row("cell_gradient_shear_percentile", "1",
        "as cell_gradient_shear_max, the 99.9th percentile over the cells in place of the largest",
        largest_of(cell_gradient<&GradientSizes::shear_percentile>)),
    Row("cell_gradient_normal_percentile", "1",
        "as cell_gradient_normal_max, the 99.9th percentile over the cells in place of the largest",
        largest_of(cell_gradient<&GradientSizes::normal_percentile>)),
    Row("hopper_velocity", "m/s", "mean of u_z from `left` to `right` at `height`", at(hopper_velocity), {}, across),
    Row("hopper_packing", "1", "mean packing from `left` to `right` at `height`", at(hopper_packing), {}, across),
    Row("stream_narrowing", "1",
        "width of the stream (5th to 95th percentile of the mass in x) from `below_from` to `below_to` over that from "
        "`above_from` to `above_to`, each the mean over the snapshots in which the heap beside it is lower than that",
        {narrowing}, {}, {"above_from", "above_to", "below_from", "below_to"}),
    Row("stream_packing", "1", "mean packing of the stream's particles from `from` to `to`, while the heap is lower",
        at(stream_packing), {}, {"from", "to"}),
    Row("stream_packing_of_cells", "1",
        "mean packing of the cells of three quarters of a spacing from `from` to `to`, in the middle of the depth, in "
        "which it is above 0.1, while the heap is lower",
        at(stream_packing_of_cells), {}, {"from", "to"}),
    Row("stream_stress_share", "1",
        "mean τ_zz of the stream's particles from `from` to `to`, while the heap is lower, over that of the grains "
        "above "
        "the outlet",
        at(stream_stress_share), {}, {"from", "to"}),
    Row("stream_stripes", "1",
        "standard deviation of the packing along the middle of the stream from `from` to `to`, over its mean",
        at(stream_stripes), {}, {"from", "to"}),
    Row("corner_packing_ratio_hopper", "1",
        "mean packing of the squares of `size` in the hopper's two bottom corners over that of the layer deeper than 3 "
        "h, without the outermost h/2",
        at(corner_packing_ratio_in<Where::hopper>), {}, {"size"}),
    Row("corner_packing_ratio_bin", "1", "the same in the bin", at(corner_packing_ratio_in<Where::bin>), {}, {"size"}),
    Row("corner_packing_over_middle_bin", "1",
        "mean packing of the squares of `size` in the bin's two bottom corners over that of the middle third of the "
        "layer "
        "of that height, without the outermost h/2",
        at(corner_packing_over_middle_bin), {}, {"size"}),
    Row("momentum_error", "1",
        "size of the change of momentum that the impulses of gravity, air, walls and damping do not explain, over "
        "gravity's impulse; settling included",
        {[](const Run& r, const Place&, const Window&) { return momentum_error(r.series); }}, {{always}}),
    Row("wall_seconds", "s", "wall time of the whole run, as its summary says",
        {[](const Run& r, const Place&, const Window&) { return r.wall_seconds; }}),
};

const GroupMeasure<Run> of_two[] = {
    {"discharge_rate_ratio_at_max", "1",
     "ratio of the discharges of two runs at the time of the first one's largest mean over T", ratio_at_largest},
    {"discharge_rate_share_larger", "1", "share of the means over T in which the first of two runs discharges more",
     share_of_larger},
    {"discharge_resolution_difference", "1",
     "largest difference of the discharged shares of two runs at equal times, one every T/20",
     largest_share_difference},
};

}  // namespace

std::span<const Measure<Run>> hopper_measures() {
  static const std::vector<Row> list = [] {
    std::vector<Row> all = of_grains;
    for (const std::vector<Row>& more : {hopper_mass_measures(), hopper_vessel_measures(), hopper_air_measures()})
      all.insert(all.end(), more.begin(), more.end());
    return all;
  }();
  return list;
}

std::span<const GroupMeasure<Run>> hopper_pair_measures() {
  return of_two;
}

std::vector<MeasureText> texts_of_hopper_measures() {
  return texts_of(hopper_measures(), hopper_pair_measures());
}

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
/// The list of measures of grains in a vessel; measures of a vessel in space are in hopper_vessel_measures.cpp. A row:
/// name, unit, what it means, how it is made; where a summary lists it.
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
  return run.setting.shape.outlet.has_value();
}
bool hand_formula(const Run& run) {
  return run.setting.hand_discharge > 0;
}
bool bin(const Run& run) {
  return run.setting.has_floor && run.setting.shape.bin().top > 0;
}
bool air(const Run& run) {
  return run.setting.air;
}
bool comes_or_goes(const Run& run) {
  return run.series.has("fed_mass");
}
bool outlet_and_bin(const Run& run) {
  return outlet(run) && bin(run);
}
/// Whether heaps are the same along y, over which their surface is a mean: not in a vessel in space without a slit.
bool is_plane(const Run& run) {
  return run.setting.section.empty() || run.setting.outlet_length > 0;
}
bool plane_bin(const Run& run) {
  return is_plane(run) && bin(run);
}
bool plane_outlet(const Run& run) {
  return is_plane(run) && outlet(run);
}

/// The last value of a column of the series; 0 if there is none.
double last(const Run& run, const char* column) {
  return run.series.has(column) ? run.series.column(column).back() : 0;
}

double mass_error(const Run& run, const Window& window) {
  const double of_all = run.setting.mass() + last(run, "fed_mass");
  return std::abs((value_at_window(mass, run, window) + last(run, "removed_mass")) / of_all - 1);
}

const std::vector<Row> of_grains = {
    Row("floor_stress_settled", "Pa",
        "upward force of floor and plate on the settled bed over the area of the box, over T before the gate "
        "opens; "
        "with `sph.stress_form = \"printed\"`, where the grains feel 1 - Φ of their stress (Eq. 17), that over the "
        "bed's packing: the stress itself",
        {[](const Run& r, const Window&) {
          return settled_force(r) / (r.setting.shape.width * r.setting.shape.depth * r.setting.stress_share);
        }},
        {level_ground}),
    Row("floor_stress_error", "1", "force on the floor as in floor_stress_settled, over M g, less 1",
        {[](const Run& r, const Window&) { return settled_force(r) / (r.setting.mass() * r.setting.gravity) - 1; }},
        {level_ground}),
    Row("stress_ratio_settled", "1",
        "Σ τ_xx over Σ τ_zz of the particles with packing above 0.55, inertial number below 10⁻³ and τ_zz above 50 Pa, "
        "in the last snapshot before the gate opens",
        {settled_stress_ratio}, {always}),
    Row("stress_ratio_flow", "1", "the same while it flows", at(stress_ratio), {always, while_it_flows}),
    Row("discharge_rate_plateau", "kg/s", "mean of Q over the window",
        {[](const Run& r, const Window& w) { return mean_rate(passed_mass(r), w.from, w.to); }},
        {outlet, while_it_flows}),
    Row("discharge_rate_beverloo", "kg/s",
        "discharge through an outlet of the case's size in a flat bottom, analytical estimate. Round: C ρ_b g^½ (D − k "
        "d)^(5/2) "
        "(Beverloo et al. 1961), C = 0.58, k = 1.5, times (tan θ)^(−0.35) in a cone of half angle θ below 45 degrees "
        "(Rose & Tanaka 1959). Rectangular: (4 C/π) ρ_b A (g D_h)^½, D_h the hydraulic diameter (Nedderman et al. "
        "1982); of a slit in a plate 1.04 ρ_b g^½ (W − k d)^(3/2) for each length",
        {[](const Run& r, const Window&) { return r.setting.hand_discharge; }}, {hand_formula}),
    Row("discharge_rate_extreme_time", "s",
        "centre of the first mean of Q over 0.3 T (one every T/100) that is the largest within 0.3 T before and after",
        {[](const Run& r, const Window& w) { return extreme_time(passed_mass(r), r, w); }}, {outlet}),
    Row("discharge_rate_max", "kg/s", "largest mean of Q over T, one every T/20",
        {[](const Run& r, const Window& w) { return max_discharge(r, w).value; }}, {outlet}),
    Row("discharge_rate_max_time", "s", "its centre",
        {[](const Run& r, const Window& w) { return max_discharge(r, w).time; }}, {outlet}),
    Row("slit_velocity_extreme_time", "s", "as discharge_rate_extreme_time, of −u_z in the middle of the outlet",
        {[](const Run& r, const Window& w) {
          return extreme_time(integral(scaled(r.curve("slit_velocity"), -1)), r, w);
        }},
        {outlet}),
    Row("floor_arrival_time", "s", "first time at which 0.1 % of M is within h of the floor", {floor_arrival},
        {outlet_and_bin}),
    Row("discharged_fraction", "1", "share of M below the outlet", {share_at}, {outlet}),
    Row("residual_fraction", "1", "share of M above the outlet",
        {[](const Run& r, const Window& w) { return 1 - share_at(r, w); }}, {outlet}),
    Row("left_right_imbalance", "1", "difference of the masses left and right in the bin, over M",
        at(left_right_imbalance), {bin}),
    Row("repose_angle_bin", "deg",
        "angle of repose in the bin. Surface: packing 0.3, mean over y, one height each h. Slope: rises or falls all "
        "along (5-point mean), longer than 10 h; the line through its middle 80 %. Mean of the longest slopes left and "
        "right of the middle. Not in a vessel in space, whose heaps are round",
        at(repose_angle_in<Where::bin, &ReposeAngle::mean>), {plane_bin}),
    Row("repose_angle_bin_steepest", "deg", "the steepest slope in the bin",
        at(repose_angle_in<Where::bin, &ReposeAngle::steepest>), {plane_bin}),
    Row("repose_angle_hopper", "deg", "as repose_angle_bin, of the heaps that stay in the hopper",
        at(repose_angle_in<Where::hopper, &ReposeAngle::mean>), {plane_outlet}),
    Row("repose_angle_hopper_steepest", "deg", "the steepest slope in the hopper",
        at(repose_angle_in<Where::hopper, &ReposeAngle::steepest>), {plane_outlet}),
    Row("surface_angle_bin", "deg",
        "slope of the bin's surface as a whole: angle of the mean size of the slopes of two lines, through its left "
        "and its right half",
        at(surface_angle_in<Where::bin>), {plane_bin}),
    Row("surface_angle_hopper", "deg",
        "slope of the hopper's surface as a whole: angle of the mean size of the slopes of two lines, through its left "
        "and its right half, mean over the window",
        mean_of(surface_angle_in<Where::hopper>), {plane_outlet, while_it_flows}),
    Row("weight_balance_error", "1", "upward force of all walls, from their impulses over T, over M g, less 1",
        {balance_error}, {always}),
    Row("quiescent_speed", "m/s",
        "95th percentile of the speeds of the particles deeper than 3 h below the surface, and not within 3 h of the "
        "outlet; speed: displacement since the snapshot about T before, over the time between",
        at(quiescent_speed), {always}),
    Row("packing_max", "1", "99.9th percentile of the particles' packing, largest over the snapshots",
        max_of(packing_max), {always}),
    Row("density_drift", "1",
        "mean of |density by continuity over the kernel's − 1| deeper than 3 h, largest over the snapshots",
        max_of(density_drift), {always}),
    Row("period_discharge", "s",
        "Q at a hundred values in T, line removed, Hann window, zero-padded four times: period of the highest peak of "
        "the power between T/10 and T",
        {period_of_discharge}, {outlet, while_it_flows}),
    Row("crossing_period_discharge", "s",
        "Q less its centred mean over T, a hundred values in T: mean time between its passages upwards through 0",
        {crossing_period_of_discharge}, {outlet, while_it_flows}),
    Row("inertial_share", "1",
        "share by mass of the particles above the outlet with I = γ̇ D √(ρ_p/p) below 10⁻²; without pressure I is "
        "infinite",
        at(inertial_share), {always, while_it_flows}),
    Row("velocity_gradient_shear_max", "1",
        "(D/g)^½ times the largest |∂u_i/∂x_j|, i ≠ j, of the particles with packing above 0.5, corrected gradient, "
        "largest over the snapshots",
        max_of(gradient<&GradientSizes::shear_max>), {gravity}),
    Row("velocity_gradient_normal_max", "1",
        "(D/g)^½ times the largest |∂u_i/∂x_i| of the particles with packing above 0.5, corrected gradient, largest "
        "over the snapshots",
        max_of(gradient<&GradientSizes::normal_max>), {gravity}),
    Row("momentum_error", "1",
        "size of the change of momentum that the impulses of gravity, air, walls and damping do not explain, over "
        "gravity's impulse; settling included",
        {[](const Run& r, const Window&) { return momentum_error(r.series); }}, {always}),
    Row("mass_error", "1", "|mass of all particles and of what was removed over M and what inlets fed, − 1|",
        {mass_error}, {always}),
    Row("outside_fraction", "1",
        "share of M and what inlets fed beyond open faces of the box at the end of the run; adjacent walls and floor "
        "go on there",
        {[](const Run& r, const Window&) {
          return last(r, "mass_outside") / (r.setting.mass() + last(r, "fed_mass"));
        }},
        {always}),
    Row("fed_mass", "kg", "mass that came in through inlets, to the end of the run",
        {[](const Run& r, const Window&) { return last(r, "fed_mass"); }}, {comes_or_goes}),
    Row("removed_mass", "kg", "mass that was taken away, to the end of the run",
        {[](const Run& r, const Window&) { return last(r, "removed_mass"); }}, {comes_or_goes}),
    Row("air_lift", "1", "upward force of the air on the grains, drag and pressure, over their weight, mean over T",
        {share_on_air}, {air}),
    Row("air_pressure_difference", "Pa", "largest less smallest pressure of the air, mean over T",
        {pressure_range_of_air}, {air}),
    Row("particle_reynolds_max", "1",
        "largest D |u − u_p| ρ/μ of a grain at any step of the air since the start; the slip of a particle is the "
        "mean "
        "of the cells that it overlaps",
        {[](const Run& r, const Window& w) {
          return quantile(part(r.curve("particle_reynolds_max"), w.from, w.to).value, 1);
        }},
        {air}),
};

}  // namespace

std::span<const Measure<Run>> hopper_measures() {
  static const std::vector<Row> list = [] {
    std::vector<Row> all = of_grains;
    for (const Row& row : hopper_vessel_measures()) all.push_back(row);
    return all;
  }();
  return list;
}

std::vector<MeasureText> texts_of_hopper_measures() {
  return texts_of(hopper_measures());
}

}  // namespace talus

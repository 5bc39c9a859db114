// SPDX-License-Identifier: Apache-2.0
#include "analysis/hopper.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/displacement.hpp"
#include "analysis/granular_state.hpp"
#include "analysis/heap_slopes.hpp"
#include "analysis/statistics.hpp"

namespace talus {

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double nearly_all = 0.999, most = 0.95;
constexpr double least_slope_in_spacings = 10;
constexpr double impact = 20e-3, corner = 10e-3;  // m

// Places of the paper's figures, m; the box is 100 mm wide, the plate 100 mm high.
constexpr double swelling_beside = 20e-3, swelling_width = 4e-3;
constexpr double profile_height = 120e-3, profile_left = 30e-3, profile_right = 70e-3;
constexpr double above_from = 90e-3, above_to = 100e-3, below_from = 40e-3, below_to = 60e-3;  // layers of the stream
constexpr double stream_from = 40e-3, stream_to = 90e-3, stripes_to = 95e-3;

Particles particles_of(const Snapshot& snapshot, const HopperSetting& s) {
  return particles_of_density(snapshot.positions(), snapshot.scalars("density"), s.particle_mass, s.grain_density,
                              s.smoothing_length);
}

Domain domain_at(const HopperSetting& setting, bool gate_is_open) {
  Domain domain = setting.domain;
  if (gate_is_open) domain.open_gates();
  return domain;
}

void measure_surfaces(HopperFrame& frame, const HopperView& view, const HopperShape& shape) {
  const double least = least_slope_in_spacings * shape.spacing, middle = shape.middle();
  const ReposeAngle bin = repose_angle(heap_slopes(view.surfaces.bin, least), middle);
  frame.surface_angle_bin = surface_angle(view.surfaces.bin, middle) / degree;
  frame.repose_angle_bin = bin.mean / degree;
  frame.repose_angle_bin_steepest = bin.steepest / degree;
  frame.corner_packing_ratio_bin = corner_packing_ratio(view.packing, view.surfaces.bin, shape.bin(), shape, corner);
  if (!shape.plate) return;
  const ReposeAngle hopper = repose_angle(heap_slopes(view.surfaces.hopper, least), middle);
  frame.surface_angle_hopper = surface_angle(view.surfaces.hopper, middle) / degree;
  frame.surface_swelling = surface_swelling(view.surfaces.hopper, middle, swelling_beside, swelling_width);
  frame.repose_angle_hopper = hopper.mean / degree;
  frame.repose_angle_hopper_steepest = hopper.steepest / degree;
  frame.corner_packing_ratio_hopper =
      corner_packing_ratio(view.packing, view.surfaces.hopper, shape.hopper(), shape, corner);
}

/// Whether the heap in the bin, left and right of what is below the slit, is lower than where the stream is measured.
bool stream_is_free(const FreeSurface& bin, const HopperShape::Plate& plate) {
  for (std::size_t n = 0; n < bin.x.size(); ++n)
    if ((bin.x[n] < plate.slit_left || bin.x[n] > plate.slit_right) && bin.z[n] > below_from) return false;
  return true;
}

void measure_stream(HopperFrame& frame, const Snapshot& snapshot, const ParticleField& field,
                    const HopperShape& shape) {
  frame.stream_width_above = stream_width(snapshot.positions(), above_from, above_to);
  frame.stream_width_below = stream_width(snapshot.positions(), below_from, below_to);
  frame.stream_packing = mean_between(snapshot.positions(), snapshot.scalars("packing"), stream_from, stream_to);
  std::vector<double> along;
  for (double z = stream_from; z < stripes_to; z += hopper_cell)
    along.push_back(field.packing(cell_centre({shape.middle(), 0.5 * shape.depth, z}, hopper_cell)));
  if (mean(along) > 0) frame.stream_stripes = standard_deviation(along) / mean(along);
}

void measure_hopper(HopperFrame& frame, const Snapshot& snapshot, const ParticleField& field,
                    const HopperShape& shape) {
  std::vector<double> velocity, packing;
  for (double x = profile_left; x < profile_right; x += hopper_cell) {
    const Vector3 cell = cell_centre({x, 0.5 * shape.depth, profile_height}, hopper_cell);
    velocity.push_back(field.value(cell, snapshot.vectors("velocity")).z);
    packing.push_back(field.packing(cell));
  }
  frame.hopper_velocity = mean(velocity);
  frame.hopper_packing = mean(packing);
}

double imbalance_in_bin(std::span<const Vector3> position, const HopperSetting& setting) {
  double difference = 0;
  for (const Vector3& x : position)
    if (x.z < setting.shape.bin().top) difference += x.x < setting.shape.middle() ? -1 : 1;
  return std::abs(difference) / setting.particles;
}

std::vector<bool> without_nan(std::vector<bool> taken, std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i) taken[i] = taken[i] && !std::isnan(values[i]);
  return taken;
}

}  // namespace

HopperView hopper_view(const Snapshot& snapshot, const HopperSetting& setting, bool gate_is_open) {
  const double h = setting.shape.spacing;
  HopperView view{packing_section(particles_of(snapshot, setting), domain_at(setting, gate_is_open), h, 0.5 * h), {}};
  view.surfaces = hopper_surfaces(view.packing, setting.shape);
  return view;
}

HopperFrame hopper_frame(const Snapshot& snapshot, const Snapshot* before, const HopperSetting& setting,
                         double gate_time) {
  HopperFrame frame{.time = snapshot.time - gate_time};
  const bool open = frame.time >= 0;
  const auto position = snapshot.positions();
  const auto packing = snapshot.scalars("packing");
  frame.mass = static_cast<double>(position.size()) * setting.particle_mass;
  if (position.empty()) return frame;

  const HopperView view = hopper_view(snapshot, setting, open);
  const std::vector<bool> deep = deep_particles(position, view.surfaces, setting.shape);
  measure_surfaces(frame, view, setting.shape);
  frame.packing_max = quantile(packing, nearly_all);
  frame.packing_max_outside_impact =
      quantile_of(packing, outside_impact(position, view.surfaces.bin, setting.shape, impact), nearly_all);
  frame.density_drift = density_drift(snapshot.scalars("density"), packing, setting.grain_density, deep);
  if (before) {
    const std::vector<double> speed = mean_speeds(*before, snapshot);
    frame.quiescent_speed = quantile_of(speed, without_nan(deep, speed), most);
  }

  const std::vector<double> inertial = inertial_numbers(snapshot, setting.grain_diameter, setting.grain_density);
  frame.stress_ratio = stress_ratio(snapshot, inertial);
  frame.inertial_share = inertial_share(position, inertial, setting.shape.plate ? setting.shape.plate->height : 0);

  const ParticleField field(particles_of(snapshot, setting), domain_at(setting, open));
  const GradientSizes sizes =
      velocity_gradient_sizes(field, snapshot.vectors("velocity"), packing, setting.grain_diameter, setting.gravity);
  frame.velocity_gradient_shear_max = sizes.shear_max;
  frame.velocity_gradient_shear_percentile = sizes.shear_percentile;
  frame.velocity_gradient_normal_max = sizes.normal_max;
  frame.velocity_gradient_normal_percentile = sizes.normal_percentile;

  frame.left_right_imbalance = imbalance_in_bin(position, setting);
  if (!setting.shape.plate) return frame;
  if (stream_is_free(view.surfaces.bin, *setting.shape.plate)) measure_stream(frame, snapshot, field, setting.shape);
  measure_hopper(frame, snapshot, field, setting.shape);
  return frame;
}

double HopperRun::end() const {
  return series.column("time").back() - gate_time;
}

Curve HopperRun::curve(std::string_view column) const {
  Curve result;
  if (!series.has(column)) return result;
  const auto time = series.column("time"), value = series.column(column);
  result.value.assign(value.begin(), value.end());
  for (const double t : time) result.time.push_back(t - gate_time);
  return result;
}

Curve HopperRun::curve(double HopperFrame::*number) const {
  Curve result;
  for (const HopperFrame& frame : frames) {
    if (frame.time < 0 || !std::isfinite(frame.*number)) continue;
    result.time.push_back(frame.time);
    result.value.push_back(frame.*number);
  }
  return result;
}

double gate_time_of(const Series& series) {
  if (series.has("gate_time"))
    for (const double time : series.column("gate_time"))
      if (time >= 0) return time;
  return series.column("time").back();
}

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
#include "analysis/hopper_numbers.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/displacement.hpp"
#include "analysis/statistics.hpp"

namespace talus::hopper {

namespace {

constexpr double none = HopperRun::none;
constexpr double nearly_all = 0.999, most = 0.95;
constexpr double least_slope_in_spacings = 10;
constexpr double foot_packing = 0.15;

/// The numbers of the hopper need an outlet below it.
bool has_hopper(const HopperSnapshot& s) {
  return s.shape().plate.has_value();
}

/// Whether the heap in the bin, left and right of what is below the outlet, is lower than a height.
bool stream_is_free(const HopperSnapshot& s, const Place& place) {
  const double height = length_of(place, place.contains("free") ? "free" : "from");
  if (!s.shape().plate || s.now.size() == 0) return false;
  const FreeSurface& bin = s.surfaces().bin;
  const HopperShape::Plate& outlet = *s.shape().plate;
  for (std::size_t n = 0; n < bin.x.size(); ++n)
    if ((bin.x[n] < outlet.slit_left || bin.x[n] > outlet.slit_right) && bin.z[n] > height) return false;
  return true;
}

std::vector<bool> without_nan(std::vector<bool> taken, std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i) taken[i] = taken[i] && !std::isnan(values[i]);
  return taken;
}

std::vector<bool> both(std::vector<bool> taken, const std::vector<bool>& too) {
  for (std::size_t i = 0; i < taken.size(); ++i) taken[i] = taken[i] && too[i];
  return taken;
}

/// The largest distance from the middle, on the side of `sign`, at which the packing of the columns passes the foot's;
/// the wall's where it does not.
double reach_to(const Section& section, const std::vector<double>& packing, double middle, int sign) {
  double reach = none;
  for (std::size_t c = 0; c < packing.size(); ++c) {
    const double away = sign * (section.x(c) - middle);
    if (packing[c] < foot_packing || away <= 0) continue;
    const bool is_outermost = c == (sign < 0 ? 0 : packing.size() - 1);
    const double next = is_outermost ? 0 : packing[sign < 0 ? c - 1 : c + 1];
    if (is_outermost) reach = std::fmax(reach, away + 0.5 * section.width);
    if (!is_outermost && next < foot_packing)
      reach = std::fmax(reach, away + section.width * (packing[c] - foot_packing) / (packing[c] - next));
  }
  return reach;
}

/// Mean of what `value` makes of the centres of the cells from left to right at a height.
template <class Value>
double mean_across(const HopperSnapshot& s, const Place& place, Value&& value) {
  if (!has_hopper(s) || s.now.size() == 0) return none;
  const double cell = s.shape().cell();
  std::vector<double> values;
  for (double x = length_of(place, "left"); x < length_of(place, "right"); x += cell)
    values.push_back(value(cell_centre({x, 0.5 * s.shape().depth, length_of(place, "height")}, cell)));
  return mean(values);
}

}  // namespace

double mass(const HopperSnapshot& s, const Place&) {
  return static_cast<double>(s.now.size()) * s.setting.particle_mass;
}

const FreeSurface& surface_in(const HopperSnapshot& s, Where where) {
  return where == Where::bin ? s.surfaces().bin : s.surfaces().hopper;
}

ReposeAngle repose_in(const HopperSnapshot& s, Where where) {
  const double least = least_slope_in_spacings * s.shape().spacing;
  return repose_angle(heap_slopes(surface_in(s, where), least), s.shape().middle());
}

double corner_packing_in(const HopperSnapshot& s, Where where, double size) {
  if (where == Where::hopper && !s.shape().plate) return none;
  return corner_packing_ratio(s.packing_section(), surface_in(s, where),
                              where == Where::bin ? s.shape().bin() : s.shape().hopper(), s.shape(), size);
}

double surface_swelling(const HopperSnapshot& s, const Place& place) {
  if (!has_hopper(s)) return none;
  return talus::surface_swelling(s.surfaces().hopper, s.shape().middle(), length_of(place, "beside"),
                                 length_of(place, "width"));
}

double swelling_above_flanks(const HopperSnapshot& s, const Place& place) {
  if (!has_hopper(s)) return none;
  return talus::swelling_above_flanks(s.surfaces().hopper, s.shape().middle(), length_of(place, "from"),
                                      length_of(place, "to"), length_of(place, "width"));
}

double surface_inward_angle_hopper(const HopperSnapshot& s, const Place& place) {
  return -surface_outward_angle_in<Where::hopper>(s, place);
}

double corner_packing_over_middle_bin(const HopperSnapshot& s, const Place& place) {
  return corner_packing_over_middle(s.packing_section(), s.shape().bin(), s.shape(), length_of(place, "size"));
}

double quiescent_speed(const HopperSnapshot& s, const Place&) {
  const Snapshot* before = s.before ? s.before() : nullptr;
  if (!before) return none;
  const std::vector<double> speed = mean_speeds(*before, s.now);
  return quantile_of(speed, without_nan(s.deep(), speed), most);
}

double packing_max(const HopperSnapshot& s, const Place&) {
  return quantile(s.now.scalars("packing"), nearly_all);
}

double packing_max_outside_impact(const HopperSnapshot& s, const Place& place) {
  return quantile_of(s.now.scalars("packing"),
                     outside_impact(s.now.positions(), s.surfaces().bin, s.shape(), length_of(place, "distance")),
                     nearly_all);
}

double density_drift(const HopperSnapshot& s, const Place&) {
  return talus::density_drift(s.now.scalars("density"), s.now.scalars("packing"), s.setting.grain_density, s.deep());
}

double stress_ratio(const HopperSnapshot& s, const Place&) {
  return talus::stress_ratio(s.now, quasistatic_particles(s.now, s.inertial()));
}

double stress_ratio_where_dense(const HopperSnapshot& s, const Place&) {
  return talus::stress_ratio(s.now, dense_particles(s.now));
}

double inertial_share_of_bearing(const HopperSnapshot& s, const Place&) {
  return talus::inertial_share(s.inertial(),
                               both(outside_outlet(s.now.positions(), s.shape()), bearing_particles(s.inertial())));
}

double inertial_share_of_bearing_in_shear(const HopperSnapshot& s, const Place&) {
  if (s.now.size() == 0) return none;
  const std::vector<double> inertial =
      inertial_numbers_of_shear(s.now, s.velocity_gradients(), s.setting.grain_diameter, s.setting.grain_density);
  return talus::inertial_share(inertial,
                               both(outside_outlet(s.now.positions(), s.shape()), bearing_particles(inertial)));
}

double inertial_share(const HopperSnapshot& s, const Place&) {
  return talus::inertial_share(s.inertial(), above_outlet(s.now.positions(), s.shape()));
}

double left_right_imbalance(const HopperSnapshot& s, const Place&) {
  double difference = 0;
  for (const Vector3& x : s.now.positions())
    if (x.z < s.shape().bin().top) difference += x.x < s.shape().middle() ? -1 : 1;
  return std::abs(difference) / s.setting.particles;
}

double stream_width(const HopperSnapshot& s, const Place& place) {
  if (!stream_is_free(s, place)) return none;
  return talus::stream_width(s.now.positions(), length_of(place, "from"), length_of(place, "to"));
}

double stream_packing(const HopperSnapshot& s, const Place& place) {
  if (!stream_is_free(s, place)) return none;
  return mean_between(s.now.positions(), s.now.scalars("packing"), length_of(place, "from"), length_of(place, "to"));
}

double stream_packing_of_cells(const HopperSnapshot& s, const Place& place) {
  if (!stream_is_free(s, place)) return none;
  const double cell = s.shape().cell();
  std::vector<double> packings;
  for (double z = length_of(place, "from"); z < length_of(place, "to"); z += cell)
    for (double x = 0.5 * cell; x < s.shape().width; x += cell) {
      const double packing = s.field().packing(cell_centre({x, 0.5 * s.shape().depth, z}, cell));
      if (packing > in_stream) packings.push_back(packing);
    }
  return mean(packings);
}

double stream_stress_share(const HopperSnapshot& s, const Place& place) {
  if (!stream_is_free(s, place)) return none;
  const auto stress = s.now.scalars("stress_zz");
  return mean_between(s.now.positions(), stress, length_of(place, "from"), length_of(place, "to")) /
         mean_between(s.now.positions(), stress, s.shape().plate->height, s.shape().height);
}

double stream_stripes(const HopperSnapshot& s, const Place& place) {
  if (!stream_is_free(s, place)) return none;
  const double cell = s.shape().cell();
  std::vector<double> along;
  for (double z = length_of(place, "from"); z < length_of(place, "to"); z += cell)
    along.push_back(s.field().packing(cell_centre({s.shape().middle(), 0.5 * s.shape().depth, z}, cell)));
  return mean(along) > 0 ? standard_deviation(along) / mean(along) : none;
}

double foot_reach(const HopperSnapshot& s, const Place& place) {
  if (s.now.size() == 0) return none;
  const Section& section = s.packing_section();
  std::vector<double> packing;
  for (std::size_t column = 0; column < section.columns; ++column) {
    std::vector<double> layer;
    for (std::size_t row = 0; row < section.rows && section.z(row) < length_of(place, "height"); ++row)
      layer.push_back(section.at(column, row));
    packing.push_back(mean(layer));
  }
  const double middle = s.shape().middle();
  return 0.5 * (reach_to(section, packing, middle, -1) + reach_to(section, packing, middle, 1));
}

double hopper_velocity(const HopperSnapshot& s, const Place& place) {
  return mean_across(s, place, [&](const Vector3& x) { return s.field().value(x, s.now.vectors("velocity")).z; });
}

double hopper_packing(const HopperSnapshot& s, const Place& place) {
  return mean_across(s, place, [&](const Vector3& x) { return s.field().packing(x); });
}

}  // namespace talus::hopper

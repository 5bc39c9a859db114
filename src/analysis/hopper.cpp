// SPDX-License-Identifier: Apache-2.0
#include "analysis/hopper.hpp"

#include <cmath>
#include <numeric>

#include "analysis/discharge.hpp"
#include "analysis/statistics.hpp"

namespace talus {

namespace {

constexpr double depth_in_spacings = 3;

template <class T, class Make>
const T& made_once(std::optional<T>& value, Make&& make) {
  if (!value) value.emplace(make());
  return *value;
}

}  // namespace

Vessel HopperShape::bin() const {
  return {0, outlet ? outlet->height : height, Vessel::Search::from_below};
}

Vessel HopperShape::hopper() const {
  return {outlet.value().height, height, Vessel::Search::from_above};
}

HopperSurfaces hopper_surfaces(const Section& packing, const HopperShape& shape) {
  return {free_surface(packing, shape.bin()), shape.outlet ? free_surface(packing, shape.hopper()) : FreeSurface{}};
}

std::vector<bool> deep_particles(std::span<const Vector3> position, const HopperSurfaces& surfaces,
                                 const HopperShape& shape) {
  const double least = depth_in_spacings * shape.spacing;
  std::vector<bool> deep;
  for (const Vector3& x : position) {
    const bool in_hopper = shape.outlet && x.z >= shape.outlet->height;
    const bool at_slit = shape.outlet && x.x > shape.outlet->left && x.x < shape.outlet->right &&
                         std::abs(x.z - shape.outlet->height) < least;
    deep.push_back(!at_slit && (in_hopper ? surfaces.hopper : surfaces.bin).height(x.x) - x.z > least);
  }
  return deep;
}

double mean_between(std::span<const Vector3> position, std::span<const double> values, double from, double to) {
  std::vector<double> chosen;
  for (std::size_t i = 0; i < position.size(); ++i)
    if (position[i].z > from && position[i].z < to) chosen.push_back(values[i]);
  return mean(chosen);
}

std::vector<bool> above_outlet(std::span<const Vector3> position, const HopperShape& shape) {
  const double height = shape.outlet ? shape.outlet->height : 0;
  std::vector<bool> above;
  for (const Vector3& x : position) above.push_back(x.z >= height);
  return above;
}

Domain HopperSnapshot::domain() const {
  Domain domain = setting.domain;
  if (time >= 0) domain.open_gates(time);
  return domain;
}

Particles HopperSnapshot::particles() const {
  return particles_of_density(now.positions(), now.scalars("density"), setting.particle_mass, setting.grain_density,
                              setting.smoothing_length, now.mass_ratios());
}

const Section& HopperSnapshot::packing_section() const {
  const double h = shape().spacing;
  return made_once(packing_section_,
                   [&] { return now.size() ? talus::packing_section(particles(), domain(), h, 0.5 * h) : Section{}; });
}

const HopperSurfaces& HopperSnapshot::surfaces() const {
  return made_once(surfaces_,
                   [&] { return now.size() ? hopper_surfaces(packing_section(), shape()) : HopperSurfaces{}; });
}

const std::vector<bool>& HopperSnapshot::deep() const {
  return made_once(deep_, [&] { return deep_particles(now.positions(), surfaces(), shape()); });
}

const std::vector<double>& HopperSnapshot::inertial() const {
  return made_once(inertial_, [&] { return inertial_numbers(now, setting.grain_diameter, setting.grain_density); });
}

const std::vector<Tensor3<>>& HopperSnapshot::velocity_gradients() const {
  return made_once(velocity_gradients_, [&] {
    std::vector<std::uint32_t> all(now.size());
    std::iota(all.begin(), all.end(), 0u);
    return talus::velocity_gradients(particles(), domain(), all, now.vectors("velocity"));
  });
}

const GradientSizes& HopperSnapshot::gradient_sizes() const {
  return made_once(gradient_sizes_, [&] {
    if (now.size() == 0) return GradientSizes{no_value, no_value};
    return velocity_gradient_sizes(velocity_gradients(), now.scalars("packing"), setting.grain_diameter,
                                   setting.gravity);
  });
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

Curve HopperRun::curve(Numbers::Number number) const {
  Curve result;
  for (std::size_t n = 0; n < snapshots.time().size(); ++n) {
    const double time = snapshots.time()[n];
    if (time < 0) continue;
    const double value = snapshots.value(n, number);
    if (!std::isfinite(value)) continue;
    result.time.push_back(time);
    result.value.push_back(value);
  }
  return result;
}

double gate_time_of(const Series& series) {
  if (series.has("gate_time"))
    for (const double time : series.column("gate_time"))
      if (time >= 0) return time;
  return series.column("time").back();
}

Curve discharged_mass(const HopperRun& run) {
  Curve below = run.curve("discharged_mass");
  const Curve removed = run.curve("removed_mass");
  for (std::size_t n = 0; n < removed.value.size(); ++n) below.value[n] += removed.value[n];
  return below;
}

Curve passed_mass(const HopperRun& run) {
  return integral(run.curve("discharge_rate"));
}

std::vector<NamedValue> outlet_quantities(const HopperRun& run, double from, double to) {
  std::vector<NamedValue> quantities;
  for (const OutletSetting& outlet : run.setting.outlets) {
    const Curve passed = integral(run.curve("discharge_rate_" + outlet.name));
    const auto add = [&](const char* name, const char* unit, double value) {
      if (std::isfinite(value)) quantities.push_back({name + ("_" + outlet.name), unit, value});
    };
    if (passed.value.empty()) continue;
    add("discharged_mass", "kg", passed.value.back());
    const double open = outlet.gate ? outlet.gate->time_away(from, to) : to - from;
    add("discharge_rate", "kg/s", open > 0 ? mean_rate(passed, from, to) * (to - from) / open : no_value);
    if (outlet.hand_discharge > 0) add("discharge_rate_beverloo", "kg/s", outlet.hand_discharge);
    add("particles_across", "1", outlet.across / run.setting.shape.spacing);
    add("grains_across", "1", outlet.across / run.setting.grain_diameter);
  }
  return quantities;
}

Curve discharged_share(const HopperRun& run) {
  const Curve fed = run.curve("fed_mass");
  if (fed.value.empty()) return scaled(discharged_mass(run), 1 / run.setting.mass());
  Curve share = discharged_mass(run);
  for (std::size_t n = 0; n < fed.value.size(); ++n) {
    const double all = run.setting.mass() + fed.value[n];
    share.value[n] = all > 0 ? share.value[n] / all : 0;
  }
  return share;
}

}  // namespace talus

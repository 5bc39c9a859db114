// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/hopper_observers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/particle_field.hpp"

namespace talus::app {

namespace {

constexpr double share_of_outlet = 0.125;  // height of the probe: z = 105 mm in the paper's hopper, a slit of 40 mm

/// The cubic spline of one dimension, support 2 h: 1/m.
double spread_along_z(double distance, double h) {
  const double q = std::abs(distance) / h;
  const double outer = std::max(2 - q, 0.0), inner = std::max(1 - q, 0.0);
  return (outer * outer * outer - 4 * inner * inner * inner) / (6 * h);
}

/// What passes each of several outlets of a vessel, near which it is, spread along z as that of all.
void add_rates(const Snapshot& some, const continuum::Layout& layout, std::vector<NamedValue>& rates) {
  const double mass = layout.lattice.mass, spacing = layout.given.bed.spacing;
  const auto position = some.positions();
  const auto velocity = some.vectors("velocity");
  const MassRatios ratios = some.mass_ratios();
  for (std::size_t n = 0; n < rates.size(); ++n) {
    const continuum::VesselOutlet& outlet = layout.vessel_outlets[n];
    for (std::size_t i = 0; i < position.size(); ++i) {
      const double above = position[i].z - outlet.middle.z;
      if (std::abs(above) < sph::support * spacing && outlet.is_beside(position[i], spacing))
        rates[n].value -= ratios[i] * mass * velocity[i].z * spread_along_z(above, spacing);
    }
  }
}

/// Particles near slit and probe.
struct Near {
  std::vector<Vector3> position, velocity;
  std::vector<double> density, stress, strain, mass_ratio;
};

}  // namespace

std::vector<NamedValue> observe_hopper(const Pieces& pieces, const continuum::Layout& layout) {
  const continuum::Parameters& p = layout.given;
  const double mass = layout.lattice.mass;

  constexpr double infinity = std::numeric_limits<double>::infinity();
  double passed = 0, rate = 0, lowest = infinity, near_floor = 0;
  const auto& outlet = layout.outlet;
  const double plate = outlet ? outlet->height : p.plate.height.value_or(-infinity);
  std::vector<NamedValue> by_outlet;
  if (layout.vessel_outlets.size() > 1)
    for (const continuum::VesselOutlet& one : layout.vessel_outlets)
      by_outlet.push_back({"discharge_rate_" + one.name, "kg/s", 0});
  Vector3 slit, probe;
  double probe_above_slit = 0;
  if (outlet) {
    slit = {0.5 * (outlet->left + outlet->right), outlet->middle_y, outlet->height};
    probe_above_slit = share_of_outlet * layout.outlet_width.value_or(0);
    probe = slit + Vector3{0, 0, probe_above_slit};
  }
  Near near;
  const Domain* domain = nullptr;
  pieces([&](const Snapshot& some) {
    const auto position = some.positions(), velocity = some.vectors("velocity");
    const auto density = some.scalars("density");
    const MassRatios ratios = some.mass_ratios();
    for (std::size_t i = 0; i < position.size(); ++i) {
      const double z = position[i].z, above = z - plate;
      if (above < 0) passed += ratios[i] * mass;
      if (std::abs(above) < sph::support * p.bed.spacing)
        rate -= ratios[i] * mass * velocity[i].z * spread_along_z(above, p.bed.spacing);
      lowest = std::min(lowest, z);
      if (z < p.bed.spacing) near_floor += ratios[i] * mass;
    }
    add_rates(some, layout, by_outlet);
    domain = some.domain;
    if (!outlet) return;
    // Particles near both places are enough: others do not contribute there. No image is nearer than its source.
    const auto stress = some.scalars("stress_zz"), strain = some.scalars("strain");
    for (const std::size_t i : particles_around(position, slit, 3 * sph::support * p.bed.spacing + probe_above_slit)) {
      const double reach = sph::support * sph::smoothing_length(size_ratio(ratios[i]) * mass, density[i]);
      if (std::abs(position[i].x - slit.x) > reach || std::abs(position[i].z - slit.z) > reach + probe_above_slit)
        continue;
      near.position.push_back(position[i]), near.velocity.push_back(velocity[i]);
      if (!ratios.of.empty()) near.mass_ratio.push_back(ratios[i]);
      near.density.push_back(density[i]), near.stress.push_back(stress[i]), near.strain.push_back(strain[i]);
    }
  });
  if (std::isinf(lowest)) lowest = std::nan("");

  double slit_velocity = std::nan(""), probe_density = slit_velocity, probe_velocity = slit_velocity,
         probe_stress = slit_velocity, probe_strain = slit_velocity;
  if (outlet) {
    const ParticleField field(
        particles_of_density(near.position, near.density, mass, p.grains.density, {}, {near.mass_ratio}), *domain);
    slit_velocity = field.value(slit, near.velocity).z;
    probe_velocity = field.value(probe, near.velocity).z;
    probe_density = field.value(probe, near.density);
    probe_stress = field.value(probe, near.stress);
    probe_strain = field.value(probe, near.strain);
  }
  std::vector<NamedValue> values = {{"discharged_mass", "kg", passed},
                                    {"discharge_rate", "kg/s", rate},
                                    {"lowest_z", "m", lowest},
                                    {"mass_near_floor", "kg", near_floor},
                                    {"slit_velocity", "m/s", slit_velocity},
                                    {"probe_density", "kg/m3", probe_density},
                                    {"probe_velocity", "m/s", probe_velocity},
                                    {"probe_stress", "Pa", probe_stress},
                                    {"probe_strain", "1", probe_strain}};
  values.insert(values.end(), by_outlet.begin(), by_outlet.end());
  return values;
}

}  // namespace talus::app

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

/// What passes each of several outlets of a vessel, near which it is, spread along z as that of all; empty of one
/// alone.
std::vector<NamedValue> rates_by_outlet(const Snapshot& snapshot, const continuum::Layout& layout) {
  const std::vector<continuum::VesselOutlet>& outlets = layout.vessel_outlets;
  const double mass = layout.lattice.mass, spacing = layout.given.bed.spacing;
  std::vector<NamedValue> rates;
  if (outlets.size() < 2) return rates;
  const auto position = snapshot.positions();
  const auto velocity = snapshot.vectors("velocity");
  for (const continuum::VesselOutlet& outlet : outlets) {
    double rate = 0;
    for (std::size_t i = 0; i < position.size(); ++i) {
      const double above = position[i].z - outlet.middle.z;
      if (std::abs(above) < sph::support * spacing && outlet.is_beside(position[i], spacing))
        rate -= mass * velocity[i].z * spread_along_z(above, spacing);
    }
    rates.push_back({"discharge_rate_" + outlet.name, "kg/s", rate});
  }
  return rates;
}

}  // namespace

std::vector<NamedValue> observe_hopper(const Snapshot& snapshot, const continuum::Layout& layout) {
  const continuum::Parameters& p = layout.given;
  const auto position = snapshot.positions();
  const auto velocity = snapshot.vectors("velocity");
  const auto density = snapshot.scalars("density");
  const double mass = layout.lattice.mass;

  constexpr double infinity = std::numeric_limits<double>::infinity();
  double passed = 0, rate = 0, lowest = infinity, near_floor = 0;
  const auto& outlet = layout.outlet;
  const double plate = outlet ? outlet->height : p.plate.height.value_or(-infinity);
  for (std::size_t i = 0; i < position.size(); ++i) {
    const double z = position[i].z, above = z - plate;
    if (above < 0) passed += mass;
    if (std::abs(above) < sph::support * p.bed.spacing)
      rate -= mass * velocity[i].z * spread_along_z(above, p.bed.spacing);
    lowest = std::min(lowest, z);
    if (z < p.bed.spacing) near_floor += mass;
  }
  if (position.empty()) lowest = std::nan("");
  const std::vector<NamedValue> by_outlet = rates_by_outlet(snapshot, layout);

  double slit_velocity = std::nan(""), probe_density = slit_velocity, probe_velocity = slit_velocity,
         probe_stress = slit_velocity, probe_strain = slit_velocity;
  if (outlet) {
    const Vector3 slit{0.5 * (outlet->left + outlet->right), outlet->middle_y, outlet->height};
    const double probe_above_slit = share_of_outlet * layout.outlet_width.value_or(0);
    const Vector3 probe = slit + Vector3{0, 0, probe_above_slit};
    // Particles near both places are enough: others do not contribute there. No image is nearer than its source.
    auto near = particles_around(position, slit, 3 * sph::support * p.bed.spacing + probe_above_slit);
    std::erase_if(near, [&](std::size_t i) {
      const double reach = sph::support * sph::smoothing_length(mass, density[i]);
      return std::abs(position[i].x - slit.x) > reach || std::abs(position[i].z - slit.z) > reach + probe_above_slit;
    });
    const auto pick = [&near](const auto& column) {
      std::vector<std::decay_t<decltype(column[0])>> picked;
      for (const std::size_t i : near) picked.push_back(column[i]);
      return picked;
    };
    const auto places = pick(position);
    const auto velocities = pick(velocity);
    const auto densities = pick(density);
    const ParticleField field(particles_of_density(places, densities, mass, p.grains.density), *snapshot.domain);
    slit_velocity = field.value(slit, velocities).z;
    probe_velocity = field.value(probe, velocities).z;
    probe_density = field.value(probe, densities);
    probe_stress = field.value(probe, pick(snapshot.scalars("stress_zz")));
    probe_strain = field.value(probe, pick(snapshot.scalars("strain")));
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

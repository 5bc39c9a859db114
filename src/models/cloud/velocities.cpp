// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/velocities.hpp"

#include <algorithm>

#include "physics/contact/linear_spring.hpp"
#include "physics/hydrodynamics/stokes.hpp"

namespace talus::cloud {

namespace {

// Skin of the neighbour list over the mean radius. Inside a cloud grains pass each other at some ten Stokes speeds, a
// few radii a step: a wider skin is searched more often than it is rebuilt less.
constexpr double skin_over_radius = 1.5;

}  // namespace

Vector3 in_plane(const Vector3& v, Motion motion) {
  switch (motion) {
    case Motion::xy:
      return {v.x, v.y, 0};
    case Motion::xz:
      return {v.x, 0, v.z};
    case Motion::xyz:
      return v;
  }
  return v;
}

Velocities::Velocities(const Parameters& p, std::span<const double> radius, const Ranks& ranks)
    : parameters_(p),
      touches_slope_(p.slope.enabled && p.contact.enabled && p.motion != Motion::xy),
      radius_(radius.begin(), radius.end()),
      sum_(p, radius_, ranks),
      force_(radius.size()),
      contact_force_(radius.size()),
      overlap_(radius.size(), 0.0) {
  const Vector3 direction = scales(p).gravity;
  for (const double a : radius_)
    weight_.push_back(in_plane(
        hydrodynamics::buoyant_weight(a, p.particles.density, p.fluid.density, p.gravity.acceleration) * direction,
        p.motion));
}

void Velocities::arrange_sum(std::span<const std::int64_t> order, double cutoff) {
  sum_.arrange({order.begin(), order.end()}, cutoff);
}

void Velocities::find_contacts(ThreadTeam& team, std::span<const Vector3> position) {
  const double stiffness = parameters_.contact.stiffness;
  if (!neighbours_.holds(team, position))
    neighbours_.build(team, position, radius_, skin_over_radius * parameters_.particles.radius);
  for_each(team, position.size(), [&](std::size_t i) {
    Vector3 force;
    double largest = 0;
    for (const std::uint32_t j : neighbours_.of(i)) {
      const Vector3 offset = position[j] - position[i];
      const double reach = radius_[i] + radius_[j];
      if (dot(offset, offset) > reach * reach) continue;
      force += contact::repulsion(stiffness, radius_[i], radius_[j], offset);
      largest = std::max(largest, contact::overlap(radius_[i], radius_[j], norm(offset)));
    }
    if (touches_slope_) {
      const double overlap = contact::slope_overlap(radius_[i], position[i].z);
      force.z += contact::linear_spring(stiffness, overlap);
      largest = std::max(largest, overlap);
    }
    contact_force_[i] = force;
    overlap_[i] = largest;
  });
}

void Velocities::operator()(ThreadTeam& team, std::span<const Vector3> position, std::span<Vector3> velocity) {
  const double viscosity = parameters_.fluid.viscosity;
  if (parameters_.contact.enabled) find_contacts(team, position);
  max_overlap_ = reduce(
      team, position.size(), 0.0, [&](std::size_t i) { return overlap_[i]; },
      [](double a, double b) { return std::max(a, b); });
  for_each(team, position.size(), [&](std::size_t i) { force_[i] = weight_[i] + contact_force_[i]; });
  sum_.velocities(team, position, force_, velocity);
  for_each(team, position.size(),
           [&](std::size_t i) { velocity[i] += hydrodynamics::stokes_mobility(radius_[i], viscosity) * force_[i]; });
}

}  // namespace talus::cloud

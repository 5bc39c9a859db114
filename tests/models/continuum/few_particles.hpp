// SPDX-License-Identifier: Apache-2.0
/// A model with a few particles of the test's own.
#pragma once

#include <cstdint>
#include <span>
#include <type_traits>

#include "models/continuum/cases.hpp"

namespace talus::continuum {

struct PlacedParticle {
  Vector3 position, velocity;  // m, m/s
};

/// A model of the case that holds these particles alone, at its start. \pre the case has a bed
inline void place_particles(Continuum& model, std::span<const PlacedParticle> particles, ThreadTeam& team) {
  State& s = model.mutable_state();
  const auto first_for_all = [&]<class Member>(const FieldInfo& field, Member& column) {
    if constexpr (!std::is_arithmetic_v<Member>)
      if (field.of_particles && !column.empty()) column.assign(particles.size(), Member(column)[0]);
  };
  for_each_field(first_for_all, s);
  for (std::size_t n = 0; n < particles.size(); ++n) {
    s.identity[n] = static_cast<std::int64_t>(n);
    s.position[n] = particles[n].position;
    s.velocity[n] = particles[n].velocity;
  }
  model.begin(team);
}

}  // namespace talus::continuum

// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/pairs/displacement.hpp"

#include "physics/granular/half_spheres.hpp"
#include "physics/granular/kinematics.hpp"

namespace talus::continuum {

void measure_strain(ThreadTeam& team, const Neighbourhood& around, std::span<const Vector3> position,
                    std::span<const Vector3> reset_position, std::span<const double> smoothing_length,
                    std::vector<SymmetricTensor3<>>& strain) {
  const std::size_t count = position.size();
  strain.resize(count);
  for_each(team, count, [&](std::size_t i) {
    const double radius = granular::half_sphere_radius * smoothing_length[i];
    granular::HalfSpheres halves;
    halves.add({}, position[i] - reset_position[i]);
    for (const std::uint32_t n : around.of(i)) {
      const bool ghost = n >= count;
      const std::size_t source = ghost ? around.ghosts()[n - count].source : n;
      const Image image = ghost ? around.image(around.ghosts()[n - count]) : Image{};
      const Vector3 place = image.position(position[source]), offset = place - position[i];
      if (dot(offset, offset) > radius * radius) continue;
      if (around.sight_may_change(i) && !around.domain().is_visible(position[i], place, image)) continue;
      halves.add(offset, image.vector(position[source] - reset_position[source]));
    }
    strain[i] = granular::almansi_strain(halves.gradient());
  });
}

}  // namespace talus::continuum

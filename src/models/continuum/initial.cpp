// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/initial.hpp"

namespace talus::continuum {

State initial_state(const Parameters& parameters, const Material& material) {
  const Lattice lattice = lattice_of(parameters);
  State state;
  state.mass = lattice.mass;
  for (std::int64_t k = 0; k < lattice.count[2]; ++k)
    for (std::int64_t j = 0; j < lattice.count[1]; ++j)
      for (std::int64_t i = 0; i < lattice.count[0]; ++i)
        state.position.push_back(lattice.corner + Vector3{(double(i) + 0.5) * lattice.spacing.x,
                                                          (double(j) + 0.5) * lattice.spacing.y,
                                                          (double(k) + 0.5) * lattice.spacing.z});
  const std::size_t count = state.position.size();
  state.velocity.assign(count, Vector3{});
  state.density.assign(count, parameters.bed.packing * parameters.grains.density);
  for (std::size_t n = 0; n < count; ++n) state.identity.push_back(static_cast<std::int64_t>(n));
  for (auto& column : state.material.stress) column.assign(count, 0.0);
  for (auto& column : state.material.collisional) column.assign(count, 0.0);
  if (material.by_displacements()) state.reset_position = state.position;
  state.slots = material.slots();
  state.material.history.assign(state.slots.size(), std::vector<double>(count, 0.0));
  return state;
}

}  // namespace talus::continuum

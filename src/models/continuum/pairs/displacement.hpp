// SPDX-License-Identifier: Apache-2.0
/// The strain of the printed route: not by its rate but from the displacements of the particles since each one's last
/// reset, x_i - X_i, over half spheres (Appendix A). Where neighbours were reset at different times their displacements
/// are of different histories, and their differences are no strain: the paper's route has it so.
#pragma once

#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "base/tensor.hpp"
#include "numerics/neighbourhood.hpp"

namespace talus::continuum {

/// Almansi's strain of every particle, positive in compression.
/// \param around lists that hold at `position`; \param reset_position X_i, m; \param smoothing_length h_k, m
/// \param strain number; resized to one per particle; not finite where the displacements have no inverse
void measure_strain(ThreadTeam& team, const Neighbourhood& around, std::span<const Vector3> position,
                    std::span<const Vector3> reset_position, std::span<const double> smoothing_length,
                    std::vector<SymmetricTensor3<>>& strain);

}  // namespace talus::continuum

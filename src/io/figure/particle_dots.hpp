// SPDX-License-Identifier: Apache-2.0
/// Particles of a continuum drawn as dots, as Yuu & Umekage (2011) draw theirs in Figure 4: each stands for many
/// grains, which are scattered about it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vector.hpp"
#include "numerics/geometry/domain.hpp"

namespace talus::figure {

/// Dots about each particle, normally distributed with a standard deviation of (2/3) h along each axis, those beyond 2
/// h drawn again. A dot behind a wall or plate goes to its mirror image (choice; the paper does not say), so that there
/// are none where there are no grains. The same for the same identities. They are drawn once, 65,536 for all particles,
/// of which each takes some that follow each other. \param identity chooses these
/// \param smoothing_length h, m; one entry per particle in all columns
std::vector<Vector3> particle_dots(std::span<const Vector3> position, std::span<const double> smoothing_length,
                                   std::span<const std::int64_t> identity, const Domain& domain, int dots = 50);

}  // namespace talus::figure

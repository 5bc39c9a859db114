// SPDX-License-Identifier: Apache-2.0
/// A sector of a vessel in place of the whole: which cases may have one, how particles come back into it, and what the
/// whole is. The state is the sector's; snapshots and totals are those of the whole vessel.
#pragma once

#include <vector>

#include "base/error.hpp"
#include "models/continuum/material.hpp"
#include "models/continuum/setup/layout.hpp"
#include "models/continuum/state.hpp"
#include "numerics/geometry/domain.hpp"
#include "numerics/snapshot.hpp"

namespace talus::continuum {

/// What of a case with box.sector contradicts it, key by key.
std::vector<Problem> check_sector(const Parameters& parameters);
/// Walls of the vessel that do not turn into themselves. \pre a vessel without faults
std::vector<Problem> check_symmetry(const Layout& layout);

/// Turns particles that have left the sector back into it, with all that they carry.
void return_to_sector(const Domain& domain, const Material& material, State& state);

/// The sector as snapshots hold it: its particles once, each with the identity of the one that stands there in the
/// whole (whole_of(), numerics/snapshot.hpp). A particle that has passed a face goes on in the next copy.
PointSet part_of(const State& state, const Sector& sector);
SectorCopies copies_of(const State& state, const Sector& sector);
/// \param turns of the particle (State::sector_turns)
inline std::int64_t identity_in_whole(const SectorCopies& copies, std::int64_t identity, std::int64_t turns) {
  return identity + copies.identities * ((copies.count - turns) % copies.count);
}

}  // namespace talus::continuum

// SPDX-License-Identifier: Apache-2.0
/// What a run takes on several processes: a model, from the speed of one process and counts (docs/design/ranks.md).
#pragma once

#include "app/case/prepared_case.hpp"
#include "models/continuum/setup/setup.hpp"

namespace talus::app {

/// The air, of a cell, spread over the steps of the particles.
struct AirOfStep {
  double seconds = 0;   ///< of a cell in a step of the particles
  double deposits = 0;  ///< steps of the air in one of the particles
};

/// Measured now on a small sample. Nothing in a vacuum.
AirOfStep air_of_step(const continuum::Setup& setup, ThreadTeam& team);

/// Owned particles and copies of others, of the largest part of a bed that is cut in two again and again.
struct PartOfBed {
  double owned = 0, copies = 0;
};
/// \param sides of the bed, in particles \param parts that it is cut into \param reach of a copy, in particles
PartOfBed largest_part(const std::array<double, 3>& sides, int parts, double reach);

/// Lines of a name and a text: particles on each, time of a step and of the run, efficiency, memory; in air of
/// few cells up to how many processes it pays that each computes all of it. \param end of the run, s \param step
/// seconds on one process
Lines forecast_on_ranks(const continuum::Setup& setup, double end, const AirOfStep& air, double step, int ranks);

}  // namespace talus::app

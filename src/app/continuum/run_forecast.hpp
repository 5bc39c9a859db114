// SPDX-License-Identifier: Apache-2.0
/// How long a run of the continuum will take: steps from its parameters, the cost of one measured.
#pragma once

#include <memory>

#include "app/case/prepared_case.hpp"
#include "base/parallel.hpp"
#include "models/continuum/setup/setup.hpp"

namespace talus::app {

/// Steps, mean particles, memory and disk. \pre the case is valid
Forecast forecast_of_run(const continuum::Setup& setup, const run::RunParameters& run);

/// Neighbour lists that a step in flow builds: the fastest particle leaves its own after half of the skin, at the
/// latest after the steps that its margin is for (steps_of_margin), and inlets let in a layer. At most 1.
double list_builds_of_step(const continuum::Setup& setup);

/// Processor time of a step in flow over the threads, s, with the particles of the start or, where grains come in only,
/// with those of the mean until `end`, s. \throws NumericalError if steps fail
double measure_step(const std::shared_ptr<const continuum::Setup>& setup, double end, ThreadTeam& team);

}  // namespace talus::app

// SPDX-License-Identifier: Apache-2.0
/// What the run of a cloud takes on several processes: a model, from the speed of one process and counts
/// (docs/design/ranks.md).
#pragma once

#include "app/case/prepared_case.hpp"
#include "models/cloud/parameters.hpp"

namespace talus::app {

/// Seconds of an evaluation of all velocities by one process.
struct CloudEvaluation {
  double all = 0;
  double not_shared = 0;  ///< of it what every process computes alike: contacts, stages
};

/// Lines of a name and a text: grains and tasks, time of an evaluation and of the run, efficiency, memory.
/// \param evaluations of the run
Lines forecast_on_ranks(const cloud::Parameters& parameters, double evaluations, const CloudEvaluation& seconds,
                        int ranks);

}  // namespace talus::app

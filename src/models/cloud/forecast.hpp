// SPDX-License-Identifier: Apache-2.0
/// What a run of a cloud will take, from its parameters and the number of its grains alone: nothing is placed.
#pragma once

#include <optional>

#include "base/error.hpp"
#include "models/cloud/initial.hpp"
#include "models/cloud/parameters.hpp"

namespace talus::cloud {

struct Forecast {
  double steps = 0;
  double evaluations = 0;  ///< of all velocities
};

/// Steps and evaluations of a run up to a time. A free cloud takes the largest step with the stages that contacts which
/// form within a step ask for. One that gravity presses against a slope falls in on it at the start, in steps that the
/// growth of overlaps limits, and its contacts are stiffer, the more so the more grains move each other: its layer on
/// the slope gives way as one, with a mobility that grows with its extent (a sum of 1/r over it).
/// Measured: docs/decisions/0015-forecast.md.
/// \param end s; \param grains how many
Forecast forecast(const Parameters& parameters, double end, double grains);

/// A problem if a run would take more steps than any machine can: run.end against the longest step.
std::optional<Problem> check_steps(const Parameters& parameters, double end);

/// Bytes that a run takes, the program itself among them.
double memory_of(double grains);

/// Grains on a regular lattice, in the plane of motion or in space, that almost touch: what a machine's speed is
/// measured with.
Grains sample(const Parameters& parameters, std::size_t count);

}  // namespace talus::cloud

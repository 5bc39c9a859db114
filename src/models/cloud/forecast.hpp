// SPDX-License-Identifier: Apache-2.0
/// The cost of a run of a cloud, from its parameters and the number of grains alone.
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

/// Steps and evaluations of a run up to a time. A free cloud takes the largest step, with the stages required by
/// contacts that form within a step. A cloud that gravity presses against a slope first collapses onto it, in steps
/// limited by the growth of overlaps; its contacts relax faster, the more so the more grains interact: the layer on the
/// slope moves collectively, with a mobility that grows with its extent (a sum of 1/r over it). Measured:
/// docs/design/forecast.md.
/// \param end s; \param grains how many
Forecast forecast(const Parameters& parameters, double end, double grains);

/// A problem if a run would take more steps than is possible: run.end over the longest step.
std::optional<Problem> check_steps(const Parameters& parameters, double end);

/// Memory of a run in bytes, including the program itself.
double memory_of(double grains);

/// Grains on a regular lattice, in the plane of motion or in space, that almost touch: the sample on which the speed of
/// the machine is measured.
Grains sample(const Parameters& parameters, std::size_t count);

}  // namespace talus::cloud

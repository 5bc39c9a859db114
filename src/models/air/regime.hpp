// SPDX-License-Identifier: Apache-2.0
/// Whether a case of air alone keeps to what the model was made for: the lines of the regime card that are known before
/// the run.
#pragma once

#include <vector>

#include "models/air/model.hpp"
#include "numerics/named_value.hpp"

namespace talus::air {

/// Speed of the walls, or of the vortices at the start, m/s: what a case says of its flow before it has run.
double given_speed(const ModelParameters& parameters);

std::vector<RegimeLine> regime_of_case(const ModelParameters& parameters);

}  // namespace talus::air

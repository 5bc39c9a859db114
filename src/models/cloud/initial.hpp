// SPDX-License-Identifier: Apache-2.0
/// The initial grains: radii, then positions drawn at random in the shape of the case without overlap.
#pragma once

#include <vector>

#include "base/vector.hpp"
#include "models/cloud/parameters.hpp"

namespace talus::cloud {

struct Grains {
  std::vector<Vector3> position;  ///< m
  std::vector<double> radius;     ///< m
};

/// Packs the shape of the case by random sequential addition: each grain in turn is placed at random until it overlaps
/// none placed before. All radii are drawn before the first place. With a slope, shapes on it (triangle, wedge, dome;
/// any shape in the plane xz) keep every grain above it.
/// \throws NumericalError if a grain finds no place after 10^6 trials (the fraction is too high)
Grains pack(const Parameters& parameters);

/// Problems of grains that come from a file: radii not positive, places not finite, out of the plane of motion, too far
/// apart, or within each other or the slope deeper than integration.largest_overlap.
std::vector<Problem> check_grains(const Parameters& parameters, const Grains& grains);

}  // namespace talus::cloud

// SPDX-License-Identifier: Apache-2.0
/// Small cases for the tests of the cloud model.
#pragma once

#include <numbers>

#include "models/cloud/model.hpp"

namespace talus::cloud {

/// The paper's material: polystyrene of 5 mm in air on 45 degrees.
inline Parameters polystyrene(Shape shape, std::int64_t count) {
  Parameters p;
  p.particles.shape = shape;
  p.particles.count = count;
  p.particles.radius = 5e-3;
  p.particles.density = 20;
  p.slope.angle = std::numbers::pi / 4;
  return p;
}

/// A disc filled to 0.43, as the paper's.
inline Parameters disc(std::int64_t count, std::int64_t seed = 1) {
  Parameters p = polystyrene(Shape::circle, count);
  p.particles.size = p.particles.radius * std::sqrt(static_cast<double>(count) / 0.43);
  p.seed = seed;
  return p;
}

/// Runs a cloud for some steps or Stokes times.
inline Cloud started(const Parameters& p, ThreadTeam& team) {
  Cloud cloud(p, pack(p));
  cloud.begin(team);
  return cloud;
}

inline void run_until(Cloud& cloud, ThreadTeam& team, double time) {
  while (cloud.state().time < time) cloud.advance(team);
}

}  // namespace talus::cloud

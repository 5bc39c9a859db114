// SPDX-License-Identifier: Apache-2.0
/// The hopper of Yuu & Umekage 2011 for tests of its measures.
#pragma once

#include "analysis/hopper.hpp"
#include "analysis/particles.hpp"

namespace talus::paper_hopper {

// The paper's box: 100 x 5 x 250 mm, the plate at 100 mm, its slit from 30 to 70 mm; h = 5/3 mm.
inline constexpr double width = 0.1, depth = 5e-3, height = 0.25, plate = 0.1, h = 5e-3 / 3;
inline constexpr double grain_density = 2500, bulk_density = 1500;
inline constexpr double particle_mass = bulk_density * h * h * h;
inline constexpr double gate = 0.25;  // s, in the run's time

inline HopperSetting setting() {
  return {.shape = {width, depth, height, HopperShape::Outlet{plate, 0.03, 0.07}, h},
          .domain = test::box(width, depth, height, {test::plate(width, plate, 0.03, 0.07)}),
          .particle_mass = particle_mass,
          .particles = 9000,
          .grain_density = grain_density,
          .grain_diameter = 200e-6,
          .gravity = 9.8};
}

}  // namespace talus::paper_hopper

// SPDX-License-Identifier: Apache-2.0
/// The bed at the start: [bed], and the seed of what is random in it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/parameter.hpp"

namespace talus::continuum {

struct BedParameters {
  double packing = 0.6;
  double spacing = 0;
  std::optional<double> mass;
  double height = 0;  ///< m; with a mass that which holds it (with_level, filling.hpp)
  std::optional<double> bottom;
  std::optional<double> left, right;
  std::optional<std::array<double, 3>> velocity;
  double disorder = 0;
};

template <class Visit, class B, class Seed>
void for_each_parameter_of_bed(Visit&& visit, B& bed, Seed& seed) {
  visit(Parameter{"bed.packing", dimension::none, between(1e-4, 0.74), "packing fraction at the start"}, bed.packing);
  visit(
      Parameter{"bed.spacing", dimension::length, above(0),
                "distance of the particles at the start; adjusted to whole numbers of particles along each side", true},
      bed.spacing);
  visit(
      Parameter{
          "bed.mass",
          {0, 1, 0, 0},
          above(0),
          "mass of the bed, to the nearest particle, in place of bed.height: the bed fills its region from below"},
      bed.mass);
  auto filled = only_if({"bed.mass", "is given", "left out", !bed.mass}, visit);
  filled(Parameter{"bed.height", dimension::length, above(0),
                   "height of the bed at the start, where there is no bed.mass; the bed fills the region that is "
                   "connected with the middle of its top, with no plate or wall between",
                   true},
         bed.height);
  visit(Parameter{"bed.bottom", dimension::length, at_least(0),
                  "bottom of the bed; left out: that of the vessel, the plate, the wedge's outlet, or the floor"},
        bed.bottom);
  visit(Parameter{"bed.left", dimension::length, at_least(0), "start of the bed along x; left out: the left face"},
        bed.left);
  visit(Parameter{"bed.right", dimension::length, above(0), "end of the bed along x; left out: the right face"},
        bed.right);
  visit(Parameter{"bed.velocity", dimension::velocity, {}, "initial velocity of the bed; left out: at rest"},
        bed.velocity);
  visit(Parameter{"bed.disorder", dimension::none, between(0, 0.1),
                  "how far the particles stand from their places at the start, at most, along each axis, in units of "
                  "bed.spacing; 0: on them. Runs that differ in the seed alone show what is chance: 1e-6 will do"},
        bed.disorder);
  auto random = only_if({"bed.disorder", "is 0", "above 0", bed.disorder > 0}, visit);
  random(Parameter{"seed", dimension::none, between(0, 9e15), "seed of the displacements by bed.disorder"}, seed);
}

}  // namespace talus::continuum

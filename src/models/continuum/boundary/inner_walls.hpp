// SPDX-License-Identifier: Apache-2.0
/// Straight walls through the whole depth of the box: [plate], [wedge] and [[plates]].
#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "base/parameter.hpp"

namespace talus::continuum {

inline constexpr double half_turn = std::numbers::pi;

struct Plate {
  std::optional<double> height;
  std::optional<double> slit_left, slit_right;
};
struct Wedge {
  std::optional<double> half_angle;
  double outlet = 0;
  double height = 0;
};
/// Of [[plates]].
struct InclinedPlate {
  std::vector<double> from, to;  ///< x and z, m
  std::vector<double> openings;  ///< where each begins and ends, in pairs, from `from` along the plate, m
  std::optional<double> opens_after;
};

/// The keys of the nth of [[plates]]: 0 from, 1 to, 2 openings, 3 opens_after.
std::string plate_key(std::size_t n, int key);

template <class Visit, class P>
void for_each_parameter_of_inner_walls(Visit&& visit, P& p) {
  visit(Parameter{"plate.height", dimension::length, above(0),
                  "height of a thin horizontal plate across the box; left out: no plate"},
        p.plate.height);
  visit(Parameter{"plate.slit_left", dimension::length, at_least(0), "start of the slit in the plate, along x"},
        p.plate.slit_left);
  visit(Parameter{"plate.slit_right", dimension::length, above(0), "end of the slit in the plate"}, p.plate.slit_right);
  visit(
      Parameter{"wedge.half_angle",
                dimension::angle,
                {.min = 0, .max = half_turn / 2, .min_excluded = true, .max_excluded = true},
                "angle to the vertical of the two walls of a wedge hopper, which reach from its outlet, in the middle "
                "of the box, up to the left and right faces; left out: no wedge"},
      p.wedge.half_angle);
  visit(Parameter{"wedge.outlet", dimension::length, at_least(0),
                  "width of the outlet of the wedge, which the gate closes"},
        p.wedge.outlet);
  visit(Parameter{"wedge.height", dimension::length, at_least(0), "height of the outlet above the floor"},
        p.wedge.height);
  for (std::size_t n = 0; n < p.plates.size(); ++n) {
    visit(Parameter{plate_key(n, 0),
                    dimension::length,
                    {},
                    "thin straight plate through the whole depth, at any angle: x and z of one end",
                    true},
          p.plates[n].from);
    visit(Parameter{plate_key(n, 1), dimension::length, {}, "x and z of the other end", true}, p.plates[n].to);
    visit(Parameter{plate_key(n, 2), dimension::length, at_least(0),
                    "start and end of each opening, along the plate from `from`"},
          p.plates[n].openings);
    visit(
        Parameter{plate_key(n, 3), dimension::time, at_least(0),
                  "its openings are closed by gates that open so long after the gate of the case; left out: no gates"},
        p.plates[n].opens_after);
  }
}

}  // namespace talus::continuum

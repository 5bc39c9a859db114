// SPDX-License-Identifier: Apache-2.0
/// A cloud of light grains that runs down a slope, as in Niiya, Awazu & Nishimori (2020).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/new/kind.hpp"

namespace talus::app {

namespace {

constexpr Question questions[] = {
    {"grains", "how many", "2000", {}, 1, 1e6, true},
    {"radius", "mean radius of a grain", "5 mm", dimension::length, 0, 1},
    {"density", "density of a grain", "20 kg/m3", dimension::density, 0, 30000},
    {"angle", "angle of the slope", "45 deg", dimension::angle, 0, 0.5 * std::numbers::pi},
    {"fluid-density", "density of the fluid", "1.2 kg/m3", dimension::density, 0, 30000, true},
    {"viscosity", "viscosity of the fluid", "1.82e-5 Pa s", dimension::viscosity, 0, 1e6},
};

std::string write(const Answers& a) {
  const double count = std::round(a["grains"]), radius = a["radius"], excess = a["density"] - a["fluid-density"];
  // The paper's disc of 2000 grains of 5 mm has a radius of 0.34 m; its springs hold them apart there, and overlaps
  // grow as the square root of the number (docs/guidance.md).
  const double disc = 0.34 * radius / 5e-3 * std::sqrt(count / 2000);
  const double stiffness = 10 * std::pow(radius / 5e-3, 2) * a["density"] / 20 * std::sqrt(std::max(1.0, count / 2000));
  // 60 times that in which a grain alone falls by its radius (Stokes): the paper's 5 ms. Where the grain is not denser
  // than the fluid, talus check says so.
  const double speed = 2.0 / 9.0 * std::abs(excess) * drafted_gravity * radius * radius / a["viscosity"];
  const double end = 60 * radius / (speed > 0 ? speed : 1);
  return fmt::format(
      "# A disc of grains on a slope sinks through a viscous fluid and drags it along: a model of powder clouds.\n"
      "# Written by talus new. Every key: docs/case-reference-cloud.md. Speeds in units of one grain's speed and "
      "lengths\n"
      "# in radii are what this model is about (docs/guidance.md).\n"
      "model = \"cloud\"\ntitle = \"Avalanche of {0:.0f} grains\"\nseed = 1\nmotion = \"xy\"\n\n"
      "[particles]\nshape = \"circle\"\ncount = {0:.0f}\nsize = {1}\nradius = {2}\nradius_spread = 0.05\ndensity = "
      "{3}\n\n"
      "[fluid]\ndensity = {4}\nviscosity = {5}\nmobility = \"zuk-2014\"\n\n"
      "# So stiff that grains overlap by a few hundredths (the regime card shows it).\n[contact]\nstiffness = {6}\n\n"
      "[slope]\nangle = {7}\n\n[gravity]\nacceleration = \"9.81 m/s2\"\n\n"
      "# 60 times as long as a grain alone takes to sink by its radius.\n[run]\nend = {8}\n\n[output]\nsnapshots = "
      "{9}\n",
      count, written(disc, "m"), written(radius, "mm"), written(a["density"], "kg/m3"),
      written(a["fluid-density"], "kg/m3"), written(a["viscosity"], "Pa s"), written(stiffness, "N/m"),
      written(a["angle"], "deg"), written(end, "ms"), written(end / 20, "ms"));
}

}  // namespace

const Kind avalanche_kind{"avalanche", "a cloud of grains runs down a slope", questions, write};

}  // namespace talus::app

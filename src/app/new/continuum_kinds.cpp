// SPDX-License-Identifier: Apache-2.0
/// Hopper and column, sections one particle deep of the continuum, and a silo in space. The choices follow the cases of
/// the papers and docs/guidance.md.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/new/kind.hpp"

namespace talus::app {

namespace {

constexpr double gravity = 9.81;          // m/s2
constexpr double packing = 0.6;           // at the start, as in the papers' cases
constexpr double most_particles = 40000;  // a run of some minutes to an hour on two cores
constexpr double across_an_outlet = 16;   // particles; below 12 the discharge shows them

constexpr Question diameter{"diameter", "diameter of the grains", "200 um", dimension::length, 0, 0.1};
constexpr Question density{"density", "density of a grain", "2500 kg/m3", dimension::density, 0, 30000};
constexpr Question friction{
    "friction", "friction of the grains in slow flow: the tangent of their angle of repose, less 0.08", "0.5", {}, 0,
    1.3};

/// So many particles along a length, unless the bed would have too many.
double spacing_of(double length, double count, double area) {
  return std::max(length / count, std::sqrt(area / most_particles));
}

double rounded_up(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return unit * std::ceil(value / unit);
}

std::string head(std::string_view title, std::string_view comment) {
  return fmt::format(
      "# {}\n# Written by talus new. Every key: docs/case-reference-continuum.md.\nmodel = "
      "\"continuum\"\ntitle = \"{}\"\n\n",
      comment, title);
}

std::string grains(const Answers& a) {
  return fmt::format("[grains]\ndensity = {}\ndiameter = {}\n\n", written(a["density"], "kg/m3"),
                     written(a["diameter"], "um"));
}

/// The law of the papers' cases, with another friction.
std::string critical_state(double slow_friction) {
  return fmt::format(
      "# Grains whose packing tends to a critical one under shear. Fast flow has half as much friction again as slow\n"
      "# flow (docs/critical-state.md).\n"
      "[law]\nname = \"critical-state\"\n\n"
      "[law.critical-state]\nfriction = {:.5g}\nfast_friction = {:.5g}\n\n"
      "[collisions]\nform = \"none\"\n\n"
      "# As little viscosity as the scheme bears.\n[sph]\nviscosity_alpha = 0.01\n\n",
      slow_friction, std::min(2.0, 1.52 * slow_friction));
}

/// How the bed settles, by the time (D/g)^½ of a length D: the outlet's width, or the height of a bed without one.
/// \param creeps whether a lattice of particles may go on creeping: along inclined walls, or beside one that goes
std::string settling(double length, bool creeps) {
  const double time = std::sqrt(length / gravity), speed = std::sqrt(length * gravity);
  const auto two_digits = [](double value) {
    const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
    return unit * std::round(value / unit);
  };
  std::string text = fmt::format("[settle]\ndamping_time = {}\n", written(two_digits(0.08 * time), "ms"));
  if (creeps)
    text += fmt::format("speed = {}\nduration = {}\n", written(two_digits(3.2e-3 * speed), "mm/s"),
                        written(two_digits(0.15 * time), "ms"));
  return text + "\n";
}

std::string ending(double end, double frames, double rows) {
  return fmt::format(
      "[integration]\nmethod = \"leapfrog\"\ncourant = 1.2\n\n"
      "# Counted from the opening of the gate.\n[run]\nend = {}\n\n"
      "[output]\nsnapshots = {}\nseries = {}\n",
      written(end, "s"), written(end / frames, "ms"), written(end / rows, "ms"));
}

// ---------------------------------------------------------------------------------------------- hopper

constexpr Question hopper_questions[] = {
    {"width", "width of the hopper", "100 mm", dimension::length, 0, 100},
    {"fill", "height of the bed above the outlet", "83.333 mm", dimension::length, 0, 100},
    {"outlet", "width of the outlet", "40 mm", dimension::length, 0, 100},
    {"drop", "height of the outlet above the floor", "100 mm", dimension::length, 0, 100},
    {"half-angle", "half angle of a wedge, to the vertical; a flat bottom if not given", "", dimension::angle, 0,
     1.5533},
    diameter,
    density,
    friction,
    {"air", "with air between and around the grains", "", {}, 0, 1, false, true},
};

std::string write_hopper(const Answers& a) {
  const double width = a["width"], outlet = a["outlet"], fill = a["fill"], drop = a["drop"];
  const bool wedge = a.has("half-angle"), air = a["air"] > 0;
  const double spacing = spacing_of(outlet, across_an_outlet, width * fill);
  // The mass flow of a slit, near 1.04 rho_b g^(1/2) W^(3/2) a depth in the paper's hopper in a vacuum, two thirds of
  // it in air; then some fall and rest.
  const double flow = 1.04 * std::sqrt(gravity) * std::pow(outlet, 1.5) * (air ? 0.67 : 1);
  const double end = rounded_up(2 * width * fill / flow + 2 * std::sqrt(2 * drop / gravity));
  std::string text = head(fmt::format("{}{}", wedge ? "Wedge hopper" : "Flat-bottomed hopper", air ? " in air" : ""),
                          "Grains settle in a hopper; the gate opens; they flow through the outlet into the bin.");
  text += fmt::format("# A section one particle deep.\n[box]\nwidth = {}\ndepth = {}\nheight = {}\n\n",
                      written(width, "mm"), written(spacing, "mm"), written(drop + 1.5 * fill, "mm"));
  if (wedge)
    text += fmt::format("[wedge]\nhalf_angle = {}\noutlet = {}\nheight = {}\n\n", written(a["half-angle"], "deg"),
                        written(outlet, "mm"), written(drop, "mm"));
  else
    text += fmt::format("[plate]\nheight = {}\nslit_left = {}\nslit_right = {}\n\n", written(drop, "mm"),
                        written(0.5 * (width - outlet), "mm"), written(0.5 * (width + outlet), "mm"));
  text += "[gate]\nopens = \"when-settled\"\n\n" + grains(a);
  text += fmt::format(
      "# {:.3g} particles across the outlet; fewer than 12 show in the discharge (talus check).\n"
      "[bed]\npacking = {}\nspacing = {}\nheight = {}\n\n",
      outlet / spacing, packing, written(spacing, "mm"), written(fill, "mm"));
  if (air)
    text +=
        "# The bin is closed, the hopper open above. Boundaries of the air: docs/guidance.md.\n[air]\nenabled = true\n"
        "continuity = \"air-alone\"\nformulation = \"model-b\"\n\n";
  text += critical_state(a["friction"]);
  text += wedge
              ? "# Along smooth inclined walls a lattice of particles would go on creeping.\n[walls]\nfriction_from = "
                "\"start\"\n\n"
              : "";
  text += settling(outlet, wedge);
  return text + ending(end, 50, 5000);
}

// ------------------------------------------------------------------------------------------------ silo

constexpr Question silo_questions[] = {
    {"width", "diameter of the silo", "65 mm", dimension::length, 0, 100},
    {"fill", "height of the bed above the outlet", "80 mm", dimension::length, 0, 200},
    {"outlet", "diameter of the outlet", "30 mm", dimension::length, 0, 100},
    {"half-angle", "half angle of the cone, to the vertical", "30 deg", dimension::angle, 0, 1.5533},
    {"diameter", "diameter of the grains", "0.5 mm", dimension::length, 0, 0.1},
    {"wall-friction", "coefficient of wall friction; that of glass beads on steel if not given", "", {}, 0, 2, true},
};

std::string write_silo(const Answers& a) {
  const double radius = 0.5 * a["width"], outlet = a["outlet"], fill = a["fill"], drop = 2 * outlet;
  const double volume = std::numbers::pi * radius * radius * fill;
  const double spacing = std::max(outlet / 12, std::cbrt(volume / most_particles));
  const double cone_top = drop + (radius - 0.5 * outlet) / std::tan(a["half-angle"]);
  const double top = std::max(cone_top, drop + fill) + 4 * spacing, room = 2 * radius + 8 * spacing;
  // Beverloo's rule with the grains as points, half as long again.
  const double rate = 0.58 * std::sqrt(gravity) * std::pow(outlet, 2.5);
  std::string text =
      head("Silo", "Grains flow out of a silo, a cone under a cylinder, and are taken away and counted.");
  text += fmt::format("[box]\nwidth = {0}\ndepth = {0}\nheight = {1}\nfloor = \"open\"\n\n", written(room, "mm"),
                      written(top + 2 * spacing, "mm"));
  if (top > cone_top)
    text += fmt::format("[[vessel]]\nname = \"cylinder\"\nshape = \"cylinder\"\nradius = {}\nbottom = {}\ntop = {}\n\n",
                        written(radius, "mm"), written(cone_top, "mm"), written(top, "mm"));
  text += fmt::format(
      "[[vessel]]\nname = \"cone\"\nshape = \"cone\"\nlower_radius = {}\nupper_radius = {}\nbottom = {}\ntop = {}\n\n",
      written(0.5 * outlet, "mm"), written(radius, "mm"), written(drop, "mm"), written(cone_top, "mm"));
  text += fmt::format(
      "# It goes when the bed has settled.\n[[vessel]]\nname = \"gate\"\nshape = \"disc\"\nradius = {}\nheight = "
      "{}\ngate = true\n\n[gate]\nopens = \"when-settled\"\n\n[removal]\nbelow = {}\n\n",
      written(0.5 * outlet, "mm"), written(drop, "mm"), written(0.25 * drop, "mm"));
  text += fmt::format(
      "# Density, packing, law and wall friction with their sources: talus materials glass-beads. What stands here\n"
      "# instead holds; the stiffness follows from the weight of the bed.\n"
      "[grains]\nmaterial = \"glass-beads\"\ndiameter = {}\n\n[walls]\nmaterial = \"steel\"\n{}friction_from = "
      "\"start\"\n\n",
      written(a["diameter"], "mm"),
      a.has("wall-friction") ? fmt::format("coefficient = {:.5g}\n", a["wall-friction"]) : std::string());
  text += fmt::format(
      "# {:.3g} particles across the outlet; fewer than 12 show in the discharge (talus check). In place of the "
      "height\n"
      "# a mass may stand.\n[bed]\nspacing = {}\nheight = {}\n\n",
      outlet / spacing, written(spacing, "mm"), written(fill, "mm"));
  text +=
      "[collisions]\nform = \"none\"\n\n# As little viscosity as the scheme bears.\n[sph]\nviscosity_alpha = 0.01\n\n" +
      settling(outlet, true);
  return text + ending(rounded_up(1.5 * volume / rate), 25, 1000);
}

// ---------------------------------------------------------------------------------------------- column

constexpr Question column_questions[] = {
    {"width", "width of the column, half of it: the left face is its middle", "50 mm", dimension::length, 0, 100},
    {"height", "height of the column", "50 mm", dimension::length, 0, 100},
    {"floor-friction", "coefficient of friction of the floor", "0.5", {}, 0, 2, true},
    diameter,
    density,
    friction,
};

std::string write_column(const Answers& a) {
  const double width = a["width"], height = a["height"];
  const double spacing = spacing_of(std::min(width, height), 24, width * height);
  std::string text = head("Collapsing column", "A column of grains collapses when the wall that held it goes.");
  text += fmt::format(
      "# A section one particle deep, its left face a plane of symmetry; room for three times the usual runout.\n"
      "[box]\nwidth = {}\ndepth = {}\nheight = {}\nleft = \"symmetry\"\nright = \"open\"\n\n",
      written(width + 4 * height, "mm"), written(spacing, "mm"), written(1.5 * height, "mm"));
  text += fmt::format(
      "# The wall, which goes when the bed has settled.\n[[plates]]\nfrom = [{0}, \"0 mm\"]\nto = [{0}, {1}]\n"
      "openings = [\"0 mm\", {1}]\nopens_after = \"0 s\"\n\n[gate]\nopens = \"when-settled\"\n\n",
      written(width, "mm"), written(1.5 * height, "mm"));
  text += grains(a);
  text += fmt::format("[bed]\npacking = {}\nspacing = {}\nright = {}\nheight = {}\n\n", packing, written(spacing, "mm"),
                      written(width, "mm"), written(height, "mm"));
  text += critical_state(a["friction"]);
  text += settling(height, true) + fmt::format("[walls]\ncoefficient = {:.5g}\n\n", a["floor-friction"]);
  return text + ending(rounded_up(7 * std::sqrt(height / gravity)), 25, 1000);
}

}  // namespace

const Kind hopper_kind{"hopper", "grains flow out of a hopper, in air or not", hopper_questions, write_hopper};
const Kind silo_kind{"silo", "grains flow out of a silo, a cone under a cylinder", silo_questions, write_silo};
const Kind column_kind{"column", "a column of grains collapses over a floor", column_questions, write_column};

}  // namespace talus::app

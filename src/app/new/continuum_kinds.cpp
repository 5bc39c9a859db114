// SPDX-License-Identifier: Apache-2.0
/// Hopper and column, sections one particle deep of the continuum, and a silo in space. The choices follow the cases of
/// the papers and docs/guidance.md.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "app/new/kind.hpp"
#include "models/continuum/setup/choices.hpp"

namespace talus::app {

namespace {

constexpr double packing = 0.6;           // at the start, as in the papers' cases
constexpr double max_particles = 40000;   // a run of some minutes to an hour on two cores
constexpr double across_an_outlet = 16;   // particles; below 12 the discharge shows them
constexpr double outlet_over_ring = 2.9;  // of a sector; below 2.8 the discharge shows it (validation/sector)

constexpr Question diameter{"diameter", "diameter of the grains", "200 um", dimension::length, 0, 0.1};
constexpr Question density{"density", "density of a grain", "2500 kg/m3", dimension::density, 0, 30000};
constexpr std::string_view friction_text =
    "friction of the grains in slow flow: the tangent of their angle of repose, less 0.08";
constexpr Question friction{"friction", friction_text, "0.5", {}, 0, 1.3};

// Of grains with a material, whose values hold where none is given.
constexpr Question material{.name = "material",
                            .text = "what the grains are: one that talus materials lists",
                            .standard = "glass-beads",
                            .words = choices<continuum::GrainMaterial>,
                            .only_words = true};
constexpr Question own_density{"density", "density of a grain; the material's if not given", "", dimension::density, 0,
                               30000};
constexpr Question own_diameter{
    "diameter", "diameter of the grains; the material's if not given", "", dimension::length, 0, 0.1};
constexpr Question own_friction{
    "friction", "tangent of the grains' angle of repose, less 0.08; the material's if not given", "", {}, 0, 1.3};
constexpr Question wall{.name = "wall",
                        .text = "what the walls are made of: steel, acrylic, glass or concrete",
                        .standard = "steel",
                        .words = choices<continuum::WallMaterial>,
                        .only_words = true};
constexpr Question wall_friction{.name = "wall-friction",
                                 .text = "coefficient of wall friction; of the material on the wall if not given",
                                 .standard = "",
                                 .min = 0,
                                 .max = 2,
                                 .from_min = true};
constexpr std::string_view openings[] = {"when-settled", "from-the-start"};
constexpr Question gate{.name = "gate",
                        .text = "when the outlet opens: when-settled, from-the-start, or a time such as 0.5 s",
                        .standard = "when-settled",
                        .dimension = dimension::time,
                        .min = 0,
                        .max = 1e4,
                        .from_min = true,
                        .words = openings};
constexpr std::string_view yes_or_no[] = {"yes", "no"};
constexpr Question of_materials[] = {material, own_diameter, own_density, own_friction, wall, wall_friction, gate};
constexpr KeyOfAnswer keys_of_materials[] = {{"grains.diameter", "diameter"},
                                             {"grains.density", "density"},
                                             {"grains.material", "material"},
                                             {"walls.material", "wall"},
                                             {"walls.coefficient", "wall-friction"},
                                             {"critical-state.static_friction", "friction"},
                                             {"critical-state.dynamic_friction", "friction"},
                                             {"gate.time", "gate"},
                                             {"settle.damping_time", "gate"},
                                             {"removal.below", "removal"},
                                             {"run.end", "fill"}};

template <class T, std::size_t n, std::size_t m>
constexpr std::array<T, n + m> joined(const T (&first)[n], const T (&second)[m]) {
  std::array<T, n + m> all{};
  std::copy(std::begin(first), std::end(first), all.begin());
  std::copy(std::begin(second), std::end(second), all.begin() + n);
  return all;
}

/// So many particles along a length, unless the bed would have too many.
double spacing_of(double length, double count, double area) {
  return std::max(length / count, std::sqrt(area / max_particles));
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

/// A friction of slow flow; fast flow has half as much again.
std::string frictions(double slow_friction) {
  return fmt::format(
      "# Fast flow has half as much friction again as slow flow (docs/theory/critical-state.md).\n"
      "[law.critical-state]\nstatic_friction = {:.5g}\ndynamic_friction = {:.5g}\n\n",
      slow_friction, std::min(2.0, 1.52 * slow_friction));
}

/// Grains and walls of a material, with what is given of their own.
std::string grains_of_material(const Answers& a, bool rubs_from_start) {
  std::string text = fmt::format(
      "# Values of grains and walls with their sources: talus materials {0}. What stands here holds in place of them.\n"
      "[grains]\nmaterial = \"{0}\"\n",
      a.word("material"));
  if (a.has("density")) text += fmt::format("density = {}\n", written(a["density"], "kg/m3"));
  if (a.has("diameter")) text += fmt::format("diameter = {}\n", written(a["diameter"], "mm"));
  text += fmt::format("\n[walls]\nmaterial = \"{}\"\n", a.word("wall"));
  if (a.has("wall-friction")) text += fmt::format("coefficient = {:.5g}\n", a["wall-friction"]);
  if (rubs_from_start) text += "friction_from = \"start\"\n";
  text += "\n";
  return a.has("friction") ? text + frictions(a["friction"]) : text;
}

/// How the bed settles, by the time (D/g)^½ of a length D: the outlet's width, or the height of a bed without one.
/// \param creeps whether a lattice of particles may go on creeping: along inclined walls, or beside one that goes
/// \param layers whether the weight comes on in layers, for loads on walls as those of a silo that has been filled
std::string settling(double length, bool creeps, bool layers = false) {
  const double time = std::sqrt(length / drafted_gravity), speed = std::sqrt(length * drafted_gravity);
  const auto two_digits = [](double value) {
    const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
    return unit * std::round(value / unit);
  };
  std::string text = fmt::format("[settle]\ndamping_time = {}\n", written(two_digits(0.08 * time), "ms"));
  if (creeps)
    text += fmt::format("speed = {}\nduration = {}\n", written(two_digits(3.2e-3 * speed), "mm/s"),
                        written(two_digits(0.15 * time), "ms"));
  return text + (layers ? "filling = \"layers\"\n\n" : "\n");
}

/// The gate, and how the bed settles before it opens. \param inclined walls, along which particles go on creeping
/// \param layers of settling()
std::string opening(const Answers& a, bool inclined, bool layers = false) {
  if (a.has("gate"))
    return fmt::format("[gate]\nopens = \"at-time\"\ntime = {}\n\n", written(a["gate"], "s")) +
           settling(a["outlet"], false);
  const std::string& opens = a.word("gate");
  std::string text = fmt::format("[gate]\nopens = \"{}\"\n\n", opens);
  if (opens != "when-settled") return text;
  return text + settling(a["outlet"], inclined, layers);
}

/// The outlet against the vessel above it, and the bed against the particles, a part of the outlet.
std::vector<Problem> check_outlet(const Answers& a) {
  std::vector<Problem> problems;
  if (!(a["outlet"] < a["width"]))
    problems.push_back({.key = "outlet",
                        .what = "is not narrower than the vessel",
                        .allowed = fmt::format("less than --width, {:.5g} mm", 1e3 * a["width"])});
  if (const double least = a["outlet"] / 3; a["fill"] < least)
    problems.push_back({.key = "fill",
                        .what = "is a bed of fewer than four layers of particles",
                        .allowed = fmt::format("at least a third of --outlet, {:.5g} mm", 1e3 * least)});
  return problems;
}

/// \param outlet its width, m: rows of the series are at most T/2 apart (analysis.averaging_time); infinite without one
std::string ending(double end, double frames, double rows, double outlet = std::numeric_limits<double>::infinity()) {
  const double apart = std::min(end / rows, 0.15 * std::sqrt(outlet / drafted_gravity));
  return fmt::format(
      "# Counted from the opening of the gate.\n[run]\nend = {}\n\n"
      "[output]\nsnapshots = {}\nseries = {}\n",
      written(end, "s"), written(end / frames, "ms"), written(apart, "ms"));
}

// ---------------------------------------------------------------------------------------------- hopper

constexpr std::string_view hopper_sketch = R"(
   |<------ width ------>|
   |                     |
   |. . . . . . . . . . .|  ---
   | . . . . . . . . . . |   ^
    \ . . . . . . . . . /    |
     \ . . . . . . . . /:    |  fill: from the outlet to the top of the bed
      \ . . . . . . . / :    |
       \ . . . . . . / <--- half-angle, between the wall and the vertical; without it a flat bottom
        \ . . . . . /   :    v
         '---------'  ------+--
           outlet            |
         (a slit, through    |  drop: from the outlet to the floor of the bin
          the slice)         |
   _____________________  ------
 A slice of a long hopper, one particle deep.
)";

constexpr Question of_hopper[] = {
    {"width", "width of the hopper, between its upright walls", "100 mm", dimension::length, 0, 100},
    {"fill", "height of the bed, from the outlet to its top", "83.333 mm", dimension::length, 0, 100},
    {"outlet", "width of the outlet, a slit", "40 mm", dimension::length, 0, 100},
    {"drop", "height of the outlet above the floor of the bin", "100 mm", dimension::length, 0, 100},
    {"half-angle", "angle between an inclined wall and the vertical; a flat bottom if not given", "", dimension::angle,
     0, 1.5533},
    {.name = "removal",
     .text = "whether grains are taken away below the outlet (yes), or fill the bin (no)",
     .standard = "no",
     .words = yes_or_no,
     .only_words = true},
    {"air", "with air between and around the grains", "", {}, 0, 1, false, true},
};
constexpr auto hopper_questions = joined(of_hopper, of_materials);

constexpr KeyOfAnswer keys_of_hopper[] = {
    {"box.width", "width"},     {"box.height", "fill"},        {"bed.height", "fill"},
    {"wedge.outlet", "outlet"}, {"plate.slit_left", "outlet"}, {"plate.slit_right", "outlet"},
    {"bed.spacing", "outlet"},  {"box.depth", "outlet"},       {"air.cell", "outlet"},
    {"wedge.height", "drop"},   {"plate.height", "drop"},      {"wedge.half_angle", "half-angle"}};
constexpr auto hopper_keys = joined(keys_of_hopper, keys_of_materials);

std::string write_hopper(const Answers& a) {
  const double width = a["width"], outlet = a["outlet"], fill = a["fill"], drop = a["drop"];
  const bool wedge = a.has("half-angle"), air = a["air"] > 0, removal = a.word("removal") == "yes";
  const double spacing = spacing_of(outlet, across_an_outlet, width * fill);
  // The mass flow of a slit, near 1.04 rho_b g^(1/2) W^(3/2) a depth in the paper's hopper in a vacuum, two thirds of
  // it in air; then some fall and rest.
  const double flow = 1.04 * std::sqrt(drafted_gravity) * std::pow(outlet, 1.5) * (air ? 0.67 : 1);
  const double end = rounded_up(2 * width * fill / flow + 2 * std::sqrt(2 * drop / drafted_gravity));
  std::string text =
      head(fmt::format("{}{}", wedge ? "Wedge hopper" : "Flat-bottomed hopper", air ? " in air" : ""),
           removal ? "Grains settle in a hopper; the gate opens; they flow out and are taken away."
                   : "Grains settle in a hopper; the gate opens; they flow through the outlet into the bin.");
  text += fmt::format("# A section one particle deep.\n[box]\nwidth = {}\ndepth = {}\nheight = {}\n{}\n",
                      written(width, "mm"), written(spacing, "mm"), written(drop + 1.5 * fill, "mm"),
                      removal ? "floor = \"open\"\n" : "");
  if (wedge)
    text += fmt::format("[wedge]\nhalf_angle = {}\noutlet = {}\nheight = {}\n\n", written(a["half-angle"], "deg"),
                        written(outlet, "mm"), written(drop, "mm"));
  else
    text += fmt::format("[plate]\nheight = {}\nslit_left = {}\nslit_right = {}\n\n", written(drop, "mm"),
                        written(0.5 * (width - outlet), "mm"), written(0.5 * (width + outlet), "mm"));
  if (removal) text += fmt::format("[removal]\nbelow = {}\n\n", written(0.25 * drop, "mm"));
  text += opening(a, wedge);
  // Along smooth inclined walls a lattice of particles would go on creeping.
  text += grains_of_material(a, wedge);
  text += fmt::format(
      "# {:.3g} particles across the outlet; fewer than 12 show in the discharge (talus check).\n"
      "[bed]\nspacing = {}\nheight = {}\n\n",
      outlet / spacing, written(spacing, "mm"), written(fill, "mm"));
  if (air)
    text += fmt::format(
        "# The {}hopper is open above. Boundaries of the air: docs/guidance.md.\n[air]\nenabled = true\n"
        "drag = \"ergun-wen-yu\"\n\n",
        removal ? "" : "bin is closed, the ");
  return text + ending(end, 50, 5000, a["outlet"]);
}

// ------------------------------------------------------------------------------------------------ silo

constexpr std::string_view silo_sketch = R"(
   |<-- width (diameter) ->|
   |                       |
   |. . . . . . . . . . . .|  ---
   | . . . . . . . . . . . |   ^
   |. . . . . . . . . . . .|   |
    \ . . . . . . . . . . /    |
     \ . . . . . . . . . /:    |  fill: from the outlet to the top of the bed
      \ . . . . . . . . / :    |
       \ . . . . . . . / <--- half-angle, between the wall of the cone and the vertical
        \ . . . . . . /   :    v
         '-----------'       ---
         outlet (diameter)
)";

constexpr Question of_silo[] = {
    {"width", "diameter of the silo", "65 mm", dimension::length, 0, 100},
    {"fill", "height of the bed, from the outlet to its top", "80 mm", dimension::length, 0, 200},
    {"outlet", "diameter of the outlet", "30 mm", dimension::length, 0, 100},
    {"half-angle", "half angle of the cone, between its wall and the vertical", "30 deg", dimension::angle, 0, 1.5533},
    {"sector", "angle of a sector computed in place of the whole, such as 20 deg; the whole if not given", "",
     dimension::angle, 0, 2 * std::numbers::pi},
    {.name = "removal",
     .text = "whether grains are taken away below the outlet (yes), or pile up on a floor (no)",
     .standard = "yes",
     .words = yes_or_no,
     .only_words = true},
};
constexpr auto silo_questions = joined(of_silo, of_materials);

constexpr KeyOfAnswer keys_of_silo[] = {
    {"box.width", "width"},    {"box.depth", "width"},       {"box.height", "fill"},     {"bed.height", "fill"},
    {"upper_radius", "width"}, {"vessel.1.radius", "width"}, {"lower_radius", "outlet"}, {"radius", "outlet"},
    {"bed.spacing", "outlet"}, {"bottom", "half-angle"},     {"top", "half-angle"},      {"box.sector", "sector"}};
constexpr auto silo_keys = joined(keys_of_silo, keys_of_materials);

std::string write_silo(const Answers& a) {
  const double radius = 0.5 * a["width"], outlet = a["outlet"], fill = a["fill"], drop = 2 * outlet;
  const bool removal = a.word("removal") == "yes";
  const double volume = std::numbers::pi * radius * radius * fill;
  const double share = a.has("sector") ? a["sector"] / (2 * std::numbers::pi) : 1;
  // The ring in which a particle and its copies stand about the axis, as narrow as the outlet asks for.
  const double on_ring = 0.5 * outlet / (outlet_over_ring * std::sqrt(1 / (share * std::numbers::pi)));
  const double across = a.has("sector") ? std::min(outlet / 12, on_ring) : outlet / 12;
  const double spacing = std::max(across, std::cbrt(share * volume / max_particles));
  const double cone_top = drop + (radius - 0.5 * outlet) / std::tan(a["half-angle"]);
  const double top = std::max(cone_top, drop + fill) + 4 * spacing, room = 2 * radius + 8 * spacing;
  // Beverloo's rule with the grains as points, half as long again.
  const double rate = 0.58 * std::sqrt(drafted_gravity) * std::pow(outlet, 2.5);
  std::string text =
      head("Silo", removal ? "Grains flow out of a silo, a cone under a cylinder, and are taken away and counted."
                           : "Grains flow out of a silo, a cone under a cylinder, and pile up on the floor.");
  if (a.has("sector"))
    text += "# A sector of the silo is computed in place of the whole; all results are those of the whole.\n";
  text += fmt::format("[box]\nwidth = {0}\ndepth = {0}\nheight = {1}\n", written(room, "mm"),
                      written(top + 2 * spacing, "mm"));
  if (a.has("sector")) text += fmt::format("sector = {}\n", written(a["sector"], "deg"));
  text += removal ? "floor = \"open\"\n\n" : "\n";
  if (top > cone_top)
    text += fmt::format("[[vessel]]\nname = \"cylinder\"\nshape = \"cylinder\"\nradius = {}\nbottom = {}\ntop = {}\n\n",
                        written(radius, "mm"), written(cone_top, "mm"), written(top, "mm"));
  text += fmt::format(
      "[[vessel]]\nname = \"cone\"\nshape = \"cone\"\nlower_radius = {}\nupper_radius = {}\nbottom = {}\ntop = {}\n\n",
      written(0.5 * outlet, "mm"), written(radius, "mm"), written(drop, "mm"), written(cone_top, "mm"));
  text += fmt::format(
      "# Shuts the outlet until the gate opens.\n[[vessel]]\nname = \"gate\"\nshape = \"disc\"\nradius = {}\nheight = "
      "{}\ngate = true\n\n",
      written(0.5 * outlet, "mm"), written(drop, "mm"));
  text += opening(a, true, true);
  if (removal) text += fmt::format("[removal]\nbelow = {}\n\n", written(0.25 * drop, "mm"));
  text += grains_of_material(a, true);
  text += fmt::format(
      "# {:.3g} particles across the outlet; fewer than 12 show in the discharge (talus check). A mass may be given\n"
      "# instead of the height.\n[bed]\nspacing = {}\nheight = {}\n\n",
      outlet / spacing, written(spacing, "mm"), written(fill, "mm"));
  return text + ending(rounded_up(1.5 * volume / rate), 25, 1000, a["outlet"]);
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
  text += frictions(a["friction"]);
  text += settling(height, true) + fmt::format("[walls]\ncoefficient = {:.5g}\n\n", a["floor-friction"]);
  return text + ending(rounded_up(7 * std::sqrt(height / drafted_gravity)), 25, 1000);
}

}  // namespace

const Kind hopper_kind{.name = "hopper",
                       .text = "grains flow out of a hopper, in air or not",
                       .questions = hopper_questions,
                       .write = write_hopper,
                       .keys = hopper_keys,
                       .sketch = hopper_sketch,
                       .check = check_outlet};
const Kind silo_kind{.name = "silo",
                     .text = "grains flow out of a silo, a cone under a cylinder",
                     .questions = silo_questions,
                     .write = write_silo,
                     .keys = silo_keys,
                     .sketch = silo_sketch,
                     .check = check_outlet};
const Kind column_kind{"column", "a column of grains collapses over a floor", column_questions, write_column};

}  // namespace talus::app

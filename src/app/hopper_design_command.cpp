// SPDX-License-Identifier: Apache-2.0
/// talus hopper-design: Jenike's hopper for a material and a wall, and the loads of EN 1991-4, by formulas alone.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "app/commands.hpp"
#include "app/continuum/design_code.hpp"
#include "app/continuum/engineering_units.hpp"
#include "app/continuum/hand_formulas.hpp"
#include "app/continuum/silo_shape.hpp"
#include "app/materials/materials.hpp"
#include "base/text.hpp"
#include "base/unit.hpp"
#include "physics/granular/hopper_design.hpp"
#include "physics/granular/silo.hpp"

namespace talus::app {

namespace {

using granular::HopperShape;

constexpr double margin = 3 * degree, any = 1e12;
constexpr double of_funnel = 30 * degree;  // a choice, where no half angle gives mass flow
constexpr std::array shapes = {HopperShape::wedge, HopperShape::cone};

struct DesignWords {
  std::string material, wall = "steel", half_angle, outlet, diameter, height, gravity = "9.81 m/s2";
};

/// What the words say, SI; 0 where nothing is said.
struct DesignInput {
  continuum::Parameters grains;
  granular::CriticalStateParameters law;
  double half_angle = 0, outlet = 0, diameter = 0, height = 0;
};

/// Of a wall that is given by its friction, a number or an angle; 0: it is not.
double wall_coefficient(const std::string& text) {
  const auto wall = parse_quantity(text);
  if (!wall) return 0;
  constexpr double max_coefficient = 3;
  const bool is_angle = wall->dimension == dimension::angle && wall->value < std::atan(max_coefficient);
  const double coefficient = is_angle ? std::tan(wall->value) : wall->value;
  return (is_angle || wall->dimension == dimension::none) && coefficient < max_coefficient ? coefficient : 0;
}

DesignInput read_input(const DesignWords& words) {
  DesignInput input;
  std::vector<Problem> problems;
  const auto number = [&](const char* option, const std::string& text, const Dimension& unit, double below,
                          const char* allowed) {
    if (text.empty()) return 0.0;
    const auto read = numbers_of(option, text, unit, below, allowed, problems);
    if (read.size() == 1) return read[0];
    if (read.size() > 1) problems.push_back({.where = option, .what = "are several", .allowed = allowed});
    return 0.0;
  };
  input.half_angle = number("--half-angle", words.half_angle, dimension::angle, 90 * degree,
                            "above 0 and below 90 deg, such as \"20 deg\"");
  input.outlet = number("--outlet", words.outlet, dimension::length, any, "a width such as \"200 mm\"");
  input.diameter = number("--silo-diameter", words.diameter, dimension::length, any, "a length such as \"3 m\"");
  input.height = number("--silo-height", words.height, dimension::length, any, "a depth of the bed such as \"9 m\"");
  if ((input.diameter > 0) != (input.height > 0))
    problems.push_back({.where = input.diameter > 0 ? "--silo-height" : "--silo-diameter",
                        .what = "missing",
                        .allowed = "both, or neither"});
  if (input.outlet > 0 && input.diameter > 0 && input.outlet >= input.diameter)
    problems.push_back({.where = "--outlet", .what = "is as wide as the silo", .allowed = "less than its diameter"});
  continuum::Parameters& p = input.grains;
  p.gravity.acceleration =
      number("--gravity", words.gravity, dimension::acceleration, any, "an acceleration such as \"9.81 m/s2\"");
  // A case that says no more than that: its material's values, and the friction on its walls.
  const double coefficient = wall_coefficient(words.wall);
  const bool is_number = coefficient > 0;
  std::string text = fmt::format("[grains]\nmaterial = {}\n", talus::quoted(words.material));
  if (!is_number) text += fmt::format("[walls]\nmaterial = {}\n", talus::quoted(words.wall));
  const CaseFile file = CaseFile::from_text(text, "");
  const FilledIn filled = fill_in_material(file, p);
  if (p.grains.range.name.empty() && filled.problems.empty())
    problems.push_back({.where = "--material " + words.material,
                        .what = "is no material",
                        .allowed = "one that talus materials lists, or a file that ends in .toml"});
  for (Problem problem : filled.problems) {
    if (problem.where.empty()) problem.where = problem.key == "walls.material" ? "--wall" : "--material";
    if (problem.where == "--wall")
      problem.allowed = "a wall of the material's file, a coefficient such as 0.35 or an angle such as \"20 deg\"";
    problem.key = problem.where.starts_with("--") ? "" : problem.key;
    problems.push_back(std::move(problem));
  }
  if (is_number) p.walls.coefficient = coefficient;
  if (!is_number && !choice_in<continuum::WallMaterial>(file, "walls.material"))
    problems.push_back(
        {.where = "--wall " + words.wall,
         .what = "is no wall",
         .allowed =
             "steel, acrylic, glass, concrete, a coefficient of friction such as 0.35, or its angle, \"20 deg\""});
  if (const auto material = material_file(file, problems); material && !is_number && filled.problems.empty()) {
    const Parameter key{.key = fmt::format("walls.{}.adhesion", words.wall), .dimension = dimension::pressure};
    if (const auto value = value_in(*material, key.key, key, value_type<double>(), problems))
      from_value(*value, p.walls.adhesion);
  }
  p.grains.material = material_of(file);
  input.law =
      p.law.is<granular::CriticalState>() ? p.law.of<granular::CriticalState>() : granular::CriticalStateParameters{};
  if (!problems.empty()) throw InputError(problems);
  return input;
}

void line(const std::string& what, const std::string& wedge, const std::string& cone, std::string_view source) {
  constexpr std::size_t column = 58;
  print("{:32} {:>12} {:>12} {}\n", what, wedge, cone,
        wrapped(source, std::max<std::size_t>(terminal_width(), column + 40), column, column));
}

std::string width_text(double width) {
  return width > 0 ? std::isinf(width) ? "arches" : length_text(width) : "any";
}

/// The friction of a wall with its adhesion at the outlet, of which the stress follows; without a stress that of the
/// wall alone. The stress on the wall is that of Mohr's circle of sigma_1, as of granular::flow_factor().
double friction_there(const DesignInput& input, const granular::CriticalOutlet& outlet) {
  const auto& walls = input.grains.walls;
  if (!(outlet.major > 0)) return walls.coefficient;
  const double major = outlet.major * std::max(1.0, input.outlet / outlet.width);
  const double sine = std::sin(outlet.effective_angle),
               wall = std::min(std::atan(walls.coefficient), outlet.effective_angle);
  const double turned = wall + std::asin(std::min(std::sin(wall) / sine, 1.0));
  return walls.coefficient + walls.adhesion * (1 + sine) / (major * (1 + sine * std::cos(turned)));
}

/// A hopper of each shape, by Jenike.
struct Design {
  std::array<double, 2> internal, limit, there, half_angle;  // delta; limits of mass flow without, with adhesion
  std::array<granular::CriticalOutlet, 2> outlet;
  bool has_outlet = false;  // as wide as said: then the limit with adhesion there counts

  double most(std::size_t n) const { return has_outlet ? there[n] : limit[n]; }
  bool is_mass_flow(std::size_t n) const { return half_angle[n] <= most(n); }
};

Design designed(const DesignInput& input, double weight) {
  const double wall = input.grains.walls.coefficient;
  Design design;
  design.has_outlet = input.outlet > 0;
  for (std::size_t n = 0; n < shapes.size(); ++n) {
    double& internal = design.internal[n] = std::atan(input.law.static_friction);
    // The angle of friction falls with the stress at the outlet, whose width depends on the half angle.
    for (int pass = 0;; ++pass) {
      design.limit[n] = granular::mass_flow_half_angle(shapes[n], wall, internal);
      design.there[n] = granular::mass_flow_half_angle(shapes[n], friction_there(input, design.outlet[n]), internal);
      design.half_angle[n] = input.half_angle > 0 ? input.half_angle : std::max(design.most(n) - margin, 1 * degree);
      design.outlet[n] = granular::critical_outlet(shapes[n], design.half_angle[n], wall, input.law, weight);
      if (!input.law.has_cohesion() || pass == 50) break;
      internal += 0.5 * (design.outlet[n].effective_angle - internal);
    }
    if (!(input.half_angle > 0) && design.most(n) <= margin) design.half_angle[n] = of_funnel;
  }
  return design;
}

void print_discharge(const DesignInput& input, const Design& design) {
  const continuum::Parameters& p = input.grains;
  const double density = bulk_density(p), gravity = p.gravity.acceleration, d = p.grains.diameter;
  const auto johanson = [&](std::size_t n, double length) {
    if (!design.is_mass_flow(n)) return std::string("funnel");
    if (input.outlet > design.outlet[n].widest) return std::string("arches");
    return rate_text(granular::johanson_discharge(shapes[n], design.half_angle[n], input.outlet, length, density,
                                                  gravity, design.outlet[n].width),
                     no_value);
  };
  const double steep = std::tan(design.half_angle[1]);
  print("\nThrough {}, of a slot per metre:\n", length_text(input.outlet));
  line("discharge, coarse grains", johanson(0, 1), johanson(1, 0),
       "Johanson 1965, mass flow; less near the critical outlet");
  line("the same, by the outlet",
       rate_text(granular::rectangular_discharge(input.outlet, 1, true, density, gravity, d), no_value),
       rate_text(granular::factor_of_cone(steep) * granular::orifice_discharge(input.outlet, density, gravity, d),
                 no_value),
       "Beverloo 1961, Rose & Tanaka 1959: grains that do not stick together, outlets above 6 diameters");
  line("discharge, fine grains", "",
       design.is_mass_flow(1) ? rate_text(granular::carleton_discharge(design.half_angle[1], input.outlet, density,
                                                                       gravity, p.grains.density, d),
                                          no_value)
                              : "funnel",
       "Carleton 1972, mass flow: held back by the air that must enter; grains that do not stick together");
}

/// \returns the largest vertical stress, Pa; 0 if none is known
double print_loads(const DesignInput& input, const Design& design) {
  continuum::Parameters p = input.grains;
  const double outlet = input.outlet > 0 ? input.outlet
                        : std::isinf(design.outlet[1].width) || !design.is_mass_flow(1)
                            ? 0.2 * input.diameter
                            : std::clamp(design.outlet[1].width, 0.05 * input.diameter, 0.8 * input.diameter);
  const double cone = 0.5 * (input.diameter - outlet) / std::tan(design.half_angle[1]);
  p.box.width = p.box.depth = 1.2 * input.diameter, p.box.height = 1.2 * (cone + input.height) + 0.1;
  p.bed.spacing = 0.02 * input.diameter;
  continuum::VesselPart upright, hopper;
  upright.name = "wall", upright.radius = 0.5 * input.diameter, upright.bottom = cone, upright.top = p.box.height;
  hopper.name = "cone", hopper.shape = continuum::VesselShape::cone;
  hopper.lower_radius = 0.5 * outlet, hopper.upper_radius = upright.radius, hopper.top = cone;
  p.vessel = {upright, hopper};
  const continuum::Layout layout(p);
  const double top = cone + input.height;
  const auto silo = silo_of_code(layout, top, {0.5 * p.box.width, 0.5 * p.box.depth, cone});
  if (!silo) return 0;
  const double weight = bulk_density(p) * p.gravity.acceleration;
  const double vertical = silo->filling(granular::en1991::Load::bottom, granular::en1991::Limit::upper, cone).vertical;
  const double phi = std::round(std::atan(input.law.static_friction) / degree);
  print("\nSilo, {} wide, bed {} deep above the cone of {}, outlet {}:\n", length_text(input.diameter),
        length_text(input.height), fmt::format("{:.3g}°", design.half_angle[1] / degree), length_text(outlet));
  line("rathole, if the flow is a funnel", "",
       input.law.has_cohesion() ? length_text(granular::rathole_diameter(input.law, vertical, weight)) : "none",
       fmt::format("Jenike 1964, G(phi) as Schulze 2008: sigma_1 {}, at the cone's top; an upper bound{}",
                   pressure_text(vertical), phi < 30 || phi > 70 ? "; G is known from 30 to 70 deg" : ""));
  print("{:32} {:>12} {:>12}\n", "", "filling", "discharge");
  const auto loads = [&](const char* what, std::size_t part, double height) {
    BandOfWall band;
    band.patch = part;
    band.sine = part == 1 ? std::sin(design.half_angle[1]) : 0;
    const CodeLoads at = code_loads(layout, band, top, height);
    line(what, pressure_text(at.pressure_filling), pressure_text(at.pressure_discharge), "EN 1991-4:2006, upper");
  };
  loads("pressure, foot of the wall", 0, cone);
  loads("pressure, top of the cone", 1, cone);
  loads("pressure, cone at the outlet", 1, 0);
  return vertical;
}

void print_half_angles(const DesignInput& input, const Design& design) {
  const auto both = [](const char* what, const auto& value, std::string_view source) {
    const auto text = [&](std::size_t n) {
      return value[n] > 0 ? fmt::format("{:.1f} deg", value[n] / degree) : "none";
    };
    line(what, text(0), text(1), source);
  };
  const double least = *std::min_element(design.internal.begin(), design.internal.end());
  both("effective angle, delta", design.internal,
       std::string(input.law.has_cohesion() ? "of steady shear at the outlet" : "without cohesion that of friction") +
           (std::round(least / degree) < 30 ? "; below 30 deg the closed forms are outside their charts" : ""));
  both("half angle of mass flow, at most", design.limit,
       "Jenike 1964, closed forms of Arnold & McLean; a slot three times as long as wide");
  if (const double adhesion = input.grains.walls.adhesion; adhesion > 0) {
    const std::array<double, 2> wall = {std::atan(friction_there(input, design.outlet[0])),
                                        std::atan(friction_there(input, design.outlet[1]))};
    both("angle of the wall at the outlet", wall,
         fmt::format("atan(mu + a_w/sigma), adhesion a_w = {}, sigma the stress on the wall", pressure_text(adhesion)));
    both("half angle there, at most", design.there,
         design.has_outlet ? "by that angle: what counts"
                           : "by that angle; that above holds where a_w is small against sigma; --outlet says");
  }
  std::string source = input.half_angle > 0 ? "as given" : "3 deg less, as practice has it";
  for (const std::size_t n : {0u, 1u})
    if (!design.is_mass_flow(n))
      source += fmt::format("; {}: funnel flow{}", n == 0 ? "wedge" : "cone",
                            input.half_angle > 0 ? " beyond the limit" : ", none gives mass flow, 30 deg a choice");
  both("half angle here", design.half_angle, source);
}

ExitStatus design_hopper(const DesignWords& words) {
  const DesignInput input = read_input(words);
  const continuum::Parameters& p = input.grains;
  const double density = bulk_density(p), weight = density * p.gravity.acceleration;
  const Design design = designed(input, weight);
  const auto& outlet = design.outlet;
  print("{} on {}: {:.4g} kg/m3, angle of friction {:.1f} deg in a shear tester, of the wall {:.1f} deg\n\n",
        p.grains.range.name, words.wall, density, std::atan(input.law.static_friction) / degree,
        std::atan(p.walls.coefficient) / degree);
  line("", "wedge", "cone", "source; limits");
  print_half_angles(input, design);
  const auto both = [&](const char* what, const auto& text, std::string_view source) {
    const auto shown = [&](std::size_t n) { return design.is_mass_flow(n) ? text(n) : std::string("funnel"); };
    line(what, shown(0), shown(1), source);
  };
  if (!input.law.has_cohesion()) {
    line("critical outlet", "any", "any", "no cohesion: only grains' size counts, 6 to 10 diameters");
  } else {
    const auto stress = [](double value) { return value > 0 ? pressure_text(value) : std::string("none"); };
    both(
        "flow factor there", [&](std::size_t n) { return fmt::format("{:.2f}", outlet[n].factor); },
        "Jenike 1964, closed form of Arnold & McLean: 7 % above the chart at 30 deg");
    both(
        "strength of an arch, f_c", [&](std::size_t n) { return stress(outlet[n].strength); },
        "where the flow function meets the flow factor; steady shear, without time consolidation");
    both(
        "sigma_1 there", [&](std::size_t n) { return stress(outlet[n].major); },
        "compare with the loads of the shear tests; none: flow function and flow factor do not meet");
    both(
        "critical outlet", [&](std::size_t n) { return width_text(outlet[n].width); },
        "H f_c/(rho_b g), H = 1 + theta/180 deg and 2 + theta/60 deg; a round outlet's diameter, a slot's width");
    if (std::isfinite(std::min(outlet[0].widest, outlet[1].widest)))
      both(
          "widest outlet",
          [&](std::size_t n) { return std::isinf(outlet[n].widest) ? "any" : length_text(outlet[n].widest); },
          "wider ones arch again: delta falls with the stress");
  }
  if (input.outlet > 0) print_discharge(input, design);
  double most = input.diameter > 0 ? print_loads(input, design) : 0;
  for (const std::size_t n : {0u, 1u})
    if (design.is_mass_flow(n)) most = std::max(most, outlet[n].major);
  if (const continuum::MaterialRange& range = p.grains.range; most > range.max_pressure)
    print("\n  ! sigma_1 of {}: the values of {} hold up to {}\n", pressure_text(most), range.name,
          pressure_text(range.max_pressure));
  return ExitStatus::done;
}

}  // namespace

void add_hopper_design_command(CLI::App& app, Action& action) {
  auto words = std::make_shared<DesignWords>();
  CLI::App* command = app.add_subcommand(
      "hopper-design", "design a hopper for a material: half angles, critical outlets, discharge, loads");
  command->add_option("--material", words->material, "one that talus materials lists, or the file of another")
      ->required();
  command->add_option("--wall", words->wall, "steel, acrylic, glass, concrete, or the friction as a number or an angle")
      ->capture_default_str();
  command->add_option("--half-angle", words->half_angle, "of the hopper, from the vertical; 3 deg below the limit");
  command->add_option("--outlet", words->outlet, "diameter, or width of a slot, of which the discharge is told");
  command->add_option("--silo-diameter", words->diameter, "of a round silo, for ratholes and loads");
  command->add_option("--silo-height", words->height, "depth of its bed above the cone");
  command->add_option("--gravity", words->gravity, "acceleration")->capture_default_str();
  command->footer(
      "By formulas alone, each with its source and its limits; nothing is computed with particles, nothing written.\n"
      "Strengths and angles are those of a shear tester (talus shear-cell).");
  command->callback([words, &action] { action = [words] { return design_hopper(*words); }; });
}

}  // namespace talus::app

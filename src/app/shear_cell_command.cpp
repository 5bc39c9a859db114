// SPDX-License-Identifier: Apache-2.0
/// talus shear-cell: the tests of a powder laboratory, on one material point of a case's law.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/commands.hpp"
#include "app/law/law_case.hpp"
#include "app/law/shear_cell_results.hpp"
#include "base/text.hpp"
#include "base/unit.hpp"
#include "io/file_list.hpp"

namespace talus::app {

namespace {

struct ShearCellWords {
  CaseOptions case_options;
  std::string loads = "1 kPa,2 kPa,4 kPa,8 kPa", fractions = "0.2,0.35,0.5,0.65,0.8", rate = "0.003 1/s", out;
  bool overwrite = false;
};

void print_table(std::span<const granular::ShearTest> tests) {
  constexpr const char* words = "{:>10} {:>10} {:>9} {:>8} {:>9} {:>9} {:>9} {:>8} {:>12} {:>10}\n";
  print(words, "load", "density", "cohesion", "angle", "eff. ang.", "sigma_1", "f_c", "ff_c", "plane f_c", "cyl. f_c");
  print(words, "Pa", "kg/m3", "Pa", "deg", "deg", "Pa", "Pa", "", "Pa", "Pa");
  const auto strength = [](double value) { return std::isnan(value) ? "none" : fmt::format("{:.4g}", value); };
  for (const granular::ShearTest& test : tests) {
    const granular::YieldLocus& locus = test.locus;
    print("{:10.4g} {:10.5g} {:9.4g} {:8.2f} {:9.2f} {:9.4g} {:9.4g} {:8.3g} {:>12} {:>10}\n", test.pre_shear.normal,
          test.density, locus.cohesion, locus.angle * 180 / std::numbers::pi,
          locus.effective_angle * 180 / std::numbers::pi, locus.major, locus.strength, locus.flow_factor(),
          strength(test.strength_in_plane_strain), strength(test.strength_of_cylinder));
  }
}

/// Angles under the largest and the smallest load of each locus.
void print_wall(std::span<const granular::ShearTest> tests, const granular::CellWall& wall) {
  const auto degrees = [](const granular::YieldPoint& point) {
    return std::atan(point.shear / point.normal) * 180 / std::numbers::pi;
  };
  print("\nOn a wall of friction {:.4g} and adhesion {:.4g} Pa\n{:>10} {:>10} {:>10} {:>10}\n", wall.coefficient,
        wall.adhesion, "load", "wall ang.", "at", "wall ang.");
  print("{:>10} {:>10} {:>10} {:>10}\n", "Pa", "deg", "Pa", "deg");
  for (const granular::ShearTest& test : tests) {
    const granular::YieldPoint &most = test.on_wall.back(), &least = test.on_wall.front();
    print("{:10.4g} {:10.2f} {:10.4g} {:10.2f}\n", most.normal, degrees(most), least.normal, degrees(least));
  }
}

/// \throws InputError if the law leaves no yield locus
granular::ShearTest test_of(const granular::AnyLaw& law, const LawCase& parameters, double load,
                            std::span<const double> fractions, const granular::ShearCellOptions& options) {
  try {
    granular::ShearTest test = granular::shear_test(law, load, fractions, options);
    if (test.density <= parameters.grains.density) return test;
  } catch (const std::invalid_argument&) {
  }
  const double speed = std::visit([&](const auto& one) { return one.sound_speed(options.density); }, law);
  throw InputError(
      {{.where = fmt::format("--loads {:.4g} Pa", load),
        .what = fmt::format("the law {} leaves no yield locus", choice_name(parameters.law.name)),
        .allowed = fmt::format("a law with friction, and loads far below its modulus rho c^2: up to {:.2g} Pa",
                               0.05 * options.density * speed * speed)}});
}

ExitStatus run_tests(const ShearCellWords& words) {
  const LawCase parameters = read_law_case(words.case_options.read());
  std::vector<Problem> problems;
  constexpr double any = 1e12;
  const std::vector<double> loads = numbers_of("--loads", words.loads, dimension::pressure, any,
                                               "loads of pre-shear above 0, such as \"1 kPa,2 kPa\"", problems),
                            fractions =
                                numbers_of("--fractions", words.fractions, dimension::none, 1,
                                           "fractions of the load between 0 and 1, such as 0.2,0.5,0.8", problems),
                            rate = numbers_of("--rate", words.rate, {0, 0, -1, 0}, any, "a rate such as \"0.003 1/s\"",
                                              problems);
  if (!fractions.empty() && std::ranges::max(fractions) < 1.01 * std::ranges::min(fractions))
    problems.push_back(
        {.where = "--fractions " + words.fractions, .what = "is one load", .allowed = "at least two that differ"});
  if (rate.size() > 1)
    problems.push_back({.where = "--rate " + words.rate, .what = "are several", .allowed = "one rate"});
  if (!problems.empty()) throw InputError(problems);
  const std::filesystem::path folder =
      words.out.empty() ? std::filesystem::path("results") /
                              (std::filesystem::path(words.case_options.path).stem().string() + "-shear-cell")
                        : std::filesystem::path(words.out);
  const Existing existing = words.overwrite ? Existing::overwrite : Existing::refuse;
  check_output(folder, existing, "--overwrite");

  const granular::AnyLaw law = make_law(parameters.law, parameters.grains.density, parameters.grains.diameter);
  granular::ShearCellOptions options{.density = path_options(parameters, 1).density, .rate = rate[0]};
  if (parameters.walls.coefficient)
    options.wall = {.coefficient = *parameters.walls.coefficient, .adhesion = parameters.walls.adhesion};
  std::vector<granular::ShearTest> tests;
  for (const double load : loads) tests.push_back(test_of(law, parameters, load, fractions, options));

  begin_output(folder, existing, "--overwrite");
  write_shear_tables(tests, folder);
  claim_file(folder / "shear-cell.png");
  write_shear_figure(tests, folder / "shear-cell.png");
  print("Law {}\n", choice_name(parameters.law.name));
  print_table(tests);
  if (options.wall) print_wall(tests, *options.wall);
  if (const auto& range = parameters.grains.range; std::ranges::max(loads) > range.max_pressure)
    print("\n  ! a load of {:.4g} Pa: the values of {} hold up to a pressure of {:.4g} Pa\n", std::ranges::max(loads),
          range.name, range.max_pressure);
  print("{}: yield-loci.csv, {}flow-function.csv, triaxial.csv, shear-cell.png\n", folder.string(),
        options.wall ? "wall-yield-loci.csv, " : "");
  return ExitStatus::done;
}

}  // namespace

void add_shear_cell_command(CLI::App& app, Action& action) {
  auto words = std::make_shared<ShearCellWords>();
  CLI::App* command = app.add_subcommand(
      "shear-cell", "test the law of a case as a powder laboratory would: yield loci, flow function, triaxial tests");
  words->case_options.add_to(*command);
  command->add_option("--loads", words->loads, "normal stresses of pre-shear, each the consolidation of a yield locus")
      ->capture_default_str();
  command->add_option("--fractions", words->fractions, "of that stress, under which samples fail")
      ->capture_default_str();
  command->add_option("--rate", words->rate, "shear rate")->capture_default_str();
  add_out_option(*command, words->out, "folder of the results; results/CASE-shear-cell if not given");
  command->add_flag("--overwrite", words->overwrite, "replace what earlier tests left in the folder");
  command->footer(
      "CASE is as for talus law. Each sample is one material point, laid free of stress at path.packing.\n"
      "Shear tester: sheared under the load to steady state, then, under fractions of it, to failure; a straight line\n"
      "through these points gives cohesion, angle, f_c and sigma_1 as in ASTM D6773, and ff_c = sigma_1/f_c. Plane "
      "and\n"
      "cyl. f_c: the same sample out of the cell, compressed without lateral stress, in plane strain and as a "
      "cylinder;\n"
      "none: it shows no peak.\n"
      "With walls.coefficient, or walls.material and grains.material, also the wall yield locus: the wall's friction "
      "and\n"
      "walls.adhesion, or what the grains themselves bear if that is less.");
  command->callback([words, &action] { action = [words] { return run_tests(*words); }; });
}

}  // namespace talus::app

// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "app/commands.hpp"
#include "base/error.hpp"
#include "io/scratch_folder.hpp"
#include "io/series.hpp"

namespace talus::app {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

const char* const powder = R"([law]
name = "critical-state"
[law.critical-state]
static_friction = 0.5
dynamic_friction = 0.5
packing_slope = 0
ageing_strength = 0
tensile_strength = "100 Pa"
consolidation_strength = 0.2
cohesion_strain = 2
)";

class ShearCellCommand : public testing::Test {
 protected:
  std::string powder_case() const {
    std::ofstream(folder_ / "powder.toml") << powder;
    return (folder_ / "powder.toml").string();
  }
  std::string out() const { return (folder_ / "out").string(); }

  /// What it prints.
  static std::string run(std::vector<std::string> arguments) {
    CLI::App app;
    Action action;
    add_shear_cell_command(app, action);
    arguments.insert(arguments.begin(), "shear-cell");
    std::reverse(arguments.begin(), arguments.end());
    app.parse(arguments);
    testing::internal::CaptureStdout();
    try {
      EXPECT_EQ(action(), ExitStatus::done);
    } catch (...) {
      testing::internal::GetCapturedStdout();
      throw;
    }
    return testing::internal::GetCapturedStdout();
  }
  static std::vector<std::string> problems(const std::vector<std::string>& arguments) {
    std::vector<std::string> lines;
    try {
      run(arguments);
    } catch (const InputError& error) {
      for (const Problem& problem : error.problems()) lines.push_back(to_string(problem));
    }
    return lines;
  }

  ScratchFolder folder_;
};

TEST_F(ShearCellCommand, WritesWhatItMeasuresAndDrawsIt) {
  const std::string said = run({powder_case(), "--loads", "1 kPa,4 kPa", "--fractions", "0.2,0.5,0.8", "--out", out()});
  const Series flow = read_series(folder_ / "out" / "flow-function.csv");
  ASSERT_EQ(flow.rows(), 2u);
  const double strength[] = {100 + 0.2 * 1000, 100 + 0.2 * 4000};
  for (std::size_t n = 0; n < 2; ++n) {
    EXPECT_NEAR(flow.column("cohesion")[n], 0.5 * strength[n], 0.005 * strength[n]);
    EXPECT_NEAR(std::tan(flow.column("friction_angle")[n]), 0.5, 0.005);
    EXPECT_NEAR(flow.column("strength_in_plane_strain")[n], 2 * strength[n], 0.02 * strength[n]);
  }
  const Series loci = read_series(folder_ / "out" / "yield-loci.csv");
  EXPECT_THAT(loci.column("normal_stress"), ElementsAre(200, 500, 800, 800, 2000, 3200));
  EXPECT_EQ(read_series(folder_ / "out" / "triaxial.csv").rows(), 6u);
  EXPECT_GT(std::filesystem::file_size(folder_ / "out" / "shear-cell.png"), 10000u);
  EXPECT_THAT(said, HasSubstr("ff_c"));
  EXPECT_THAT(said, HasSubstr("flow-function.csv"));
  // A folder that is there is not replaced without being asked for.
  EXPECT_FALSE(problems({powder_case(), "--out", out()}).empty());
}

TEST_F(ShearCellCommand, WithAWallMeasuresItsYieldLocus) {
  const std::string said = run({powder_case(), "--loads", "1 kPa", "--fractions", "0.2,0.5", "--set",
                                "walls.coefficient=0.3", "--set", "walls.adhesion=40 Pa", "--out", out()});
  const Series wall = read_series(folder_ / "out" / "wall-yield-loci.csv");
  EXPECT_THAT(wall.column("normal_stress"), ElementsAre(200, 500, 1000));
  EXPECT_THAT(wall.column("shear_stress"), ElementsAre(100, 190, 340));
  EXPECT_THAT(said, HasSubstr("wall-yield-loci.csv"));
  EXPECT_THAT(said, HasSubstr("26.57")) << "atan(100/200)";
}

TEST_F(ShearCellCommand, TakesTheWallOfAMaterial) {
  std::ofstream(folder_ / "wheat.toml") << R"([law]
name = "critical-state"
[grains]
material = "wheat"
[walls]
material = "steel"
)";
  const std::string said =
      run({(folder_ / "wheat.toml").string(), "--loads", "1 kPa", "--fractions", "0.2,0.5", "--out", out()});
  EXPECT_THAT(said, HasSubstr("On a wall of friction"));
  EXPECT_THAT(problems({(folder_ / "wheat.toml").string(), "--set", "walls.material=glass", "--out", out()}),
              ElementsAre(HasSubstr("no friction of wheat on glass is known")));
  EXPECT_THAT(problems({powder_case(), "--set", "walls.material=steel", "--out", out()}),
              Contains(HasSubstr("walls.material: no friction follows from it")));
}

TEST_F(ShearCellCommand, NamesEveryProblem) {
  EXPECT_THAT(problems({powder_case(), "--loads", "1 kPa,3,-2 Pa", "--fractions", "0.5", "--rate", "1 m"}),
              ElementsAre(HasSubstr("\"3\" has no unit; allowed: loads of pre-shear above 0"),
                          HasSubstr("\"-2 Pa\" is out of range"), HasSubstr("--rate 1 m: \"1 m\" has another unit"),
                          HasSubstr("--fractions 0.5: is one load; allowed: at least two")));
  EXPECT_THAT(problems({powder_case(), "--fractions", "0.5,0.5"}),
              ElementsAre(HasSubstr("--fractions 0.5,0.5: is one load; allowed: at least two that differ")));
  EXPECT_THAT(problems({powder_case(), "--loads", "1 GPa", "--fractions", "0.2,0.5", "--out", out()}),
              ElementsAre(HasSubstr("--loads 1e+09 Pa: the law critical-state leaves no yield locus; allowed: a law "
                                    "with friction, and loads far below its modulus rho c^2: up to 4.4e+05 Pa")));
  EXPECT_THAT(problems({powder_case(), "--set", "law.critical-state.tensile_strength=3"}),
              ElementsAre(HasSubstr("tensile_strength")));
  EXPECT_THAT(problems({powder_case(), "--set", "law.critical-state.tensile_strength=1 MPa"}),
              ElementsAre(HasSubstr("at most 0.1 bulk_modulus")));
}

TEST_F(ShearCellCommand, RefusesFilesWithoutALaw) {
  std::ofstream(folder_ / "empty.toml") << "";
  std::ofstream(folder_ / "cloud.toml") << "model = \"cloud\"\n";
  const auto of = [&](const char* name) { return problems({(folder_ / name).string(), "--out", out()}); };
  EXPECT_THAT(of("empty.toml"), ElementsAre(HasSubstr("empty.toml: holds no law; allowed: a case of the model")));
  EXPECT_THAT(of("cloud.toml"), ElementsAre(HasSubstr("cloud.toml:1: model: cloud has no law of grains")));
}

TEST_F(ShearCellCommand, NamesTheLawAndWarnsBeyondTheRangeOfTheMaterial) {
  std::ofstream(folder_ / "pharma.toml") << "[grains]\nmaterial = \"pharma-powder\"\n";
  const auto said = [&](const char* load) {
    return run({(folder_ / "pharma.toml").string(), "--loads", load, "--fractions", "0.2,0.5", "--out",
                (folder_ / load).string()});
  };
  EXPECT_THAT(said("1 kPa"), HasSubstr("Law critical-state"));
  EXPECT_THAT(said("2 kPa"), HasSubstr("a load of 2000 Pa: the values of pharma-powder hold up to a pressure of 700"));
  EXPECT_THAT(said("0.5 kPa"), Not(HasSubstr("hold up to")));
}

TEST_F(ShearCellCommand, APackingBesideTheLawsOwnNamesItsKey) {
  try {
    run({powder_case(), "--set", "path.packing=0.58", "--loads", "1 Pa", "--out", out()});
    FAIL() << "the grains do not touch";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), HasSubstr("path.packing left out, so that the grains just touch"));
  }
}

TEST_F(ShearCellCommand, WithoutAPeakThereIsNoStrength) {
  // A sample that its own compression strengthens without end.
  const std::string said = run(
      {powder_case(), "--loads", "1 kPa", "--fractions", "0.2,0.5", "--set", "law.critical-state.cohesion_strain=0.1",
       "--set", "law.critical-state.consolidation_strength=0.8", "--set", "law.critical-state.static_friction=0.6",
       "--set", "law.critical-state.dynamic_friction=0.6", "--out", out()});
  EXPECT_THAT(said, HasSubstr("        none"));
  EXPECT_TRUE(std::isnan(read_series(folder_ / "out" / "flow-function.csv").column("strength_in_plane_strain")[0]));
}

}  // namespace
}  // namespace talus::app

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
#include "app/law/law_case.hpp"
#include "base/error.hpp"
#include "io/scratch_folder.hpp"
#include "io/series.hpp"

namespace talus::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class LawCommand : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  std::string out() const { return (folder_ / "out").string(); }

  static ExitStatus run(std::vector<std::string> arguments) {
    CLI::App app;
    Action action;
    add_law_command(app, action);
    arguments.insert(arguments.begin(), "law");
    std::reverse(arguments.begin(), arguments.end());
    app.parse(arguments);
    testing::internal::CaptureStdout();
    ExitStatus status = ExitStatus::numerical;
    try {
      status = action();
    } catch (...) {
      testing::internal::GetCapturedStdout();
      throw;
    }
    testing::internal::GetCapturedStdout();
    return status;
  }

  /// What an InputError says, line by line, without the folder's name.
  std::vector<std::string> problems(const std::vector<std::string>& arguments) const {
    std::vector<std::string> lines;
    try {
      run(arguments);
    } catch (const InputError& error) {
      for (const Problem& problem : error.problems()) {
        std::string line = to_string(problem);
        if (line.starts_with(folder_.path().string())) line.erase(0, folder_.path().string().size() + 1);
        lines.push_back(line);
      }
    }
    return lines;
  }

  ScratchFolder folder_;
};

const char* const elastic = R"([law]
name = "linear-elastic"
[law.linear-elastic]
lambda = "2 MPa"
shear_modulus = "1 MPa"
[collisions]
form = "printed"
)";

TEST_F(LawCommand, TableHoldsHookesAnswer) {
  const std::string path =
      file("path.csv", "duration [ms],gradient_zz [1/s],gradient_xz [1/s]\n500,-2e-4,0\n1000,0,3e-4\n");
  ASSERT_EQ(run({file("case.toml", elastic), "--path", path, "--out", out(), "--set", "path.points=4"}),
            ExitStatus::done);
  const Series table = read_series(folder_ / "out" / "path.csv");
  ASSERT_EQ(table.rows(), 9u);
  EXPECT_EQ(table.column("time").back(), 1.5);
  EXPECT_EQ(table.column("stretch")[4], 1);
  EXPECT_EQ(table.column("stretch")[5], 2);
  EXPECT_NEAR(table.column("stress_zz")[4], 4e6 * 1e-4, 0.1);
  EXPECT_NEAR(table.column("stress_xx")[4], 2e6 * 1e-4, 0.1);
  EXPECT_NEAR(table.column("stress_zx")[8], -1e6 * 3e-4, 0.1);
  EXPECT_NEAR(table.column("strain_zz")[4], 1e-4, 2e-8);
  EXPECT_NEAR(table.column("packing")[4], 0.6 * std::exp(1e-4), 1e-12);
  // Eq. 13 with tau = (4 + 2 + 2)/3 x 100 Pa and -du_z/dz = 2e-4/s; Eq. 14 in the second stretch.
  EXPECT_NEAR(table.column("collision_stress_zz")[4], 1.67 * std::sqrt(2e-4 / 9.81) * 2e-4 * 800 / 3, 1e-8);
  EXPECT_EQ(table.column("collision_stress_zz")[8], 0);
  EXPECT_TRUE(std::isnan(table.column("friction")[0]));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / "functions.csv"));
}

TEST_F(LawCommand, PrescribesStressesInPlaceOfRates) {
  // Hooke, sides held: M = lambda + 2 G = 4 MPa.
  const std::string law = file("case.toml", elastic);
  const std::string path = file("path.csv", "duration [s],stress_zz [kPa],gradient_xz [1/s]\n1,0.4,0\n1,0.4,1e-4\n");
  ASSERT_EQ(run({law, "--path", path, "--out", out(), "--set", "path.points=4"}), ExitStatus::done);
  const Series table = read_series(folder_ / "out" / "path.csv");
  EXPECT_NEAR(table.column("stress_zz")[2], 200, 1e-3);
  EXPECT_NEAR(table.column("stress_zz")[4], 400, 1e-3);
  EXPECT_NEAR(table.column("strain_zz")[4], 1e-4, 2e-8);
  EXPECT_NEAR(table.column("stress_zz")[8], 400, 1e-3);
  EXPECT_NEAR(std::abs(table.column("stress_zx")[8]), 1e6 * 1e-4, 0.1);
  EXPECT_THAT(problems({law, "--path", file("both.csv", "duration,stress_xx,gradient_xx,stress_yy\n1,1,1,1\n")}),
              ElementsAre("both.csv:1: gradient_xx: follows from stress_xx; allowed: one of the two columns"));
}

TEST_F(LawCommand, FollowsThePathsOfTheRepository) {
  const std::filesystem::path cases = std::filesystem::path(TALUS_SOURCE_DIR) / "cases" / "law";
  for (const char* path : {"shear.csv", "uniaxial.csv"})
    for (const char* name : {"yuu-umekage", "yuu-umekage-printed", "drucker-prager", "critical-state"}) {
      const std::string law = file("case.toml", "[law]\nname = \"" + std::string(name) + "\"\n");
      ASSERT_EQ(run({name == std::string("yuu-umekage") ? (cases / "yuu2011.toml").string() : law, "--path",
                     (cases / path).string(), "--out", out(), "--overwrite"}),
                ExitStatus::done);
      const Series table = read_series(folder_ / "out" / "path.csv");
      EXPECT_GE(table.rows(), 600u);
      for (const double pressure : table.column("pressure")) EXPECT_GE(pressure, 0);
      // The fitted functions of those laws that have them.
      EXPECT_EQ(std::filesystem::exists(folder_ / "out" / "functions.csv"), name != std::string("critical-state"));
    }
}

TEST_F(LawCommand, TakesTheLawOutOfAWholeCaseAndNothingElse) {
  const LawCase part =
      read_law_case(CaseFile::from_text("model = \"continuum\"\n[bed]\nheight = \"80 mm\"\n"
                                        "[grains]\ndensity = \"2600 kg/m3\"\nshape = \"round\"\n"
                                        "[law]\nname = \"drucker-prager\"\n[law.drucker-prager]\nscale = 4\n",
                                        "case.toml"));
  EXPECT_TRUE(part.law.is<granular::DruckerPrager>());
  EXPECT_EQ(part.law.of<granular::DruckerPrager>().fits.scale, 4);
  EXPECT_EQ(part.grains.density, 2600);
  EXPECT_THAT(
      problems({file("case.toml", "model = \"continuum\"\n[law.yuu-umekage]\nscael = 4\n"), "--path", "none.csv"}),
      ElementsAre("case.toml:3: law.yuu-umekage.scael: unknown key; did you mean 'law.yuu-umekage.scale'?"));
}

TEST_F(LawCommand, NamesEveryProblemOfTheCase) {
  const std::string text = "[bed]\nheight = 3\n[law]\nname = \"yuu\"\n[law.critical-state]\nstatic_friction = -1\n";
  EXPECT_THAT(problems({file("case.toml", text), "--path", "none.csv", "--set", "law.critical-state.dilatancy=-1"}),
              ElementsAre(HasSubstr("case.toml:1: bed: unknown table"), HasSubstr("case.toml:4: law.name: "),
                          HasSubstr("case.toml:6: law.critical-state.static_friction: "), HasSubstr("--set")));
}

TEST_F(LawCommand, AnOldKeyOfThePathNamesTheNewOne) {
  const std::string path = file("path.csv", "duration [s],gradient_xx [1/s]\n1,1e-3\n");
  const std::string old = file("old.toml", "[law]\nname = \"linear-elastic\"\n[path]\nlargest_increment = 1e-6\n");
  EXPECT_THAT(
      problems({old, "--path", path, "--out", out()}),
      testing::Contains(HasSubstr("path.largest_increment: has another name now; allowed: path.max_increment")));
}

TEST_F(LawCommand, NamesEveryBadLineOfThePath) {
  const std::string law = file("case.toml", elastic);
  EXPECT_THAT(problems({law, "--path", file("a.csv", "gradient_zx [s],gradient_zy,gradeint_zz\n1,2,3\n")}),
              ElementsAre(HasSubstr("a.csv:1: gradient_zx: 's' is no unit of"),
                          AllOf(HasSubstr("a.csv:1: gradeint_zz: unknown column; allowed: duration, gradient_xx"),
                                HasSubstr("did you mean 'gradient_zz'?")),
                          "a.csv:1: duration: missing column"));
  EXPECT_THAT(problems({law, "--path", file("b.csv", "duration,gradient_zz\n1,x\n-1,2\n")}),
              ElementsAre("b.csv:2: gradient_zz: 'x' is not a number"));
  EXPECT_THAT(problems({law, "--path", file("c.csv", "duration,gradient_zz\n1,1\n-1,2\n")}),
              ElementsAre(HasSubstr("c.csv:3: duration: -1 s is negative")));
  EXPECT_THAT(problems({law, "--path", file("d.csv", "duration,gradient_zz\n")}),
              ElementsAre(HasSubstr("d.csv: holds no stretch")));
  EXPECT_THROW(run({law, "--path", (folder_ / "none.csv").string()}), FileError);
}

TEST_F(LawCommand, RefusesFoldersThatAreNotEmptyAndPathsWithoutEnd) {
  const std::string law = file("case.toml", elastic), path = file("a.csv", "duration,gradient_zz\n1,-1e-4\n");
  ASSERT_EQ(run({law, "--path", path, "--out", out()}), ExitStatus::done);
  EXPECT_THAT(problems({law, "--path", path, "--out", out()}), ElementsAre(HasSubstr("is not empty")));
  EXPECT_EQ(run({law, "--path", path, "--out", out(), "--overwrite"}), ExitStatus::done);
  EXPECT_THAT(problems({law, "--path", file("b.csv", "duration,gradient_zz\n1,-1e4\n")}),
              ElementsAre(HasSubstr("takes 1e+10 steps")));
}

TEST_F(LawCommand, FailsWhereTheNumbersEnd) {
  const std::string path = file("a.csv", "duration,gradient_zz\n1,-0.4\n");
  const std::string law = file("case.toml", std::string(elastic) + "[path]\nmax_increment = 1e-3\n");
  EXPECT_EQ(run({law, "--path", path, "--out", out()}), ExitStatus::done);
  EXPECT_THROW(run({law, "--path", file("b.csv", "duration,gradient_zz\n1,-900\n"), "--out", out(), "--overwrite"}),
               NumericalError);
}

}  // namespace
}  // namespace talus::app

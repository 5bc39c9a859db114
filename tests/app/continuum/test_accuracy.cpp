// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/accuracy.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>

#include "app/models/models.hpp"
#include "base/error.hpp"
#include "io/parameter_writer.hpp"

namespace talus::app {
namespace {

/// A silo of 65 mm on a cone of 30 degrees with an outlet of 30 mm, 30 mm above where grains are taken away.
CaseFile silo(const std::string& gate = "") {
  return CaseFile::from_text(R"(model = "continuum"
accuracy = "design"
[box]
width = "100 mm"
depth = "100 mm"
height = "170 mm"
floor = "open"
[removal]
below = "30 mm"
[[vessel]]
shape = "cylinder"
radius = "32.5 mm"
bottom = "90.3 mm"
top = "160 mm"
[[vessel]]
shape = "cone"
lower_radius = "15 mm"
upper_radius = "32.5 mm"
bottom = "60 mm"
top = "90.3 mm"
[[vessel]]
shape = "disc"
radius = "15 mm"
height = "60 mm"
gate = true
)" + gate + R"(
[bed]
height = "80 mm"
[run]
end = "1 s"
)",
                             "case.toml");
}

CaseFile with(CaseFile file, std::initializer_list<const char*> settings) {
  for (const char* const setting : settings) file.set(setting);
  return file;
}

/// The value of a key in SI, and what it follows from.
std::pair<std::string, std::string> of(const CaseFile& file, const std::string& key) {
  const PreparedCase prepared = prepare_case(file);
  for (const ResolvedLine& line : resolved_table(prepared.parameters, file)) {
    if (line.key != key) continue;
    const auto followed = prepared.filled_in.find(key);
    return {line.value, followed != prepared.filled_in.end() ? followed->second : line.origin};
  }
  return {};
}

using Found = std::pair<std::string, std::string>;

TEST(Accuracy, OfADesignSetsSpacingPrecisionAndSector) {
  EXPECT_EQ(of(silo(), "bed.spacing"), Found("0.0025", "accuracy"));
  EXPECT_EQ(of(silo(), "integration.pair_precision"), Found("single", "accuracy"));
  EXPECT_EQ(of(silo(), "box.sector"), Found("20", "accuracy"));
}

TEST(Accuracy, IsParticlesAcrossTheOutlet) {
  EXPECT_EQ(of(with(silo(), {"accuracy=draft"}), "bed.spacing"), Found("0.00375", "accuracy"));
  EXPECT_EQ(of(with(silo(), {"accuracy=reference"}), "bed.spacing"), Found("0.0015", "accuracy"));
}

TEST(Accuracy, OfAReferenceIsWholeInDoublePrecision) {
  const CaseFile file = with(silo(), {"accuracy=reference"});
  EXPECT_EQ(of(file, "integration.pair_precision"), Found("double", "default"));
  EXPECT_NE(of(file, "box.sector").second, "accuracy");
}

TEST(Accuracy, IsTheStiffnessOverTheWeight) {
  const auto modulus = [](const char* accuracy) {
    return std::stod(of(with(silo(), {accuracy, "removal.below=59 mm"}), "law.critical-state.bulk_modulus").first);
  };
  const double reference = modulus("accuracy=reference");
  EXPECT_NEAR(modulus("accuracy=design"), reference / 4, 0.02 * reference) << "the bed is a whole number of layers";
  EXPECT_NEAR(modulus("accuracy=draft"), reference / 16, 0.01 * reference);
}

TEST(Accuracy, AndEveryOtherCaseHasAViscosityThatFollowsTheOutletOnceItFlows) {
  const CaseFile file = with(silo(), {"accuracy=reference", "gate.opens=when-settled"});
  EXPECT_EQ(of(file, "sph.viscosity_alpha").second, "bed");
  EXPECT_LT(std::stod(of(file, "sph.viscosity_alpha").first), 0.1);
  EXPECT_EQ(of(file, "settle.viscosity_alpha"), Found("0.1", "bed"));
  EXPECT_EQ(of(with(file, {"sph.viscosity_alpha=0.05"}), "settle.viscosity_alpha").second, "default");
  EXPECT_EQ(of(with(file, {"settle.viscosity_alpha=0.3"}), "settle.viscosity_alpha"), Found("0.3", "option"));
}

TEST(Accuracy, TakesCoarserParticlesWhereTheBedIsWideEnough) {
  EXPECT_EQ(of(silo(), "levels.count"), Found("0", "default"));
  EXPECT_EQ(of(with(silo(), {"bed.spacing=2 mm"}), "levels.count"), Found("1", "accuracy"));
  EXPECT_EQ(of(with(silo(), {"bed.spacing=1 mm"}), "levels.count"), Found("1", "accuracy"));
  EXPECT_EQ(of(with(silo(), {"bed.spacing=1 mm", "accuracy=draft"}), "levels.count"), Found("2", "accuracy"));
  EXPECT_EQ(of(with(silo(), {"bed.spacing=2 mm", "accuracy=draft"}), "levels.count"), Found("1", "accuracy"));
  EXPECT_EQ(of(with(silo(), {"bed.spacing=1 mm", "levels.count=0"}), "levels.count"), Found("0", "option"));
  EXPECT_EQ(of(with(silo(), {"bed.spacing=1 mm", "accuracy=reference"}), "levels.count"), Found("0", "default"));
  const CaseFile half = with(silo(), {"box.depth=50 mm", "box.front=symmetry", "vessel.1.centre=['50 mm', '0 mm']",
                                      "vessel.2.centre=['50 mm', '0 mm']", "vessel.3.centre=['50 mm', '0 mm']"});
  EXPECT_EQ(of(with(half, {"bed.spacing=1.9 mm"}), "levels.count"), Found("1", "accuracy"));
}

TEST(Accuracy, LeavesTheKeysOfTheCase) {
  const CaseFile file = with(silo(), {"bed.spacing=3 mm", "integration.pair_precision=double", "box.sector=60 deg",
                                      "law.critical-state.bulk_modulus=1 MPa"});
  for (const auto& [key, value] : std::map<std::string, std::string>{{"bed.spacing", "0.003"},
                                                                     {"integration.pair_precision", "double"},
                                                                     {"box.sector", "60"},
                                                                     {"law.critical-state.bulk_modulus", "1000000"}})
    EXPECT_EQ(of(file, key), Found(value, "option"));
}

TEST(Accuracy, TakesNoSectorOfWhatIsNotAxisymmetric) {
  EXPECT_NE(of(silo(R"(centre = ["51 mm", "50 mm"])"), "box.sector").second, "accuracy");
}

TEST(Accuracy, WithoutItNothingIsSet) {
  const CaseFile file = CaseFile::from_text("model = \"continuum\"\n[box]\nwidth = \"1 m\"\n", "case.toml");
  const CaseFile same = with_accuracy(
      file, [](const CaseFile&) -> std::shared_ptr<const continuum::Setup> { throw std::logic_error("not read"); });
  EXPECT_EQ(same.entries().size(), file.entries().size());
}

TEST(Accuracy, OfACaseWithoutOutletLacksTheSpacing) {
  const CaseFile file = CaseFile::from_text(
      "model = \"continuum\"\naccuracy = \"draft\"\n[box]\nwidth = \"0.1 m\"\ndepth = \"0.1 m\"\nheight = \"0.1 m\"\n"
      "[bed]\nheight = \"50 mm\"\n[run]\nend = \"1 s\"\n",
      "case.toml");
  try {
    prepare_case(file);
    FAIL();
  } catch (const InputError& error) {
    ASSERT_EQ(error.problems().size(), 1u);
    EXPECT_EQ(error.problems()[0].key, "bed.spacing");
    EXPECT_EQ(error.problems()[0].what, "missing, and accuracy sets it by an outlet, which this case lacks");
  }
}

}  // namespace
}  // namespace talus::app

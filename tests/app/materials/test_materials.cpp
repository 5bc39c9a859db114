// SPDX-License-Identifier: Apache-2.0
#include "app/materials/materials.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "physics/granular/material_path.hpp"

namespace talus::app {
namespace {

using continuum::GrainMaterial;
using continuum::Parameters;

constexpr std::size_t count = choices<GrainMaterial>.size();

CaseFile a_case(const std::string& text) {
  return CaseFile::from_text("model = \"continuum\"\n" + text, "case.toml");
}

TEST(Materials, EveryNameHasAFileAndEveryFileAName) {
  std::set<std::string> names, files;
  for (const std::string_view name : choices<GrainMaterial>) names.insert(std::string(name));
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(TALUS_SOURCE_DIR) / "materials"))
    files.insert(entry.path().stem());
  EXPECT_EQ(names, files);
}

TEST(Materials, EveryValueHasASourceAndLiesInItsRange) {
  for (std::size_t n = 0; n < count; ++n) {
    const auto material = static_cast<GrainMaterial>(n);
    EXPECT_FALSE(title_of(material).empty());
    std::set<std::string> keys;
    for (const MaterialLine& line : lines_of(material)) {
      keys.insert(line.key);
      EXPECT_TRUE(line.key == "law.name" || !line.source.empty()) << line.key;
      if (line.value.empty() || line.range.empty()) continue;
      const std::string middle = " to ";
      const auto at = line.range.find(middle);
      ASSERT_NE(at, std::string::npos) << line.range;
      const double value = parse_quantity(line.value)->value, low = parse_quantity(line.range.substr(0, at))->value;
      const double high = parse_quantity(line.range.substr(at + middle.size()))->value;
      EXPECT_LE(low, value) << line.key;
      EXPECT_LE(value, high) << line.key;
    }
    EXPECT_THAT(keys, testing::IsSupersetOf({"grains.density", "grains.diameter", "bed.packing", "pressure",
                                             "law.critical-state.static_friction", "walls.steel", "walls.concrete"}));
  }
}

TEST(Materials, EveryFrictionIsThatOfTheTestThatItsFileNames) {
  for (std::size_t n = 0; n < count; ++n)
    for (const MaterialLine& line : lines_of(static_cast<GrainMaterial>(n))) {
      if (line.key != "law.critical-state.static_friction" && line.key != "law.critical-state.dynamic_friction")
        continue;
      std::size_t test = 0;
      while (test < choices<granular::FrictionTest>.size() && choices<granular::FrictionTest>[test] != line.test)
        ++test;
      ASSERT_LT(test, choices<granular::FrictionTest>.size()) << line.key << ": no test \"" << line.test << '"';
      EXPECT_TRUE(!line.angle.empty() || line.key.ends_with("dynamic_friction"));
      if (line.angle.empty()) continue;
      EXPECT_NEAR(
          granular::angle_of_friction(static_cast<granular::FrictionTest>(test), parse_quantity(line.value)->value),
          parse_quantity(line.angle)->value, 5e-4)
          << choices<GrainMaterial>[n];
    }
}

TEST(Materials, AFrictionIsThreeAngles) {
  EXPECT_EQ(angles_of_friction(0.577),
            "30.0 degrees on the plane of a shear tester, 35.2 in plane strain, 25.4 in triaxial compression");
}

TEST(Materials, EveryEntryOfAFileIsTaken) {
  for (std::size_t n = 0; n < count; ++n) {
    const auto material = static_cast<GrainMaterial>(n);
    Parameters p;
    const auto filled =
        fill_in_material(a_case("[grains]\nmaterial = \"" + std::string(choices<GrainMaterial>[n]) + "\"\n"), p);
    EXPECT_TRUE(filled.problems.empty());
    for (const MaterialLine& line : lines_of(material)) {
      if (line.key == "pressure" || line.key.starts_with("walls.") || line.key.starts_with("en1991.")) continue;
      if (line.key == "lateral_pressure_ratio") continue;  // of the shear modulus, which takes it (below)
      EXPECT_TRUE(filled.keys.contains(line.key)) << "no key of a case: " << line.key;
    }
    EXPECT_GT(p.grains.range.min_diameter, 0);
    EXPECT_LE(p.grains.range.min_diameter, p.grains.diameter);
    EXPECT_GE(p.grains.range.max_diameter, p.grains.diameter);
    EXPECT_LT(p.grains.range.max_pressure, 1e6);
  }
}

TEST(Materials, TheCodesValuesAreThoseOfItsTable) {
  const auto wheat = solid_of_code(GrainMaterial::wheat);
  ASSERT_TRUE(wheat);
  EXPECT_NEAR(wheat->repose * 180 / 3.14159265358979, 34, 1e-9);
  EXPECT_NEAR(wheat->internal * 180 / 3.14159265358979, 30, 1e-9);
  EXPECT_EQ(wheat->internal_factor, 1.12);
  EXPECT_EQ(wheat->ratio, 0.54);
  EXPECT_EQ(wheat->ratio_factor, 1.11);
  EXPECT_EQ(wheat->friction_factor, 1.16);
  EXPECT_EQ(wheat->patch, 0.5);
  EXPECT_EQ(solid_of_code(GrainMaterial::maize)->patch, 0.9);
  EXPECT_EQ(solid_of_code(GrainMaterial::sand)->ratio, 0.45);
  EXPECT_EQ(solid_of_code(GrainMaterial::cement)->ratio_factor, 1.20);
  EXPECT_FALSE(solid_of_code(GrainMaterial::glass_beads)) << "the code does not list them";
}

TEST(Materials, WallsRubAsTheirMaterialSays) {
  Parameters p;
  p.vessel.resize(3);
  const CaseFile file = a_case(
      "[grains]\nmaterial = \"sand\"\n[walls]\nmaterial = \"steel\"\n"
      "[[vessel]]\nmaterial = \"concrete\"\n[[vessel]]\nmaterial = \"acrylic\"\nfriction = 0.1\n"
      "[[vessel]]\nmaterial = \"glass\"\n");
  const FilledIn filled = fill_in_material(file, p);
  EXPECT_EQ(p.walls.coefficient, 0.48);
  EXPECT_EQ(p.vessel[0].friction, 0.57);
  EXPECT_FALSE(p.vessel[1].friction) << "what the case gives is the reader's";
  ASSERT_EQ(filled.problems.size(), 1u);
  EXPECT_EQ(filled.problems[0].key, "vessel.3.material");
  EXPECT_THAT(filled.problems[0].what, testing::HasSubstr("no friction of sand on glass is known"));
  EXPECT_THAT(filled.problems[0].allowed, testing::HasSubstr("steel, acrylic, concrete"));
}

Parameters in_a_box() {
  Parameters p;
  p.box.width = p.box.depth = 1, p.box.height = 3, p.bed.spacing = 0.1, p.bed.height = 1;
  return p;
}

TEST(Materials, TheStiffnessFollowsFromTheBedsWeight) {
  const CaseFile file = a_case("[grains]\nmaterial = \"wheat\"\n");
  Parameters p = in_a_box();
  p.grains.material = GrainMaterial::wheat;
  FilledIn filled = fill_in_material(file, p);
  p.bed.height = 2;
  p.gravity.acceleration = 10;
  set_from_bed(file, continuum::Layout(p), 1, p, filled);
  const auto& law = p.law.of<granular::CriticalState>();
  EXPECT_NEAR(law.bulk_modulus, 1000 * 0.6 * 1350 * 10 * 2, 1e-3);
  const double ratio = 0.5, shear = 1.5 * (1 - ratio) / (1 + 2 * ratio);
  EXPECT_NEAR(law.shear_modulus, shear * law.bulk_modulus, 1e-3);
  const CaseFile given = a_case("[grains]\nmaterial = \"wheat\"\n[law.critical-state]\nbulk_modulus = \"1 MPa\"\n");
  p.law.of<granular::CriticalState>().bulk_modulus = 1e6;
  set_from_bed(given, continuum::Layout(p), 1, p, filled);
  EXPECT_EQ(law.bulk_modulus, 1e6);
  EXPECT_NEAR(law.shear_modulus, shear * 1e6, 1e-6);
}

TEST(Materials, ABedAtRestHasTheLateralPressureRatioOfItsAngle) {
  for (const GrainMaterial material : {GrainMaterial::wheat, GrainMaterial::maize, GrainMaterial::sand,
                                       GrainMaterial::cement, GrainMaterial::soybean}) {
    granular::CriticalState::Parameters law;
    law.bulk_modulus = 1e7, law.shear_modulus = shear_over_bulk(material) * law.bulk_modulus;
    law.static_friction = 0.57;
    const auto solid = solid_of_code(material);
    const double ratio = solid ? 1 - std::sin(solid->internal) : 0.54;
    const std::vector<granular::PathStretch> path = {{1, {.zz = -1e-3}}};
    const auto stress = granular::follow_path(granular::make_law(law, 1350), path,
                                              {.density = 0.6 * 1350, .max_increment = 1e-5, .points = 1})
                            .back()
                            .stress;
    EXPECT_NEAR(stress.xx / stress.zz, ratio, 1e-3) << choices<GrainMaterial>[static_cast<std::size_t>(material)];
  }
  EXPECT_EQ(shear_over_bulk({}), 0.6);
  EXPECT_EQ(shear_over_bulk(GrainMaterial::glass_beads), 0.6) << "the code does not list them";
}

TEST(Materials, TheStiffnessFollowsWithoutAMaterialToo) {
  const CaseFile file = a_case("[grains]\ndensity = \"2000 kg/m3\"\n");
  const auto taken = [&](double packing, double gravity) {
    Parameters p = in_a_box();
    p.grains.density = 2000;
    p.bed.height = 2, p.bed.packing = packing, p.gravity.acceleration = gravity;
    FilledIn filled;
    set_from_bed(file, continuum::Layout(p), 1, p, filled);
    return std::pair{p.law.of<granular::CriticalState>(), filled.keys};
  };
  const auto [law, keys] = taken(0.58, 10);
  EXPECT_NEAR(law.bulk_modulus, 1000 * 0.58 * 2000 * 10 * 2, 1e-3);
  EXPECT_NEAR(law.shear_modulus, 0.6 * law.bulk_modulus, 1e-3);
  EXPECT_EQ(law.reference_packing, 0.58);
  EXPECT_EQ(keys.at("law.critical-state.bulk_modulus"), "bed");
  const auto [loose, of_loose] = taken(0.3, 10);
  EXPECT_EQ(loose.reference_packing, 0.6) << "they do not touch";
  EXPECT_FALSE(of_loose.contains("law.critical-state.reference_packing"));
  EXPECT_EQ(taken(0.6, 0).first.bulk_modulus, granular::CriticalState::Parameters{}.bulk_modulus) << "no weight";
}

TEST(Materials, TheBedBearsNoPressureBeforeItsWeight) {
  const CaseFile file = a_case("[grains]\nmaterial = \"maize\"\n[bed]\npacking = 0.64\n");
  Parameters p = in_a_box();
  p.grains.material = GrainMaterial::maize;
  FilledIn filled = fill_in_material(file, p);
  p.bed.packing = 0.64;
  set_from_bed(file, continuum::Layout(p), 1, p, filled);
  const auto& law = p.law.of<granular::CriticalState>();
  EXPECT_EQ(law.reference_packing, 0.64);
  const CaseFile given = a_case("[grains]\nmaterial = \"maize\"\n[law.critical-state]\nreference_packing = 0.6\n");
  p.law.of<granular::CriticalState>().reference_packing = 0.6;
  set_from_bed(given, continuum::Layout(p), 1, p, filled);
  EXPECT_EQ(law.reference_packing, 0.6);
}

}  // namespace
}  // namespace talus::app

// SPDX-License-Identifier: Apache-2.0
/// Keys that a choice owns, keys that were renamed, and hints at what a value was meant for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/parameter_reader.hpp"
#include "io/parameter_writer.hpp"

namespace talus {
namespace choosing {

enum class Cover { none, snow, sand };

struct Parameters {
  Cover cover = Cover::none;
  double depth = 0.5;
  struct Sand {
    bool wet = false;
    double water = 0.1;
    double friction = 0.6;
  } sand;
};

template <class Visit, class P>
void for_each_parameter(Visit&& visit, P& p) {
  visit(Parameter{"cover.name", {}, {}, "what lies on the slope"}, p.cover);
  auto covered = only_if(unless("cover.name", p.cover, Cover::none), visit);
  covered(Parameter{"cover.depth", dimension::length, above(0), "how deep"}, p.depth);
  auto sandy = only_if(where("cover.name", p.cover, Cover::sand), visit);
  auto sand = in_table("cover.sand", sandy);
  sand(Parameter{"wet", {}, {}, "whether it is wet"}, p.sand.wet);
  auto wet = only_if(where("wet", p.sand.wet, true), sand);
  wet(Parameter{"water", dimension::none, between(0, 1), "how wet"}, p.sand.water);
  sand(Parameter{"friction", dimension::none, friction_coefficient(), "its friction"}, p.sand.friction);
}

constexpr RenamedKey renamed[] = {{"depth", "cover.depth"}, {"cover.form", "cover.name = \"sand\""}};

}  // namespace choosing

template <>
inline constexpr auto choices<choosing::Cover> = std::to_array<std::string_view>({"none", "snow", "sand"});

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

struct Read {
  choosing::Parameters parameters;
  std::vector<std::string> problems;
};

Read read(const std::string& text, const std::vector<std::string>& options = {}) {
  CaseFile file = CaseFile::from_text(text, "c");
  for (const std::string& option : options) file.set(option);
  Read result;
  ParameterReader reader(file, choosing::renamed);
  for_each_parameter(reader, result.parameters);
  try {
    reader.finish();
  } catch (const InputError& error) {
    for (const Problem& problem : error.problems()) result.problems.push_back(to_string(problem));
  }
  return result;
}

ParameterList list_of(const choosing::Parameters& parameters) {
  ParameterList list;
  for_each_parameter(list, parameters);
  return list;
}

TEST(Conditions, AKeyOfAChoiceThatIsNotTakenIsAFault) {
  EXPECT_THAT(read("cover.sand.wet = true").problems,
              ElementsAre("c:1: cover.sand.wet: given, but cover.name is \"none\"; allowed: cover.name = \"sand\""));
  EXPECT_THAT(read("cover.depth = \"1 m\"").problems,
              ElementsAre("c:1: cover.depth: given, but cover.name is \"none\"; allowed: cover.name other than "
                          "\"none\""));
}

TEST(Conditions, AnOptionThatTakesAnotherChoiceReplacesTheKeysOfTheFormer) {
  const std::string sand = "cover = { name = \"sand\", sand = { wet = true, water = 0.2 } }";
  EXPECT_THAT(read(sand).problems, IsEmpty());
  for (const auto& option : {"cover.name=snow", "cover.name=none"}) {
    const Read other = read(sand, {option});
    EXPECT_THAT(other.problems, IsEmpty()) << option;
    EXPECT_EQ(other.parameters.sand.water, 0.1) << option;
  }
  // An inner choice takes its own keys along alone.
  EXPECT_EQ(read(sand, {"cover.sand.wet=false"}).parameters.sand.water, 0.1);
  // What an option gives itself still has to mean something.
  EXPECT_THAT(read(sand, {"cover.name=snow", "cover.sand.friction=0.5"}).problems,
              ElementsAre(HasSubstr("cover.sand.friction: given, but cover.name is \"snow\"")));
}

TEST(Conditions, ATakenChoiceHasItsKeysWhateverTheirOrder) {
  const Read taken = read("[cover.sand]\nwater = 0.2\nwet = true\n[cover]\nname = \"sand\"\ndepth = \"2 m\"\n");
  EXPECT_THAT(taken.problems, IsEmpty());
  EXPECT_EQ(taken.parameters.sand.water, 0.2);
  EXPECT_EQ(taken.parameters.depth, 2);
}

TEST(Conditions, OfSeveralTheOutermostThatFailsIsTold) {
  EXPECT_THAT(read("cover.sand.water = 0.2").problems, ElementsAre(HasSubstr("but cover.name is \"none\"")));
  EXPECT_THAT(read("cover.sand.water = 0.2\ncover.name = \"sand\"").problems,
              ElementsAre("c:1: cover.sand.water: given, but cover.sand.wet is false; allowed: cover.sand.wet = true"));
}

TEST(Conditions, WhatFollowsFromAFaultyChoiceIsNotTold) {
  EXPECT_THAT(read("cover.name = \"sadn\"\ncover.sand.wet = true\ncover.depth = \"1 m\"").problems,
              ElementsAre(HasSubstr("c:1: cover.name: \"sadn\"")));
}

TEST(Conditions, OnlyKeysThatHoldAreOfTheResolvedCaseAndItsFingerprint) {
  choosing::Parameters p;
  EXPECT_THAT(resolved_case(list_of(p)), Not(HasSubstr("depth")));
  EXPECT_THAT(resolved_case(list_of(p)), Not(HasSubstr("[cover.sand]")));
  const std::string before = fingerprint(list_of(p));
  p.sand.water = 0.9;
  EXPECT_EQ(fingerprint(list_of(p)), before);
  p.cover = choosing::Cover::sand;
  p.sand.wet = true;
  const std::string text = resolved_case(list_of(p));
  EXPECT_THAT(text, HasSubstr("[cover.sand]\nwet = true\nwater = 0.9\n"));
  EXPECT_THAT(read(text).problems, IsEmpty());
  EXPECT_EQ(read(text).parameters.sand.water, 0.9);
}

TEST(Conditions, SchemaAndPageShowTheKeysOfEveryChoice) {
  EXPECT_THAT(reference_page(list_of({})), HasSubstr("## [cover.sand]"));
  EXPECT_THAT(json_schema(list_of({}), "t"), HasSubstr("\"water\""));
}

TEST(RenamedKeys, SayWhatStandsInTheirPlace) {
  EXPECT_THAT(read("depth = \"1 m\"\ncover.form = \"x\"\nshape = 1").problems,
              ElementsAre("c:1: depth: has another name now; allowed: cover.depth",
                          "c:2: cover.form: has another name now; allowed: cover.name = \"sand\"",
                          HasSubstr("c:3: shape: unknown key")));
}

TEST(FrictionCoefficient, HintsAtAnAngle) {
  const auto problem = [](const std::string& value) {
    const Read result = read("cover.name = \"sand\"\ncover.sand.friction = " + value);
    return result.problems.empty() ? std::string() : result.problems.front();
  };
  EXPECT_THAT(problem("35"), HasSubstr("35 is out of range: 35 looks like an angle in degrees, whose tangent is 0.70"));
  EXPECT_THAT(problem("\"35 deg\""), HasSubstr("looks like an angle in degrees, whose tangent is 0.70"));
  EXPECT_THAT(problem("\"35 mm\""), Not(HasSubstr("angle")));
  EXPECT_THAT(problem("-1"), Not(HasSubstr("angle")));
  EXPECT_THAT(problem("200"), Not(HasSubstr("angle")));
  EXPECT_EQ(problem("2"), "");
  EXPECT_EQ(problem("0"), "");
}

}  // namespace
}  // namespace talus

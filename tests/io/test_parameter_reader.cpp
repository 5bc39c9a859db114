// SPDX-License-Identifier: Apache-2.0
#include "io/parameter_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/example_case.hpp"

namespace talus {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct Read {
  example::Parameters parameters;
  example::Run run;
  std::vector<std::string> problems;  // as the user sees them
};

Read read(const CaseFile& file, const std::vector<Problem>& contradictions = {}) {
  Read result;
  try {
    ParameterReader reader(file);
    for_each_parameter(reader, result.parameters);
    for_each_parameter(reader, result.run);
    reader.check(contradictions);
    reader.finish();
  } catch (const InputError& error) {
    for (const Problem& problem : error.problems()) result.problems.push_back(to_string(problem));
  }
  return result;
}

Read read(const std::string& text, const std::vector<std::string>& options = {}) {
  CaseFile file = CaseFile::from_text(text, "c");
  for (const std::string& option : options) file.set(option);
  return read(file);
}

/// The problem that one line, added to a valid case as its first, makes.
std::string problem_of(const std::string& line) {
  const std::vector<std::string> problems = read(line + example::minimal_case).problems;
  EXPECT_EQ(problems.size(), 1u) << line << "\n" << testing::PrintToString(problems);
  return problems.empty() ? "" : problems.front();
}

TEST(ParameterReader, ReadsEveryType) {
  const Read all = read(R"(
    seed = 17
    title = "heap of grains"
    [particles]
    shape = "triangle"
    count = 1e6
    radius = "200 um"
    radius_spread = 0
    density = "2.5 g/cm3"
    size = "3 cm"
    [slope]
    enabled = false
    angle = "30 deg"
    [gravity]
    direction = [0, 0.5, -1]
    origin = ["1 mm", "2 cm", "3 m"]
    [run]
    end = "2 min"
    [output]
    snapshots = ["1 ms", "1 s"]
    weights = []
  )");
  EXPECT_TRUE(all.problems.empty()) << testing::PrintToString(all.problems);
  const example::Parameters& p = all.parameters;
  EXPECT_EQ(p.seed, 17);
  EXPECT_EQ(p.title, "heap of grains");
  EXPECT_EQ(p.particles.shape, example::Shape::triangle);
  EXPECT_EQ(p.particles.count, 1000000);
  EXPECT_EQ(p.particles.radius, 200e-6);
  EXPECT_EQ(p.particles.radius_spread, 0.0);
  EXPECT_EQ(p.particles.density, 2500.0);
  EXPECT_EQ(p.particles.size, 0.03);
  EXPECT_FALSE(p.slope.enabled);
  EXPECT_EQ(p.slope.angle, 0.52359877559829887308);
  EXPECT_THAT(p.gravity.direction, ElementsAre(0.0, 0.5, -1.0));
  ASSERT_TRUE(p.gravity.origin);
  EXPECT_THAT(*p.gravity.origin, ElementsAre(1e-3, 2e-2, 3.0));
  EXPECT_EQ(p.numerics.scheme, example::Scheme::chebyshev);  // not given
  EXPECT_EQ(all.run.end, 120.0);
  EXPECT_THAT(all.run.snapshots, ElementsAre(1e-3, 1.0));
}

TEST(ParameterReader, WhatIsNotGivenKeepsItsDefault) {
  const Read smallest = read(example::minimal_case);
  EXPECT_TRUE(smallest.problems.empty()) << testing::PrintToString(smallest.problems);
  EXPECT_EQ(smallest.parameters.particles.count, 2000);
  EXPECT_FALSE(smallest.parameters.particles.size);
  EXPECT_FALSE(smallest.parameters.gravity.origin);
  EXPECT_THAT(smallest.run.snapshots, ElementsAre(0.001, 0.002));
}

TEST(ParameterReader, RangesIncludeTheirBoundsUnlessSaid) {
  EXPECT_TRUE(read("slope.angle = \"90 deg\"" + std::string(example::minimal_case)).problems.empty());
  EXPECT_TRUE(read("slope.angle = \"0 deg\"" + std::string(example::minimal_case)).problems.empty());
  EXPECT_TRUE(read("particles.count = 10000000" + std::string(example::minimal_case)).problems.empty());
  EXPECT_EQ(problem_of("slope.angle = \"90.0000001 deg\""),
            "c:1: slope.angle: \"90.0000001 deg\" is out of range; allowed: an angle, from 0 deg to 90 deg, such as "
            "\"45 deg\"");
  EXPECT_EQ(problem_of("particles.size = \"-5 um\""),
            "c:1: particles.size: \"-5 um\" is out of range; allowed: a length, above 0 mm, such as \"5 mm\"");
  EXPECT_EQ(problem_of("numerics.porosity = 1"),
            "c:1: numerics.porosity: 1 is out of range; allowed: a number, above 0 and below 1, such as 0.5");
  EXPECT_EQ(problem_of("numerics.temperature_slope = 0.5"),
            "c:1: numerics.temperature_slope: 0.5 is out of range; allowed: a number, below 0, such as -1.0");
  EXPECT_EQ(problem_of("particles.count = 10000001"),
            "c:1: particles.count: 10000001 is out of range; allowed: a whole number, from 1 to 10000000");
  EXPECT_EQ(problem_of("output.snapshots = [\"1 s\", \"-1 ms\"]"),
            "c:1: output.snapshots: value 2: \"-1 ms\" is out of range; allowed: values in brackets, each a time, at "
            "least 0 ms, such as [\"5 ms\"]");
}

TEST(ParameterReader, AQuantityNeedsItsUnitAndANumberNone) {
  EXPECT_EQ(problem_of("particles.density = 2500"),
            "c:1: particles.density: 2500 has no unit; allowed: a density, above 0 kg/m3, such as \"2500 kg/m3\"");
  EXPECT_THAT(problem_of("particles.density = \"2500\""), HasSubstr("density: \"2500\" has no unit; allowed: "));
  EXPECT_THAT(problem_of("particles.density = \"5 kg\""), HasSubstr("\"5 kg\" is not a density but a mass; allowed: "));
  EXPECT_THAT(problem_of("particles.size = \"5 deg\""), HasSubstr("\"5 deg\" is not a length but an angle; allowed: "));
  EXPECT_THAT(problem_of("particles.size = \"5 m kg\""),
              HasSubstr("\"5 m kg\" is not a length but a quantity in m kg; allowed: "));
  EXPECT_THAT(problem_of("particles.size = \"5 meters\""),
              HasSubstr("\"5 meters\" has the unknown unit 'meters'; write 'm'; allowed: "));
  EXPECT_THAT(problem_of("particles.size = true"), HasSubstr("size: true is not a length; allowed: "));
  EXPECT_THAT(problem_of("particles.radius_spread = \"5 %\""),
              HasSubstr("\"5 %\" is in percent, which is no unit; write 0.05 for 5 %"));
  EXPECT_THAT(problem_of("particles.radius_spread = \"0.05\""),
              HasSubstr("\"0.05\" is text; write it without quotes; allowed: a number, from 0 to 0.9, such as 0.5"));
  EXPECT_THAT(problem_of("particles.radius_spread = \"5 mm\""),
              HasSubstr("\"5 mm\" has a unit where a plain number is due"));
  EXPECT_THAT(problem_of("particles.radius_spread = nan"), HasSubstr("nan is not a finite number"));
  EXPECT_THAT(problem_of("particles.radius_spread = -inf"), HasSubstr("-inf is not a finite number"));
  EXPECT_THAT(problem_of("particles.size = inf"), HasSubstr("inf is not a finite number"));
  EXPECT_THAT(problem_of("particles.size = \"inf m\""), HasSubstr("\"inf m\" does not begin with a number"));
}

TEST(ParameterReader, EveryTypeRefusesTheOthers) {
  EXPECT_EQ(problem_of("particles.count = 2.5"),
            "c:1: particles.count: 2.5 is not a whole number; allowed: a whole number, from 1 to 10000000");
  EXPECT_THAT(problem_of("particles.count = \"5\""), HasSubstr("\"5\" is text; write it without quotes"));
  EXPECT_THAT(problem_of("particles.count = \"many\""), HasSubstr("\"many\" is not a whole number"));
  EXPECT_THAT(problem_of("particles.count = 1e300"), HasSubstr("is not a whole number"));
  EXPECT_THAT(problem_of("particles.count = nan"), HasSubstr("nan is not a whole number"));
  EXPECT_THAT(problem_of("particles.count = 2020-01-01"), HasSubstr("the date 2020-01-01 is not a whole number"));
  EXPECT_EQ(problem_of("slope.enabled = 1"), "c:1: slope.enabled: 1 is not true or false; allowed: true or false");
  EXPECT_THAT(problem_of("slope.enabled = \"true\""), HasSubstr("\"true\" is text; write it without quotes"));
  EXPECT_EQ(problem_of("title = 5"), "c:1: title: 5 is not text in quotes; allowed: text in quotes");
  EXPECT_EQ(problem_of("numerics.scheme = \"eular\""),
            "c:1: numerics.scheme: \"eular\" is not one of the choices; allowed: euler, chebyshev; did you mean "
            "'euler'?");
  EXPECT_EQ(problem_of("numerics.scheme = 5"),
            "c:1: numerics.scheme: 5 is not one of the choices; allowed: euler, chebyshev");
  EXPECT_EQ(problem_of("gravity.direction = 5"),
            "c:1: gravity.direction: 5 is not an array of 3 values; allowed: 3 values in brackets, each a number, such "
            "as [0.5, 0.5, 0.5]");
  EXPECT_THAT(problem_of("gravity.direction = [0, 1]"), HasSubstr("has 2 values and not 3"));
  EXPECT_THAT(problem_of("gravity.direction = [0, 1, [2]]"), HasSubstr("value 3: an array is not a number"));
  EXPECT_THAT(problem_of("gravity.origin = [\"1 m\", 2, \"3 m\"]"), HasSubstr("value 2: 2 has no unit"));
  EXPECT_THAT(problem_of("output.weights = [1, inf]"), HasSubstr("value 2: inf is not a finite number"));
  EXPECT_THAT(problem_of("output.snapshots = \"1 s\""), HasSubstr("\"1 s\" is not an array; allowed: values in"));
  EXPECT_THAT(problem_of("slope.angle = {x = 1}"), HasSubstr("c:1: slope.angle: a table is not an angle"));
  EXPECT_THAT(problem_of("slope.angle = []"), HasSubstr("an array is not an angle"));
}

TEST(ParameterReader, ATableIsATable) {
  EXPECT_EQ(problem_of("numerics = 5"), "c:1: numerics: 5 is not a table; allowed: a table: [numerics]");
  EXPECT_EQ(read("particles = 5\nrun.end = \"1 s\"").problems,
            std::vector<std::string>{"c:1: particles: 5 is not a table; allowed: a table: [particles]"})
      << "that its required keys are missing is a consequence";
  EXPECT_EQ(read(std::string(example::minimal_case) + "[[numerics]]\nporosity = 3").problems,
            std::vector<std::string>{"c:6: numerics.1.porosity: unknown key; did you mean 'numerics.porosity'?"})
      << "keys of an array of tables have its number";
  EXPECT_TRUE(read(std::string(example::minimal_case) + "[numerics]\n").problems.empty()) << "may be empty";
}

TEST(ParameterReader, UnknownKeysNameTheNearest) {
  EXPECT_EQ(problem_of("particles.cuont = 5"), "c:1: particles.cuont: unknown key; did you mean 'particles.count'?");
  EXPECT_EQ(problem_of("partcles.count = 5"), "c:1: partcles.count: unknown key; did you mean 'particles.count'?");
  EXPECT_EQ(problem_of("slope.denstiy = \"5 mm\""),
            "c:1: slope.denstiy: unknown key; did you mean 'particles.density'?");
  EXPECT_EQ(problem_of("density = 5"), "c:1: density: unknown key; did you mean 'particles.density'?");
  EXPECT_EQ(problem_of("particles.seed = 5"), "c:1: particles.seed: unknown key; did you mean 'seed'?");
  EXPECT_EQ(problem_of("Particles.Radius-Spread = 5"),
            "c:1: Particles.Radius-Spread: unknown key; did you mean 'particles.radius_spread'?");
  EXPECT_EQ(problem_of("slope.colour = 5"), "c:1: slope.colour: unknown key; allowed: slope.enabled, slope.angle");
  EXPECT_EQ(problem_of("colour = 5"), "c:1: colour: unknown key; allowed: seed, title");
  EXPECT_EQ(problem_of("seed.first = 5"),
            "c:1: seed: a table is not a whole number; allowed: a whole number, from 0 "
            "to 9000000000000000");
}

TEST(ParameterReader, AnUnknownTableIsOneProblem) {
  const std::string start = example::minimal_case;
  EXPECT_EQ(read(start + "[numercs]\nscheme = \"euler\"\nporosity = 0.3").problems,
            std::vector<std::string>{"c:5: numercs: unknown table; did you mean 'numerics'?"});
  EXPECT_EQ(read(start + "[solver]\nscheme = \"euler\"\nporosity = 0.3").problems,
            std::vector<std::string>{"c:5: solver: unknown table; did you mean 'numerics'?"})
      << "by its keys";
  EXPECT_EQ(read(start + "[colours.of]\nred = 1\nblue = 2").problems,
            std::vector<std::string>{
                "c:5: colours: unknown table; allowed: [particles], [slope], [gravity], [numerics], [run], [output]"});
  EXPECT_EQ(read(start + "[colours]").problems,
            std::vector<std::string>{
                "c:5: colours: unknown table; allowed: [particles], [slope], [gravity], [numerics], [run], [output]"});
  EXPECT_EQ(read("[particels]\nshape = \"circle\"\nradius = \"5 mm\"\n[run]\nend = \"1 s\"").problems,
            std::vector<std::string>{"c:1: particels: unknown table; did you mean 'particles'?"})
      << "that shape and radius are missing is a consequence";
}

TEST(ParameterReader, AMisspeltRequiredKeyIsOneProblem) {
  EXPECT_EQ(read("particles.shape = \"circle\"\nparticles.raduis = \"5 mm\"\nrun.end = \"1 s\"").problems,
            std::vector<std::string>{"c:2: particles.raduis: unknown key; did you mean 'particles.radius'?"});
}

TEST(ParameterReader, MissingKeysSayWhatIsDue) {
  EXPECT_THAT(read("").problems, ElementsAre("c: particles.shape: missing; allowed: circle, rectangle, triangle",
                                             "c: particles.radius: missing; allowed: a length, above 0 mm, such as "
                                             "\"5 mm\"",
                                             "c: run.end: missing; allowed: a time, above 0 ms, such as \"5 ms\""));
}

TEST(ParameterReader, TwelveFaultsAreTwelveProblems) {
  const std::string text = R"(seed = -1
titel = "a heap"
[particles]
shape = "circel"
count = 2.5
radius = 5
density = "2500 kg"
[slope]
enabled = "true"
angle = "95 deg"
[gravity]
direction = [0, -1]
[numerics]
porosity = nan
[ouptut]
snapshots = ["1 s"]
)";
  EXPECT_THAT(
      read(text).problems,
      ElementsAre(
          "c:1: seed: -1 is out of range; allowed: a whole number, from 0 to 9000000000000000",
          "c:2: titel: unknown key; did you mean 'title'?",
          "c:4: particles.shape: \"circel\" is not one of the choices; allowed: circle, rectangle, triangle; did you "
          "mean 'circle'?",
          "c:5: particles.count: 2.5 is not a whole number; allowed: a whole number, from 1 to 10000000",
          "c:6: particles.radius: 5 has no unit; allowed: a length, above 0 mm, such as \"5 mm\"",
          "c:7: particles.density: \"2500 kg\" is not a density but a mass; allowed: a density, above 0 kg/m3, such as "
          "\"2500 kg/m3\"",
          "c:9: slope.enabled: \"true\" is text; write it without quotes; allowed: true or false",
          "c:10: slope.angle: \"95 deg\" is out of range; allowed: an angle, from 0 deg to 90 deg, such as \"45 deg\"",
          "c:12: gravity.direction: has 2 values and not 3; allowed: 3 values in brackets, each a number, such as "
          "[0.5, 0.5, 0.5]",
          "c:14: numerics.porosity: nan is not a finite number; allowed: a number, above 0 and below 1, such as 0.5",
          "c:16: ouptut.snapshots: unknown key; did you mean 'output.snapshots'?",
          "c: run.end: missing; allowed: a time, above 0 ms, such as \"5 ms\""));
}

TEST(ParameterReader, OptionsNameThemselves) {
  const std::vector<std::string> options = {"particles.count=x",           "particles.raduis=3 mm", "seed",
                                            "slope.angle=95 deg",          "particles.count.x=3",   "title=2024",
                                            "particles.density=2000 kg/m3"};
  const Read with_options = read(example::minimal_case, options);
  EXPECT_THAT(
      with_options.problems,
      ElementsAre(
          "--set seed: has no '='; allowed: table.key=value",
          "--set particles.count=x: particles.count: \"x\" is not a whole number; allowed: a whole number, from "
          "1 to 10000000",
          "--set slope.angle=95 deg: slope.angle: \"95 deg\" is out of range; allowed: an angle, from 0 deg to "
          "90 deg, such as \"45 deg\"",
          "--set particles.raduis=3 mm: particles.raduis: unknown key; did you mean 'particles.radius'?",
          "--set particles.count.x=3: particles.count.x: unknown key; did you mean 'particles.count'?"));
  EXPECT_EQ(with_options.parameters.title, "2024") << "text need not stand in quotes in an option";
  EXPECT_EQ(with_options.parameters.particles.density, 2000.0);
}

TEST(ParameterReader, AFaultOfTheFileIsMendedByAnOption) {
  EXPECT_TRUE(read("slope.angle = 3" + std::string(example::minimal_case), {"slope.angle=3 deg"}).problems.empty());
}

TEST(ParameterReader, ContradictionsGetTheirLines) {
  CaseFile file =
      CaseFile::from_text("particles.count = 0\nslope.angle = \"3 deg\"" + std::string(example::minimal_case), "c");
  file.set("particles.size=3 mm");
  const auto contradiction = [](std::string key, std::string what) {
    return Problem{.where = {}, .key = std::move(key), .what = std::move(what), .allowed = "less"};
  };
  EXPECT_THAT(
      read(file, {contradiction("particles.size", "too large"), contradiction("slope.angle", "too steep"),
                  contradiction("slope.angle", "steep as well"), contradiction("title", "missing"),
                  contradiction("particles.count", "consequence of a fault"),
                  contradiction("particles.radius", "too large for particles.count"),
                  contradiction("particles.radius", "particles.counts is another key"),
                  contradiction("particles.radius", "as is my.particles.count")})
          .problems,
      ElementsAre("c:1: particles.count: 0 is out of range; allowed: a whole number, from 1 to 10000000",
                  "c:2: slope.angle: too steep; allowed: less", "c:2: slope.angle: steep as well; allowed: less",
                  "c:4: particles.radius: particles.counts is another key; allowed: less",
                  "c:4: particles.radius: as is my.particles.count; allowed: less", "c: title: missing; allowed: less",
                  "--set particles.size=3 mm: particles.size: too large; allowed: less"));
}

TEST(ParameterReader, ALackThatAMisspellingExplainsIsNoProblem) {
  const CaseFile file = CaseFile::from_text("particles.sise = \"3 mm\"" + std::string(example::minimal_case), "c");
  EXPECT_THAT(read(file, {{.where = {}, .key = "particles.size", .what = "missing: a circle needs it"}}).problems,
              ElementsAre("c:1: particles.sise: unknown key; did you mean 'particles.size'?"));
}

/// A radius and a size that contradict each other in words that name no key, and a contradiction of others.
std::vector<Problem> contradictions_of(const example::Parameters& p) {
  std::vector<Problem> problems;
  if (p.particles.size && !(*p.particles.size > 2 * p.particles.radius))
    problems.push_back({.key = "particles.shape", .what = "no room for a grain"});
  if (!(p.particles.radius > 1e-3)) problems.push_back({.key = "particles.shape", .what = "too fine for words"});
  if (p.slope.angle > 1) problems.push_back({.key = "slope.angle", .what = "too steep"});
  if (p.numerics.scheme == example::Scheme::chebyshev && p.seed == 1)
    problems.push_back({.key = "title", .what = "the seed suits another scheme"});
  return problems;
}

std::vector<std::string> all_problems(const std::string& text) {
  std::vector<std::string> problems;
  const CaseFile file = CaseFile::from_text(text, "c");
  example::Parameters parameters;
  example::Run run;
  try {
    ParameterReader reader(file);
    for_each_parameter(reader, run);
    for_each_parameter(reader, parameters);
    reader.check(parameters, contradictions_of);
    reader.finish();
  } catch (const InputError& error) {
    for (const Problem& problem : error.problems()) problems.push_back(to_string(problem));
  }
  return problems;
}

TEST(ParameterReader, WhatFollowsFromAnUnreadableValueIsNotTold) {
  const std::string rest = "particles.shape = \"circle\"\nrun.end = \"1 s\"\nseed = 2\nslope.angle = \"70 deg\"\n";
  EXPECT_THAT(all_problems(rest + "particles.size = \"5 mm\"\nparticles.radius = \"5 mm\"\n"),
              ElementsAre("c:1: particles.shape: no room for a grain", "c:4: slope.angle: too steep"));
  for (const char* radius : {"radius = \"5 furlongs\"", "radius = 5", "raduis = \"5 mm\"", "radius = \"-1 mm\""})
    EXPECT_THAT(all_problems(rest + "particles.size = \"5 mm\"\nparticles." + radius),
                ElementsAre("c:4: slope.angle: too steep", HasSubstr("c:6: particles.")))
        << radius;
  EXPECT_THAT(all_problems(rest + "particles.size = \"5 mm\""),
              ElementsAre("c:4: slope.angle: too steep", HasSubstr("c: particles.radius: missing")));
  // A choice and a whole number: their defaults would contradict each other.
  EXPECT_THAT(all_problems("particles.shape = \"circle\"\nrun.end = \"1 s\"\nparticles.radius = \"5 mm\"\n"
                           "numerics.scheme = \"eular\""),
              ElementsAre(HasSubstr("c:4: numerics.scheme: \"eular\"")));
  EXPECT_THAT(all_problems("particles.shape = \"circle\"\nrun.end = \"1 s\"\nparticles.radius = \"5 mm\"\nseed = 0.5"),
              ElementsAre(HasSubstr("c:4: seed: 0.5")));
}

TEST(ParameterReader, ValuesOfATrialAreAllowed) {
  example::Parameters p;
  example::Run run;
  const auto check_values = []<class T>(const Parameter& parameter, const T&) {
    const auto value_of = [&](int trial) { return trial_value(parameter, value_type<T>(), trial); };
    for (int trial = 0; trial < 8; ++trial) {
      const ParameterValue value = value_of(trial);
      if (const auto* number = std::get_if<double>(&value)) {
        EXPECT_TRUE(parameter.range.contains(*number)) << parameter.key;
      }
      if (const auto* whole = std::get_if<std::int64_t>(&value)) {
        EXPECT_TRUE(parameter.range.contains(static_cast<double>(*whole))) << parameter.key;
      }
      if (const auto* numbers = std::get_if<std::vector<double>>(&value)) {
        for (const double number : *numbers) EXPECT_TRUE(parameter.range.contains(number)) << parameter.key;
      }
      T member{};
      from_value(value, member);
    }
    EXPECT_NE(value_of(0), value_of(1)) << parameter.key;
  };
  for_each_parameter(check_values, p);
  for_each_parameter(check_values, run);
}

TEST(ParameterReader, LongTextIsCutBetweenLetters) {
  const std::string letters(59, 'x');
  EXPECT_THAT(problem_of("numerics.scheme = \"" + letters + "µµ\""),
              HasSubstr("\"" + letters + "...\" is not one of the choices"));
  EXPECT_THAT(problem_of("numerics.scheme = \"" + letters + "y\""), HasSubstr("\"" + letters + "y\" is not one of"));
}

}  // namespace
}  // namespace talus

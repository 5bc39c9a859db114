// SPDX-License-Identifier: Apache-2.0
#include "io/parameter_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "io/example_case.hpp"
#include "io/parameter_reader.hpp"

namespace talus {
namespace {

using testing::ElementsAre;

struct Case {
  example::Parameters parameters;
  example::Run run;
};

ParameterList list_of(const Case& resolved) {
  ParameterList list;
  for_each_parameter(list, resolved.parameters);
  for_each_parameter(list, resolved.run);
  return list;
}

Case read(const CaseFile& file) {
  Case result;
  ParameterReader reader(file);
  for_each_parameter(reader, result.parameters);
  for_each_parameter(reader, result.run);
  reader.finish();
  return result;
}

Case smallest() {
  return read(CaseFile::from_text(example::minimal_case, "c"));
}

/// Numbers compared bit for bit: -0.0 is not 0.0.
template <class T>
T bits(const T& value) {
  return value;
}
std::uint64_t bits(double value) {
  return std::bit_cast<std::uint64_t>(value);
}
std::vector<std::uint64_t> bits(const std::vector<double>& values) {
  std::vector<std::uint64_t> result;
  for (const double value : values) result.push_back(bits(value));
  return result;
}
std::vector<std::uint64_t> bits(const std::array<double, 3>& values) {
  return bits(std::vector<double>(values.begin(), values.end()));
}
template <class T>
auto bits(const std::optional<T>& value) {
  return value ? std::optional(bits(*value)) : std::nullopt;
}

void expect_same_bits(const Case& a, const Case& b) {
  const auto &p = a.parameters, &q = b.parameters;
  EXPECT_EQ(p.seed, q.seed);
  EXPECT_EQ(p.title, q.title);
  EXPECT_EQ(p.particles.shape, q.particles.shape);
  EXPECT_EQ(p.particles.count, q.particles.count);
  EXPECT_EQ(bits(p.particles.radius), bits(q.particles.radius));
  EXPECT_EQ(bits(p.particles.radius_spread), bits(q.particles.radius_spread));
  EXPECT_EQ(bits(p.particles.density), bits(q.particles.density));
  EXPECT_EQ(bits(p.particles.size), bits(q.particles.size));
  EXPECT_EQ(p.slope.enabled, q.slope.enabled);
  EXPECT_EQ(bits(p.slope.angle), bits(q.slope.angle));
  EXPECT_EQ(bits(p.gravity.direction), bits(q.gravity.direction));
  EXPECT_EQ(bits(p.gravity.origin), bits(q.gravity.origin));
  EXPECT_EQ(p.numerics.scheme, q.numerics.scheme);
  EXPECT_EQ(bits(p.numerics.porosity), bits(q.numerics.porosity));
  EXPECT_EQ(bits(p.numerics.temperature_slope), bits(q.numerics.temperature_slope));
  EXPECT_EQ(bits(a.run.end), bits(b.run.end));
  EXPECT_EQ(bits(a.run.snapshots), bits(b.run.snapshots));
  EXPECT_EQ(bits(a.run.weights), bits(b.run.weights));
}

TEST(ResolvedCase, ShowsEveryParameterInSi) {
  Case resolved = smallest();
  resolved.parameters.title = "a \"heap\"\n\tof grains \\ \x01";
  resolved.parameters.particles.radius = 200e-6;
  EXPECT_EQ(resolved_case(list_of(resolved)), R"(seed = 1
title = "a \"heap\"\n\tof grains \\ \u0001"

[particles]
shape = "circle"
count = 2000
radius = "0.0002 m"
radius_spread = 0.05
density = "2500 kg/m3"
# size is not given

[slope]
enabled = true
angle = "45 deg"

[gravity]
direction = [0.0, 0.0, -1.0]
# origin is not given

[numerics]
scheme = "chebyshev"
porosity = 0.4
temperature_slope = -3.0

[run]
end = "1 s"

[output]
snapshots = ["0.001 s", "0.002 s"]
weights = []
)");
}

TEST(ResolvedCase, KeysAtTheTopComeFirst) {
  ParameterList list;
  list(Parameter{"a.b", {}, {}, ""}, true);
  list(Parameter{"c", {}, {}, ""}, std::int64_t{1});
  list(Parameter{"a.d.e", {}, {}, ""}, std::int64_t{2});
  list(Parameter{"a.f", {}, {}, ""}, std::int64_t{3});
  const std::string text = resolved_case(list);
  EXPECT_EQ(text, "c = 1\n\n[a]\nb = true\nf = 3\n\n[a.d]\ne = 2\n");
  EXPECT_TRUE(CaseFile::from_text(text, "c").contains("a.d.e"));
}

TEST(ResolvedCase, ReadsBackToTheSameBits) {
  Random random(11);
  const auto positive = [&] { return std::ldexp(random.uniform(0.5, 1), static_cast<int>(random.uniform(-300, 300))); };
  const auto any = [&] { return random.uniform() < 0.5 ? -positive() : positive(); };
  for (int i = 0; i < 300; ++i) {
    Case original = smallest();
    example::Parameters& p = original.parameters;
    p.seed = static_cast<std::int64_t>(random.uniform(0, 9e15));
    p.title = i % 2 ? "quote \" backslash \\ tab \t µ" : "";
    p.particles.shape = static_cast<example::Shape>(i % 3);
    p.particles.radius = positive();
    p.particles.radius_spread = random.uniform(0, 0.9);
    p.particles.density = positive();
    if (i % 2) p.particles.size = positive();
    p.slope.enabled = i % 3 == 0;
    p.slope.angle = random.uniform(0, std::numbers::pi / 2);
    p.gravity.direction = {any(), -0.0, 0.0};
    if (i % 5) p.gravity.origin = {any(), -0.0, 1e22};
    p.numerics.porosity = random.uniform(0.001, 1);
    p.numerics.temperature_slope = -positive();
    original.run = {positive(), {0.0, positive()}, {any(), 1e300, std::numeric_limits<double>::min(), 3.0}};
    const std::string text = resolved_case(list_of(original));
    const Case again = read(CaseFile::from_text(text, "resolved"));
    expect_same_bits(original, again);
    EXPECT_EQ(resolved_case(list_of(again)), text);
    EXPECT_EQ(fingerprint(list_of(again)), fingerprint(list_of(original)));
    if (HasFailure()) FAIL() << text;
  }
}

TEST(ResolvedTable, SaysWhereAValueComesFrom) {
  CaseFile file = CaseFile::from_text(
      "title = \"a | b\"\ngravity.origin = [\"1 mm\", \"0 m\", \"-1 m\"]" + std::string(example::minimal_case), "c");
  file.set("slope.angle=30 deg");
  std::vector<std::string> lines;
  for (const ResolvedLine& line : resolved_table(list_of(read(file)), file))
    lines.push_back(line.key + "|" + line.value + "|" + line.unit + "|" + line.origin + "|" + line.text);
  EXPECT_THAT(
      lines,
      ElementsAre(
          "seed|1||default|seed of the radii", "title|a | b||given|a title | free text",
          "particles.shape|circle||given|shape at the start", "particles.count|2000||default|number of particles",
          "particles.radius|0.005|m|given|mean radius", "particles.radius_spread|0.05||default|half width",
          "particles.density|2500|kg/m3|default|true density", "particles.size|-|m|default|size of the shape",
          "slope.enabled|true||default|whether there is a slope", "slope.angle|30|deg|option|incline",
          "gravity.direction|[0, 0, -1]||default|direction of gravity", "gravity.origin|[0.001, 0, -1]|m|given|a place",
          "numerics.scheme|chebyshev||default|integrator", "numerics.porosity|0.4||default|p",
          "numerics.temperature_slope|-3||default|s", "run.end|1|s|given|simulated time",
          "output.snapshots|[0.001, 0.002]|s|default|times of the snapshots",
          "output.weights|[]||default|weights of the snapshots"));
}

TEST(Fingerprint, IsTheKnownHash) {
  EXPECT_EQ(fingerprint({}), "cbf29ce484222325");  // of nothing: the offset basis
  ParameterList list;
  list(Parameter{"a", {}, {}, ""}, std::int64_t{1});
  EXPECT_EQ(fingerprint(list), "58ac462f1a79636e");  // of "a = 1\n"
}

TEST(Fingerprint, IsThatOfTheCaseNotOfItsWriting) {
  const std::string one = fingerprint(list_of(smallest()));
  EXPECT_EQ(one.size(), 16u);
  const char* other = "[run]\nend = \"1000 ms\"\n[particles]\nradius = \"0.5 cm\"\nshape = \"circle\"\ncount = 2e3\n";
  EXPECT_EQ(fingerprint(list_of(read(CaseFile::from_text(other, "other")))), one);

  ParameterList forwards, backwards;
  const Parameter a{"a", {}, {}, ""}, b{"b", {}, {}, ""};
  forwards(a, true), forwards(b, false);
  backwards(b, false), backwards(a, true);
  EXPECT_EQ(fingerprint(forwards), fingerprint(backwards));
}

TEST(Fingerprint, ChangesWithEveryValueAndNotWithExcludedOnes) {
  const std::string original = fingerprint(list_of(smallest()));
  std::set<std::string> seen = {original};
  int changes = 0;
  const auto changed = [&](auto change) {
    Case other = smallest();
    change(other);
    seen.insert(fingerprint(list_of(other)));
    ++changes;
    return other;
  };
  changed([](Case& c) { c.parameters.seed = 2; });
  changed([](Case& c) { c.parameters.title = "x"; });
  changed([](Case& c) { c.parameters.particles.shape = example::Shape::rectangle; });
  changed([](Case& c) { c.parameters.particles.count = 2001; });
  changed([](Case& c) { c.parameters.particles.radius = std::nextafter(0.005, 1); });
  changed([](Case& c) { c.parameters.particles.radius_spread = 0.06; });
  changed([](Case& c) { c.parameters.particles.density = 2501; });
  changed([](Case& c) { c.parameters.particles.size = 0.1; });
  changed([](Case& c) { c.parameters.slope.enabled = false; });
  changed([](Case& c) { c.parameters.slope.angle = std::nextafter(std::numbers::pi / 4, 1); });
  changed([](Case& c) { c.parameters.gravity.direction[1] = 1e-9; });
  changed([](Case& c) { c.parameters.gravity.origin = {0, 0, 0}; });
  changed([](Case& c) { c.parameters.numerics.scheme = example::Scheme::euler; });
  changed([](Case& c) { c.parameters.numerics.porosity = 0.41; });
  changed([](Case& c) { c.parameters.numerics.temperature_slope = -2; });
  changed([](Case& c) { c.run.weights = {1}; });
  const Case later = changed([](Case& c) { c.run.end = 2; });
  const Case other_output = changed([](Case& c) { c.run.snapshots = {}; });
  EXPECT_EQ(seen.size(), static_cast<std::size_t>(changes) + 1);

  constexpr auto excluded = std::to_array<std::string_view>({"run.end", "output"});
  const std::string without = fingerprint(list_of(smallest()), excluded);
  EXPECT_EQ(fingerprint(list_of(later), excluded), without);
  EXPECT_EQ(fingerprint(list_of(other_output), excluded), without);
  EXPECT_NE(fingerprint(list_of(changed([](Case& c) { c.parameters.seed = 2; })), excluded), without);
  constexpr auto beginning = std::to_array<std::string_view>({"run.e", "outpu"});
  EXPECT_EQ(fingerprint(list_of(smallest()), beginning), original) << "a key's beginning excludes nothing";
}

}  // namespace
}  // namespace talus

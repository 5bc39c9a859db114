// SPDX-License-Identifier: Apache-2.0
#include "base/nearest.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace talus {
namespace {

TEST(EditDistance, CountsSlips) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("radius", "radius"), 0u);
  EXPECT_EQ(edit_distance("raduis", "radius"), 1u);  // neighbours swapped
  EXPECT_EQ(edit_distance("radus", "radius"), 1u);
  EXPECT_EQ(edit_distance("radiius", "radius"), 1u);
  EXPECT_EQ(edit_distance("radios", "radius"), 1u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("sitting", "kitten"), 3u);
  EXPECT_EQ(edit_distance("ca", "abc"), 3u);  // optimal string alignment: a swapped pair is not edited again
  EXPECT_EQ(edit_distance("Radius-Spread", "radius_spread"), 0u);
}

TEST(Nearest, FindsTheSlipAndNothingFarOff) {
  constexpr auto shapes = std::to_array<std::string_view>({"circle", "rectangle", "triangle", "ball", "dome", "file"});
  EXPECT_EQ(nearest("circel", shapes), "circle");
  EXPECT_EQ(nearest("Triangle", shapes), "triangle");
  EXPECT_EQ(nearest("rect", shapes), "rectangle");
  EXPECT_EQ(nearest("hexagon", shapes), "");
  EXPECT_EQ(nearest("", shapes), "");
  EXPECT_EQ(nearest("bal", shapes), "ball");
  constexpr auto equals = std::to_array<std::string_view>({"xy", "xz"});
  EXPECT_EQ(nearest("xx", equals), "xy");  // of equals the first
}

// The edit distance of long words costs the product of their lengths: over a hundred keys, minutes.
TEST(Slips, OfAVeryLongWordAreNotCounted) {
  const std::string word(30'000'000, 'a');
  for (int n = 0; n < 100; ++n) EXPECT_FALSE(typos(word, "particles.radius"));
}

}  // namespace
}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "base/error.hpp"
#include "base/text.hpp"

namespace talus {

namespace {

using namespace std::string_literals;

TEST(Printable, LeavesTextAsItIs) {
  EXPECT_EQ(printable("Discharge through a slit of 40 mm, 45\u00b0, \u00b5m, \u706b \U0001f30b"),
            "Discharge through a slit of 40 mm, 45\u00b0, \u00b5m, \u706b \U0001f30b");
}

TEST(Printable, EscapesWhatMovesACursor) {
  EXPECT_EQ(printable("\x1b[31mred\r\b\a"), "\\u001b[31mred\\u000d\\u0008\\u0007");
  EXPECT_EQ(printable("\x7f\0"s), "\\u007f\\u0000");
  EXPECT_EQ(printable("\u009b31m"), "\\u009b31m");               // a control sequence by one character
  EXPECT_EQ(printable("a\u202eb\u2066c"), "a\\u202eb\\u2066c");  // what follows would be written backwards
}

TEST(Printable, EscapesWhatIsNoUtf8) {
  EXPECT_EQ(printable("\x9b\x33"), "\\x9b3");
  EXPECT_EQ(printable("\xc3"), "\\xc3");
  EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b");           // an overlong ESC's cousin
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");  // half of a surrogate pair
  EXPECT_EQ(printable("\xf5\x80\x80\x80"), "\\xf5\\x80\\x80\\x80");
}

TEST(Printable, KeepsLineEndsWhereAsked) {
  EXPECT_EQ(printable("a\nb\tc"), "a\\nb\\tc");
  EXPECT_EQ(printable("a\nb\x1b", Controls::line_ends), "a\nb\\u001b");
}

TEST(Printable, HoldsInMessages) {
  EXPECT_EQ(to_string({.where = "a\x1b[2J.toml", .line = 3, .key = "k\ney", .what = "unknown\r"}),
            "a\\u001b[2J.toml:3: k\\ney: unknown\\u000d");
  EXPECT_STREQ(FileError("a\x1b.csv", "cannot open").what(), "a\\u001b.csv: cannot open");
}

TEST(Wrapped, BreaksAtBlanksAndIndents) {
  EXPECT_EQ(wrapped("one two three", 9, 2, 0), "one two\n  three");
  EXPECT_EQ(wrapped("one two three", 9, 2, 5), "one\n  two\n  three");
  EXPECT_EQ(wrapped("one two", 9, 2, 20), "\n  one two");
  EXPECT_EQ(wrapped("", 9, 2, 5), "");
  EXPECT_EQ(wrapped("a word-longer-than-a-line b", 9, 0, 0), "a\nword-longer-than-a-line\nb");
  EXPECT_EQ(wrapped("\u00b5\u00b5\u00b5\u00b5 \u00b5\u00b5\u00b5\u00b5", 9, 0, 0),
            "\u00b5\u00b5\u00b5\u00b5 \u00b5\u00b5\u00b5\u00b5");  // letters count, not bytes
}

}  // namespace

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

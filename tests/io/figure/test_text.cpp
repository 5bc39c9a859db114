// SPDX-License-Identifier: Apache-2.0
#include "io/figure/canvas.hpp"

#include <gtest/gtest.h>

#include "io/figure/picture.hpp"

namespace talus::figure {
namespace {

const TextStyle style{.size = 10};

TextExtent extent(std::string_view text) {
  const Canvas canvas(10, 10, 1);
  return text_extent(canvas.context(), text, style);
}

Picture written(std::string_view text, double x, double y, Align align = Align::left) {
  const Canvas canvas(40, 20, 8);
  draw_text(canvas.context(), text, x, y, style, align);
  return decode(canvas.png());
}

/// The box of what is dark, in units.
Rectangle dark_box(const Picture& picture, double scale) {
  int left = picture.width, right = 0, top = picture.height, bottom = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (picture.at(x, y).red > 0.5) continue;
      left = std::min(left, x), right = std::max(right, x + 1), top = std::min(top, y),
      bottom = std::max(bottom, y + 1);
    }
  }
  return {left / scale, top / scale, (right - left) / scale, (bottom - top) / scale};
}

TEST(Text, MarksAddNoWidthAndStandAboveTheLetter) {
  for (const char* letter : {"v", "t", "W", "a"}) {
    const TextExtent bare = extent(letter), tilde = extent(std::string(letter) + "\xcc\x83");
    EXPECT_DOUBLE_EQ(tilde.width, bare.width);
    EXPECT_GT(tilde.ascent, bare.ascent + 0.8) << letter;
    EXPECT_NEAR(tilde.descent, bare.descent, 1e-9);
  }
}

TEST(Text, MarksAreCentredOnTheLetter) {
  for (const char* letter : {"v", "t", "W", "l"}) {
    const Rectangle bare = dark_box(written(letter, 10, 15), 8);
    const Picture with_mark = written(std::string(letter) + "\xcc\x83", 10, 15);
    Picture mark = with_mark;  // what is above the letter
    const int first_row = static_cast<int>(bare.y * 8) - 1;
    mark.height = first_row;
    mark.pixels.resize(static_cast<std::size_t>(mark.width * first_row));
    const Rectangle box = dark_box(mark, 8);
    EXPECT_GT(box.height, 0.3) << letter;
    EXPECT_NEAR(box.x + 0.5 * box.width, bare.x + 0.5 * bare.width, 0.25) << letter;
  }
}

TEST(Text, ComposedAndCombinedLettersLookTheSame) {
  EXPECT_EQ(written("ṽ", 5, 15).pixels, written("v\xcc\x83", 5, 15).pixels);
  EXPECT_EQ(written("ã", 5, 15).pixels, written("a\xcc\x83", 5, 15).pixels);
  EXPECT_NE(written("ã", 5, 15).pixels, written("a", 5, 15).pixels);
}

TEST(Text, ScriptsAreSmallerAndShifted) {
  const TextExtent plain = extent("vf"), sub = extent("v_{f}"), super = extent("v^{f}");
  EXPECT_LT(sub.width, plain.width);
  EXPECT_DOUBLE_EQ(sub.width, super.width);
  EXPECT_GT(sub.descent, plain.descent + 1);
  EXPECT_GT(super.ascent, plain.ascent + 1);
}

TEST(Text, UnderscoresAndLoneStarsStayAsTheyAre) {
  EXPECT_GT(extent("front_speed").width, extent("frontspeed").width);
  EXPECT_GT(extent("2 * 3").width, extent("2  3").width);
  EXPECT_DOUBLE_EQ(extent("*v*").width, extent("v").width);
  EXPECT_NE(written("*v*", 5, 15).pixels, written("v", 5, 15).pixels);
}

TEST(Text, IsAlignedOnThePoint) {
  EXPECT_NEAR(dark_box(written("HH", 20, 15, Align::left), 8).x, 21, 0.2);  // the letter's own bearing
  const Rectangle middle = dark_box(written("HH", 20, 15, Align::centre), 8);
  EXPECT_NEAR(middle.x + 0.5 * middle.width, 20, 0.15);
  EXPECT_NEAR(middle.bottom(), 15, 0.15);
  EXPECT_NEAR(dark_box(written("HH", 20, 15, Align::right), 8).right(), 19, 0.2);
}

/// A letter that the font lacks is drawn as the font's box: all that the labels use must differ from it.
TEST(Text, TheFontHasTheLettersOfTheLabels) {
  const Picture missing = written("\xef\xbf\xb9", 10, 15);  // U+FFF9, which no font draws as a letter
  for (const char* letter : {"θ", "φ", "μ", "ρ", "Δ", "°", "−", "×", "±", "·", "≤", "≈", "→", "²", "³", "ₕ", "√"}) {
    const Picture picture = written(letter, 10, 15);
    EXPECT_LT(dark_box(picture, 8).width, 40) << letter;
    EXPECT_GT(picture.count(ink, 0.3), 20) << letter;
    EXPECT_NE(picture.pixels, missing.pixels) << letter;
  }
}

}  // namespace
}  // namespace talus::figure

// SPDX-License-Identifier: Apache-2.0
#include "io/figure/figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "base/error.hpp"
#include "io/figure/picture.hpp"
#include "io/scratch_folder.hpp"

namespace talus::figure {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Two grains of a colour.
ParticlePicture with_grains(const Colour& colour) {
  static const std::vector<Vector3> positions = {{0, 0, 0}, {4, 1.5, 0}};
  static const std::vector<double> radii = {0.5, 0.5};
  return {.title = "*ṽ*_{f}", .positions = positions, .radii = radii, .colouring = Plain{colour}};
}

/// The columns and rows in which a colour is seen, first and last.
Rectangle where(const Picture& picture, const Colour& colour) {
  int left = picture.width, right = -1, top = picture.height, bottom = -1;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (difference(picture.at(x, y), colour) > 0.01) continue;
      left = std::min(left, x), right = std::max(right, x), top = std::min(top, y), bottom = std::max(bottom, y);
    }
  }
  return {double(left), double(top), double(right - left), double(bottom - top)};
}

TEST(Figure, HasTheSizeThatWasAskedFor) {
  const Picture picture = decode(png({.panels = {with_grains(blue)}, .width = 300, .scale = 3}));
  EXPECT_EQ(picture.width, 900);
  EXPECT_GT(picture.height, 500);
  EXPECT_LT(picture.height, 900);
}

TEST(Figure, PutsPanelsInAGrid) {
  const Picture picture = decode(
      png({.panels = {with_grains(blue), with_grains(vermillion), with_grains(green)}, .columns = 2, .width = 400}));
  const Rectangle a = where(picture, blue), b = where(picture, vermillion), c = where(picture, green);
  EXPECT_LT(a.right(), b.x);
  EXPECT_LT(a.bottom(), c.y);
  EXPECT_NEAR(a.width, b.width, 2);
  EXPECT_NEAR(a.height, b.height, 2);
  EXPECT_NEAR(a.y, b.y, 1);
  EXPECT_NEAR(a.x, c.x, 1);
}

TEST(Figure, OneColourBarAndOneKeyStandRightOfAllPanels) {
  const Figure plain{.panels = {with_grains(blue), with_grains(vermillion)}, .columns = 1, .width = 300};
  Figure with = plain;
  with.bar = ColourBar{.low = 0, .high = 1, .title = "packing"};
  with.key = ArrowKey{.label = "1 m/s", .length = 20, .colour = purple};
  const Picture alone = decode(png(plain)), both = decode(png(with));
  const Rectangle before = where(alone, blue), line = where(both, blue), key = where(both, purple),
                  brightest = where(both, colour_at(1)), other = where(both, vermillion);
  EXPECT_LT(line.right(), before.right());
  EXPECT_GT(brightest.x, std::max(line.right(), other.right()));
  EXPECT_GT(key.x, other.right());
  EXPECT_GT(key.y, brightest.bottom());
  EXPECT_NEAR(key.width, 40, 8);
}

TEST(Figure, PixelsAreThoseOfThePng) {
  const Figure figure{.panels = {with_grains(blue)}, .width = 150, .scale = 1.5};
  const Picture picture = decode(png(figure));
  const Pixels raw = pixels(figure);
  ASSERT_EQ(raw.width, picture.width);
  ASSERT_EQ(raw.height, picture.height);
  ASSERT_EQ(raw.bytes.size(), 4u * picture.pixels.size());
  for (std::size_t n = 0; n < picture.pixels.size(); ++n) {
    const auto at = [&](std::size_t k) { return static_cast<unsigned char>(raw.bytes[4 * n + k]) / 255.0; };
    ASSERT_NEAR(difference({at(2), at(1), at(0)}, picture.pixels[n]), 0, 1e-9) << n;
  }
}

TEST(Figure, NothingIsCutOffAtTheEdge) {
  const std::vector<Vector3> positions = {{0, -1e-3, 0}, {1e6, 1e5, 0}};
  const std::vector<double> radii = {1, 1}, values = {-1e-7, 1e-7};
  const ParticlePicture wide{.title = "title",
                             .positions = positions,
                             .radii = radii,
                             .colouring = ByValue{.values = values, .label = "label", .unit = {1, "unit"}}};
  const Picture picture = decode(png({.title = "a title", .panels = {wide, wide}, .width = 500}));
  for (int x = 0; x < picture.width; ++x) {
    EXPECT_EQ(picture.at(x, 1), white);
    EXPECT_EQ(picture.at(x, picture.height - 2), white);
  }
  for (int y = 0; y < picture.height; ++y) {
    EXPECT_EQ(picture.at(1, y), white);
    EXPECT_EQ(picture.at(picture.width - 2, y), white);
  }
}

TEST(Figure, SameDescriptionSameBytes) {
  const Figure figure{.panels = {with_grains(blue), with_grains(green)}};
  EXPECT_EQ(png(figure), png(figure));
}

TEST(Figure, RefusesWhatCannotBeDrawn) {
  EXPECT_THROW(png({}), std::invalid_argument);
  EXPECT_THROW(png({.panels = {with_grains(blue)}, .scale = 0}), std::invalid_argument);
  EXPECT_THROW(png({.panels = {with_grains(blue)}, .scale = 1e6}), std::invalid_argument);
}

TEST(WritePng, WritesTheFileWhole) {
  const ScratchFolder folder;
  const Figure figure{.panels = {with_grains(blue)}};
  put_content(folder / "drawn.png", "an older file");
  write_png(figure, folder / "drawn.png");
  EXPECT_EQ(content_of(folder / "drawn.png"), png(figure));
  EXPECT_THAT(names_in(folder.path()), ElementsAre("drawn.png"));
}

TEST(WritePng, FailsWithTheNameAndLeavesNothing) {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder / "taken.png");  // a folder stands where the file should
  const Figure figure{.panels = {with_grains(blue)}};
  for (const auto& path : {folder / "taken.png", folder / "missing/drawn.png"}) {
    EXPECT_THAT(message_of<FileError>([&] { write_png(figure, path); }), HasSubstr(path.string()));
  }
  EXPECT_THAT(names_in(folder.path()), ElementsAre("taken.png"));
  EXPECT_TRUE(std::filesystem::is_empty(folder / "taken.png"));
}

TEST(WritePng, KeepsTheOlderPictureWhenTheDiskIsFull) {
  const SmallDisk disk;
  if (!disk.mounted()) GTEST_SKIP() << "needs the right to mount a small disk";
  put_content(disk / "filling", std::string(1'036'000, 'x'));
  put_content(disk / "drawn.png", "old");
  EXPECT_THAT(message_of<FileError>([&] { write_png({.panels = {with_grains(blue)}}, disk / "drawn.png"); }),
              HasSubstr("No space left"));
  EXPECT_EQ(content_of(disk / "drawn.png"), "old");
  EXPECT_THAT(names_in(disk.path()), ElementsAre("drawn.png", "filling"));
}

}  // namespace
}  // namespace talus::figure

// SPDX-License-Identifier: Apache-2.0
#include "io/figure/figure.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "base/error.hpp"
#include "io/figure/picture.hpp"

namespace talus::figure {
namespace {

namespace fs = std::filesystem;

Chart with_line(const Colour& colour) {
  return {.title = "*ṽ*_{f}", .x = {"*t̃*"}, .series = {Line{.x = {0, 1}, .y = {0, 1}, .colour = colour, .width = 3}}};
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
  const Picture picture = decode(png({.panels = {with_line(blue)}, .width = 300, .scale = 3}));
  EXPECT_EQ(picture.width, 900);
  EXPECT_GT(picture.height, 500);
  EXPECT_LT(picture.height, 900);
}

TEST(Figure, PutsPanelsInAGrid) {
  const Picture picture =
      decode(png({.panels = {with_line(blue), with_line(vermillion), with_line(green)}, .columns = 2, .width = 400}));
  const Rectangle a = where(picture, blue), b = where(picture, vermillion), c = where(picture, green);
  EXPECT_LT(a.right(), b.x);
  EXPECT_LT(a.bottom(), c.y);
  EXPECT_NEAR(a.width, b.width, 2);
  EXPECT_NEAR(a.height, b.height, 2);
  EXPECT_NEAR(a.y, b.y, 1);
  EXPECT_NEAR(a.x, c.x, 1);
}

TEST(Figure, MixesCurvesAndParticles) {
  const std::vector<Vector3> positions = {{0, 0, 0}, {2, 1, 0}};
  const std::vector<double> radii = {0.5, 0.5};
  const ParticlePicture particles{.positions = positions, .radii = radii, .colouring = Plain{purple}};
  const Picture picture = decode(png({.panels = {with_line(blue), particles}}));
  EXPECT_GT(picture.count(blue), 100);
  EXPECT_GT(picture.count(purple), 1000);
}

TEST(Figure, NothingIsCutOffAtTheEdge) {
  const Chart wide{.title = "title",
                   .x = {"label", "unit"},
                   .y = {"label", "unit"},
                   .series = {Line{.x = {0, 1e6}, .y = {-1e-7, 1e-7}}}};
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
  const Figure figure{.panels = {with_line(blue), with_line(green)}};
  EXPECT_EQ(png(figure), png(figure));
}

TEST(Figure, RefusesWhatCannotBeDrawn) {
  EXPECT_THROW(png({}), std::invalid_argument);
  EXPECT_THROW(png({.panels = {with_line(blue)}, .scale = 0}), std::invalid_argument);
  EXPECT_THROW(png({.panels = {with_line(blue)}, .scale = 1e6}), std::invalid_argument);
}

TEST(WritePng, WritesTheFileWhole) {
  const fs::path folder = fs::path(testing::TempDir()) / "talus_figure_whole";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const Figure figure{.panels = {with_line(blue)}};
  std::ofstream(folder / "curve.png") << "an older file";
  write_png(figure, folder / "curve.png");
  std::ifstream file(folder / "curve.png", std::ios::binary);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), png(figure));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
  fs::remove_all(folder);
}

TEST(WritePng, FailsWithTheNameAndLeavesNothing) {
  const fs::path folder = fs::path(testing::TempDir()) / "talus_figure_fails";
  fs::remove_all(folder);
  fs::create_directories(folder / "taken.png");  // a folder stands where the file should
  const Figure figure{.panels = {with_line(blue)}};
  for (const fs::path& path : {folder / "taken.png", folder / "missing" / "curve.png"}) {
    try {
      write_png(figure, path);
      FAIL() << path;
    } catch (const FileError& error) {
      EXPECT_EQ(error.path(), path.string());
    }
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
  EXPECT_TRUE(fs::is_directory(folder / "taken.png"));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace talus::figure

// SPDX-License-Identifier: Apache-2.0
/// Walls of triangles on a grid; the flow through openings of straight walls is tested with the air.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "numerics/grid/face_apertures.hpp"

namespace talus {

namespace {

constexpr double cell = 1.25e-3;

FlowBoundaries closed_box() {
  FlowBoundaries all;
  all.kind.fill(FlowBoundary::no_slip);
  return all;
}

/// A rectangle from one corner, as two triangles.
void add_plate(std::vector<Triangle>& all, const Vector3& corner, const Vector3& u, const Vector3& v,
               std::uint32_t patch) {
  all.push_back({{corner, corner + u, corner + u + v}, patch});
  all.push_back({{corner, corner + u + v, corner + v}, patch});
}

TEST(FaceApertures, APlateOfTrianglesClosesTheFacesOfAStraightWall) {
  const Grid grid{.count = {16, 4, 32}, .low = {}, .spacing = {cell, cell, cell}};
  const Wall wall("plate", {0, 0, 15e-3}, {20e-3, 0, 15e-3}, {{7.5e-3, 12.5e-3}});
  std::vector<Triangle> plates;
  add_plate(plates, {-1e-3, -1e-3, 15e-3}, {8.5e-3, 0, 0}, {0, 7e-3, 0}, 0);
  add_plate(plates, {12.5e-3, -1e-3, 15e-3}, {8.5e-3, 0, 0}, {0, 7e-3, 0}, 0);
  const FaceApertures straight(grid, closed_box(), {wall}), triangles(grid, closed_box(), {}, Surface(plates, 1));
  EXPECT_EQ(straight.open, triangles.open);
  EXPECT_EQ(straight.link, triangles.link);
  EXPECT_EQ(straight.wide, triangles.wide);
  EXPECT_EQ(straight.wall, triangles.wall);
}

/// Number of cells that the fluid of one reaches.
std::size_t reached(const FaceApertures& apertures, std::array<int, 3> start) {
  const Grid& grid = apertures.grid;
  std::vector<bool> seen(grid.cell_field().size());
  std::vector<std::array<int, 3>> stack{start};
  std::size_t count = 0;
  while (!stack.empty()) {
    const auto at = stack.back();
    stack.pop_back();
    const std::size_t c = grid.index(at[0], at[1], at[2]);
    if (seen[c]) continue;
    seen[c] = true, ++count;
    for (std::size_t a = 0; a < 3; ++a)
      for (const int side : {0, 1}) {
        auto next = at, face = at;
        next[a] += side == 0 ? -1 : 1, face[a] += side;
        if (next[a] < 0 || next[a] >= grid.count[a]) continue;
        if (apertures.open[a][grid.index(face[0], face[1], face[2])] > 0) stack.push_back(next);
      }
  }
  return count;
}

TEST(FaceApertures, AConeOfTrianglesIsTightUntilItsLidOpens) {
  const int n = 24;
  const Grid grid{.count = {n, n, n}, .low = {}, .spacing = {cell, cell, cell}};
  const double middle = 0.5 * n * cell, low = 5.3 * cell, high = 20.7 * cell, wide = 9.1 * cell, narrow = 3.2 * cell;
  std::vector<Triangle> cone;
  const auto corner = [&](double radius, double z, int k) {
    const double angle = 2 * std::numbers::pi * k / 40;
    return Vector3{middle + radius * std::cos(angle), middle + radius * std::sin(angle), z};
  };
  for (int k = 0; k < 40; ++k) {
    cone.push_back({{corner(narrow, low, k), corner(narrow, low, k + 1), corner(wide, high, k)}, 0});
    cone.push_back({{corner(narrow, low, k + 1), corner(wide, high, k + 1), corner(wide, high, k)}, 0});
    cone.push_back({{Vector3{middle, middle, high}, corner(wide, high, k), corner(wide, high, k + 1)}, 0});
    cone.push_back({{Vector3{middle, middle, low}, corner(narrow, low, k), corner(narrow, low, k + 1)}, 1});
  }
  Surface surface(cone, 2);
  const std::array<int, 3> inside{n / 2, n / 2, n / 2};
  const FaceApertures shut(grid, closed_box(), {}, surface);
  const std::size_t within = reached(shut, inside), without = reached(shut, {0, 0, 0});
  EXPECT_EQ(within + without, static_cast<std::size_t>(n * n * n));
  const double volume =
      std::numbers::pi * (high - low) / 3 * (wide * wide + wide * narrow + narrow * narrow) / std::pow(cell, 3);
  EXPECT_NEAR(static_cast<double>(within), volume, 0.05 * volume);
  surface.set_open(1, true);
  EXPECT_EQ(reached(FaceApertures(grid, closed_box(), {}, surface), inside), static_cast<std::size_t>(n * n * n));
}

}  // namespace

namespace {

TEST(DistinctRows, HoldEachRowOnceAndAllRowsAreThoseOfTheField) {
  const Grid grid{.count = {5, 3, 7}, .low = {}, .spacing = {1, 1, 1}};
  CellField field = grid.cell_field();
  for (int k = 0; k < 7; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = -1; i < 6; ++i) field[grid.index(i, j, k)] = k < 4 ? 0 : 1 + (i == 2 && j == 1 && k == 6);
  const DistinctRows rows(grid, field);
  EXPECT_EQ(rows.count(), 3u);  // of zeros, of ones, and one with a 2
  for (int k = -Grid::margin; k < 7 + Grid::margin; ++k)
    for (int j = -Grid::margin; j < 3 + Grid::margin; ++j) {
      const std::size_t row = grid.row(j, k);
      EXPECT_EQ(rows.is_zero(row), j < 0 || j >= 3 || k < 4 || k >= 7) << j << ' ' << k;
      for (int i = -Grid::margin; i < 5 + Grid::margin; ++i)
        EXPECT_EQ(rows.at(row)[i], field[grid.index(i, j, k)]) << i << ' ' << j << ' ' << k;
    }
}

}  // namespace

}  // namespace talus

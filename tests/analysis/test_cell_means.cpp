// SPDX-License-Identifier: Apache-2.0
#include "analysis/cell_means.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace talus {
namespace {

/// Three particles: two in the first cell, one in the last, one outside; `shift` adds to all values.
PointSet three(double shift) {
  PointSet set;
  set.columns.push_back(
      {"position", "m", std::vector<Vector3>{{0.1, 0.1, 0.1}, {0.9, 0.2, 0.3}, {1.5, 0.5, 1.5}, {3, 0, 0}}});
  set.columns.push_back(
      {"velocity", "m/s", std::vector<Vector3>{{1 + shift, 0, 0}, {3 + shift, 0, 0}, {0, 0, -2}, {9, 9, 9}}});
  set.columns.push_back({"packing", "1", std::vector<double>{0.5, 0.6, 0.4, 0.1}});
  set.columns.push_back({"shear_rate", "1/s", std::vector<double>{2, 4, 1, 1}});
  const std::vector<double> diagonal{90 + shift, 110 + shift, 0, 5};
  for (const char* name : {"stress_xx", "stress_yy", "stress_zz"}) set.columns.push_back({name, "Pa", diagonal});
  for (const char* name : {"stress_xy", "stress_yz", "stress_zx"})
    set.columns.push_back({name, "Pa", std::vector<double>{0, 0, 0, 0}});
  std::get<std::vector<double>>(set.columns[7].values) = {30, 50, 0, 0};  // stress_xy
  return set;
}

TEST(CellMeans, AreOverTheParticlesOfACellAndThenOverSnapshots) {
  const CellBox box = cells_over({0, 0, 0}, {2, 1, 2}, 1);
  ASSERT_EQ(box.count, (std::array<int, 3>{2, 1, 2}));
  CellMeans means(box, 1e-3, 2500);
  means.take(three(0).view());
  means.take(three(4).view());
  const GridSnapshot grid = means.result(1.5);
  EXPECT_EQ(grid.cells(), 4u);
  EXPECT_NEAR(grid.vectors("velocity")[0].x, 4, 1e-12);  // 2 and 6
  EXPECT_NEAR(grid.scalars("velocity_deviation")[0], std::sqrt(8.0), 1e-12);
  EXPECT_NEAR(grid.scalars("packing")[0], 0.55, 1e-12);
  EXPECT_NEAR(grid.scalars("packing_deviation")[0], 0, 1e-7);
  EXPECT_NEAR(grid.scalars("pressure")[0], 102, 1e-12);
  EXPECT_NEAR(grid.scalars("pressure_deviation")[0], std::sqrt(8.0), 1e-9);
  EXPECT_NEAR(grid.scalars("shear_stress")[0], 40, 1e-12);
  const double inertial = 0.5 * 3 * 1e-3 * (std::sqrt(2500.0 / 100) + std::sqrt(2500.0 / 104));
  EXPECT_NEAR(grid.scalars("inertial_number")[0], inertial, 1e-12);
  EXPECT_EQ(grid.vectors("velocity")[3], (Vector3{0, 0, -2}));
  EXPECT_EQ(grid.scalars("filled")[0], 1);
  EXPECT_EQ(grid.scalars("filled")[1], 0);
  EXPECT_EQ(grid.scalars("pressure")[1], 0);
}

TEST(CellMeans, ACellThatEmptiesCountsOnlyWhileItIsFilled) {
  CellMeans means(cells_over({0, 0, 0}, {2, 1, 2}, 1), 1e-3, 2500);
  means.take(three(0).view());
  PointSet away = three(0);
  std::get<std::vector<Vector3>>(away.columns[0].values)[2] = {9, 9, 9};
  means.take(away.view());
  const GridSnapshot grid = means.result(0);
  EXPECT_EQ(grid.scalars("filled")[3], 0.5);
  EXPECT_EQ(grid.vectors("velocity")[3].z, -2);
  EXPECT_EQ(grid.scalars("packing")[3], 0.4);
}

}  // namespace
}  // namespace talus

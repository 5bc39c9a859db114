// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/report/report.hpp"

namespace talus::app {
namespace {

using testing::ElementsAre;

TEST(ThinnedSeries, LeavesAShortOneAsItIs) {
  const Series table{.names = {"time", "a"}, .units = {"s", "m"}, .columns = {{0, 1, 2}, {5, 4, 6}}};
  EXPECT_EQ(thinned(table, 3).columns, table.columns);
}

TEST(ThinnedSeries, KeepsTheExtremesOfEveryStretchInTheirOrder) {
  Series table{.names = {"time", "a"}, .units = {"s", "m"}, .columns = {{}, {}}};
  for (int n = 0; n < 1000; ++n) {
    table.columns[0].push_back(n);
    table.columns[1].push_back(std::sin(0.7 * n));
  }
  table.columns[1][123] = 50;
  table.columns[1][124] = -50;
  table.columns[1][500] = std::nan("");
  const Series thin = thinned(table, 100);
  EXPECT_EQ(thin.rows(), 100);
  EXPECT_TRUE(std::is_sorted(thin.columns[0].begin(), thin.columns[0].end()));
  const auto peak = std::find(thin.columns[1].begin(), thin.columns[1].end(), 50);
  ASSERT_NE(peak, thin.columns[1].end());
  EXPECT_EQ(*(peak + 1), -50);
  EXPECT_TRUE(std::none_of(thin.columns[1].begin(), thin.columns[1].end(), [](double v) { return std::isnan(v); }));
}

TEST(ForcesOnWalls, AreTheRatesOfTheImpulses) {
  Series series{.names = {"time", "impulse_gravity_x", "impulse_floor_x", "impulse_floor_y", "impulse_floor_z"},
                .units = {"s", "N s", "N s", "N s", "N s"},
                .columns = {{}, {}, {}, {}, {}}};
  for (int n = 0; n <= 1000; ++n) {
    const double t = 1e-3 * n;
    const std::vector<double> row = {t, 3 * t, 0, 0, -2 * t};
    for (std::size_t c = 0; c < row.size(); ++c) series.columns[c].push_back(row[c]);
  }
  const Series forces = forces_on_walls(series);
  EXPECT_THAT(forces.names, ElementsAre("time", "force_floor_z"));  // gravity is no wall; no force is left out
  for (const double f : forces.columns[1]) EXPECT_NEAR(f, -2, 1e-9);
  EXPECT_EQ(forces_on_walls({}).rows(), 0);
}

TEST(Evenly, ChoosesTheFirstAndTheLast) {
  EXPECT_THAT(evenly(5, 100), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(evenly(101, 3), ElementsAre(0, 50, 100));
  EXPECT_THAT(evenly(1, 100), ElementsAre(0));
  EXPECT_TRUE(evenly(0, 100).empty());
}

}  // namespace
}  // namespace talus::app

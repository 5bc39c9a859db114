// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <stdexcept>

#include "base/error.hpp"
#include "io/scratch_folder.hpp"
#include "io/vtkhdf.hpp"

namespace talus {
namespace {

GridSnapshot sample() {
  GridSnapshot grid{.time = 0.25,
                    .step = 17,
                    .count = {3, 1, 2},
                    .low = {0, -1, 2},
                    .spacing = {0.5, 1, 0.25},
                    .columns = {{"pressure", "Pa", std::vector<double>{1, 2, 3, 4, 5, 6}}}};
  std::vector<Vector3> velocity;
  for (int c = 0; c < 6; ++c) velocity.push_back({1.0 * c, -2.0 * c, 0.5});
  grid.columns.push_back({"velocity", "m/s", velocity});
  return grid;
}

TEST(VtkHdfGrid, ReadsBackWhatWasWritten) {
  const ScratchFolder folder;
  const GridSnapshot written = sample();
  write_grid(folder / "a.vtkhdf", written);
  const GridSnapshot read = read_grid(folder / "a.vtkhdf");
  EXPECT_EQ(read.time, written.time);
  EXPECT_EQ(read.step, written.step);
  EXPECT_EQ(read.count, written.count);
  EXPECT_EQ(read.low, written.low);
  EXPECT_EQ(read.spacing, written.spacing);
  EXPECT_EQ(read.scalars("pressure"), written.scalars("pressure"));
  EXPECT_EQ(read.vectors("velocity"), written.vectors("velocity"));
  EXPECT_EQ(read.columns[1].unit, "m/s");
  EXPECT_EQ(read_points_time(folder / "a.vtkhdf"), 0.25);  // as the index of snapshots asks
}

TEST(VtkHdfGrid, RefusesColumnsThatDoNotFitAndFilesOfAnotherKind) {
  const ScratchFolder folder;
  GridSnapshot grid = sample();
  grid.columns.push_back({"short", "1", std::vector<double>{1}});
  EXPECT_THROW(write_grid(folder / "a.vtkhdf", grid), std::invalid_argument);
  const PointSet points{.time = 0, .step = 0, .columns = {{"position", "m", std::vector<Vector3>{{1, 2, 3}}}}};
  write_points(folder / "p.vtkhdf", points.view());
  EXPECT_THROW(read_grid(folder / "p.vtkhdf"), FileError);
}

TEST(GridSnapshot, FindsCellsAndColumns) {
  const GridSnapshot grid = sample();
  EXPECT_EQ(grid.cell_at(0, 0.6), 1);
  EXPECT_EQ(grid.cell_at(2, 2.3), 1);
  EXPECT_EQ(grid.cell_at(2, 99), 1);
  EXPECT_EQ(grid.centre(2, 0, 1), (Vector3{1.25, -0.5, 2.375}));
  EXPECT_THROW(grid.scalars("velocity"), std::out_of_range);
}

}  // namespace
}  // namespace talus

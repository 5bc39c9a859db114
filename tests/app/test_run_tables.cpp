// SPDX-License-Identifier: Apache-2.0
#include "app/case/run_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <span>
#include <vector>

#include "io/scratch_folder.hpp"

namespace talus::app {
namespace {

using ::testing::ElementsAre;

TEST(ChosenSnapshots, SpanTheRunFromTheOpeningToItsEnd) {
  std::vector<double> time;
  for (int n = -2; n <= 6; ++n) time.push_back(0.1 * n);
  EXPECT_THAT(chosen_snapshots(time, 4), ElementsAre(2, 4, 6, 8)) << "0, 0.2, 0.4 and 0.6 s";
  EXPECT_THAT(chosen_snapshots(time, 2), ElementsAre(2, 8));
  EXPECT_THAT(chosen_snapshots({-0.3, -0.2, -0.1}, 3), ElementsAre(0, 1, 2)) << "a gate that never opens";
  EXPECT_THAT(chosen_snapshots({0, 1}, 4), ElementsAre(0, 1)) << "each once";
  EXPECT_TRUE(chosen_snapshots({}, 4).empty());
}

struct Sample {
  using Snapshot = double;
  SnapshotNumbers<double> snapshots;
};

TEST(SnapshotTable, LoadsEachSnapshotOnceHoweverFewAreKept) {
  std::vector<std::size_t> loaded;
  const auto load = [&](std::size_t n) {
    loaded.push_back(n);
    return std::make_shared<const double>(static_cast<double>(n));
  };
  const Sample run{SnapshotNumbers<double>::of({0.0, 0.1, 0.2, 0.3, 0.4}, load, 2)};
  const auto row = [](const char* name, double (*number)(const double&)) {
    return Measure<Sample>(name, "1", "a number of a snapshot", Estimator<Sample>{.of = {}, .number = number}, {});
  };
  const std::vector<Measure<Sample>> measures{row("same", [](const double& n) { return n; }),
                                              row("twice", [](const double& n) { return 2 * n; }),
                                              row("square", [](const double& n) { return n * n; })};
  const ScratchFolder folder;
  write_snapshots(folder / "snapshots.csv", run, std::span<const Measure<Sample>>(measures), "s");
  EXPECT_THAT(loaded, ElementsAre(0, 1, 2, 3, 4));
  const Series table = read_series(folder / "snapshots.csv");
  EXPECT_THAT(table.column("square"), ElementsAre(0, 1, 4, 9, 16));
}

}  // namespace
}  // namespace talus::app

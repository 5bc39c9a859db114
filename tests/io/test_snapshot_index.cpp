// SPDX-License-Identifier: Apache-2.0
#include "io/snapshot_index.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "io/scratch_folder.hpp"
#include "io/vtkhdf.hpp"

namespace talus {
namespace {

class SnapshotIndex : public ::testing::Test {
 protected:
  void write(int number, double time) const {
    const PointSet points{.time = time, .columns = {{"position", "m", std::vector<Vector3>{{1, 2, 3}}}}};
    write_points(folder_.snapshot(number), points.view());
  }
  nlohmann::json index() const { return nlohmann::json::parse(content_of(folder_.snapshot_index())); }

  const ScratchFolder scratch_;
  const RunFolder folder_ = RunFolder::create(scratch_ / "run", Existing::refuse);
};

const auto first_two = nlohmann::json::parse(R"({"file-series-version": "1.0", "files": [
  {"name": "particles_0000.vtkhdf", "time": 0.0}, {"name": "particles_0001.vtkhdf", "time": 0.1}]})");

TEST_F(SnapshotIndex, GrowsWithTheSnapshots) {
  write(0, 0);
  index_snapshots(folder_, 0);
  EXPECT_EQ(index()["files"].size(), 1u);
  write(1, 0.1);
  index_snapshots(folder_, 1);
  EXPECT_EQ(index(), first_two);
}

TEST_F(SnapshotIndex, LeavesOutWhatAResumedRunWillReplaceAndTakesItsNewTime) {
  for (const int number : {0, 1, 2, 3}) write(number, 7 + number);
  index_snapshots(folder_, 3);
  EXPECT_EQ(index()["files"][3]["time"], 10.0);
  write(1, 0.5);
  index_snapshots(folder_, 1);
  ASSERT_EQ(index()["files"].size(), 2u);
  EXPECT_EQ(index()["files"][0]["time"], 7.0);
  EXPECT_EQ(index()["files"][1]["time"], 0.5);
}

TEST_F(SnapshotIndex, IsMadeAnewWhereItIsMissingOrDamaged) {
  write(0, 0);
  write(1, 0.1);
  index_snapshots(folder_, 1);
  for (const char* damage : {"", "{\"files\": [", "{}", R"({"files": [{"name": "particles_0000.vtkhdf"}]})"}) {
    put_content(folder_.snapshot_index(), damage);
    index_snapshots(folder_, 1);
    EXPECT_EQ(index(), first_two) << damage;
  }
  std::filesystem::remove(folder_.snapshot_index());
  index_snapshots(folder_, 1);
  EXPECT_EQ(index(), first_two);
}

TEST_F(SnapshotIndex, ReadsNoSnapshotWhoseTimeItKnows) {
  write(0, 0);
  index_snapshots(folder_, 0);
  put_content(folder_.snapshot(0), "no longer a snapshot");
  write(1, 0.1);
  index_snapshots(folder_, 1);
  EXPECT_EQ(index(), first_two);
}

}  // namespace
}  // namespace talus

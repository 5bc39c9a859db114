// SPDX-License-Identifier: Apache-2.0
#include "run/snapshot_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "io/checkpoint.hpp"
#include "io/scratch_folder.hpp"
#include "run/loop.hpp"

namespace talus::run {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A particle that moves by 0.01 m a step of 0.01 s.
class Moving final : public AnyModel {
 public:
  double time() const override { return time_; }
  std::uint64_t step() const override { return step_; }
  double time_origin() const override { return 0; }
  double latest_origin() const override { return 0; }
  NumericalError::Report step_limit() const override { return {}; }
  void begin(ThreadTeam&) override {}
  void advance(ThreadTeam&) override { ++step_, time_ += 1e-2, position_[0].x += 1e-2; }
  Snapshot snapshot() const override {
    return {.time = time_, .step = step_, .columns = {{"position", "m", std::span<const Vector3>(position_)}}};
  }
  PointSource stored() const override { return source_of(snapshot()); }
  std::optional<GridSnapshot> grid() const override { return std::nullopt; }
  std::optional<SurfaceSnapshot> walls() const override { return std::nullopt; }
  std::vector<NamedValue> totals() const override { return {{"x", "m", position_[0].x}}; }
  std::vector<RegimeLine> regime(const RunRecord&) const override { return {}; }
  void save(CheckpointWriter& checkpoint) const override {
    checkpoint.put("state/time", time_);
    checkpoint.put("state/step", step_);
  }
  void read(const CheckpointReader& checkpoint) override {
    checkpoint.get("state/time", time_);
    checkpoint.get("state/step", step_);
    position_[0].x = 1e-2 * static_cast<double>(step_);
  }
  using AnyModel::resume;
  void resume(ThreadTeam&) override {}

 private:
  double time_ = 0;
  std::uint64_t step_ = 0;
  std::vector<Vector3> position_ = {Vector3{}};
};

class WrittenRun : public ::testing::Test {
 protected:
  /// Snapshots 0 to 3 are counted, at 0, 0.3, 0.6 and 0.9 s; number 4 is that of the end, 1 s.
  WrittenRun() {
    std::filesystem::create_directories(folder_ / "snapshots");
    go(false);
  }
  void go(bool resume) {
    Moving model;
    ThreadTeam team(1);
    run_loop(model, team, folder_.path(), {.end = 1, .snapshot_interval = 0.3, .resume = resume}, {});
  }
  FilesFound compare(bool ended = true) const {
    return compare_files(RunFolder(folder_.path()), CheckpointFiles(folder_.path()).load().value(), ended);
  }
  void turn_a_bit(const std::string& name, std::size_t place) const {
    std::string content = content_of(folder_ / name);
    content.at(place) = static_cast<char>(content.at(place) ^ 4);
    put_content(folder_ / name, content);
  }

  ScratchFolder folder_;
};

TEST_F(WrittenRun, IsWhatItWrote) {
  const FilesFound found = compare();
  EXPECT_TRUE(found.has_sums);
  EXPECT_EQ(found.compared, 6u);  // the series and five snapshots
  EXPECT_THAT(found.changed, IsEmpty());
  EXPECT_THAT(found.missing, IsEmpty());
  EXPECT_EQ(compare(false).compared, 5u);
}

TEST_F(WrittenRun, ATurnedBitIsFoundWhereverItIs) {
  for (const char* name : {"series.csv", "snapshots/particles_0002.vtkhdf"}) {
    const std::string whole = content_of(folder_ / name);
    for (std::size_t place = 0; place < whole.size(); place += 97) {
      turn_a_bit(name, place);
      try {
        EXPECT_THAT(compare().changed, ElementsAre(HasSubstr(name))) << place;
      } catch (const FileError& error) {  // a row less, by a line end that is gone
        EXPECT_THAT(error.what(), HasSubstr("whole rows"));
      }
      put_content(folder_ / name, whole);
    }
  }
  EXPECT_THAT(compare().changed, IsEmpty());
}

TEST_F(WrittenRun, TheLastStateIsComparedOnceTheRunHasEnded) {
  turn_a_bit("snapshots/particles_0004.vtkhdf", 3000);
  EXPECT_THAT(compare(true).changed, ElementsAre(HasSubstr("particles_0004.vtkhdf: its checksum is ")));
  EXPECT_THAT(compare(false).changed, IsEmpty());
}

TEST_F(WrittenRun, RowsBehindTheCheckpointCountForNothing) {
  put_content(folder_ / "series.csv", content_of(folder_ / "series.csv") + "1,2");
  EXPECT_THAT(compare(false).changed, IsEmpty());
  EXPECT_THAT(compare(true).changed, ElementsAre(HasSubstr("series.csv"))) << "none does once the run has ended";
}

TEST_F(WrittenRun, WhatIsMissingIsNamed) {
  std::filesystem::remove(folder_ / "snapshots/particles_0001.vtkhdf");
  EXPECT_THAT(compare().missing, ElementsAre(HasSubstr("particles_0001.vtkhdf")));
}

TEST_F(WrittenRun, ADamagedIndexIsMadeAnewFromTheSnapshots) {
  const std::string index = "snapshots/particles.hdf.series";
  const std::string whole = content_of(folder_ / index);
  std::string changed = whole;
  changed.replace(changed.find("0.3"), 3, "0.7");  // another time, and well formed
  put_content(folder_ / index, changed);
  go(true);
  EXPECT_EQ(content_of(folder_ / index), whole);
  EXPECT_THAT(compare().changed, IsEmpty());
}

}  // namespace
}  // namespace talus::run

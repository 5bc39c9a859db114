// SPDX-License-Identifier: Apache-2.0
#include "run/loop.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "io/run_folder.hpp"
#include "io/scratch_folder.hpp"
#include "io/series.hpp"

namespace talus::run {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

/// A particle that falls; the length of each step is what the test says.
class Falling final : public AnyModel {
 public:
  using Steps = std::function<double(std::uint64_t step)>;
  explicit Falling(Steps steps, double origin = 0) : steps_(std::move(steps)), origin_(origin) {}

  double time() const override { return time_; }
  std::uint64_t step() const override { return step_; }
  double time_origin() const override { return time_ >= origin_ ? origin_ : std::numeric_limits<double>::infinity(); }
  double latest_origin() const override { return origin_; }
  NumericalError::Report step_limit() const override {
    return {.what = {}, .term = "the test", .place = "particle 0", .step = 0, .time = 0, .advice = "longer steps"};
  }
  void begin(ThreadTeam&) override { position_ = {Vector3{}}; }
  void advance(ThreadTeam&) override {
    const double dt = steps_(step_++);
    time_ += dt;
    position_[0].z -= dt;
  }
  Snapshot snapshot() const override {
    return {.time = time_, .step = step_, .columns = {{"position", "m", std::span<const Vector3>(position_)}}};
  }
  PointSource stored() const override { return source_of(snapshot()); }
  std::optional<GridSnapshot> grid() const override { return std::nullopt; }
  std::optional<SurfaceSnapshot> walls() const override { return std::nullopt; }
  std::vector<NamedValue> totals() const override { return {{"z", "m", position_[0].z}}; }
  std::vector<RegimeLine> regime(const RunRecord&) const override { return {}; }
  void save(CheckpointWriter& checkpoint) const override {
    checkpoint.put("state/time", time_);
    checkpoint.put("state/step", step_);
    checkpoint.put("state/position", position_);
  }
  void read(const CheckpointReader& checkpoint) override {
    checkpoint.get("state/time", time_);
    checkpoint.get("state/step", step_);
    checkpoint.get("state/position", position_);
  }
  using AnyModel::resume;
  void resume(ThreadTeam&) override {}

 private:
  Steps steps_;
  double origin_;
  double time_ = 0;
  std::uint64_t step_ = 0;
  std::vector<Vector3> position_;
};

LoopResult loop(const std::filesystem::path& folder, Falling::Steps steps, LoopOptions options, double origin = 0) {
  std::filesystem::create_directories(folder / "snapshots");
  Falling model(std::move(steps), origin);
  ThreadTeam team(1);
  if (options.snapshot_interval == 0) options.snapshot_interval = 1;
  return run_loop(model, team, folder, options, {});
}

Falling::Steps shorter_from(std::uint64_t begin, double factor, std::uint64_t count = 1000000) {
  return [=](std::uint64_t step) { return step >= begin && step < begin + count ? 1e-2 / factor : 1e-2; };
}

TEST(Loop, StopsWhenTheStepHasFallenAndSaysWhy) {
  const ScratchFolder folder;
  const auto said = message_of<NumericalError>([&] { loop(folder / "a", shorter_from(20, 101), {.end = 10}); });
  EXPECT_THAT(said, HasSubstr("the time step has fallen from 0.01 s to 9.9e-05 s, 100 steps in a row"));
  EXPECT_THAT(said, HasSubstr("(the test) at particle 0, step 120, "));
  EXPECT_THAT(said, HasSubstr("try: longer steps"));
  // It has not fallen by so much, or not for so long, or its phase began so.
  EXPECT_GT(loop(folder / "b", shorter_from(20, 99), {.end = 0.25}).steps, 500u);
  EXPECT_FALSE(loop(folder / "c", shorter_from(20, 1e4, 99), {.end = 1}).interrupted);
  EXPECT_FALSE(loop(folder / "d", shorter_from(20, 1000), {.end = 0.01}, 0.2 - 1e-9).interrupted);
}

TEST(Loop, AResumedRunStopsAtTheSameStep) {
  const ScratchFolder folder;
  LoopOptions options{.end = 10, .checkpoint_interval = 1e-9};
  const auto stopped = [&](const char* name, const LoopOptions& how) {
    return message_of<NumericalError>([&] { loop(folder / name, shorter_from(20, 200), how); });
  };
  const std::string whole = stopped("whole", options);
  // Up to a step within the fall, then on.
  options.end = 0.2 + 50 * 5e-5;
  loop(folder / "r", shorter_from(20, 200), options);
  options.end = 10;
  options.resume = true;
  EXPECT_EQ(stopped("r", options), whole);
}

TEST(Loop, ALaterEndGoesOnAsIfItHadBeenTheFirst) {
  const ScratchFolder folder;
  const auto steps = [](std::uint64_t step) { return 1e-2 * (1 + 0.3 * std::sin(static_cast<double>(step))); };
  LoopOptions options{.end = 2, .snapshot_interval = 0.3};
  loop(folder / "whole", steps, options);
  options.end = 1;
  loop(folder / "r", steps, options);
  EXPECT_EQ(RunFolder(folder / "r").snapshot_numbers().back(), 4);
  options.end = 2;
  options.resume = true;
  loop(folder / "r", steps, options);
  loop(folder / "r", steps, options);  // nothing is left to do
  for (const char* name : {"series.csv", "snapshots/particles.hdf.series", "snapshots/particles_0004.vtkhdf",
                           "snapshots/particles_0007.vtkhdf"})
    EXPECT_EQ(content_of(folder / "r" / name), content_of(folder / "whole" / name)) << name;
  EXPECT_EQ(names_in(folder / "r/snapshots"), names_in(folder / "whole/snapshots"));
}

TEST(Loop, TheLastRowIsOfTheEndUntilALaterOne) {
  const ScratchFolder folder;
  const auto steps = [](std::uint64_t) { return 1e-2; };
  LoopOptions options{.end = 2, .series_interval = 0.3};
  loop(folder / "whole", steps, options);
  options.end = 1;
  loop(folder / "r", steps, options);
  const auto times = read_series(folder / "r/series.csv").column("time");
  EXPECT_THAT(std::vector<double>(times.begin(), times.end()), SizeIs(5u)) << "0, 0.3, 0.6, 0.9 s and the end";
  EXPECT_NEAR(times.back(), 1, 1.1e-2);
  const std::string ended = content_of(folder / "r/series.csv");
  options.resume = true;
  loop(folder / "r", steps, options);
  EXPECT_EQ(content_of(folder / "r/series.csv"), ended) << "nothing is left to do";
  options.end = 2;
  loop(folder / "r", steps, options);
  EXPECT_EQ(content_of(folder / "r/series.csv"), content_of(folder / "whole/series.csv"));
}

TEST(Loop, LogsTheWayNowAndThen) {
  const ScratchFolder folder;
  std::vector<std::string> lines;
  const auto slow = [](std::uint64_t) {
    timespec pause{0, 4'000'000};
    nanosleep(&pause, nullptr);
    return 1e-2;
  };
  loop(folder / "a", slow,
       {.end = 4, .headline = {.column = "z", .name = "fall", .is_rate = true}, .log = [&](const std::string& line) {
          lines.push_back(line);
        }});
  ASSERT_THAT(lines, SizeIs(::testing::Ge(1u)));
  EXPECT_THAT(lines, SizeIs(::testing::Le(10u)));
  EXPECT_THAT(lines.back(), HasSubstr(" of 4 s  step "));
  EXPECT_THAT(lines.back(), HasSubstr(" %  ETA "));
}

}  // namespace
}  // namespace talus::run

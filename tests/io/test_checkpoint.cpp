// SPDX-License-Identifier: Apache-2.0
#include "io/checkpoint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "base/error.hpp"
#include "io/scratch_folder.hpp"
#include "numerics/field.hpp"

namespace talus {

namespace pebbles {  // a model's state, as a model lists it

struct State {
  double time = 0.1;
  std::uint64_t step = UINT64_MAX;
  std::vector<Vector3> position{{1.0 / 3, -0.0, 3}, {4, 5, 6}};
  std::vector<double> radius{0.005, 0x1.0p-1074};
  std::vector<double> speed{7, 8};
  std::vector<std::int64_t> order{INT64_MIN, 9007199254740993};
  std::vector<Vector3> mode;  // not known yet
};

template <class Visit, class S>
void for_each_field(Visit&& visit, S& s) {
  visit(FieldInfo{"time", "s"}, s.time);
  visit(FieldInfo{"step", "1"}, s.step);
  visit(FieldInfo{"position", "m"}, s.position);
  visit(FieldInfo{"radius", "m"}, s.radius);
  visit(FieldInfo{"speed", "m/s", FieldRole::derived}, s.speed);
  visit(FieldInfo{"order", "1", FieldRole::kept, false}, s.order);
  visit(FieldInfo{"mode", "1", FieldRole::kept, false}, s.mode);
}

}  // namespace pebbles

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

CheckpointWriter checkpoint_of(const pebbles::State& state, const std::string& fingerprint = "f00d") {
  CheckpointWriter writer(fingerprint);
  for_each_field(writer, state);
  writer.put("run/rows", std::uint64_t{42});
  writer.put("run/phase", std::string("settle"));
  return writer;
}

/// Two checkpoints of steps 1 and 2; the second is the newest.
void save_two(const std::filesystem::path& folder) {
  CheckpointFiles files(folder);
  for (const std::uint64_t step : {1, 2}) {
    pebbles::State state;
    state.step = step;
    files.save(checkpoint_of(state));
  }
}

std::uint64_t step_loaded(const std::filesystem::path& folder) {
  pebbles::State state;
  for_each_field(*CheckpointFiles(folder).load(), state);
  return state.step;
}

TEST(SnapshotOf, HoldsTheColumnsForSnapshotsAndTheTime) {
  const pebbles::State state;
  const Snapshot snapshot = snapshot_of(state);
  EXPECT_EQ(snapshot.time, 0.1);
  EXPECT_EQ(snapshot.step, UINT64_MAX);
  ASSERT_THAT(snapshot.columns, SizeIs(3));
  EXPECT_EQ(snapshot.positions().data(), state.position.data());
  EXPECT_EQ(snapshot.scalars("speed").data(), state.speed.data());
  EXPECT_EQ(snapshot.columns[2].unit, "m/s");
  EXPECT_FALSE(snapshot.has("order"));
}

TEST(Checkpoint, BringsBackKeptFieldsBitForBitAndLeavesDerivedOnes) {
  const ScratchFolder folder;
  const pebbles::State saved;
  CheckpointFiles(folder.path()).save(checkpoint_of(saved));

  pebbles::State state{
      .time = 9, .step = 9, .position = {}, .radius = {1, 2, 3}, .speed = {-1}, .order = {}, .mode = {{}}};
  const auto reader = CheckpointFiles(folder.path()).load();
  ASSERT_TRUE(reader);
  for_each_field(*reader, state);
  EXPECT_EQ(state.time, saved.time);
  EXPECT_EQ(state.step, saved.step);
  ASSERT_THAT(state.position, SizeIs(2));
  EXPECT_EQ(std::memcmp(state.position.data(), saved.position.data(), sizeof(Vector3) * 2), 0);
  EXPECT_EQ(state.radius, saved.radius);
  EXPECT_EQ(state.order, saved.order);
  EXPECT_THAT(state.mode, SizeIs(0));
  EXPECT_THAT(state.speed, ElementsAre(-1));

  EXPECT_EQ(reader->fingerprint(), "f00d");
  std::uint64_t rows = 0;
  std::string phase;
  reader->get("run/rows", rows);
  reader->get("run/phase", phase);
  EXPECT_EQ(rows, 42u);
  EXPECT_EQ(phase, "settle");
  EXPECT_FALSE(reader->has("state/speed"));
  EXPECT_FALSE(reader->has("nothing/here"));
}

TEST(Checkpoint, AlternatesAndLoadsTheNewest) {
  const ScratchFolder folder;
  EXPECT_FALSE(CheckpointFiles(folder.path()).load());
  for (std::uint64_t step = 1; step <= 5; ++step) {
    CheckpointFiles files(folder.path());  // again each time, as resumed runs do
    const std::string before = content_of(folder / (step % 2 ? "checkpoint_b.h5" : "checkpoint_a.h5"));
    pebbles::State state;
    state.step = step;
    files.save(checkpoint_of(state));
    EXPECT_EQ(content_of(folder / (step % 2 ? "checkpoint_b.h5" : "checkpoint_a.h5")), before) << step;
    EXPECT_EQ(step_loaded(folder.path()), step);
    EXPECT_EQ(files.load()->sequence(), step);
  }
  EXPECT_THAT(names_in(folder.path()), ElementsAre("checkpoint_a.h5", "checkpoint_b.h5"));
}

TEST(Checkpoint, NoTurnedBitGoesUnnoticed) {
  const ScratchFolder folder;
  save_two(folder.path());
  const std::string whole = content_of(folder / "checkpoint_b.h5");
  // Every bit of the first lines, and one bit of every 97th byte of the rest; the padding between them says nothing.
  const std::size_t lines = whole.find('\0');
  ASSERT_LT(lines, 512u);
  std::fstream file(folder / "checkpoint_b.h5", std::ios::binary | std::ios::in | std::ios::out);
  const auto put = [&](std::size_t byte, int value) {
    file.seekp(static_cast<std::streamoff>(byte));
    file.put(static_cast<char>(value)).flush();
  };
  std::size_t noticed = 0, turned = 0;
  for (std::size_t byte = 0; byte < whole.size(); byte += byte < lines ? 1 : 97) {
    if (byte >= lines && byte < 512) continue;
    for (int bit = 0; bit < 8; ++bit) {
      if (byte >= lines && bit != static_cast<int>(byte % 8)) continue;
      put(byte, whole[byte] ^ (1 << bit));
      noticed += CheckpointFiles(folder.path()).damages().size() == 1;
      ++turned;
    }
    put(byte, whole[byte]);
  }
  EXPECT_GT(turned, 500u);
  EXPECT_EQ(noticed, turned);
  EXPECT_EQ(step_loaded(folder.path()), 2u);
  put(whole.size() / 2, ~whole[whole.size() / 2]);
  EXPECT_EQ(step_loaded(folder.path()), 1u);
}

TEST(Checkpoint, AnyTruncationFallsBackToTheOtherAndTheNextReplacesIt) {
  const ScratchFolder folder;
  save_two(folder.path());
  const std::string whole = content_of(folder / "checkpoint_b.h5");
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{10}, std::size_t{60}, std::size_t{512}, std::size_t{1000}, whole.size() - 1}) {
    put_content(folder / "checkpoint_b.h5", whole.substr(0, size));
    EXPECT_THAT(CheckpointFiles(folder.path()).damages(), ElementsAre(HasSubstr("checkpoint_b.h5: "))) << size;
    EXPECT_EQ(step_loaded(folder.path()), 1u) << size;
  }
  const std::string older = content_of(folder / "checkpoint_a.h5");
  pebbles::State state;
  state.step = 3;
  CheckpointFiles(folder.path()).save(checkpoint_of(state));
  EXPECT_EQ(content_of(folder / "checkpoint_a.h5"), older);
  EXPECT_EQ(step_loaded(folder.path()), 3u);
  EXPECT_THAT(CheckpointFiles(folder.path()).damages(), ElementsAre());
}

TEST(Checkpoint, SaysSoIfNoneIsWhole) {
  const ScratchFolder folder;
  save_two(folder.path());
  put_content(folder / "checkpoint_a.h5", "Talus checkpoint\nformat 2\n");
  put_content(folder / "checkpoint_b.h5", content_of(folder / "checkpoint_b.h5").substr(0, 700));
  const std::string message = message_of<FileError>([&] { CheckpointFiles(folder.path()).load(); });
  EXPECT_THAT(message, HasSubstr("holds no whole checkpoint: "));
  EXPECT_THAT(message, HasSubstr("checkpoint_a.h5: has format 2, this program reads 1"));
  EXPECT_THAT(message, HasSubstr("checkpoint_b.h5: is 700 bytes long in place of "));
}

TEST(Checkpoint, NamesAMissingOrChangedEntry) {
  const ScratchFolder folder;
  CheckpointFiles(folder.path()).save(checkpoint_of({}));
  const auto reader = CheckpointFiles(folder.path()).load();
  std::vector<Vector3> vectors;
  std::vector<double> scalars;
  double number = 0;
  EXPECT_THAT(message_of<FileError>([&] { reader->get("state/spin", vectors); }),
              HasSubstr("checkpoint_a.h5: holds no 'state/spin'"));
  EXPECT_THAT(message_of<FileError>([&] { reader->get("state/radius", vectors); }), HasSubstr("of another kind"));
  EXPECT_THAT(message_of<FileError>([&] { reader->get("state/position", scalars); }), HasSubstr("of another kind"));
  EXPECT_THAT(message_of<FileError>([&] { reader->get("state/step", number); }), HasSubstr("of another kind"));
  CheckpointWriter writer("f00d");
  writer.put("run/rows", 1.0);
  EXPECT_THAT(message_of<FileError>([&] { writer.put("run/rows", 2.0); }), HasSubstr("cannot write 'run/rows'"));
}

}  // namespace
}  // namespace talus

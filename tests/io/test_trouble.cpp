// SPDX-License-Identifier: Apache-2.0
// What befalls a run's files: a disk that fills up, a folder that cannot be written, a kill at any moment.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <optional>
#include <thread>

#include "base/error.hpp"
#include "io/checkpoint.hpp"
#include "io/run_folder.hpp"
#include "io/run_json.hpp"
#include "io/scratch_folder.hpp"
#include "io/series.hpp"
#include "io/vtkhdf.hpp"

namespace talus {
namespace {

using ::testing::Contains;
using ::testing::EndsWith;
using ::testing::Not;

constexpr std::size_t count = 1000;
const std::vector<SeriesColumn> series_columns{{"step", "1"}, {"third", "1"}};

/// A state that follows from its step, so that a mixture of two shows.
std::vector<double> column_of(std::uint64_t step) {
  std::vector<double> column(count);
  for (std::size_t i = 0; i < count; ++i) column[i] = static_cast<double>(step) + static_cast<double>(i) / 7;
  return column;
}

std::vector<Vector3> positions_of(std::uint64_t step) {
  std::vector<Vector3> position;
  for (const double x : column_of(step)) position.push_back({x, -x, 2 * x});
  return position;
}

CheckpointWriter checkpoint_of(std::uint64_t step) {
  CheckpointWriter writer("f00d");
  writer.put("step", step);
  writer.put("position", positions_of(step));
  return writer;
}

/// \returns the checkpoint's step, after a comparison of all of it
std::uint64_t verified_step(const CheckpointReader& reader) {
  std::uint64_t step = 0;
  std::vector<Vector3> position;
  reader.get("step", step);
  reader.get("position", position);
  EXPECT_EQ(position, positions_of(step));
  return step;
}

void write_snapshot(const RunFolder& folder, int number) {
  const auto step = static_cast<std::uint64_t>(number);
  const PointSet points{.time = 0.5 * number,
                        .step = step,
                        .columns = {{"position", "m", positions_of(step)}, {"radius", "m", column_of(step)}}};
  write_points(folder.snapshot(number), points.view());
}

/// All snapshots are whole. \returns how many there are
std::size_t verified_snapshots(const RunFolder& folder) {
  const std::vector<int> numbers = folder.snapshot_numbers();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    EXPECT_EQ(numbers[i], static_cast<int>(i));
    const PointSet points = read_points(folder.snapshot(numbers[i]));
    EXPECT_EQ(points.time, 0.5 * numbers[i]);
    EXPECT_EQ(std::get<1>(points.columns[0].values), positions_of(points.step));
    EXPECT_EQ(std::get<0>(points.columns[1].values), column_of(points.step));
  }
  return numbers.size();
}

/// The series holds rows 0, 1, 2, ... \returns how many
std::size_t verified_rows(const std::filesystem::path& path) {
  const Series series = read_series(path);
  for (std::size_t i = 0; i < series.rows(); ++i) {
    EXPECT_EQ(series.columns[0][i], static_cast<double>(i));
    EXPECT_EQ(series.columns[1][i], static_cast<double>(i) / 3);
  }
  return series.rows();
}

void append_row(SeriesWriter& writer) {
  const auto row = static_cast<double>(writer.position());
  writer.append(std::vector{row, row / 3});
}

std::string full(const std::filesystem::path& path) {
  return path.string() + ": cannot write: No space left on device";
}

class FullDisk : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!disk_.mounted()) GTEST_SKIP() << "only root may mount the small file system that this test fills";
    folder_.emplace(RunFolder::create(disk_ / "run", Existing::refuse));
  }

  /// Leaves `free` bytes.
  void fill(std::size_t free) const {
    const std::size_t available = std::filesystem::space(disk_.path()).available;
    if (available > free) put_content(disk_ / "filler", std::string(available - free, 'x'));
  }
  void make_room() const { std::filesystem::remove(disk_ / "filler"); }

  const SmallDisk disk_;
  std::optional<RunFolder> folder_;
};

TEST_F(FullDisk, KeepsEarlierSnapshots) {
  int number = 0;
  const std::string message = message_of<FileError>([&] {
    for (; number < 1000; ++number) write_snapshot(*folder_, number);
  });
  EXPECT_EQ(message, full(folder_->snapshot(number)));
  EXPECT_GT(number, 5);
  EXPECT_EQ(verified_snapshots(*folder_), static_cast<std::size_t>(number));
  EXPECT_THAT(names_in(folder_->snapshots()), Not(Contains(EndsWith(".part"))));
}

TEST_F(FullDisk, KeepsBothCheckpoints) {
  CheckpointFiles files(folder_->path());
  files.save(checkpoint_of(1));
  files.save(checkpoint_of(2));
  const std::string older = content_of(disk_ / "run/checkpoint_a.h5");
  // The next one fails with any room less than its size; with it the older file gives way.
  for (const std::size_t free : {std::size_t{0}, std::size_t{4096}, older.size() / 2}) {
    fill(free);
    EXPECT_EQ(message_of<FileError>([&] { files.save(checkpoint_of(3)); }), full(disk_ / "run/checkpoint_a.h5"));
    EXPECT_EQ(content_of(disk_ / "run/checkpoint_a.h5"), older);
    EXPECT_EQ(verified_step(*CheckpointFiles(folder_->path()).load()), 2u);
    EXPECT_THAT(names_in(folder_->path()), Not(Contains(EndsWith(".part"))));
    make_room();
  }
  files.save(checkpoint_of(3));
  EXPECT_EQ(verified_step(*CheckpointFiles(folder_->path()).load()), 3u);
}

TEST_F(FullDisk, KeepsTheSeriesRowsAndGoesOnWhenThereIsRoom) {
  SeriesWriter writer(folder_->series(), series_columns);
  for (int i = 0; i < 100; ++i) append_row(writer);
  fill(8192);
  const std::string message = message_of<FileError>([&] {
    for (int i = 0; i < 100000; ++i) append_row(writer);
  });
  EXPECT_EQ(message, full(folder_->series()));
  const std::uint64_t rows = writer.position();
  EXPECT_GT(rows, 200u);
  EXPECT_EQ(verified_rows(folder_->series()), rows);
  EXPECT_EQ(content_of(folder_->series()).back(), '\n');
  make_room();
  append_row(writer);
  writer.sync();
  EXPECT_EQ(verified_rows(folder_->series()), rows + 1);
}

TEST_F(FullDisk, KeepsManifestAndSummary) {
  Manifest manifest;
  write_summary(folder_->summary(), {.status = "running", .wall_seconds = 1, .quantities = {}});
  write_manifest(folder_->manifest(), manifest);
  fill(0);
  manifest.case_text = std::string(5000, 'c');
  EXPECT_EQ(message_of<FileError>([&] { write_manifest(folder_->manifest(), manifest); }), full(folder_->manifest()));
  EXPECT_EQ(message_of<FileError>([&] { write_summary(folder_->summary(), {.status = "done", .quantities = {}}); }),
            full(folder_->summary()));
  EXPECT_EQ(read_manifest(folder_->manifest()).case_text, "");
  EXPECT_EQ(read_summary(folder_->summary()).status, "running");
}

/// Everything that a run writes fails with this reason, and names the file: of one that is not there yet the list of
/// files, which would have to name it first.
void expect_nothing_writable(const RunFolder& folder, const std::string& reason) {
  const auto expected = [&](const std::filesystem::path& path) {
    const auto file = std::filesystem::exists(path) ? path : folder.path() / "files.txt";
    return file.string() + ": cannot open: " + reason;
  };
  EXPECT_EQ(message_of<FileError>([&] { write_snapshot(folder, 1); }), expected(folder.snapshot(1)));
  EXPECT_EQ(message_of<FileError>([&] { SeriesWriter(folder.series(), series_columns); }), expected(folder.series()));
  EXPECT_EQ(message_of<FileError>([&] { CheckpointFiles(folder.path()).save(checkpoint_of(1)); }),
            expected(folder.path() / "checkpoint_a.h5"));
  EXPECT_EQ(message_of<FileError>([&] { write_manifest(folder.manifest(), {}); }), expected(folder.manifest()));
  EXPECT_EQ(message_of<FileError>([&] { RunFolder::create(folder.path() / "inner", Existing::refuse); }),
            (folder.path() / "inner").string() + ": cannot make the folder: " + reason);
}

TEST(UnwritableFolder, GivesTheSystemsReason) {
  const ScratchFolder scratch;
  const RunFolder folder = RunFolder::create(scratch / "run", Existing::refuse);
  write_snapshot(folder, 0);
  namespace fs = std::filesystem;
  fs::permissions(scratch.path(), fs::perms(0755));
  for (const fs::path& path : {folder.path(), folder.snapshots()}) fs::permissions(path, fs::perms(0555));
  constexpr uid_t nobody = 65534;
  const bool root = ::geteuid() == 0;  // whom permissions do not bind
  if (root) {
    ASSERT_EQ(::seteuid(nobody), 0);
  }
  expect_nothing_writable(folder, "Permission denied");
  EXPECT_EQ(verified_snapshots(folder), 1u);
  if (root) {
    ASSERT_EQ(::seteuid(0), 0);
  }
  for (const fs::path& path : {folder.path(), folder.snapshots()}) fs::permissions(path, fs::perms(0755));
}

TEST(UnwritableFolder, OnAReadOnlyFileSystemToo) {
  const SmallDisk disk;
  if (!disk.mounted()) GTEST_SKIP() << "only root may mount a file system";
  const RunFolder folder = RunFolder::create(disk / "run", Existing::refuse);
  write_snapshot(folder, 0);
  ASSERT_EQ(::mount("talus-test", disk.path().c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, nullptr), 0);
  expect_nothing_writable(folder, "Read-only file system");
  EXPECT_EQ(verified_snapshots(folder), 1u);
}

/// What a run does with its files, in its order, from the checkpoint on, until it is killed.
[[noreturn]] void run_until_killed(const RunFolder& folder) {
  CheckpointFiles files(folder.path());
  std::uint64_t step = verified_step(*files.load());
  SeriesWriter series = SeriesWriter::resume(folder.series(), series_columns, step);
  while (true) {
    for (; series.position() < step + 10;) append_row(series);
    step += 10;
    write_snapshot(folder, static_cast<int>(step / 10));
    series.sync();
    files.save(checkpoint_of(step));
  }
}

TEST(Kill, AtAnyMomentLeavesAWholeCheckpointToGoOnFrom) {
  const ScratchFolder scratch;
  const RunFolder folder = RunFolder::create(scratch / "run", Existing::refuse);
  SeriesWriter(folder.series(), series_columns).sync();
  write_snapshot(folder, 0);
  CheckpointFiles(folder.path()).save(checkpoint_of(0));

  std::uint64_t step = 0;
  std::chrono::microseconds patience(2000);  // grows until a run gets anywhere, on slow disks
  for (int kill = 0; kill < 25; ++kill) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      try {
        run_until_killed(folder);
      } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        ::_exit(1);
      }
    }
    std::this_thread::sleep_for(patience + std::chrono::microseconds(731 * kill));
    ::kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the run failed by itself";

    const CheckpointFiles files(folder.path());
    EXPECT_TRUE(files.damages().empty());
    const auto reader = files.load();
    ASSERT_TRUE(reader);
    EXPECT_GE(verified_step(*reader), step);
    if (verified_step(*reader) == step && patience < std::chrono::seconds(1)) patience *= 2;
    step = verified_step(*reader);
    EXPECT_EQ(SeriesWriter::resume(folder.series(), series_columns, step).position(), step);
    EXPECT_EQ(verified_rows(folder.series()), step);
    EXPECT_GE(verified_snapshots(folder), step / 10 + 1);
  }
  EXPECT_GT(step, 0u);
}

}  // namespace
}  // namespace talus

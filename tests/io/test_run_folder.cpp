// SPDX-License-Identifier: Apache-2.0
#include "io/run_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "io/manifest.hpp"
#include "io/scratch_folder.hpp"

namespace talus {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string refusal(const std::filesystem::path& path, Existing existing) {
  return message_of<InputError>([&] { RunFolder::create(path, existing); });
}

/// A folder in which a run has ended.
void run_in(const std::filesystem::path& path) {
  const RunFolder folder = RunFolder::create(path, Existing::refuse);
  write_manifest(folder.manifest(), {});
  for (const char* name : {"series.csv", "checkpoint_a.h5", "checkpoint_b.h5", "summary.json", "report.html", "log.txt",
                           "stop", "series.csv.part"})
    put_content(path / name, name);
  for (const int number : {0, 9, 10}) put_content(folder.snapshot(number), "");
  put_content(folder.snapshot(10000, "air"), "");
  put_content(folder.snapshot(11).string() + ".part", "");
  put_content(folder.snapshot_index(), "");
}

TEST(RunFolder, IsMadeWithItsParents) {
  const ScratchFolder scratch;
  for (const Existing existing : {Existing::refuse, Existing::overwrite}) {
    const auto path = scratch / (existing == Existing::refuse ? "a/b" : "c/d");
    EXPECT_EQ(RunFolder::create(path, existing).path(), path);
    EXPECT_THAT(names_in(path), ElementsAre("snapshots"));
  }
}

TEST(RunFolder, IsAsGoodAsNewUntilItsManifestIsInPlace) {
  const ScratchFolder scratch;
  std::filesystem::create_directory(scratch / "empty");
  RunFolder::create(scratch / "empty", Existing::resume);
  for (const Existing existing : {Existing::refuse, Existing::resume, Existing::overwrite}) {
    RunFolder::create(scratch / "killed", Existing::refuse);
    put_content(scratch / "killed/manifest.json.part", "{");
    EXPECT_EQ(RunFolder::create(scratch / "killed", existing).path(), scratch / "killed");
  }
  put_content(scratch / "killed/snapshots/mine", "");
  EXPECT_THAT(refusal(scratch / "killed", Existing::overwrite), HasSubstr("holds 'snapshots', but no run of Talus"));
}

TEST(RunFolder, NamesSnapshotsSoThatTheyAreASeries) {
  const RunFolder folder("out");
  EXPECT_EQ(folder.snapshot(7), "out/snapshots/particles_0007.vtkhdf");
  EXPECT_EQ(folder.snapshot(12345, "air"), "out/snapshots/air_12345.vtkhdf");
  EXPECT_EQ(folder.snapshot_index(), "out/snapshots/particles.hdf.series");
}

TEST(RunFolder, FindsTheLatestSnapshotByNumber) {
  const ScratchFolder scratch;
  EXPECT_EQ(RunFolder(scratch / "none").latest_snapshot(), std::nullopt);
  run_in(scratch / "run");
  const RunFolder folder(scratch / "run");
  for (const char* name : {"particles_99.vtkhdf.part", "particles_x9.vtkhdf", "particles_.vtkhdf", "particles_88.h5",
                           "particles_-5.vtkhdf", "my_particles_0077.vtkhdf"})
    put_content(folder.snapshots() / name, "");
  EXPECT_THAT(folder.snapshot_numbers(), ElementsAre(0, 9, 10));
  EXPECT_EQ(folder.latest_snapshot(), 10);
  EXPECT_EQ(folder.latest_snapshot("air"), 10000);
}

TEST(RunFolder, RefusesAFolderInUseUnlessTold) {
  const ScratchFolder scratch;
  run_in(scratch / "run");
  const auto before = names_in(scratch / "run");
  EXPECT_THAT(refusal(scratch / "run", Existing::refuse),
              HasSubstr("run: holds a run already; allowed: --resume to go on with it, --overwrite to replace it"));
  put_content(scratch / "thesis.tex", "");
  EXPECT_THAT(refusal(scratch.path(), Existing::refuse), HasSubstr("is not empty; allowed: --out for another folder"));
  EXPECT_THAT(refusal(scratch.path(), Existing::resume), HasSubstr("holds no run to resume"));
  EXPECT_THAT(refusal(scratch / "none", Existing::resume), HasSubstr("none: there is no such folder"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "none"));
  for (const Existing existing : {Existing::refuse, Existing::resume, Existing::overwrite})
    EXPECT_THAT(refusal(scratch / "thesis.tex", existing), HasSubstr("thesis.tex: is a file, not a folder"));
  EXPECT_EQ(names_in(scratch / "run"), before);
}

TEST(RunFolder, ResumingKeepsEverythingButTheStopFile) {
  const ScratchFolder scratch;
  run_in(scratch / "run");
  std::filesystem::remove(scratch / "run/stop");
  const auto before = names_in(scratch / "run");
  put_content(scratch / "run/stop", "");
  const RunFolder folder = RunFolder::create(scratch / "run", Existing::resume);
  EXPECT_EQ(names_in(scratch / "run"), before);
  EXPECT_EQ(content_of(folder.series()), "series.csv");
  EXPECT_EQ(folder.latest_snapshot(), 10);
}

TEST(RunFolder, OverwritingRemovesTheRunsFilesAndNoOthers) {
  const ScratchFolder scratch;
  run_in(scratch / "run");
  std::filesystem::create_directories(scratch / "run/snapshots/pictures");
  for (const char* name : {"run/notes.txt", "run/series.csv.bak", "run/snapshots/particles_0001.vtu",
                           "run/snapshots/pictures/particles_0001.vtkhdf", "run/snapshots/particles_0001.vtkhdf.txt",
                           "run/snapshots/mine.hdf.series"})
    put_content(scratch / name, name);
  RunFolder::create(scratch / "run", Existing::overwrite);
  EXPECT_THAT(names_in(scratch / "run"), ElementsAre("notes.txt", "series.csv.bak", "snapshots"));
  EXPECT_THAT(names_in(scratch / "run/snapshots"),
              ElementsAre("mine.hdf.series", "particles_0001.vtkhdf.txt", "particles_0001.vtu", "pictures"));
  EXPECT_THAT(names_in(scratch / "run/snapshots/pictures"), ElementsAre("particles_0001.vtkhdf"));
  EXPECT_EQ(content_of(scratch / "run/notes.txt"), "run/notes.txt");
}

TEST(RunFolder, OverwritesNothingThatIsNotFromTalus) {
  const ScratchFolder scratch;
  put_content(scratch / "log.txt", "precious");
  EXPECT_THAT(refusal(scratch.path(), Existing::overwrite), HasSubstr("holds 'log.txt', but no run of Talus"));
  put_content(scratch / "manifest.json", R"({"name": "a web page"})");
  EXPECT_THAT(refusal(scratch.path(), Existing::overwrite), HasSubstr("but no run of Talus"));
  EXPECT_THAT(refusal(scratch.path(), Existing::resume), HasSubstr("holds no run to resume"));
  EXPECT_THAT(names_in(scratch.path()), ElementsAre("log.txt", "manifest.json"));
  EXPECT_EQ(content_of(scratch / "log.txt"), "precious");
}

TEST(RunFolder, IsLockedWhileARunWritesIntoIt) {
  const ScratchFolder scratch;
  {
    const RunFolder first = RunFolder::create(scratch / "run", Existing::refuse);
    write_manifest(first.manifest(), {});
    for (const Existing existing : {Existing::refuse, Existing::resume, Existing::overwrite})
      EXPECT_THAT(refusal(scratch / "run", existing), HasSubstr("run: another run is writing into this folder"));
    EXPECT_THAT(names_in(scratch / "run"), ElementsAre("manifest.json", "snapshots"));
  }
  RunFolder::create(scratch / "run", Existing::resume);
}

}  // namespace
}  // namespace talus

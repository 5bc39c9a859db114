// SPDX-License-Identifier: Apache-2.0
#include "io/run_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "io/file.hpp"
#include "io/run_json.hpp"
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
                           "pictures/frames.png", "analysis/snapshots.csv"}) {
    make_folder((path / name).parent_path());
    write_atomically(path / name, name);
  }
  for (const int number : {0, 9, 10, 11}) write_atomically(folder.snapshot(number), "");
  std::filesystem::remove(folder.snapshot(11));
  write_atomically(folder.snapshot(10000, "air"), "");
  write_atomically(folder.snapshot_index(), "");
  for (const auto& left_by_a_kill : {folder.snapshot(11), folder.summary()})
    put_content(left_by_a_kill.string() + ".part", "");
  put_content(folder.stop(), "");
}

TEST(RunFolder, IsMadeWithItsParents) {
  const ScratchFolder scratch;
  for (const Existing existing : {Existing::refuse, Existing::overwrite}) {
    const auto path = scratch / (existing == Existing::refuse ? "a/b" : "c/d");
    EXPECT_EQ(RunFolder::create(path, existing).path(), path);
    EXPECT_THAT(names_in(path), ElementsAre("files.txt", "snapshots"));
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
  EXPECT_THAT(refusal(scratch / "killed", Existing::resume), HasSubstr("holds no run to resume"));
}

TEST(RunFolder, NamesSnapshotsSoThatTheyAreASeries) {
  const RunFolder folder("out");
  EXPECT_EQ(folder.snapshot(7), "out/snapshots/particles_0007.vtkhdf");
  EXPECT_EQ(folder.snapshot(12345, "air"), "out/snapshots/air_12345.vtkhdf");
  EXPECT_EQ(folder.snapshot_index(), "out/snapshots/particles.hdf.series");
}

TEST(RunFolder, FindsTheSnapshotsByNumber) {
  const ScratchFolder scratch;
  EXPECT_THAT(RunFolder(scratch / "none").snapshot_numbers(), ::testing::IsEmpty());
  run_in(scratch / "run");
  const RunFolder folder(scratch / "run");
  for (const char* name : {"particles_99.vtkhdf.part", "particles_x9.vtkhdf", "particles_.vtkhdf", "particles_88.h5",
                           "particles_-5.vtkhdf", "my_particles_0077.vtkhdf", "particles_0050.vtkhdf"})
    put_content(folder.snapshots() / name, "");
  EXPECT_THAT(folder.snapshot_numbers(), ElementsAre(0, 9, 10));
  EXPECT_EQ(folder.snapshot_numbers("air").back(), 10000);
  // What the user put there is no snapshot of the run, and stays.
  EXPECT_TRUE(folder.remove_snapshots(9));
  EXPECT_FALSE(folder.remove_snapshots(9));
  EXPECT_THAT(folder.snapshot_numbers(), ElementsAre(0));
  EXPECT_EQ(folder.snapshot_numbers("air").back(), 10000);
  EXPECT_TRUE(std::filesystem::exists(folder.snapshot(50)));
  // Without a list the names decide, and nothing is removed.
  std::filesystem::remove(scratch / "run/files.txt");
  EXPECT_THAT(folder.snapshot_numbers(), ElementsAre(0, 50));
  EXPECT_FALSE(folder.remove_snapshots(0));
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
  EXPECT_EQ(RunFolder::create(scratch / "none", Existing::resume).path(), scratch / "none");
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
  EXPECT_EQ(folder.snapshot_numbers().back(), 10);
}

TEST(RunFolder, OverwritingRemovesTheRunsFilesAndNoOthers) {
  const ScratchFolder scratch;
  run_in(scratch / "run");
  std::filesystem::create_directories(scratch / "run/snapshots/pictures");
  const std::vector<std::string> mine{"notes.txt",
                                      "series.csv.bak",
                                      "pictures/photo.png",
                                      "analysis/mine.csv",
                                      "snapshots/particles_0001.vtu",
                                      "snapshots/particles_0005.vtkhdf",
                                      "snapshots/pictures/particles_0001.vtkhdf",
                                      "snapshots/mine.hdf.series"};
  for (const std::string& name : mine) put_content(scratch / "run" / name, name);
  RunFolder::create(scratch / "run", Existing::overwrite);
  EXPECT_THAT(names_in(scratch / "run"),
              ElementsAre("analysis", "files.txt", "notes.txt", "pictures", "series.csv.bak", "snapshots"));
  EXPECT_THAT(names_in(scratch / "run/analysis"), ElementsAre("mine.csv"));
  EXPECT_THAT(names_in(scratch / "run/pictures"), ElementsAre("photo.png"));
  EXPECT_THAT(names_in(scratch / "run/snapshots"),
              ElementsAre("mine.hdf.series", "particles_0001.vtu", "particles_0005.vtkhdf", "pictures"));
  for (const std::string& name : mine) EXPECT_EQ(content_of(scratch / "run" / name), name);
}

TEST(RunFolder, OverwritesNothingThatIsNotFromTalus) {
  const ScratchFolder scratch;
  const auto refused = [&](const std::string& why) {
    EXPECT_THAT(refusal(scratch.path(), Existing::overwrite), HasSubstr(why));
  };
  std::filesystem::create_directory(scratch / "pictures");
  put_content(scratch / "pictures/holiday.png", "precious");
  refused("is not a Talus run folder (manifest.json missing); nothing is overwritten");
  put_content(scratch / "log.txt", "precious");
  put_content(scratch / "files.txt", "bread, milk");
  put_content(scratch / "manifest.json", R"({"name": "a web page"})");
  refused("is not a Talus run folder (");
  EXPECT_THAT(refusal(scratch.path(), Existing::resume), HasSubstr("holds no run to resume: "));
  EXPECT_THAT(names_in(scratch.path()), ElementsAre("files.txt", "log.txt", "manifest.json", "pictures"));
  // A run of a version that kept no list: nobody knows what is whose.
  write_manifest(scratch / "manifest.json", {});
  refused("has no files.txt that says what Talus wrote there; nothing is overwritten");
  EXPECT_EQ(content_of(scratch / "log.txt"), "precious");
  EXPECT_EQ(content_of(scratch / "pictures/holiday.png"), "precious");
  EXPECT_EQ(content_of(scratch / "files.txt"), "bread, milk");
}

TEST(RunFolder, OverwritesNoFileOfTheseNamesThatTheUserPutThere) {
  const ScratchFolder scratch;
  {
    const RunFolder folder = RunFolder::create(scratch / "run", Existing::refuse);
    write_manifest(folder.manifest(), {});
  }
  put_content(scratch / "run/log.txt", "precious");
  EXPECT_THAT(refusal(scratch / "run", Existing::overwrite),
              HasSubstr("holds 'log.txt', and files.txt does not say that Talus wrote it"));
  EXPECT_THAT(names_in(scratch / "run"), ElementsAre("files.txt", "log.txt", "manifest.json", "snapshots"));
}

TEST(RunFolder, FollowsNoLinkWithin) {
  const ScratchFolder scratch;
  std::filesystem::create_directory(scratch / "elsewhere");
  for (const char* name : {"snapshots", "analysis", "pictures", "series.csv", "log.txt", "summary.json.part",
                           "checkpoint_a.h5", "manifest.json.part"}) {
    const auto run = scratch / ("run of " + std::string(name));
    run_in(run);
    std::filesystem::remove_all(run / name);
    std::filesystem::create_symlink(scratch / "elsewhere", run / name);
    const auto before = names_in(run);
    for (const Existing existing : {Existing::resume, Existing::overwrite})
      EXPECT_THAT(refusal(run, existing), HasSubstr(std::string(name) + ": is a symbolic link; ")) << name;
    EXPECT_EQ(names_in(run), before);
  }
  EXPECT_THAT(names_in(scratch / "elsewhere"), ElementsAre());
  // The folder itself may be somewhere else.
  std::filesystem::create_symlink(scratch / "elsewhere", scratch / "results");
  RunFolder::create(scratch / "results", Existing::refuse);
  EXPECT_THAT(names_in(scratch / "elsewhere"), ElementsAre("files.txt", "snapshots"));
}

TEST(RunFolder, ATornManifestIsToldAndNothingChanged) {
  const ScratchFolder scratch;
  run_in(scratch / "run");
  const std::string whole = content_of(scratch / "run/manifest.json");
  put_content(scratch / "run/manifest.json", whole.substr(0, whole.size() / 2));
  const auto before = names_in(scratch / "run");
  EXPECT_THAT(refusal(scratch / "run", Existing::resume), HasSubstr("holds no run to resume: "));
  EXPECT_THAT(refusal(scratch / "run", Existing::resume), HasSubstr("manifest.json: is not a manifest of Talus"));
  EXPECT_THAT(refusal(scratch / "run", Existing::refuse), HasSubstr("is not empty"));
  EXPECT_EQ(names_in(scratch / "run"), before);
}

TEST(RunFolder, ARemovalThatWasCutShortIsRepeated) {
  const ScratchFolder scratch;
  run_in(scratch / "run");
  put_content(scratch / "run/mine", "mine");
  for (const char* name : {"series.csv", "manifest.json"}) std::filesystem::remove(scratch / "run" / name);
  RunFolder::create(scratch / "run", Existing::overwrite);
  EXPECT_THAT(names_in(scratch / "run"), ElementsAre("analysis", "files.txt", "mine", "pictures", "snapshots"));
}

TEST(RunFolder, IsNotResumedWithASnapshotThatItsListDoesNotName) {
  const ScratchFolder scratch;
  run_in(scratch / "run");
  const std::filesystem::path list = scratch / "run/files.txt";
  std::string text = content_of(list);
  text[text.find("particles_0009") - 12] ^= 1;  // in the line's checksum
  put_content(list, text);
  EXPECT_THAT(refusal(scratch / "run", Existing::resume),
              HasSubstr("particles_0009.vtkhdf: is there, and files.txt does not say that Talus wrote it"));
}

TEST(RunFolder, IsLockedWhileARunWritesIntoIt) {
  const ScratchFolder scratch;
  {
    const RunFolder first = RunFolder::create(scratch / "run", Existing::refuse);
    write_manifest(first.manifest(), {});
    for (const Existing existing : {Existing::refuse, Existing::resume, Existing::overwrite})
      EXPECT_THAT(refusal(scratch / "run", existing), HasSubstr("run: another run is writing into this folder"));
    EXPECT_THAT(names_in(scratch / "run"), ElementsAre("files.txt", "manifest.json", "snapshots"));
  }
  RunFolder::create(scratch / "run", Existing::resume);
}

}  // namespace
}  // namespace talus

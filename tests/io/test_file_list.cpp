// SPDX-License-Identifier: Apache-2.0
#include "io/file_list.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "io/file.hpp"
#include "io/scratch_folder.hpp"
#include "io/series.hpp"

namespace talus {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string failure(const fs::path& path) {
  return message_of<FileError>([&] { write_atomically(path, "new"); });
}

/// A folder with a list, and folders within.
fs::path listed(const ScratchFolder& scratch) {
  const fs::path folder = scratch / "run";
  fs::create_directories(folder / "a/b/c");
  FileList::begin(folder);
  return folder;
}

TEST(FileList, KnowsWhatWasWrittenBelowItsFolder) {
  const ScratchFolder scratch;
  const fs::path folder = listed(scratch);
  write_atomically(folder / "one", "1");
  write_atomically(folder / "one", "11");
  write_atomically(folder / "a/b/c/two words", "2");
  write_table(folder / "a/table.csv", {{"x", "m"}}, {{1}, {2}});
  SeriesWriter(folder / "series.csv", {{"x", "m"}});
  write_atomically(scratch / "beside", "");
  const FileList list = *FileList::read(folder);
  for (const char* name : {"one", "a/b/c/two words", "a/table.csv", "series.csv"})
    EXPECT_TRUE(list.holds(name)) << name;
  for (const char* name : {"beside", "files.txt", "two words", ""}) EXPECT_FALSE(list.holds(name)) << name;
  EXPECT_EQ(content_of(folder / "a/table.csv"), "x [m]\n1\n2\n");
  const std::string content = content_of(folder / "files.txt");
  EXPECT_EQ(std::count(content.begin(), content.end(), '\n'), 5);
}

TEST(FileList, TheNearestCounts) {
  const ScratchFolder scratch;
  const fs::path folder = listed(scratch);
  FileList::begin(folder / "a");
  write_atomically(folder / "a/b/file", "");
  EXPECT_FALSE(FileList::read(folder)->holds("a/b/file"));
  EXPECT_TRUE(FileList::read(folder / "a")->holds("b/file"));
}

TEST(FileList, ATornOrTurnedLineCountsForNothing) {
  const ScratchFolder scratch;
  const fs::path folder = listed(scratch);
  for (const char* name : {"one", "two", "three"}) FileList::read(folder)->add(name);
  const std::string whole = content_of(folder / "files.txt");
  for (std::size_t cut = whole.size() - 1; cut > 0; --cut) {
    put_content(folder / "files.txt", whole.substr(0, cut));
    const auto list = FileList::read(folder);
    if (!list) continue;  // no title
    EXPECT_FALSE(list->holds("three"));
    FileList::read(folder)->add("four");
    EXPECT_TRUE(FileList::read(folder)->holds("four"));
    if (list->holds("one")) {
      EXPECT_TRUE(FileList::read(folder)->holds("one"));
    }
  }
  for (std::size_t at = whole.find("one") - 9; at < whole.size(); ++at) {
    std::string turned = whole;
    turned[at] ^= 4;
    put_content(folder / "files.txt", turned);
    const auto list = FileList::read(folder);
    int known = 0;
    for (const char* name : {"one", "two", "three"}) known += list->holds(name);
    EXPECT_LT(known, 3);
    EXPECT_GE(known, 1);
    FileList read = *list;
    read.remove_files({});  // none of them is there: a turned name removes nothing
    EXPECT_TRUE(fs::exists(folder / "a/b/c"));
  }
}

TEST(FileList, ReplacesNothingThatItDoesNotName) {
  const ScratchFolder scratch;
  const fs::path folder = listed(scratch);
  put_content(folder / "a/mine.png", "mine");
  EXPECT_THAT(failure(folder / "a/mine.png"), HasSubstr("is there, and "));
  EXPECT_THAT(failure(folder / "a/mine.png"), HasSubstr("files.txt does not say that Talus wrote it"));
  EXPECT_EQ(content_of(folder / "a/mine.png"), "mine");
  EXPECT_THAT(message_of<FileError>([&] {
                SeriesWriter(folder / "a/mine.png", {{"x", "m"}});
              }),
              HasSubstr("does not say that Talus wrote it"));
  EXPECT_EQ(content_of(folder / "a/mine.png"), "mine");
}

TEST(FileList, FollowsNoLink) {
  const ScratchFolder scratch;
  const fs::path folder = listed(scratch);
  fs::create_directory(scratch / "elsewhere");
  put_content(scratch / "elsewhere/file", "precious");
  fs::create_directory_symlink(scratch / "elsewhere", folder / "pictures");
  fs::create_symlink(scratch / "elsewhere/file", folder / "linked");
  fs::create_symlink(scratch / "elsewhere/none", folder / "dangling");
  fs::create_symlink(scratch / "elsewhere/file", folder / "temporary.part");
  EXPECT_THAT(failure(folder / "pictures/new"), HasSubstr("pictures is a symbolic link, through which nothing"));
  EXPECT_THAT(failure(folder / "pictures/file"), HasSubstr("is a symbolic link"));
  EXPECT_THAT(failure(folder / "linked"), HasSubstr("is a symbolic link"));
  EXPECT_THAT(failure(folder / "dangling"), HasSubstr("is a symbolic link"));
  EXPECT_THAT(failure(folder / "temporary"), HasSubstr("cannot open: Too many levels of symbolic links"));
  EXPECT_THAT(message_of<FileError>([&] { make_folder(folder / "pictures"); }), HasSubstr("is a symbolic link"));
  EXPECT_THAT(message_of<FileError>([&] {
                SeriesWriter(folder / "linked", {{"x", "m"}});
              }),
              HasSubstr("is a symbolic link"));
  // Names that were written before the link was made.
  FileList::read(folder)->add("pictures/file");
  FileList::read(folder)->add("linked");
  FileList::read(folder)->remove_files({});
  EXPECT_THAT(names_in(scratch / "elsewhere"), ElementsAre("file"));
  EXPECT_EQ(content_of(scratch / "elsewhere/file"), "precious");
}

TEST(FileList, RemovesWhatItNamesAlone) {
  const ScratchFolder scratch;
  const fs::path folder = listed(scratch);
  for (const char* name : {"one", "a/two", "a/b/three"}) write_atomically(folder / name, name);
  for (const char* name : {"mine", "a/two.txt", "a/b/three.bak"}) put_content(folder / name, "");
  put_content(folder / "a/two.part", "");
  fs::remove(folder / "one");
  fs::create_directory(folder / "one");  // no file now
  FileList::read(folder)->remove_files("a/two");
  EXPECT_THAT(names_in(folder), ElementsAre("a", "files.txt", "mine", "one"));
  EXPECT_THAT(names_in(folder / "a"), ElementsAre("b", "two.txt"));
  EXPECT_THAT(names_in(folder / "a/b"), ElementsAre("c", "three.bak"));
  EXPECT_FALSE(FileList::read(folder)->holds("a/two"));
}

TEST(FileList, LeavesADiskThatIsFullAsItWas) {
  const SmallDisk disk;
  if (!disk.mounted()) GTEST_SKIP() << "needs to mount a file system";
  FileList::begin(disk.path());
  FileList::read(disk.path())->add("one");
  const std::string before = content_of(disk / "files.txt");
  // Names until the list's own page is full, then none fits.
  FileList list = *FileList::read(disk.path());
  std::string message;
  try {
    for (int n = 0; n < 100000; ++n) list.add(std::string(3000, 'x') + std::to_string(n));
  } catch (const FileError& error) {
    message = error.what();
  }
  EXPECT_THAT(message, HasSubstr("files.txt: cannot write: No space left on device"));
  EXPECT_TRUE(content_of(disk / "files.txt").ends_with('\n'));
  EXPECT_TRUE(FileList::read(disk.path())->holds("one"));
}

TEST(OutputFolder, IsNewOrTalussOwn) {
  const ScratchFolder scratch;
  const auto refusal = [&](const fs::path& folder, Existing existing, bool known = false) {
    return message_of<InputError>([&] { begin_output(folder, existing, "--resume", known); });
  };
  begin_output(scratch / "new/folder", Existing::refuse, "--resume");
  EXPECT_THAT(names_in(scratch / "new/folder"), ElementsAre("files.txt"));
  EXPECT_THAT(refusal(scratch / "new/folder", Existing::refuse),
              HasSubstr("is not empty; allowed: --resume, or another"));
  write_atomically(scratch / "new/folder/table", "");
  put_content(scratch / "new/folder/mine", "");
  begin_output(scratch / "new/folder", Existing::resume, "--resume");
  EXPECT_TRUE(FileList::read(scratch / "new/folder")->holds("table"));
  begin_output(scratch / "new/folder", Existing::overwrite, "--overwrite");
  EXPECT_THAT(names_in(scratch / "new/folder"), ElementsAre("files.txt", "mine"));

  fs::create_directory(scratch / "thesis");
  put_content(scratch / "thesis/path.csv", "precious");
  for (const Existing existing : {Existing::refuse, Existing::resume, Existing::overwrite})
    EXPECT_THAT(refusal(scratch / "thesis", existing), HasSubstr("thesis: is not empty, and has no files.txt"));
  EXPECT_THAT(names_in(scratch / "thesis"), ElementsAre("path.csv"));
  begin_output(scratch / "thesis", Existing::resume, "--resume", true);
  EXPECT_THAT(names_in(scratch / "thesis"), ElementsAre("path.csv"));
  EXPECT_THAT(refusal(scratch / "thesis/path.csv", Existing::resume), HasSubstr("is a file, not a folder"));
}

}  // namespace
}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
#include "io/file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "base/error.hpp"
#include "io/scratch_folder.hpp"

namespace talus {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(AtomicFile, ReplacesWholeFilesAndLeavesNothingElse) {
  const ScratchFolder folder;
  std::string bytes(3'000'000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * i % 251);
  write_atomically(folder / "file", bytes);
  EXPECT_EQ(read_whole_file(folder / "file"), bytes);
  write_atomically(folder / "file", "");
  EXPECT_EQ(read_whole_file(folder / "file"), "");
  put_content(folder / "file.part", "left by a kill, and longer than what comes");
  write_atomically(folder / "file", "third");
  EXPECT_EQ(read_whole_file(folder / "file"), "third");
  EXPECT_THAT(names_in(folder.path()), ElementsAre("file"));
}

TEST(AtomicFile, AReaderKeepsTheOldFile) {
  const ScratchFolder folder;
  write_atomically(folder / "file", "old");
  std::ifstream reader(folder / "file");
  write_atomically(folder / "file", "new");
  std::string seen;
  reader >> seen;
  EXPECT_EQ(seen, "old");
}

TEST(AtomicFile, ErrorsNameTheFileAndTheReason) {
  const ScratchFolder folder;
  const auto writing = [&](const std::string& name) {
    return message_of<FileError>([&] { write_atomically(folder / name, "text"); });
  };
  EXPECT_EQ(writing("none/file"), (folder / "none/file").string() + ": cannot open: No such file or directory");
  put_content(folder / "file", "");
  EXPECT_EQ(writing("file/file"), (folder / "file/file").string() + ": cannot open: Not a directory");
  std::filesystem::create_directory(folder / "folder");
  EXPECT_EQ(writing("folder"), (folder / "folder").string() + ": cannot rename into place: Is a directory");
  EXPECT_EQ(writing(std::string(300, 'x')),
            (folder / std::string(300, 'x')).string() + ": cannot open: File name too long");
  EXPECT_THAT(names_in(folder.path()), ElementsAre("file", "folder"));
  EXPECT_EQ(message_of<FileError>([&] { read_whole_file(folder / "folder"); }),
            (folder / "folder").string() + ": cannot read: Is a directory");
}

TEST(AtomicFile, WritesBesideItselfWhenGivenABareName) {
  const ScratchFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  write_atomically("bare", "text");
  std::filesystem::current_path(before);
  EXPECT_EQ(content_of(folder / "bare"), "text");
}

}  // namespace
}  // namespace talus

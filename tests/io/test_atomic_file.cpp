// SPDX-License-Identifier: Apache-2.0
#include "io/atomic_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "base/error.hpp"
#include "io/scratch_folder.hpp"

namespace talus {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(WriteAtomically, FileHoldsTheBytesAndNothingIsBesideIt) {
  const ScratchFolder folder;
  std::string bytes(3'000'000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * i % 251);
  write_atomically(folder / "data", bytes);
  EXPECT_EQ(content_of(folder / "data"), bytes);
  EXPECT_EQ(read_whole_file(folder / "data"), bytes);
  write_atomically(folder / "data", "short");
  EXPECT_EQ(content_of(folder / "data"), "short") << "replaces the older file";
  write_atomically(folder / "data", "");
  EXPECT_EQ(content_of(folder / "data"), "");
  EXPECT_THAT(names_in(folder.path()), ElementsAre("data"));
}

TEST(WriteAtomically, SaysWhichFileAndWhyAndLeavesNothing) {
  const ScratchFolder folder;
  const auto missing = folder / "missing/data";
  const std::string message = message_of<FileError>([&] { write_atomically(missing, "bytes"); });
  EXPECT_THAT(message, HasSubstr(missing.string()));
  EXPECT_THAT(message, HasSubstr("No such file or directory"));
  std::filesystem::create_directories(folder / "taken");
  EXPECT_THROW(write_atomically(folder / "taken", "bytes"), FileError);
  EXPECT_THAT(names_in(folder.path()), ElementsAre("taken")) << "the temporary file is gone";
}

}  // namespace
}  // namespace talus

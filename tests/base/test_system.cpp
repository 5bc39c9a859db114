// SPDX-License-Identifier: Apache-2.0
#include "base/system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace talus {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

/// Folders a and b with programs, and PATH as it was behind it.
class Programs : public testing::Test {
 protected:
  Programs() {
    if (const char* path = std::getenv("PATH")) path_ = path;
    std::string name = (fs::temp_directory_path() / "talus-program-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    for (const char* place : {"a", "b"}) fs::create_directories(folder_ / place);
    before_ = fs::current_path();
    fs::current_path(folder_);
  }
  ~Programs() override {
    setenv("PATH", path_.c_str(), 1);
    fs::current_path(before_);
    fs::remove_all(folder_);
  }
  void make(const std::string& name, bool executable = true) const {
    std::ofstream(folder_ / name) << "#!/bin/sh\n";
    if (executable) fs::permissions(folder_ / name, fs::perms::owner_all);
  }
  void search(const std::string& path) const { setenv("PATH", path.c_str(), 1); }
  std::string at(const std::string& name) const { return (folder_ / name).string(); }

  std::string path_;
  fs::path folder_, before_;
};

TEST_F(Programs, ThoseThatMayBeExecutedInTheOrderOfTheFolders) {
  make("a/it", false);
  make("b/it");
  fs::create_directories(folder_ / "c/it");
  fs::create_directories(folder_ / "d");
  make("d/it");
  search(at("a") + ":" + at("c") + ":" + at("none") + ":" + at("b") + ":" + at("d"));
  EXPECT_THAT(find_programs("it"), ElementsAre(at("b/it"), at("d/it")));
  EXPECT_EQ(find_program("it"), fs::path(at("b/it")));
  EXPECT_EQ(find_program("other"), std::nullopt);
}

TEST_F(Programs, NoneOfTheCurrentFolder) {
  make("it");
  for (const char* path : {"", ":", ":/nowhere", "/nowhere:"}) {
    search(path);
    EXPECT_THAT(find_programs("it"), IsEmpty()) << path;
  }
}

TEST_F(Programs, WithoutAPathThoseOfTheSystem) {
  unsetenv("PATH");
  EXPECT_TRUE(find_program("sh"));
}

}  // namespace
}  // namespace talus

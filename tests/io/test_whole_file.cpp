// SPDX-License-Identifier: Apache-2.0
#include "io/whole_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "base/error.hpp"

namespace talus {
namespace {

namespace fs = std::filesystem;

class WholeFile : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string read(const fs::path& path) const {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  auto entries() const { return std::distance(fs::directory_iterator(folder_), fs::directory_iterator()); }

  const fs::path folder_ = fs::path(testing::TempDir()) / "talus_whole_file";
};

TEST_F(WholeFile, HoldsTheBytes) {
  std::string bytes(3'000'000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * i % 251);
  write_whole_file(folder_ / "data", bytes);
  EXPECT_EQ(read(folder_ / "data"), bytes);
  write_whole_file(folder_ / "data", "short");
  EXPECT_EQ(read(folder_ / "data"), "short") << "replaces the older file";
  write_whole_file(folder_ / "data", "");
  EXPECT_EQ(read(folder_ / "data"), "");
  EXPECT_EQ(entries(), 1);
}

TEST_F(WholeFile, SaysWhichFileAndWhyAndLeavesNothing) {
  const fs::path missing = folder_ / "missing" / "data";
  try {
    write_whole_file(missing, "bytes");
    FAIL() << "no error";
  } catch (const FileError& error) {
    EXPECT_EQ(error.path(), missing.string());
    EXPECT_NE(std::string(error.what()).find("No such file or directory"), std::string::npos) << error.what();
  }
  fs::create_directories(folder_ / "taken");
  EXPECT_THROW(write_whole_file(folder_ / "taken", "bytes"), FileError);
  EXPECT_EQ(entries(), 1) << "the temporary file is gone";
}

}  // namespace
}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
#include "app/case/read_runs.hpp"

#include <gtest/gtest.h>

#include <string>

#include "io/scratch_folder.hpp"

namespace talus::app {
namespace {

/// Two folders.
class ReadRunsTest : public testing::Test {
 protected:
  ReadRunsTest() {
    std::filesystem::create_directories(folder);
    std::filesystem::create_directories(other);
  }
  const ScratchFolder scratch;
  const std::filesystem::path folder = scratch.path() / "r", other = scratch.path() / "s";
};

TEST_F(ReadRunsTest, AFolderIsReadOnceHoweverItIsWritten) {
  ReadRuns runs;
  int times = 0;
  const auto read = [&] { return "run " + std::to_string(++times); };
  EXPECT_EQ(runs.of<std::string>(folder, read), "run 1");
  EXPECT_EQ(runs.of<std::string>(folder.string() + "/", read), "run 1");
  EXPECT_EQ(runs.of<std::string>(folder / "..", read), "run 2");
  EXPECT_EQ(runs.of<std::string>(other / ".." / "r", read), "run 1");
  EXPECT_EQ(runs.of<std::string>(other, read), "run 3");
  EXPECT_THROW(runs.of<int>(folder, [] { return 1; }), std::bad_any_cast);
  ReadRuns later;
  EXPECT_EQ(later.of<std::string>(folder, read), "run 4");
}

TEST_F(ReadRunsTest, TheCaseOfARunIsReadOnceOrHandedOver) {
  ReadRuns runs;
  int times = 0;
  const auto read = [&] { return "case " + std::to_string(++times); };
  EXPECT_EQ(runs.find_case<std::string>(folder), nullptr);
  EXPECT_EQ(runs.case_of<std::string>(folder, read), "case 1");
  EXPECT_EQ(runs.case_of<std::string>(folder.string() + "/", read), "case 1");
  ASSERT_NE(runs.find_case<std::string>(folder), nullptr);
  EXPECT_EQ(runs.of<std::string>(folder, [] { return std::string("run"); }), "run") << "the run is another thing";
  runs.keep_case(other, {});
  EXPECT_EQ(runs.find_case<std::string>(other), nullptr);
  runs.keep_case(other, std::string("before the run"));
  EXPECT_EQ(runs.case_of<std::string>(other, read), "before the run");
}

}  // namespace
}  // namespace talus::app

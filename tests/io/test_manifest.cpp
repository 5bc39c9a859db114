// SPDX-License-Identifier: Apache-2.0
#include "io/manifest.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ctime>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/error.hpp"
#include "io/scratch_folder.hpp"

namespace talus {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

TEST(Manifest, KnowsItsProgramAndMachine) {
  const std::time_t before = std::time(nullptr);
  const Manifest manifest = manifest_of_this_program();
  EXPECT_THAT(manifest.version, MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
  EXPECT_THAT(manifest.revision, MatchesRegex("([0-9a-f]{12}(-dirty)?)|unknown"));
  EXPECT_THAT(manifest.compiler, MatchesRegex("(GCC|Clang) [0-9]+\\..*"));
  EXPECT_GE(manifest.libraries.size(), 6u);
  for (const auto& [name, version] : manifest.libraries)
    EXPECT_THAT(version, MatchesRegex("[0-9]+(\\.[0-9]+)+.*")) << name;
  EXPECT_EQ(manifest.cores, static_cast<int>(std::thread::hardware_concurrency()));
  EXPECT_FALSE(manifest.processor.empty());
  EXPECT_THAT(manifest.system, HasSubstr("Linux"));
  std::tm utc{};
  ASSERT_NE(::strptime(manifest.started.c_str(), "%Y-%m-%dT%H:%M:%SZ", &utc), nullptr);
  EXPECT_GE(::timegm(&utc), before);
  EXPECT_LE(::timegm(&utc), std::time(nullptr));
}

TEST(Manifest, ReadsBackAllOfIt) {
  const ScratchFolder folder;
  Manifest written = manifest_of_this_program();
  written.case_text = "model = \"cloud\"  # \u00fc\n[particles]\nradius = \"0.005 m\"\n";
  written.fingerprint = "0123abcd";
  written.seed = INT64_MAX;
  written.instruction_set = "avx2";
  written.threads = 7;
  write_manifest(folder / "manifest.json", written);
  const Manifest read = read_manifest(folder / "manifest.json");
  EXPECT_EQ(read.case_text, written.case_text);
  EXPECT_EQ(read.fingerprint, written.fingerprint);
  EXPECT_EQ(read.seed, written.seed);
  EXPECT_EQ(read.instruction_set, written.instruction_set);
  EXPECT_EQ(read.threads, written.threads);
  EXPECT_EQ(read.version, written.version);
  EXPECT_EQ(read.revision, written.revision);
  EXPECT_EQ(read.compiler, written.compiler);
  EXPECT_EQ(read.libraries, written.libraries);
  EXPECT_EQ(read.processor, written.processor);
  EXPECT_EQ(read.cores, written.cores);
  EXPECT_EQ(read.system, written.system);
  EXPECT_EQ(read.started, written.started);
}

TEST(Manifest, TakesBytesThatAreNoText) {
  const ScratchFolder folder;
  Manifest manifest;
  manifest.case_text = "a\xff";
  write_manifest(folder / "manifest.json", manifest);
  EXPECT_EQ(read_manifest(folder / "manifest.json").case_text, "a\uFFFD");
}

TEST(Manifest, RefusesAnotherProgramsFile) {
  const ScratchFolder folder;
  put_content(folder / "manifest.json", R"({"program": "other"})");
  EXPECT_THAT(message_of<FileError>([&] { read_manifest(folder / "manifest.json"); }),
              HasSubstr("manifest.json: is a manifest of another program"));
  put_content(folder / "manifest.json", R"({"name": "web page", "icons": []})");
  EXPECT_THAT(message_of<FileError>([&] { read_manifest(folder / "manifest.json"); }),
              AllOf(HasSubstr("is not a manifest of Talus"), HasSubstr("'program' not found")));
}

}  // namespace
}  // namespace talus

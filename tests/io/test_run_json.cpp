// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "base/error.hpp"
#include "io/run_json.hpp"
#include "io/scratch_folder.hpp"
#include "io/vtkhdf.hpp"

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

namespace {

using ::testing::HasSubstr;

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Summary, StandsInTheDocumentedForm) {
  const ScratchFolder folder;
  write_summary(folder / "summary.json", {.status = "done",
                                          .wall_seconds = 1.5,
                                          .instruction_set = "avx2",
                                          .quantities = {{"front_speed_max", "1", 0.1}, {"angle", "deg", NAN}},
                                          .warnings = {"mach-number: Mach number = 0.4: too fast"},
                                          .answers = {{"Flow", "has emptied after 2 s", ""}, {"Rate", "1", "2"}},
                                          .regime = {{"Mach number", "0.4", "too fast", true}}});
  EXPECT_EQ(nlohmann::json::parse(content_of(folder / "summary.json")), nlohmann::json::parse(R"({
    "status": "done", "wall_seconds": 1.5, "instruction_set": "avx2",
    "warnings": ["mach-number: Mach number = 0.4: too fast"],
    "regime": [{"quantity": "Mach number", "value": "0.4", "meaning": "too fast", "warning": true}],
    "key_results": [{"title": "Flow", "value": "has emptied after 2 s"}, {"title": "Rate", "value": "1", "estimate": "2"}],
    "quantities": {
      "front_speed_max": {"value": 0.1, "unit": "1"},
      "angle": {"value": null, "unit": "deg", "reason": "not a number"}}})"));
}

TEST(Summary, ReadsBackEveryValueInOrder) {
  const ScratchFolder folder;
  const std::vector<double> values{1.0 / 3, -0.0, 0x1.0p-1074, 1.7976931348623157e308, infinity, -infinity, NAN, 1e22};
  Summary written{
      .status = "stopped: \"walltime\"", .wall_seconds = 0.1, .instruction_set = "avx512", .warnings = {"a: b", "c"}};
  written.regime = {{"a", "1", "b", true}, {"d", "2", "e", false}};
  written.answers = {{"Flow", "has emptied after 2 s", ""}, {"Rate", "1", "2"}};
  for (std::size_t i = 0; i < values.size(); ++i)
    written.quantities.push_back({fmt::format("z{}", 10 - i), "m/s", values[i]});
  write_summary(folder / "summary.json", written);
  const Summary read = read_summary(folder / "summary.json");
  ASSERT_EQ(read.regime.size(), 2);
  ASSERT_EQ(read.answers.size(), 2);
  EXPECT_EQ(read.answers[0].answer, "has emptied after 2 s");
  EXPECT_EQ(read.answers[1].by_hand, "2");
  EXPECT_EQ(read.regime[1].meaning, "e");
  EXPECT_TRUE(read.regime[0].warning && !read.regime[1].warning);
  EXPECT_EQ(read.status, written.status);
  EXPECT_EQ(read.wall_seconds, 0.1);
  EXPECT_EQ(read.instruction_set, "avx512");
  EXPECT_EQ(read.warnings, written.warnings);
  ASSERT_EQ(read.quantities.size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_EQ(read.quantities[i].name, written.quantities[i].name);
    EXPECT_EQ(read.quantities[i].unit, "m/s");
    if (std::isnan(values[i])) {
      EXPECT_TRUE(std::isnan(read.quantities[i].value));
    } else {
      EXPECT_EQ(read.quantities[i].value, values[i]);
      EXPECT_EQ(std::signbit(read.quantities[i].value), std::signbit(values[i]));
    }
  }
  EXPECT_EQ(read.find("z8")->value, 0x1.0p-1074);
  EXPECT_EQ(read.find("z11"), nullptr);
}

TEST(Summary, RefusesANameThatStandsTwice) {
  const ScratchFolder folder;
  EXPECT_THROW(write_summary(folder / "s", {.status = "done", .quantities = {{"a", "1", 1}, {"a", "1", 2}}}),
               std::invalid_argument);
}

TEST(Summary, SaysWhatIsWrongWithAFile) {
  const ScratchFolder folder;
  const auto message = [&](const std::string& content) {
    put_content(folder / "summary.json", content);
    return message_of<FileError>([&] { read_summary(folder / "summary.json"); });
  };
  EXPECT_THAT(message("{"), HasSubstr("summary.json: is not a summary of Talus: "));
  EXPECT_THAT(message(R"({"status": "done", "wall_seconds": 1})"), HasSubstr("key 'quantities' not found"));
  EXPECT_THAT(message(R"({"status": "done", "wall_seconds": "x", "quantities": {}})"), HasSubstr("must be number"));
}

}  // namespace

namespace {

class SnapshotIndex : public ::testing::Test {
 protected:
  void write(int number, double time) const {
    const PointSet points{.time = time, .columns = {{"position", "m", std::vector<Vector3>{{1, 2, 3}}}}};
    write_points(folder_.snapshot(number), points.view());
  }
  nlohmann::json index() const { return nlohmann::json::parse(content_of(folder_.snapshot_index())); }

  const ScratchFolder scratch_;
  const RunFolder folder_ = RunFolder::create(scratch_ / "run", Existing::refuse);
};

const auto first_two = nlohmann::json::parse(R"({"file-series-version": "1.0", "files": [
  {"name": "particles_0000.vtkhdf", "time": 0.0}, {"name": "particles_0001.vtkhdf", "time": 0.1}]})");

TEST_F(SnapshotIndex, GrowsWithTheSnapshots) {
  write(0, 0);
  index_snapshots(folder_, 0);
  EXPECT_EQ(index()["files"].size(), 1u);
  write(1, 0.1);
  index_snapshots(folder_, 1);
  EXPECT_EQ(index(), first_two);
}

TEST_F(SnapshotIndex, LeavesOutWhatAResumedRunWillReplaceAndTakesItsNewTime) {
  for (const int number : {0, 1, 2, 3}) write(number, 7 + number);
  index_snapshots(folder_, 3);
  EXPECT_EQ(index()["files"][3]["time"], 10.0);
  write(1, 0.5);
  index_snapshots(folder_, 1);
  ASSERT_EQ(index()["files"].size(), 2u);
  EXPECT_EQ(index()["files"][0]["time"], 7.0);
  EXPECT_EQ(index()["files"][1]["time"], 0.5);
}

TEST_F(SnapshotIndex, IsMadeAnewWhereItIsMissingOrDamaged) {
  write(0, 0);
  write(1, 0.1);
  index_snapshots(folder_, 1);
  for (const char* damage : {"", "{\"files\": [", "{}", R"({"files": [{"name": "particles_0000.vtkhdf"}]})"}) {
    put_content(folder_.snapshot_index(), damage);
    index_snapshots(folder_, 1);
    EXPECT_EQ(index(), first_two) << damage;
  }
  std::filesystem::remove(folder_.snapshot_index());
  index_snapshots(folder_, 1);
  EXPECT_EQ(index(), first_two);
}

TEST_F(SnapshotIndex, ReadsNoSnapshotWhoseTimeItKnows) {
  write(0, 0);
  index_snapshots(folder_, 0);
  put_content(folder_.snapshot(0), "no longer a snapshot");
  write(1, 0.1);
  index_snapshots(folder_, 1);
  EXPECT_EQ(index(), first_two);
}

}  // namespace

}  // namespace talus

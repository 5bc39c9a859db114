// SPDX-License-Identifier: Apache-2.0
#include "io/summary.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/error.hpp"
#include "io/scratch_folder.hpp"

namespace talus {
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
}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
#include "app/comparison/evaluation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/error.hpp"

namespace talus::app {
namespace {

ComparisonRow row(std::vector<std::string> variants) {
  ComparisonRow row;
  row.id = "plateau", row.number = 1, row.quantity = "discharge_rate_plateau", row.unit = "kg/s", row.printed = "curve";
  row.variants = std::move(variants);
  row.criterion = {Criterion::Kind::between, 1, 2};
  return row;
}

TEST(Evaluation, JsonNamesRowsAndTheRunsTheyAreOf) {
  const ComparisonRow laws = row({"a", "b", "c", "d"});
  Reference reference;
  reference.study = "hopper", reference.title = "A hopper";
  const std::vector<FoundEnsemble> found = {{"section", "a", {"runs/laws/a/seed_0001", "runs/laws/a/seed_0002"}, {}}};
  const auto json = nlohmann::json::parse(to_json(
      reference, {{.row = &laws, .values = {1.5, 2.5, std::nullopt, std::nan("")}, .verdict = Verdict::not_met}}, found,
      "runs/laws"));
  EXPECT_EQ(json["title"], "A hopper");
  const auto& written = json["rows"][0];
  EXPECT_EQ(written["verdict"], "not met");
  EXPECT_EQ(written["values"], nlohmann::json({1.5, 2.5, nullptr, nullptr}));
  EXPECT_EQ(written["verdicts"], nlohmann::json({"met", "not met", "not evaluated", "not met"}))
      << "each variant judged by itself; what has no value there did not get there, what has no meaning is not met";
  EXPECT_EQ(json["runs"][0]["variant"], "a");
  EXPECT_EQ(json["runs"][0]["folders"], nlohmann::json({"a/seed_0001", "a/seed_0002"})) << "below the folder compared";
}

/// A run that goes on to t = 2.
StudiedRun run_with(double number) {
  return {[number](const std::string& quantity, const Window&) {
            if (quantity == "fails") throw std::invalid_argument("a spectrum needs four data");
            return number;
          },
          [](double time) { return time <= 2; }};
}

TEST(Evaluation, ARowThatFailsIsRefusedOrNotedAndTheOthersAreEvaluated) {
  Reference reference;
  reference.path = "reference.toml";
  reference.rows = {row({"a"}), row({"a", "b"}), row({"a"})};
  reference.rows[1].quantity = "fails";
  const StudiedRuns runs({{"", "a", {run_with(1.5)}}});
  EXPECT_THROW(evaluate(reference, {}, runs), InputError);
  const std::vector<EvaluatedRow> rows = evaluate(reference, {}, runs, Faults::note);
  ASSERT_EQ(rows.size(), 3);
  EXPECT_EQ(rows[0].verdict, Verdict::met);
  EXPECT_EQ(rows[1].verdict, Verdict::not_evaluated);
  EXPECT_EQ(rows[1].values.size(), 2);
  EXPECT_EQ(rows[1].missing, "a spectrum needs four data");
  EXPECT_EQ(rows[2].verdict, Verdict::met);
}

TEST(StudiedRuns, AreThereWhereAllOfAVariantReachTheWindow) {
  StudiedRun brief = run_with(3);
  brief.reaches = [](double time) { return time <= 1; };
  const StudiedRuns runs({{"", "a", {run_with(1), run_with(2)}}, {"", "b", {run_with(1), brief}}});
  ComparisonRow asked = row({"a", "b", "c"});
  EXPECT_THAT(runs.are_there(asked), testing::ElementsAre(true, true, false)) << "without a time";
  asked.window.at = 1.5;
  EXPECT_THAT(runs.are_there(asked), testing::ElementsAre(true, false, false));
  const RowNumbers numbers = runs.numbers(asked);
  EXPECT_THAT(numbers.of_variants[0], testing::ElementsAre(1.0, 2.0));
  EXPECT_TRUE(numbers.of_variants[1].empty());
  asked.window = {.from = 0.5, .to = 3};
  EXPECT_THAT(runs.are_there(asked), testing::ElementsAre(false, false, false));
}

TEST(Evaluation, JsonSaysWhyARowOfRunsThatAreThereHasNoValue) {
  const ComparisonRow here = row({"a"}), there = row({"a", "b"});
  const std::vector<FoundEnsemble> found = {{"", "a", {"r"}, {}}};
  const auto json =
      nlohmann::json::parse(to_json({},
                                    {{.row = &here, .values = {1.5}, .verdict = Verdict::met},
                                     {.row = &here, .values = {std::nullopt}},
                                     {.row = &here, .values = {std::nullopt}, .missing = "a spectrum needs four data"},
                                     {.row = &there, .values = {std::nullopt, std::nullopt}}},
                                    found, "."));
  const auto missing = [&](std::size_t n) { return json["rows"][n]["missing"].get<std::string>(); };
  EXPECT_EQ(missing(0), "");
  EXPECT_THAT(missing(1), testing::HasSubstr("ends before"));
  EXPECT_EQ(missing(2), "a spectrum needs four data");
  EXPECT_EQ(missing(3), "") << "it needs another run";
}

TEST(Evaluation, CountsVerdicts) {
  const ComparisonRow both = row({"a", "b"});
  EXPECT_EQ(counts_text({{.row = &both, .values = {}, .verdict = Verdict::met},
                         {.row = &both, .values = {}, .verdict = Verdict::not_met},
                         {.row = &both, .values = {}, .verdict = Verdict::met}}),
            "2 met, 1 not met, 0 reported, 0 not evaluated");
}

}  // namespace
}  // namespace talus::app

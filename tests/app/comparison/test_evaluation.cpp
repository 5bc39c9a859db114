// SPDX-License-Identifier: Apache-2.0
#include "app/comparison/evaluation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace talus::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

ComparisonRow row(std::vector<std::string> variants) {
  ComparisonRow row;
  row.id = "plateau", row.number = 1, row.quantity = "discharge_rate_plateau", row.unit = "kg/s", row.printed = "curve";
  row.variants = std::move(variants);
  row.criterion = {Criterion::Kind::between, 1, 2};
  return row;
}

TEST(Evaluation, ManyVariantsStandBelowEachOtherEachJudgedByItself) {
  const ComparisonRow laws = row({"a", "b", "c", "d", "e"});
  const std::string table = to_markdown({{.row = &laws, .values = {1.5, 2.5, std::nullopt, 1.0, 0.5}}});
  EXPECT_THAT(table, HasSubstr("| a | 1.5 |\n| b | **2.5** |\n| c | - |\n| d | 1 |\n| e | **0.5** |\n"));
}

TEST(Evaluation, FewVariantsStandInALine) {
  const ComparisonRow both = row({"a", "b"});
  const std::string table = to_markdown({{.row = &both, .values = {1.5, 2.5}, .verdict = Verdict::not_met}});
  EXPECT_THAT(table, HasSubstr("1.5, 2.5 | not met |"));
  EXPECT_THAT(table, Not(HasSubstr("**2.5**")));
}

}  // namespace
}  // namespace talus::app

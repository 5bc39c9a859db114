// SPDX-License-Identifier: Apache-2.0
#include "analysis/comparison.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "analysis/measure.hpp"

namespace talus {
namespace {

using Kind = Criterion::Kind;

TEST(Criterion, EndsBelongToRangesAndNotToBounds) {
  struct Case {
    Criterion criterion;
    std::vector<double> met, not_met;
    std::string text;
  };
  const std::vector<Case> cases = {
      {{Kind::between, 30, 70}, {30, 50, 70}, {29.999, 70.001, NAN}, "30 to 70"},
      {{Kind::between, 1, 1}, {1}, {0, 1.05, 2}, "1"},
      {{Kind::within, 17.25, 2}, {15.25, 17, 19.25}, {15.2, 19.3, NAN}, "17.25 ± 2"},
      {{Kind::above, 0.9}, {0.91, INFINITY}, {0.9, -1, NAN}, "> 0.9"},
      {{Kind::below, 8}, {7.9, -3}, {8, 9, NAN}, "< 8"},
      {{Kind::positive}, {1e-9}, {0, -1, NAN}, "positive"},
      {{Kind::negative}, {-1e-9}, {0, 1, NAN}, "negative"},
  };
  for (const Case& c : cases) {
    for (const double value : c.met) EXPECT_EQ(judge(c.criterion, value), Verdict::met) << c.text << " " << value;
    for (const double value : c.not_met)
      EXPECT_EQ(judge(c.criterion, value), Verdict::not_met) << c.text << " " << value;
    EXPECT_EQ(judge(c.criterion, std::nullopt), Verdict::not_evaluated);
    EXPECT_EQ(to_string(c.criterion), c.text);
  }
  EXPECT_EQ(judge({Kind::reported}, 3.0), Verdict::reported);
  EXPECT_EQ(judge({Kind::reported}, std::nullopt), Verdict::reported);
}

TEST(Criterion, HasToHoldAtEachRadiusThatIsThere) {
  using Values = std::vector<std::optional<double>>;
  const Criterion above{Kind::above, 1};
  EXPECT_EQ(judge(above, Values{2, 3, 4}), Verdict::met);
  EXPECT_EQ(judge(above, Values{2, 1, 4}), Verdict::not_met);
  EXPECT_EQ(judge(above, Values{2, std::nullopt, 4}), Verdict::met);
  EXPECT_EQ(judge(above, Values{std::nullopt, NAN}), Verdict::not_met);
  EXPECT_EQ(judge(above, Values{std::nullopt, std::nullopt}), Verdict::not_evaluated);
  EXPECT_EQ(judge(above, Values{0, std::nullopt, 4}), Verdict::not_met);
  EXPECT_EQ(judge(above, Values{}), Verdict::not_evaluated);
}

TEST(Statistic, OverMembers) {
  const std::vector<double> numbers = {1, 2, 6};
  EXPECT_DOUBLE_EQ(evaluate(Statistic::mean, numbers), 3);
  EXPECT_DOUBLE_EQ(evaluate(Statistic::median, numbers), 2);
  EXPECT_DOUBLE_EQ(evaluate(Statistic::standard_deviation, numbers), std::sqrt(7.0));
}

TEST(Statistic, OfTwoVariants) {
  const std::vector<double> two = {6, 2}, three = {1, 2, 3};
  EXPECT_DOUBLE_EQ(evaluate(Statistic::ratio, two), 3);
  EXPECT_DOUBLE_EQ(evaluate(Statistic::difference, two), 4);
  EXPECT_THROW(evaluate(Statistic::ratio, three), std::invalid_argument);
}

TEST(RowValues, AreStatisticsOverTheMembersOfEachVariant) {
  const RowNumbers numbers{.of_variants = {{1, 2, 6}, {}, {5}, {4, std::nullopt}}};
  using Values = std::vector<std::optional<double>>;
  EXPECT_EQ(row_values({.statistic = Statistic::mean}, numbers), (Values{3, {}, 5, {}}));
  EXPECT_EQ(row_values({.statistic = Statistic::median}, numbers), (Values{2, {}, 5, {}}));
  EXPECT_EQ(row_values({.statistic = Statistic::standard_deviation}, numbers), (Values{std::sqrt(7.0), {}, {}, {}}));
  EXPECT_EQ(row_values({.from = From::curves}, {.of_variants = {{7}, {}}}), (Values{7, {}}));
  EXPECT_EQ(row_values({.from = From::parameters}, {.of_variants = {{7, 8}}}), (Values{7}));
}

TEST(RowValues, MembersWithoutANumberAreLeftOutWhileTheyAreTheFewer) {
  const double nan = std::nan("");
  const auto mean_of = [](std::vector<std::optional<double>> members, bool may_be_missing) {
    return *row_values({}, {.of_variants = {std::move(members)}, .may_be_missing = may_be_missing}).at(0);
  };
  EXPECT_EQ(mean_of({1, 2, nan}, true), 1.5);
  EXPECT_EQ(mean_of({1, nan}, true), 1) << "half of them";
  EXPECT_TRUE(std::isnan(mean_of({1, nan, nan}, true)));
  EXPECT_TRUE(std::isnan(mean_of({1, 2, nan}, false)));
}

TEST(RowValues, OfTwoVariantsAreMadeFromTheirMeans) {
  using Values = std::vector<std::optional<double>>;
  const ComparisonRow ratio{.from = From::variants, .statistic = Statistic::ratio};
  const ComparisonRow difference{.from = From::variants, .statistic = Statistic::difference};
  EXPECT_EQ(row_values(ratio, {.of_variants = {{1, 2}, {3}}}), (Values{0.5}));
  EXPECT_EQ(row_values(difference, {.of_variants = {{1, 2}, {3}}}), (Values{-1.5}));
  EXPECT_EQ(row_values(difference, {.of_variants = {{1, 2}, {}}}), (Values{{}}));
  EXPECT_THROW(row_values(ratio, {.of_variants = {{1}}}), std::invalid_argument);
  EXPECT_EQ(row_values({.from = From::variants}, {.of_variants = {{9}}}), (Values{9})) << "of all of them together";
  EXPECT_EQ(row_values({.from = From::variants}, {}), (Values{{}}));
}

TEST(Measures, AreNamedOnce) {
  std::set<std::string_view> names;
  const std::vector<MeasureText> all = all_measures();
  for (const MeasureText& measure : all) {
    EXPECT_TRUE(names.insert(measure.name).second) << measure.name;
    EXPECT_FALSE(measure.text.empty()) << measure.name;
  }
  ASSERT_TRUE(find_measure("head_width"));
  EXPECT_EQ(find_measure("head_width")->unit, "m");
  EXPECT_FALSE(find_measure("head_widths"));
}

}  // namespace
}  // namespace talus

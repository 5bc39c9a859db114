// SPDX-License-Identifier: Apache-2.0
#include "base/exact_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace talus {
namespace {

double sum_of(const std::vector<double>& terms) {
  ExactSum sum;
  for (const double term : terms) sum.add(term);
  return sum.value();
}

/// Terms of either sign over 120 orders of magnitude, from integers alone: the same in any language.
std::vector<double> spread_terms(std::size_t count) {
  std::vector<double> terms;
  std::uint64_t state = 1;
  const auto next = [&] { return state = state * 6364136223846793005u + 1442695040888963407u, state >> 33; };
  while (terms.size() < count) {
    const auto mantissa = static_cast<double>(next()) - 0x1p30;
    terms.push_back(std::ldexp(mantissa, static_cast<int>(next() % 400) - 200));
  }
  return terms;
}

TEST(ExactSum, IsRoundedOnceAndOfNoOrder) {
  std::vector<double> terms = spread_terms(100000);
  terms.push_back(-1e80), terms.push_back(1e-70);
  const double expected = sum_of(terms);
  std::mt19937 random(1);
  for (int order = 0; order < 20; ++order) {
    std::shuffle(terms.begin(), terms.end(), random);
    ASSERT_EQ(sum_of(terms), expected);
  }
  EXPECT_EQ(expected, -0x1.afcef51e95845p265);  // math.fsum of Python
}

TEST(ExactSum, KeepsWhatDoublesLose) {
  EXPECT_EQ(sum_of({1e100, 1, -1e100}), 1);
  EXPECT_EQ(sum_of({1e308, 1e308, -1e308}), 1e308);
  EXPECT_EQ(sum_of({0.1, 0.2, -0.3}), 0x1p-55);
  EXPECT_EQ(sum_of({}), 0);
  EXPECT_EQ(sum_of({1, -1}), 0);
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(sum_of({least, least, -0x1p-1022, 0x1p-1022}), 2 * least);
  EXPECT_EQ(sum_of({-least}), -least);
}

TEST(ExactSum, RoundsTiesToEvenAndSeesTheLeastRest) {
  EXPECT_EQ(sum_of({1, 0x1p-53}), 1);
  EXPECT_EQ(sum_of({1, 0x1p-52, 0x1p-53}), 1 + 0x1p-51);
  EXPECT_EQ(sum_of({1, 0x1p-53, 0x1p-1000}), 1 + 0x1p-52);
  EXPECT_EQ(sum_of({-1, -0x1p-53, -0x1p-1000}), -1 - 0x1p-52);
  EXPECT_EQ(sum_of({1, 0x1p-53, -0x1p-1000}), 1);
}

TEST(ExactSum, OfInfinitiesAndNoNumbers) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(sum_of({1, infinity}), infinity);
  EXPECT_TRUE(std::isnan(sum_of({infinity, -infinity})));
  EXPECT_TRUE(std::isnan(sum_of({1, std::nan("")})));
  const double largest = std::numeric_limits<double>::max();
  EXPECT_EQ(sum_of({largest, largest}), infinity);
}

TEST(ExactSum, OfPartsIsThatOfAllOnAnyNumberOfThreads) {
  const std::vector<double> terms = spread_terms(5001);
  for (const int threads : {1, 2, 3}) {
    ThreadTeam team(threads);
    EXPECT_EQ(exact_sum(team, terms.size(), [&](std::size_t i) { return terms[i]; }), sum_of(terms));
    EXPECT_EQ(exact_sum(team, 0, [&](std::size_t i) { return terms[i]; }), 0);
    EXPECT_EQ(exact_sum(team, 2, [&](std::size_t i) { return terms[i]; }), terms[0] + terms[1]);
  }
}

TEST(FixedPoint, IsOfNoOrderAndAsExactAsDoubles) {
  const FixedPoint point(3e-7);
  std::vector<double> terms;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> size(-1e-12, 1e-6);
  for (int n = 0; n < 10000; ++n) terms.push_back(size(random));
  FixedPoint::Integer sum = 0, again = 0;
  for (const double term : terms) sum += point.of(term);
  std::shuffle(terms.begin(), terms.end(), random);
  for (const double term : terms) again += point.of(term);
  EXPECT_TRUE(sum == again);
  EXPECT_NEAR(point.value(sum) / sum_of(terms), 1, 3e-16);
  for (const double term : {1e-6, -1e-6, 1.2345678901234567e-9, 3e5, -3e5, 0.0})
    EXPECT_EQ(point.value(point.of(term)), term);
  EXPECT_GT(point.value(point.of(std::nan(""))), 1e5);
  // Twenty times the largest term is beyond the range: the sum wraps around.
  FixedPoint::Integer of_none = 0;
  for (int n = 0; n < 20; ++n) of_none += point.of(std::nan(""));
  EXPECT_TRUE(std::isfinite(point.value(of_none)));
}

}  // namespace
}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
/// SimdVector of the instruction set that the tests are compiled for. The others run in the tests of the sum over
/// pairs.
#include "base/elementary.hpp"
#include "base/simd.hpp"
#include "base/simd_columns.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus {
namespace {

template <class T>
class SimdVectors : public testing::Test {};
using Numbers = testing::Types<float, double>;
TYPED_TEST_SUITE(SimdVectors, Numbers);

template <class T>
SimdVector<T> ramp(double first) {
  return SimdVector<T>::ramp(0) + first;
}

TYPED_TEST(SimdVectors, ComputeLaneByLaneAndRowByRow) {
  using T = TypeParam;
  const T rows[2] = {3, 5};
  const auto x = SimdVector<T, 2>::broadcast(rows);
  const auto y = ramp<T>(2);
  const auto sum = x + y, difference = x - y, product = x * y, quotient = x / y;
  const auto fused = multiply_add(x, y, SimdVector<T>(7)), negative = negative_multiply_add(x, y, SimdVector<T>(7));
  const auto over_rows = multiply_add_rows(x, y, SimdVector<T>(1));
  for (int r = 0; r < 2; ++r)
    for (int k = 0; k < SimdVector<T>::lanes; ++k) {
      const T a = rows[r], b = static_cast<T>(2 + k);
      EXPECT_EQ(sum.row[r][k], a + b);
      EXPECT_EQ(difference.row[r][k], a - b);
      EXPECT_EQ(product.row[r][k], a * b);
      EXPECT_EQ(quotient.row[r][k], a / b);
      EXPECT_EQ(fused.row[r][k], a * b + 7);
      EXPECT_EQ(negative.row[r][k], 7 - a * b);
      EXPECT_EQ(over_rows.row[0][k], 1 + 3 * b + 5 * b);
    }
  const int n = SimdVector<T>::lanes;
  EXPECT_EQ(sum_lanes(x, 1), 5 * n);
  EXPECT_EQ(sum_lanes(y, 0), 2 * n + n * (n - 1) / 2);
}

TYPED_TEST(SimdVectors, SelectWhateverStandsInTheOther) {
  using T = TypeParam;
  const T nan = std::numeric_limits<T>::quiet_NaN();
  const auto index = SimdVector<T>::ramp(4);
  const auto chosen = select(index > SimdVector<T, 2>::ramp_of_rows(4), index, SimdVector<T>(static_cast<double>(nan)));
  for (int r = 0; r < 2; ++r)
    for (int k = 0; k < SimdVector<T>::lanes; ++k)
      if (k > r)
        EXPECT_EQ(chosen.row[r][k], 4 + k);
      else
        EXPECT_TRUE(std::isnan(chosen.row[r][k]));
  EXPECT_TRUE(all(index > SimdVector<T>(3)));
  EXPECT_FALSE(all(index > SimdVector<T>(4)));
  EXPECT_FALSE(all(SimdVector<T>(static_cast<double>(nan)) > SimdVector<T>(0)));
}

TYPED_TEST(SimdVectors, PackTheLanesThatAreChosen) {
  using T = TypeParam;
  constexpr int lanes = SimdVector<T>::lanes;
  for (unsigned wanted = 0; wanted<(1u << lanes); wanted += lanes> 8 ? 37 : 1) {
    T flag[lanes + 1], packed[lanes];
    for (int k = 0; k < lanes; ++k) flag[k + 1] = wanted >> k & 1u ? T(1) : T(-1);
    const auto chosen = SimdVector<T>::load_unaligned(flag + 1) > SimdVector<T>(0);
    EXPECT_EQ(lane_bits(chosen), wanted);
    store_packed(ramp<T>(3), chosen, packed);
    int count = 0;
    for (int k = 0; k < lanes; ++k)
      if (wanted >> k & 1u) {
        EXPECT_EQ(packed[count], 3 + k) << wanted;
        ++count;
      }
  }
}

TYPED_TEST(SimdVectors, ReciprocalSquareRootOverTheRangeOfDistances) {
  using T = TypeParam;
  for (double x = 1e-12; x < 1e12; x *= 1.37) {
    const T argument = static_cast<T>(x);
    const T y = reciprocal_sqrt(SimdVector<T>(static_cast<double>(argument))).row[0][0];
    const auto ratio = static_cast<double>(y * std::sqrt(static_cast<long double>(argument)));
    EXPECT_NEAR(ratio, 1, std::numeric_limits<T>::epsilon());
  }
  EXPECT_FALSE(std::isfinite(reciprocal_sqrt(SimdVector<T>(0)).row[0][0]));
}

TYPED_TEST(SimdVectors, LoadColumnsOfRowsAndSumTheirLanes) {
  using Number = SimdVector<TypeParam>;
  constexpr int columns = 16;
  alignas(64) TypeParam row[Number::lanes][columns];
  for (int k = 0; k < Number::lanes; ++k)
    for (int c = 0; c < columns; ++c) row[k][c] = static_cast<TypeParam>(100 * k + c);
  Number column[columns];
  load_columns([&](int lane) { return row[Number::lanes - 1 - lane]; }, column);
  alignas(64) double sum[columns];
  store_sums(column, sum);
  for (int c = 0; c < columns; ++c) {
    for (int k = 0; k < Number::lanes; ++k) EXPECT_EQ(column[c].row[0][k], 100 * (Number::lanes - 1 - k) + c);
    EXPECT_EQ(sum[c], Number::lanes * c + 50 * Number::lanes * (Number::lanes - 1));
  }
}

/// Sums of the first columns of some whose sums depend on their order. \pre at most 32
template <class T, int count>
void expect_sums_as_of_eight(const SimdVector<T> (&column)[32]) {
  SimdVector<T> some[count];
  std::copy_n(column, count, some);
  alignas(64) double sum[count];
  store_sums(some, sum);
  for (int first = 0; first < count; first += 8) {
    SimdVector<T> eight[8];
    std::copy_n(column + first, 8, eight);
    alignas(64) double expected[8];
    store_sums(eight, expected);
    for (int c = 0; c < 8 && first + c < count; ++c)
      EXPECT_EQ(sum[first + c], expected[c]) << count << ", " << first + c;
  }
}

TYPED_TEST(SimdVectors, SumsOverTheLanesAreTheSameHoweverManyColumnsThereAre) {
  using Number = SimdVector<TypeParam>;
  Number column[32];
  for (int c = 0; c < 32; ++c) column[c] = 1.0 / (Number::ramp(static_cast<std::size_t>(3 * c)) + 0.7);
  expect_sums_as_of_eight<TypeParam, 8>(column);
  expect_sums_as_of_eight<TypeParam, 16>(column);
  expect_sums_as_of_eight<TypeParam, 24>(column);
  expect_sums_as_of_eight<TypeParam, 32>(column);
  if constexpr (sizeof(TypeParam) == sizeof(float)) {
    expect_sums_as_of_eight<TypeParam, 4>(column);
    expect_sums_as_of_eight<TypeParam, 20>(column);
    expect_sums_as_of_eight<TypeParam, 28>(column);
  }
}

TEST(CubeRoot, IsThatOfTheLibraryOverAllMagnitudes) {
  for (double x = 1e-300; x < 1e300; x *= 1.7)
    EXPECT_NEAR(static_cast<double>(cube_root(x) / std::cbrt(static_cast<long double>(x))), 1, 3e-16) << x;
  for (const std::uint64_t bits : {0ull, 1ull, 0xffffffffull, 0x100000000ull, 0x2ffffffffull, 0xffffffffffffffffull})
    for (std::uint64_t less = 0; less < 5; ++less) EXPECT_EQ(third_of(bits - less), (bits - less) / 3) << bits;
  for (const double x : {0.0, -8.0, 5e-324}) EXPECT_EQ(cube_root(x), std::cbrt(x));
  EXPECT_TRUE(std::isnan(cube_root(NAN)));
}

TEST(LogNearOne, IsThatOfTheLibraryWithTheSameBitsInVectors) {
  using Number = SimdVector<double>;
  for (double x = 0.01; x < 100; x *= 1.003) {
    const double found = log_near_one(x);
    const auto exact = static_cast<double>(std::log(static_cast<long double>(x)));
    EXPECT_NEAR(found, exact, 5e-16 * std::abs(exact)) << x;
    Number several = 1.1;  // of which one may lie outside
    several.row[0][0] = x;
    EXPECT_EQ(log_near_one(several).row[0][0], found);
    EXPECT_EQ(log_near_one(several).row[0][1], log_near_one(1.1));
  }
  EXPECT_NEAR(log_near_one(1 + 0x1p-40), 0x1p-40, 0x1p-80);
  EXPECT_EQ(log_near_one(1.0), 0);
}

}  // namespace
}  // namespace talus

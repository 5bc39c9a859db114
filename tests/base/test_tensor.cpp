// SPDX-License-Identifier: Apache-2.0
#include "base/tensor.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace talus {
namespace {

constexpr Tensor3<> general{2, -1, 0.5, 3, 4, -2, 1, 0.25, 5};
constexpr SymmetricTensor3<> symmetric{1, 2, 4, 0.5, -3, 0.25};

TEST(Tensor, MultipliesRowsWithColumns) {
  const Tensor3<> product = general * transpose(general);
  EXPECT_DOUBLE_EQ(product.xx, 2 * 2 + 1 + 0.25);
  EXPECT_DOUBLE_EQ(product.xy, 2 * 3 - 4 - 1);
  EXPECT_DOUBLE_EQ(product.zy, 3 + 1 - 10);
  EXPECT_DOUBLE_EQ(product.yz, product.zy);
}

TEST(Tensor, InverseUndoesTheTensor) {
  // By the rule of Sarrus: 40 + 2 + 0.375 - 2 + 1 + 15.
  EXPECT_DOUBLE_EQ(determinant(general), 56.375);
  const Tensor3<> unit = general * inverse(general);
  const Tensor3<> difference = unit - full(isotropic(1.0));
  for (const double component : {difference.xx, difference.xy, difference.xz, difference.yx, difference.yy,
                                 difference.yz, difference.zx, difference.zy, difference.zz})
    EXPECT_NEAR(component, 0, 1e-15);
}

TEST(Tensor, SplitsIntoSymmetricAndAntisymmetricPart) {
  EXPECT_EQ(full(symmetric_part(general)) + antisymmetric_part(general), general);
  EXPECT_DOUBLE_EQ(symmetric_part(general).zx, 0.75);
  EXPECT_DOUBLE_EQ(antisymmetric_part(general).xz, -0.25);
}

TEST(Tensor, DeviatorHasNoTraceAndNormCountsShearTwice) {
  EXPECT_NEAR(trace(deviator(symmetric)), 0, 1e-15);
  EXPECT_DOUBLE_EQ(deviator(symmetric).zz, 4 - 7.0 / 3);
  EXPECT_DOUBLE_EQ(norm(symmetric), std::sqrt(1 + 4 + 16 + 2 * (0.25 + 9 + 0.0625)));
}

TEST(Tensor, QuarterTurnAboutYExchangesXAndZ) {
  const Tensor3<> turn{0, 0, 1, 0, 1, 0, -1, 0, 0};
  const SymmetricTensor3<> turned = transformed(symmetric, turn);
  EXPECT_EQ(turned, (SymmetricTensor3<>{4, 2, 1, -3, -0.5, -0.25}));
}

TEST(SimdVector, HelpersOfLawsAgreeWithNumbersAlone) {
  using Many = SimdVector<double>;
  double first[Many::lanes], second[Many::lanes];
  for (int k = 0; k < Many::lanes; ++k) first[k] = 0.3 + k, second[k] = 1.7 - 0.5 * k;
  Many a, b;
  for (int k = 0; k < Many::lanes; ++k) a.row[0][k] = first[k], b.row[0][k] = second[k];
  const double table[2][2] = {{1, 2}, {3, 4}};
  Many gathered[2];
  gather_rows(
      a, [&](double x) { return table[x > 1 ? 1 : 0]; }, gathered);
  const auto between = a < b && a > Many(0.5);
  const auto outside = a < b || a > Many(0.5);
  for (int k = 0; k < Many::lanes; ++k) {
    EXPECT_EQ(minimum(a, b).row[0][k], minimum(first[k], second[k]));
    EXPECT_EQ(maximum(a, b).row[0][k], maximum(first[k], second[k]));
    EXPECT_EQ(sqrt(a).row[0][k], std::sqrt(first[k]));
    EXPECT_EQ(log(a).row[0][k], std::log(first[k]));
    EXPECT_EQ(gathered[1].row[0][k], first[k] > 1 ? 4 : 2);
    EXPECT_EQ(select(between, a, b).row[0][k], first[k] < second[k] && first[k] > 0.5 ? first[k] : second[k]);
    EXPECT_EQ(select(outside, a, b).row[0][k], first[k] < second[k] || first[k] > 0.5 ? first[k] : second[k]);
  }
}

}  // namespace
}  // namespace talus

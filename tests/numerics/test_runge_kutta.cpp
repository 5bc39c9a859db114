// SPDX-License-Identifier: Apache-2.0
#include "numerics/runge_kutta.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace talus {
namespace {

/// One step of y' = lambda y from y = 1: the stability polynomial at h lambda.
double polynomial(const ChebyshevStages& scheme, double z) {
  double before = 1, latest = 1 + scheme.stages[0].rate * z;
  for (std::size_t j = 1; j < scheme.stages.size(); ++j) {
    const auto& stage = scheme.stages[j];
    const double next = stage.previous * latest + stage.before_previous * before + stage.rate * z * latest;
    before = latest;
    latest = next;
  }
  return latest;
}

TEST(Chebyshev, OneStageIsExplicitEuler) {
  const ChebyshevStages scheme = chebyshev_stages(1, 0.1);
  EXPECT_DOUBLE_EQ(scheme.stages[0].rate, 1.0);
  EXPECT_DOUBLE_EQ(polynomial(scheme, -0.7), 0.3);
  EXPECT_EQ(scheme.second_order, 0);
}

TEST(Chebyshev, IsConsistentAndItsSecondOrderCoefficientIsKnown) {
  for (const int stages : {1, 2, 3, 5, 9, 40}) {
    const ChebyshevStages scheme = chebyshev_stages(stages, 0.1);
    const double h = 1e-3;
    const double first = (polynomial(scheme, h) - polynomial(scheme, -h)) / (2 * h);
    const double second = (polynomial(scheme, h) - 2 + polynomial(scheme, -h)) / (2 * h * h);
    EXPECT_NEAR(polynomial(scheme, 0), 1, 1e-13);
    EXPECT_NEAR(first, 1, 1e-6);
    EXPECT_NEAR(second, scheme.second_order, 1e-6) << stages;
    EXPECT_NEAR(scheme.stages.back().time, 1, 1e-12);
  }
  // Undamped, many stages: T_s''(1)/(2 T_s'(1)^2) = (1 - 1/s^2)/6.
  EXPECT_NEAR(chebyshev_stages(50, 1e-9).second_order, (1 - 1.0 / 2500) / 6, 1e-6);
}

TEST(Chebyshev, IsStableAndDampedUpToItsBoundAndNotMuchBeyond) {
  for (const int stages : {2, 3, 9, 45, 150}) {
    const ChebyshevStages scheme = chebyshev_stages(stages, 0.1);
    EXPECT_GT(scheme.stability, 1.85 * stages * stages);
    for (int k = 1; k <= 2000; ++k) EXPECT_LE(std::abs(polynomial(scheme, -scheme.stability * k / 2000.0)), 1 + 1e-10);
    EXPECT_LT(std::abs(polynomial(scheme, -scheme.stability)), 0.92);
    EXPECT_GT(std::abs(polynomial(scheme, -1.2 * scheme.stability)), 1.0);
  }
}

TEST(Chebyshev, LeastNumberOfStagesIsLeast) {
  for (const double stiffness : {0.0, 1.0, 1.9, 2.1, 10.0, 150.0, 3600.0, 1e5}) {
    const int stages = stages_for(stiffness, 0.1);
    EXPECT_GE(chebyshev_stages(stages, 0.1).stability, stiffness);
    if (stages > 1) {
      EXPECT_LT(chebyshev_stages(stages - 1, 0.1).stability, stiffness);
    }
  }
  EXPECT_THROW(stages_for(INFINITY, 0.1), std::invalid_argument);
  EXPECT_THROW(chebyshev_stages(0, 0.1), std::invalid_argument);
}

TEST(Chebyshev, ConvergesWithFirstOrderBesideAStiffMode) {
  // y' = -y beside a mode that decays 1000 times faster: the step is chosen for the slow one, the stages for the stiff.
  auto error = [](int steps) {
    const ChebyshevStages scheme = chebyshev_stages(stages_for(1000.0 / steps, 0.1), 0.1);
    EXPECT_LT(std::abs(std::pow(polynomial(scheme, -1000.0 / steps), steps)), 1e-2);
    return std::abs(std::pow(polynomial(scheme, -1.0 / steps), steps) - std::exp(-1.0));
  };
  EXPECT_LT(error(40), 4e-3);
  for (const int steps : {40, 80, 160}) EXPECT_NEAR(std::log2(error(steps) / error(2 * steps)), 1.0, 0.1);
}

}  // namespace
}  // namespace talus

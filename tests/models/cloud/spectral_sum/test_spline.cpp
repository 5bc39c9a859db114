// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/spectral_sum/spline.hpp"

#include <gtest/gtest.h>

namespace talus::cloud {
namespace {

template <int order>
void expect_spline() {
  for (const double t : {0.0, 0.2, 0.5, 0.93}) {
    const SplineWeights<double, order> here(t), after(t + 1e-6);
    double sum = 0, moment = 0;
    for (int k = 0; k < order; ++k) {
      sum += here.value[k];
      moment += here.value[k] * (k - (order / 2 - 1) - t);
      EXPECT_GE(here.value[k], 0);
      EXPECT_NEAR(here.slope[k], (after.value[k] - here.value[k]) / 1e-6, 1e-5);
    }
    EXPECT_NEAR(sum, 1, 1e-14);
    EXPECT_NEAR(moment, 0, 1e-14) << "its centre is where the sphere is";
  }
}

TEST(SplineWeights, AddUpToOneAboutTheirSphere) {
  expect_spline<4>();
  expect_spline<6>();
  expect_spline<8>();
}

TEST(SplineWeights, AreTheCubicSpline) {
  const SplineWeights<double, 4> w(0.25);
  EXPECT_NEAR(w.value[0], 0.75 * 0.75 * 0.75 / 6, 1e-15);
  EXPECT_NEAR(w.value[3], 0.25 * 0.25 * 0.25 / 6, 1e-15);
}

TEST(SplineCorrection, UndoesTheSplineWhereThereAreNoAliases) {
  EXPECT_NEAR(spline_correction(0, 4), 1, 1e-15);
  const double k = 0.3, w = std::pow(std::sin(k / 2) / (k / 2), 6);
  EXPECT_NEAR(spline_correction(k, 6), 1 / (w * w), 1e-9);
}

}  // namespace
}  // namespace talus::cloud

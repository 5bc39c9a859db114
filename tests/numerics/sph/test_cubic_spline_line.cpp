// SPDX-License-Identifier: Apache-2.0
#include "numerics/sph/cubic_spline_line.hpp"

#include <gtest/gtest.h>

#include "numerics/sph/cubic_spline.hpp"

namespace talus::sph {
namespace {

TEST(CubicSplineLine, IsTheKernelsIntegralAlongALine) {
  const double h = 0.4;
  for (const double s : {0.0, 1e-9, 0.1, 0.37, 0.4, 0.55, 0.79, 0.8, 0.9}) {
    const int steps = 200000;
    double sum = 0;
    for (int n = 0; n < steps; ++n) {
      const double y = (n + 0.5) * 2 * h / steps;
      sum += 2 * cubic_spline(std::sqrt(s * s + y * y), h) * 2 * h / steps;
    }
    EXPECT_NEAR(cubic_spline_line(s, h), sum, 1e-9) << s;
  }
}

TEST(CubicSplineLine, HasUnitIntegralOverThePlane) {
  const double h = 0.25;
  double sum = 0;
  const int rings = 100000;
  for (int n = 0; n < rings; ++n) {
    const double r = (n + 0.5) * 2 * h / rings;
    sum += 2 * std::numbers::pi * r * cubic_spline_line(r, h) * 2 * h / rings;
  }
  EXPECT_NEAR(sum, 1, 1e-9);
  EXPECT_EQ(cubic_spline_line(2 * h, h), 0);
}

}  // namespace
}  // namespace talus::sph

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/random.hpp"
#include "numerics/sph/cubic_spline.hpp"

namespace talus::sph {

namespace {

constexpr double pi = std::numbers::pi;

TEST(CubicSpline, HasMonaghansValues) {
  // Monaghan 1992, section 2.2: 1 - 3/2 q^2 + 3/4 q^3 and (2-q)^3/4, over pi h^3.
  const double h = 0.7;
  for (const double q : {0.0, 0.3, 0.999, 1.0, 1.5, 1.99}) {
    const double printed = q < 1 ? 1 - 1.5 * q * q + 0.75 * q * q * q : 0.25 * std::pow(2 - q, 3);
    EXPECT_NEAR(cubic_spline(q * h, h), printed / (pi * h * h * h), 1e-14);
  }
  EXPECT_EQ(cubic_spline(2.0 * h, h), 0);
  EXPECT_EQ(cubic_spline(5.0 * h, h), 0);
  EXPECT_EQ(cubic_spline_slope(2.0 * h, h), 0);
  EXPECT_EQ(cubic_spline_slope(5.0 * h, h), 0);
}

TEST(CubicSpline, HasTheVolumeOne) {
  const double h = 1.3;
  const int n = 2000;
  double sum = 0;
  for (int k = 0; k < n; ++k) {
    const double r = (k + 0.5) * 2 * h / n;
    sum += 4 * pi * r * r * cubic_spline(r, h) * 2 * h / n;
  }
  EXPECT_NEAR(sum, 1, 1e-6);
}

TEST(CubicSpline, SlopeIsTheDerivativeOverTheDistance) {
  const double h = 0.9, d = 1e-6;
  for (const double r : {1e-3, 0.2, 0.89, 0.91, 1.3, 1.7}) {
    const double derivative = (cubic_spline(r + d, h) - cubic_spline(r - d, h)) / (2 * d);
    EXPECT_NEAR(cubic_spline_slope(r, h) * r, derivative, 1e-8);
  }
  EXPECT_DOUBLE_EQ(cubic_spline_slope(0.0, h), -3 / (pi * std::pow(h, 5)));
}

TEST(CubicSpline, OnALatticeOfSpacingHTheKernelsSumToTheDensity) {
  // Known for this kernel: the sum over the cubic lattice is 1 to 2e-5; the moment of its gradient is 1.0196.
  double sum = 0, moment = 0;
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      for (int k = -2; k <= 2; ++k) {
        const double r = std::sqrt(double(i * i + j * j + k * k));
        sum += cubic_spline(r, 1.0);
        moment -= cubic_spline_slope(r, 1.0) * i * i;
      }
  EXPECT_NEAR(sum, 1, 2e-4);
  EXPECT_NEAR(moment, 1.02, 1e-3);
}

TEST(SmoothingLength, IsTheSpacingOfTheLattice) {
  EXPECT_DOUBLE_EQ(smoothing_length(1500 * std::pow(1.5e-3, 3), 1500), 1.5e-3);
}

}  // namespace

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

namespace {

TEST(CubicSpline, OverAPlaneIsItsIntegral) {
  const double h = 0.3;
  double all = 0;
  for (int n = 0; n < 2000; ++n) all += 2e-3 * h * cubic_spline_plane((n + 0.5) * 1e-3 * h, h);
  EXPECT_NEAR(all, 1, 1e-5);
  for (const double z : {0.0, 0.1, 0.29, 0.5}) {
    double ring = 0;
    const double step = 1e-4;
    for (double r = 0.5 * step; r < 2 * h; r += step)
      ring += 2 * M_PI * r * step * cubic_spline(std::sqrt(r * r + z * z), h);
    EXPECT_NEAR(cubic_spline_plane(z, h), ring, 1e-5 * cubic_spline_plane(0, h)) << z;
  }
  EXPECT_EQ(cubic_spline_plane(0.61, h), 0);
}

TEST(SmoothingLengths, AreThoseOfEachToTheBit) {
  const double mass = 1.1e-5, ratio = 1.2;
  Random random(3);
  std::vector<double> density(1003);
  for (double& value : density) value = random.uniform(1e-3, 3000);
  const std::vector<double> ordinary = density;
  for (const double strange : {1.0, 0.0, -1500.0, std::numeric_limits<double>::infinity()}) {
    density = ordinary;
    density[500] = strange;
    std::vector<double> length(density.size());
    smoothing_lengths(density.size(), mass, ratio, density.data(), length.data());
    for (std::size_t i = 0; i < density.size(); ++i)
      EXPECT_EQ(length[i], ratio * smoothing_length(mass, density[i])) << density[i];
  }
  density[500] = std::nan("");
  std::vector<double> length(density.size());
  smoothing_lengths(density.size(), mass, ratio, density.data(), length.data());
  EXPECT_TRUE(std::isnan(length[500])) << "what is no number stays so, and is found";
  EXPECT_EQ(length[499], ratio * smoothing_length(mass, density[499]));
}

}  // namespace

}  // namespace talus::sph

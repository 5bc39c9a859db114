// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/spectral_sum/split.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "models/cloud/spectral_sum.hpp"

namespace talus::cloud {
namespace {

using hydrodynamics::PairMobility;

template <class Function>
double derivative(Function&& f, double r) {
  const double h = 1e-4;
  return (8 * (f(r + h) - f(r - h)) - (f(r + 2 * h) - f(r - 2 * h))) / (12 * h);
}

TEST(Split, IsTheTensorFromTheCutoffOn) {
  for (const SpectralAccuracy& accuracy : spectral_accuracies) {
    const Split split(accuracy.beta, accuracy.order);
    for (const double r : {1.0, 1.7, 12.0}) {
      const PairMobility<double> whole = hydrodynamics::oseen_with_size(1 / r, 0.3);
      const PairMobility<double> s = split.stokeslet(r), d = split.dipole(r);
      EXPECT_DOUBLE_EQ(s.isotropic + 0.3 * d.isotropic, whole.isotropic);
      EXPECT_DOUBLE_EQ(s.radial + 0.3 * d.radial, whole.radial);
    }
  }
}

// From order 3 on the window vanishes at the cut-off with its second derivative, on which the dipole depends.
TEST(Split, ReachesTheTensorContinuously) {
  for (const SpectralAccuracy& accuracy : spectral_accuracies) {
    const Split split(accuracy.beta, accuracy.order);
    const double r = 1 - 1e-6;
    EXPECT_NEAR(split.stokeslet(r).isotropic, 1, 1e-5);
    EXPECT_NEAR(split.stokeslet(r).radial, 1, 1e-5);
    EXPECT_NEAR(split.dipole(r).isotropic, 1, 1e-5);
    if (accuracy.order > 2) {
      EXPECT_NEAR(split.dipole(r).radial, -3, 1e-4);
    }
  }
}

// div (A I + B d d) = (A'/r + B' r + 4 B) d in space.
TEST(Split, FlowOfTheSmoothPartHasNoDivergence) {
  for (const SpectralAccuracy& accuracy : spectral_accuracies) {
    const Split split(accuracy.beta, accuracy.order);
    for (const double r : {0.02, 0.1, 0.35, 0.6, 0.9}) {
      const double slope_a = derivative([&](double x) { return split.stokeslet(x).isotropic; }, r);
      const double slope_b = derivative([&](double x) { return split.stokeslet(x).radial; }, r);
      EXPECT_NEAR(slope_a / r + slope_b * r + 4 * split.stokeslet(r).radial, 0, 1e-6) << r;
    }
  }
}

// The dipole is -grad grad h with h a quarter of the stokeslet's trace, lap(F)/2.
TEST(Split, DipoleIsHalfTheLaplacianOfTheStokeslet) {
  for (const SpectralAccuracy& accuracy : spectral_accuracies) {
    const Split split(accuracy.beta, accuracy.order);
    const auto h = [&](double r) {
      const PairMobility<double> s = split.stokeslet(r);
      return (3 * s.isotropic + s.radial * r * r) / 4;
    };
    const auto isotropic = [&](double r) { return split.dipole(r).isotropic; };
    for (const double r : {0.02, 0.1, 0.35, 0.6, 0.9}) {
      EXPECT_NEAR(isotropic(r), -derivative(h, r) / r, 1e-6 * isotropic(0)) << r;
      EXPECT_NEAR(split.dipole(r).radial, derivative(isotropic, r) / r, 1e-5 * isotropic(0)) << r;
    }
  }
}

TEST(Split, PolynomialsAreTheSmoothPartWithinATenthOfTheError) {
  for (const SpectralAccuracy& accuracy : spectral_accuracies) {
    const Split split(accuracy.beta, accuracy.order);
    const auto terms = static_cast<std::size_t>(accuracy.degree) + 1;
    const std::vector<double> powers = split.polynomials(accuracy.degree);
    ASSERT_EQ(powers.size(), 4 * terms);
    for (double r = 0; r < 1; r += 0.01) {
      const PairMobility<double> s = split.stokeslet(r), d = split.dipole(r);
      const double expected[] = {s.isotropic, s.radial, d.isotropic, d.radial};
      for (std::size_t k = 0; k < 4; ++k) {
        double sum = 0;
        for (std::size_t n = terms; n-- > 0;) sum = sum * (2 * r * r - 1) + powers[k * terms + n];
        EXPECT_NEAR(sum, expected[k], 0.1 * accuracy.error) << accuracy.error << " part " << k << " at " << r;
      }
    }
  }
}

}  // namespace
}  // namespace talus::cloud

// SPDX-License-Identifier: Apache-2.0
#include "numerics/sph/smoothing_lengths.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/random.hpp"
#include "numerics/sph/cubic_spline.hpp"

namespace talus::sph {
namespace {

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

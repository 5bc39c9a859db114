// SPDX-License-Identifier: Apache-2.0
#include "analysis/residence.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace talus {
namespace {

/// Particles above each other, of which the k-th has fallen by 1 m/s from 0.1 k s on.
PointSet column(double time, bool turned = false) {
  std::vector<Vector3> position;
  std::vector<std::int64_t> identity;
  for (int k = 0; k < 8; ++k) {
    position.push_back({0, 0, 1.05 + 0.1 * k - std::max(0.0, time - 0.1 * k)});
    identity.push_back(k);
  }
  if (turned) std::reverse(position.begin(), position.end()), std::reverse(identity.begin(), identity.end());
  return {.time = time, .step = 0, .columns = {{"position", "m", position}, {"identity", "1", identity}}};
}

TEST(Residence, LayersLeaveWhenTheirParticlesPassTheOutlet) {
  const PointSet start = column(0);
  Residence residence(start.view(), 1.0, 2);
  for (int n = 1; n <= 10; ++n) residence.take(column(0.1 * n, n % 2 == 1).view(), 0.1 * n);
  const auto layers = residence.layers();
  ASSERT_EQ(layers.size(), 2u);
  // Particle k passes 1 m at 0.1 k + 0.05 + 0.1 k = 0.2 k + 0.05 s. The layers part at 1.375 m: k = 0 to 3, 4 to 7.
  EXPECT_NEAR(layers[0].high, 1.375, 1e-12);
  EXPECT_EQ(layers[0].particles, 4);
  EXPECT_EQ(layers[0].share_out, 1);
  EXPECT_NEAR(layers[0].first, 0.05, 1e-9);
  EXPECT_NEAR(layers[0].mean, 0.35, 1e-9);
  EXPECT_NEAR(layers[0].last, 0.65, 1e-9);
  EXPECT_EQ(layers[1].share_out, 0.25);
  EXPECT_NEAR(layers[1].last, 0.85, 1e-9);
}

TEST(Residence, WhatIsTakenAwayBetweenTwoSnapshotsHasPassed) {
  const PointSet start = column(0);
  Residence residence(start.view(), 1.0, 1);
  PointSet later = column(0.5);
  std::get<std::vector<Vector3>>(later.columns[0].values)
      .erase(std::get<std::vector<Vector3>>(later.columns[0].values).begin());
  std::get<std::vector<std::int64_t>>(later.columns[1].values)
      .erase(std::get<std::vector<std::int64_t>>(later.columns[1].values).begin());
  residence.take(later.view(), 0.5);
  // The first is gone, half-way through; the second and the third are below the outlet, on straight ways.
  EXPECT_EQ(residence.layers()[0].share_out, 3.0 / 8);
  EXPECT_NEAR(residence.layers()[0].mean, (0.25 + 0.5 * 0.15 / 0.4 + 0.5 * 0.25 / 0.3) / 3, 1e-12);
  residence.take(later.view(), 0.6);
  EXPECT_EQ(residence.layers()[0].share_out, 3.0 / 8) << "once";
}

TEST(Residence, WhatIsBelowAtTheStartIsNoPartAndWhatStaysHasNoTime) {
  const PointSet start = column(0);
  Residence residence(start.view(), 1.2, 1);
  const auto layers = residence.layers();
  EXPECT_EQ(layers[0].particles, 6);
  EXPECT_EQ(layers[0].share_out, 0);
  EXPECT_TRUE(std::isnan(layers[0].mean));
}

}  // namespace
}  // namespace talus

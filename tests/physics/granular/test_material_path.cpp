// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/material_path.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

#include "base/error.hpp"
#include "physics/granular/appendix_b.hpp"
#include "physics/granular/kinematics.hpp"

namespace talus::granular {
namespace {

const AnyLaw elastic = make_law(LinearElastic::Parameters{.lambda = 2e6, .shear_modulus = 1e6}, 2500);

TEST(MaterialPath, RecordsEveryStretchAtEqualTimes) {
  const std::vector<PathStretch> path = {{0.5, squash(2e-4)}, {0.0, shear(1)}, {2, shear(1e-4)}};
  const auto points = follow_path(elastic, path, {.density = 1600, .points = 4});
  ASSERT_EQ(points.size(), 13);
  EXPECT_EQ(points[0].time, 0);
  EXPECT_EQ(points[0].density, 1600);
  EXPECT_DOUBLE_EQ(points[3].time, 0.375);
  EXPECT_EQ(points[8].time, 0.5);
  EXPECT_EQ(points[8].stress, points[4].stress);  // a stretch of no duration
  EXPECT_DOUBLE_EQ(points[9].time, 1);
  EXPECT_DOUBLE_EQ(points[12].time, 2.5);
}

TEST(MaterialPath, FollowsStrainStressAndDensity) {
  const auto points = follow_path(elastic, std::vector<PathStretch>{{2, squash(0.05)}}, {.points = 1});
  // Squashed to exp(-0.1).
  EXPECT_NEAR(points[1].density, 1500 * std::exp(0.1), 1e-9);
  EXPECT_NEAR(points[1].strain.zz, (std::exp(0.2) - 1) / 2, 1e-6);
  EXPECT_NEAR(points[1].stress.zz, 4e6 * 0.1, 1e-3);
  EXPECT_NEAR(points[1].stress.xx, 2e6 * 0.1, 1e-3);
}

TEST(MaterialPath, WorkIsTheElasticEnergyAndComesBack) {
  const std::vector<PathStretch> path = {{1, squash(1e-3)}, {1, squash(-1e-3)}};
  const auto points = follow_path(elastic, path, {.points = 200});
  // Hooke: M e^2/2, less what the shrinking volume leaves of it.
  EXPECT_NEAR(work_of_path(std::span(path).first(1), std::span(points).first(201)), 4e6 * 1e-6 / 2, 1e-3 * 2);
  EXPECT_NEAR(work_of_path(path, points), 0, 1e-9);
}

using Stress = std::array<std::optional<double>, 4>;

TEST(MaterialPath, FindsTheRatesOfPrescribedStresses) {
  // Hooke: uniaxial stress strains by 1/E along, by nu/E across; E = G (3 lambda + 2 G)/(lambda + G), nu = 1/3.
  const double young = 1e6 * 8e6 / 3e6, poisson = 1.0 / 3;
  const std::vector<PathStretch> path = {{2, {}, Stress{0.0, 0.0, 300.0, {}}}};
  const auto points = follow_path(elastic, path, {.points = 10});
  EXPECT_NEAR(points[5].stress.zz, 150, 1e-4);
  EXPECT_NEAR(points[10].stress.zz, 300, 1e-4);
  EXPECT_NEAR(points[10].stress.xx, 0, 1e-4);
  EXPECT_NEAR(points[10].strain.zz, 300 / young, 1e-3 * 300 / young);
  EXPECT_NEAR(points[10].strain.yy, -poisson * 300 / young, 1e-3 * 300 / young);
  EXPECT_NEAR(points[10].density, 1500 * (1 + (1 - 2 * poisson) * 300 / young), 1e-4);
  EXPECT_NEAR(work_of_path(path, points), 0.5 * 300 * 300 / young, 1e-3 * 0.017);
  // On from there: sheared under the same stresses, then back to no shear stress.
  const std::vector<PathStretch> on = {{1, {.xz = 1e-4}, Stress{0.0, 0.0, 300.0, {}}},
                                       {1, {}, Stress{0.0, 0.0, 300.0, 0.0}}};
  const auto further = follow_path(elastic, points.back(), on, {.points = 1});
  EXPECT_EQ(further[0].stress, points.back().stress);
  EXPECT_NEAR(std::abs(further[1].stress.zx), 1e6 * 1e-4, 0.1);
  EXPECT_NEAR(further[2].stress.zx, 0, 1e-4);
  EXPECT_NEAR(further[2].stress.zz, 300, 1e-4);
}

TEST(MaterialPath, SaysWhichStressTheLawDoesNotBear) {
  const AnyLaw law = make_law(CriticalState::Parameters{}, 2500);
  EXPECT_THROW(follow_path(law, std::vector<PathStretch>{{1, {}, Stress{-100.0, -100.0, -100.0, {}}}}, {}),
               NumericalError);
}

TEST(MaterialPath, RefusesWhatIsNoPath) {
  const std::vector<PathStretch> path = {{1, squash(1e-4)}};
  EXPECT_THROW(follow_path(elastic, path, {.density = 0}), std::invalid_argument);
  EXPECT_THROW(follow_path(elastic, path, {.max_increment = 0}), std::invalid_argument);
  EXPECT_THROW(follow_path(elastic, path, {.points = 0}), std::invalid_argument);
  EXPECT_THROW(follow_path(elastic, std::vector<PathStretch>{{-1, {}}}), std::invalid_argument);
  EXPECT_THROW(follow_path(elastic, std::vector<PathStretch>{{std::numeric_limits<double>::infinity(), {}}}),
               std::invalid_argument);
}

TEST(MaterialPath, DrawsTheLoopsOfThePapersFigure2) {
  // Shear under constant pressure with excursions back: loading A, B; C down D1, up D2 to F; G down, up; every
  // excursion leaves its line and comes back to where it left, and the envelope is the loading curve.
  const AnyLaw law = make_law(YuuUmekageIsotropic::Parameters{.rule = {.unloading_stiffness = 2.5}}, 2500);
  std::vector<PathStretch> path = {{1, squeeze(4e-4)}};
  for (int loop = 0; loop < 3; ++loop) path.insert(path.end(), {{1, shear(3e-3)}, {1, shear(-2e-4)}, {1, shear(2e-4)}});
  const auto points = follow_path(law, path, {.points = 50});
  const double p = trace(points[50].stress) / 3;
  const double line = 2.5 * value(repaired_2011.a4, 0) * p;
  for (int loop = 0; loop < 3; ++loop) {
    const auto tau = [&](int k) { return -points[static_cast<std::size_t>(100 + 150 * loop + k)].stress.zx; };
    EXPECT_NEAR(tau(0) - tau(50), line * 1e-4, 0.003 * line * 1e-4) << loop;
    EXPECT_NEAR(tau(0) - tau(25), line * 0.5e-4, 0.003 * line * 1e-4) << loop;
    EXPECT_NEAR(tau(75), tau(25), 1e-6 * p) << loop;
    EXPECT_NEAR(tau(100), tau(0), 1e-3 * p) << loop;
    const double deviator = 3e-3 * (loop + 1) / std::sqrt(2.0);
    EXPECT_NEAR(tau(0), p * value(repaired_2011.a4, deviator) * deviator / std::sqrt(2.0), 2e-3 * p) << loop;
  }
}

}  // namespace
}  // namespace talus::granular

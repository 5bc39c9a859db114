// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/spectral_sum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "models/cloud/spectral_sum_cases.hpp"

namespace talus::cloud {
namespace {

std::vector<Vector3> spectral(const Spheres& spheres, const PairSum::Options& options, const SpectralAccuracy& accuracy,
                              double* cutoff = nullptr, int threads = 1) {
  ThreadTeam team(threads);
  SpectralSum sum(options, accuracy, spheres.radius);
  sum.reorder(order_of(spheres));
  const auto plan = sum.plan(spheres.position);
  EXPECT_TRUE(plan.has_value());
  sum.set_cutoff(plan->cutoff);
  if (cutoff) *cutoff = plan->cutoff;
  std::vector<Vector3> velocity(spheres.size(), Vector3{7, 7, 7});
  EXPECT_TRUE(sum.velocities(team, spheres.position, spheres.force, velocity));
  return velocity;
}

bool same_bits(const std::vector<Vector3>& u, const std::vector<Vector3>& v) {
  return u.size() == v.size() && std::memcmp(u.data(), v.data(), u.size() * sizeof(Vector3)) == 0;
}

/// The errors of velocities against those of the direct sum: within the bound everywhere, and of which root mean
/// square.
double checked_error(const Spheres& spheres, const PairSum::Options& options, const SpectralAccuracy& accuracy) {
  double cutoff = 0;
  std::vector<Vector3> difference = spectral(spheres, options, accuracy, &cutoff);
  const std::vector<Vector3> direct = velocities(spheres, options);
  const std::vector<double> bound = error_bound(spheres, accuracy, cutoff);
  double worst = 0;
  for (std::size_t i = 0; i < difference.size(); ++i) {
    difference[i] = difference[i] - direct[i];
    worst = std::max(worst, norm(difference[i]) / bound[i]);
  }
  EXPECT_LE(worst, 1) << "over the bound";
  return root_mean_square(difference) / root_mean_square(direct);
}

TEST(SpectralSum, IsTheDirectSumWithinItsErrorForCloudsOfEveryForm) {
  for (const Motion motion : plane_and_space)
    for (const NamedCloud& cloud : clouds_of_every_form(motion))
      for (const Mobility mobility : both_laws)
        for (const SpectralAccuracy& accuracy : spectral_accuracies) {
          SCOPED_TRACE(cloud.name + ", " + name(options_of(mobility, motion)));
          const double error = checked_error(cloud.spheres, options_of(mobility, motion), accuracy);
          EXPECT_LE(error, accuracy.error);
          // Of an accuracy that errs as little as the next one nothing would be known.
          EXPECT_GE(error, 1e-4 * accuracy.error);
        }
}

TEST(SpectralSum, OfWeightsErrsLessThanHalf) {
  for (const Motion motion : plane_and_space)
    for (NamedCloud& cloud : clouds_of_every_form(motion)) {
      for (std::size_t i = 0; i < cloud.spheres.size(); ++i)
        cloud.spheres.force[i] = {1e-5 * std::pow(cloud.spheres.radius[i] / a, 3), 0, 0};
      for (const SpectralAccuracy& accuracy : spectral_accuracies) {
        const PairSum::Options options = options_of(Mobility::rotne_prager_1969, motion);
        SCOPED_TRACE(cloud.name + ", " + name(options));
        EXPECT_LE(checked_error(cloud.spheres, options, accuracy), 0.5 * accuracy.error);
      }
    }
}

// One force among spheres without any: each velocity shows the error of one pair, at many places on the grid.
TEST(SpectralSum, ErrorOfEveryPairIsWithinTheBound) {
  Random random(17);
  for (const Motion motion : plane_and_space)
    for (const Mobility mobility : both_laws)
      for (const SpectralAccuracy& accuracy : spectral_accuracies) {
        const bool space = motion == Motion::xyz;
        double largest = 0;
        for (int trial = 0; trial < (space ? 12 : 40); ++trial) {
          const auto seed = 100 + static_cast<std::uint64_t>(trial);
          Spheres spheres =
              space ? box("", 6, 6, 6, 3.2, 0.2, seed).spheres : rectangle("", 14, 14, 3.2, 0.2, seed).spheres;
          const double flat = space ? 1 : 0;
          const Vector3 shift{random.uniform(0, 50 * a), random.uniform(0, 50 * a), flat * random.uniform(0, 50 * a)};
          for (Vector3& x : spheres.position) x += shift;
          for (Vector3& f : spheres.force) f = {};
          const double angle = random.uniform(0, 6.28), height = flat * random.uniform(-1, 1);
          const double level = std::sqrt(1 - height * height);
          spheres.force[static_cast<std::size_t>(random.uniform(0, 195))] = {level * std::cos(angle),
                                                                             level * std::sin(angle), height};
          double cutoff = 0;
          const PairSum::Options options = options_of(mobility, motion);
          const std::vector<Vector3> v = spectral(spheres, options, accuracy, &cutoff);
          const std::vector<Vector3> u = velocities(spheres, options);
          const std::vector<double> bound = error_bound(spheres, accuracy, cutoff);
          for (std::size_t i = 0; i < v.size(); ++i) largest = std::max(largest, norm(u[i] - v[i]) / bound[i]);
        }
        EXPECT_LE(largest, 1) << accuracy.error << " " << choice_name(motion);
        EXPECT_GE(largest, 0.1) << accuracy.error << ": the bound says little";
      }
}

TEST(SpectralSum, OfOneAndTwoSpheres) {
  for (const Motion motion : plane_and_space)
    for (const Mobility mobility : both_laws)
      for (const SpectralAccuracy& accuracy : spectral_accuracies) {
        Spheres spheres = rectangle("", 1, 1, 3, 0.05, 2).spheres;
        checked_error(spheres, options_of(mobility, motion), accuracy);
        const Vector3 way = motion == Motion::xyz ? Vector3{0.6, 0.64, 0.48} : Vector3{0.6, 0.8, 0};
        for (const double distance : {1.2, 2.0, 3.0, 7.0, 11.0, 40.0, 3000.0}) {
          spheres.position.resize(1), spheres.radius.resize(1), spheres.force.resize(1);
          spheres.position.push_back(spheres.position[0] + distance * a * way);
          spheres.radius.push_back(1.1 * a), spheres.force.push_back({0, 1e-4, 0});
          checked_error(spheres, options_of(mobility, motion), accuracy);
        }
      }
}

TEST(SpectralSum, OfSpheresInEachOther) {
  Spheres spheres = rectangle("", 3, 1, 9, 0.5, 4).spheres;
  spheres.position.push_back(spheres.position[0]);  // at one place
  spheres.position.push_back(spheres.position[1] + Vector3{0.3 * a, 0, 0});
  spheres.radius.insert(spheres.radius.end(), {1.2 * a, 0.2 * a});
  spheres.force.insert(spheres.force.end(), {{1e-4, 0, 0}, {0, 2e-4, 0}});
  for (const Motion motion : plane_and_space)
    for (const SpectralAccuracy& accuracy : spectral_accuracies) {
      double cutoff = 0;
      const auto v = spectral(spheres, options_of(Mobility::zuk_2014, motion), accuracy, &cutoff);
      const auto u = velocities(spheres, options_of(Mobility::zuk_2014, motion));
      for (std::size_t i = 0; i < v.size(); ++i)
        EXPECT_LE(norm(u[i] - v[i]), accuracy.pair_error * 8e-4 / (8 * std::numbers::pi * viscosity * cutoff));
    }
}

// Large enough for several strips and slabs of cells.
TEST(SpectralSum, GivesTheSameBitsForAnyNumberOfThreads) {
  for (const Motion motion : plane_and_space) {
    const Spheres spheres = round_cloud(motion == Motion::xyz ? 24 : 60, 0.05, motion).spheres;
    for (const Mobility mobility : both_laws)
      for (const SpectralAccuracy& accuracy : spectral_accuracies) {
        const auto one = spectral(spheres, options_of(mobility, motion), accuracy);
        for (const int threads : {2, 3, 5})
          EXPECT_TRUE(same_bits(one, spectral(spheres, options_of(mobility, motion), accuracy, nullptr, threads)));
      }
  }
}

// What was summed before, of whatever size, leaves no trace.
TEST(SpectralSum, GivesTheSameBitsWhateverCameBefore) {
  for (const Motion motion : plane_and_space) {
    const Spheres spheres = round_cloud(motion == Motion::xyz ? 12 : 40, 0.05, motion).spheres;
    const PairSum::Options options = options_of(Mobility::zuk_2014, motion);
    ThreadTeam team;
    SpectralSum fresh(options, spectral_accuracies[0], spheres.radius);
    SpectralSum used(options, spectral_accuracies[0], spheres.radius);
    std::vector<Vector3> expected(spheres.size()), velocity(spheres.size());
    std::vector<Vector3> spread_out = spheres.position;
    for (Vector3& x : spread_out) x = Vector3{3 * x.x, 1.5 * x.y, 2 * x.z};
    used.set_cutoff(20 * a);
    ASSERT_TRUE(used.velocities(team, spread_out, spheres.force, velocity));
    used.set_cutoff(11 * a), fresh.set_cutoff(11 * a);
    ASSERT_TRUE(used.velocities(team, spheres.position, spheres.force, velocity));
    ASSERT_TRUE(fresh.velocities(team, spheres.position, spheres.force, expected));
    EXPECT_TRUE(same_bits(velocity, expected));
  }
}

TEST(SpectralSum, AgreesBetweenInstructionSets) {
  for (const Motion motion : plane_and_space) {
    const Spheres spheres = round_cloud(motion == Motion::xyz ? 11 : 30, 0.3, motion).spheres;
    for (const Mobility mobility : both_laws)
      for (const SpectralAccuracy& accuracy : spectral_accuracies) {
        PairSum::Options options = options_of(mobility, motion);
        options.instruction_set = InstructionSet::portable;
        const auto portable = spectral(spheres, options, accuracy);
        const double scale = root_mean_square(portable);
        for (const InstructionSet set : available_sets()) {
          options.instruction_set = set;
          EXPECT_LE(max_difference(portable, spectral(spheres, options, accuracy)),
                    (accuracy.single ? 2e-5 : 1e-11) * scale)
              << choice_name(set);
        }
      }
  }
}

// Spreading and interpolation are transposes, and the grid's convolution is symmetric: so is the sum, but for rounding.
TEST(SpectralSum, IsSymmetricForTheSymmetricLaw) {
  for (const Motion motion : plane_and_space) {
    const Spheres spheres = round_cloud(motion == Motion::xyz ? 12 : 36, 0.4, motion).spheres;
    const PairSum::Options options = options_of(Mobility::zuk_2014, motion);
    for (const SpectralAccuracy& accuracy : spectral_accuracies) {
      const std::vector<Vector3> f = spheres.force;
      const auto of_f = spectral(spheres, options, accuracy);
      Spheres others = spheres;
      Random random(21);
      for (Vector3& g : others.force) g = {random.uniform(-1e-4, 1e-4), random.uniform(-1e-4, 1e-4), 0};
      const auto of_g = spectral(others, options, accuracy);
      double one = 0, other = 0, size = 0;
      for (std::size_t i = 0; i < f.size(); ++i) {
        one += dot(others.force[i], of_f[i]), other += dot(f[i], of_g[i]);
        size += norm(others.force[i]) * norm(of_f[i]);
      }
      EXPECT_NEAR(one, other, (accuracy.single ? 1e-6 : 1e-13) * size) << accuracy.error;
    }
  }
}

// Axes may change their names: the longest is that of the layers whatever it is called.
TEST(SpectralSum, TurnsWithSpace) {
  const Spheres spheres = box("", 5, 9, 20, 2.7, 0.05, 15).spheres;
  const auto before = spectral(spheres, options_of(Mobility::zuk_2014, Motion::xyz), spectral_accuracies[1]);
  Spheres turned = spheres;
  for (auto* column : {&turned.position, &turned.force})
    for (Vector3& x : *column) x = {x.z, x.x, x.y};
  const auto after = spectral(turned, options_of(Mobility::zuk_2014, Motion::xyz), spectral_accuracies[1]);
  const double scale = root_mean_square(before);
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_LE(norm(after[i] - Vector3{before[i].z, before[i].x, before[i].y}), 2e-5 * scale);
}

TEST(SpectralSum, TurnsWithThePlane) {
  Spheres spheres = rectangle("", 60, 12, 2.7, 0.05, 15).spheres;
  const auto in_xy = spectral(spheres, options_of(Mobility::zuk_2014), spectral_accuracies[1]);
  Spheres upright = spheres;
  for (auto* column : {&upright.position, &upright.force})
    for (Vector3& x : *column) x = {x.x, 4.0, x.y};
  const auto in_xz = spectral(upright, options_of(Mobility::zuk_2014, Motion::xz), spectral_accuracies[1]);
  for (std::size_t i = 0; i < in_xy.size(); ++i) {
    EXPECT_EQ(in_xz[i].x, in_xy[i].x);
    EXPECT_EQ(in_xz[i].z, in_xy[i].y);
    EXPECT_EQ(in_xz[i].y, 0);
  }
}

TEST(SpectralSum, PlansTheCheaperWay) {
  for (const Motion motion : plane_and_space) {
    const bool space = motion == Motion::xyz;
    const Spheres small = round_cloud(space ? 6 : 12, 0.05, motion).spheres;
    const Spheres large = (space ? box("", 34, 34, 34, 2.8, 0.05, 1) : rectangle("", 200, 200, 2.8, 0.05, 1)).spheres;
    const PairSum::Options options = options_of(Mobility::zuk_2014, motion);
    const SpectralSum of_small(options, spectral_accuracies[0], small.radius);
    const SpectralSum of_large(options, spectral_accuracies[0], large.radius);
    const auto little = of_small.plan(small.position), much = of_large.plan(large.position);
    EXPECT_LT(little->direct_cost, little->cost);
    EXPECT_LT(10 * much->cost, much->direct_cost);
    EXPECT_GE(much->cutoff, of_large.min_cutoff());
    // Ten times as far apart the spheres have fewer neighbours and take a larger grid: longer cut-offs pay.
    std::vector<Vector3> sparse = large.position;
    for (Vector3& x : sparse) x = 10.0 * x;
    EXPECT_GT(of_large.plan(sparse)->cutoff, 2 * much->cutoff);
  }
}

TEST(SpectralSum, SaysWhereItHasNoRoomAndWhereItCannotCount) {
  for (const Motion motion : plane_and_space) {
    Spheres spheres = rectangle("", 4, 4, 3, 0.05, 1).spheres;
    ThreadTeam team;
    SpectralSum sum(options_of(Mobility::zuk_2014, motion), spectral_accuracies[0], spheres.radius);
    std::vector<Vector3> velocity(spheres.size(), Vector3{7, 7, 7});
    spheres.position[3] = {1e6 * a, 1e6 * a, 0};
    EXPECT_FALSE(sum.velocities(team, spheres.position, spheres.force, velocity));
    EXPECT_EQ(velocity[5].x, 7);
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      spheres.position[3].y = bad;
      EXPECT_FALSE(sum.plan(spheres.position).has_value());
      EXPECT_TRUE(sum.velocities(team, spheres.position, spheres.force, velocity));
      EXPECT_TRUE(std::isnan(velocity[5].x));
    }
  }
}

TEST(SpectralSum, RefusesWhatItIsNotFor) {
  const std::vector<double> radius(5, a);
  const SpectralAccuracy& accuracy = spectral_accuracies[0];
  EXPECT_THROW(SpectralSum(options_of(Mobility::none), accuracy, radius), std::invalid_argument);
  SpectralSum sum(options_of(Mobility::zuk_2014), accuracy, radius);
  EXPECT_THROW(sum.set_cutoff(0.99 * sum.min_cutoff()), std::invalid_argument);
  EXPECT_THROW(sum.reorder(std::vector<std::uint32_t>{0, 1}), std::invalid_argument);
  EXPECT_THROW(sum.reorder(std::vector<std::uint32_t>{0, 1, 2, 3, 3}), std::invalid_argument);
  ThreadTeam team;
  std::vector<Vector3> four(4), five(5);
  EXPECT_THROW(sum.velocities(team, four, five, five), std::invalid_argument);
}

TEST(SpectralAccuracy, IsTheLeastThatSuffices) {
  EXPECT_EQ(spectral_accuracy(0.05), &spectral_accuracies[0]);
  EXPECT_EQ(spectral_accuracy(1e-3), &spectral_accuracies[0]);
  EXPECT_EQ(spectral_accuracy(9e-4), &spectral_accuracies[1]);
  EXPECT_EQ(spectral_accuracy(1e-5), &spectral_accuracies[2]);
  EXPECT_EQ(spectral_accuracy(9e-6), nullptr);
}

}  // namespace
}  // namespace talus::cloud

// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/pair_sum.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>

#include "base/error.hpp"
#include "base/random.hpp"
#include "numerics/cell_grid.hpp"
#include "physics/hydrodynamics/rotne_prager.hpp"
#include "physics/hydrodynamics/stokes.hpp"
#include "physics/hydrodynamics/zuk.hpp"

namespace talus::cloud {
namespace {

using hydrodynamics::Mobility;
using std::numbers::pi;

constexpr double viscosity = 1.82e-5;
constexpr double eight_pi_mu = 8 * pi * viscosity;
constexpr double a = 5e-3;
constexpr Precision both_precisions[] = {Precision::double_precision, Precision::single_precision};
constexpr Mobility both_laws[] = {Mobility::rotne_prager_1969, Mobility::zuk_2014};

std::vector<InstructionSet> available_sets() {
  std::vector<InstructionSet> sets;
  for (const auto set : {InstructionSet::avx512, InstructionSet::avx2, InstructionSet::portable})
    if (is_available(set)) sets.push_back(set);
  return sets;
}

struct Cloud {
  std::vector<Vector3> position, force;
  std::vector<double> radius;
  std::size_t size() const { return radius.size(); }
};

/// Spheres anywhere in a box (overlaps included) with random radii and forces.
Cloud random_cloud(std::size_t count, std::uint64_t seed, Motion motion = Motion::xyz, double spread = 0.3) {
  Random random(seed);
  const double edge = a * 3 * std::cbrt(static_cast<double>(count));
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    auto point = [&](double size) {
      Vector3 v{random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
      if (motion == Motion::xy) v.z = 0;
      if (motion == Motion::xz) v.y = 0;
      return v;
    };
    cloud.position.push_back(point(edge));
    cloud.force.push_back(point(1e-4));
    cloud.radius.push_back(a * random.uniform(1 - spread, 1 + spread));
  }
  return cloud;
}

std::vector<Vector3> velocities(const Cloud& cloud, PairSum::Options options, int threads = 1,
                                std::span<const std::uint32_t> order = {}) {
  options.viscosity = viscosity;
  ThreadTeam team(threads);
  PairSum sum(options, cloud.radius, order);
  std::vector<Vector3> velocity(cloud.size(), Vector3{7, 7, 7});
  sum.velocities(team, cloud.position, cloud.force, velocity);
  return velocity;
}

struct Expected {
  std::vector<Vector3> velocity;
  double scale = 0;  ///< largest sum over j of |M_ij F_j|
};

/// The sum pair by pair, from the same laws with plain doubles.
Expected oracle(const Cloud& cloud, Mobility mobility) {
  Expected expected;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    Vector3 sum;
    double size = 0;
    for (std::size_t j = 0; j < cloud.size(); ++j) {
      if (j == i) continue;
      const Vector3 d = cloud.position[i] - cloud.position[j];
      const double square = dot(d, d), inverse = 1 / std::sqrt(square), aj = cloud.radius[j];
      const auto m = mobility == Mobility::zuk_2014
                         ? hydrodynamics::zuk_2014(square, inverse, cloud.radius[i], aj)
                         : hydrodynamics::rotne_prager_1969(inverse, hydrodynamics::source_size(aj));
      const Vector3 u = (1 / eight_pi_mu) * (m.isotropic * cloud.force[j] + (m.radial * dot(d, cloud.force[j])) * d);
      sum += u;
      size += norm(u);
    }
    expected.velocity.push_back(sum);
    expected.scale = std::max(expected.scale, size);
  }
  return expected;
}

double largest_difference(std::span<const Vector3> x, std::span<const Vector3> y) {
  double largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double difference = norm(x[i] - y[i]);
    if (!(difference <= largest)) largest = difference;  // keeps what is not a number
  }
  return largest;
}

double bound(Precision precision) {
  return precision == Precision::double_precision ? 1e-14 : 1e-6;
}

std::string name(const PairSum::Options& options) {
  return std::string(choice_name(options.mobility)) + " " + std::string(choice_name(options.motion)) + " " +
         std::string(choice_name(options.precision)) + " " + std::string(choice_name(options.instruction_set));
}

template <class Check>
void for_every_option(Check check) {
  for (const InstructionSet set : available_sets())
    for (const Precision precision : both_precisions)
      for (const Mobility mobility : both_laws)
        for (const Motion motion : {Motion::xy, Motion::xz, Motion::xyz})
          check(PairSum::Options{mobility, motion, precision, set, viscosity});
}

TEST(PairSum, AgreesWithTheOracleForEveryNumberOfSpheres) {
  std::vector<std::size_t> counts{63, 64, 65, 127, 129, 255, 257, 513, 600};
  for (std::size_t count = 1; count <= 40; ++count) counts.push_back(count);
  for (const std::size_t count : counts)
    for_every_option([&](const PairSum::Options& options) {
      const Cloud cloud = random_cloud(count, count, options.motion);
      const Expected expected = oracle(cloud, options.mobility);
      EXPECT_LE(largest_difference(velocities(cloud, options), expected.velocity),
                bound(options.precision) * expected.scale)
          << count << " " << name(options);
    });
}

TEST(PairSum, SameBitsForAnyNumberOfThreads) {
  for_every_option([&](const PairSum::Options& options) {
    const Cloud cloud = random_cloud(333, 1, options.motion);
    const auto one = velocities(cloud, options, 1);
    for (const int threads : {2, 3}) EXPECT_EQ(velocities(cloud, options, threads), one) << name(options);
  });
}

}  // namespace
}  // namespace talus::cloud

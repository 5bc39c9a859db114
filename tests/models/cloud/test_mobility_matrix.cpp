// SPDX-License-Identifier: Apache-2.0
/// The whole 3N x 3N mobility, assembled column by column from unit forces: symmetric and positive definite with the
/// symmetric law wherever the spheres are; not symmetric with the printed one.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "models/cloud/pair_sum_cases.hpp"
#include "physics/hydrodynamics/stokes.hpp"

namespace talus::cloud {
namespace {

/// In units of the Stokes mobility of a sphere of radius a.
Eigen::MatrixXd mobility_matrix(Spheres spheres, Mobility mobility, InstructionSet set) {
  const auto n = static_cast<Eigen::Index>(spheres.size());
  const double unit = hydrodynamics::stokes_mobility(a, viscosity);
  Eigen::MatrixXd matrix(3 * n, 3 * n);
  for (Eigen::Index column = 0; column < 3 * n; ++column) {
    const std::size_t j = static_cast<std::size_t>(column / 3);
    spheres.force.assign(spheres.size(), Vector3{});
    Vector3& force = spheres.force[j];
    (column % 3 == 0 ? force.x : column % 3 == 1 ? force.y : force.z) = 1;
    auto velocity = velocities(spheres, {mobility, Motion::xyz, Precision::double_precision, set});
    velocity[j] += hydrodynamics::stokes_mobility(spheres.radius[j], viscosity) * force;
    for (Eigen::Index i = 0; i < n; ++i) {
      const Vector3& v = velocity[static_cast<std::size_t>(i)];
      matrix.block<3, 1>(3 * i, column) << v.x / unit, v.y / unit, v.z / unit;
    }
  }
  return matrix;
}

/// `count` spheres with centres in a box of edge 2 `extent` and radii from `least` to `most`, all in a; flat: z = 0.
Spheres crowd(std::size_t count, double extent, double least, double most, bool flat, std::uint64_t seed) {
  Random random(seed);
  Spheres spheres;
  for (std::size_t i = 0; i < count; ++i) {
    spheres.position.push_back({random.uniform(-extent, extent) * a, random.uniform(-extent, extent) * a,
                                flat ? 0.0 : random.uniform(-extent, extent) * a});
    spheres.radius.push_back(a * random.uniform(least, most));
  }
  return spheres;
}

TEST(MobilityMatrix, IsSymmetricAndPositiveDefiniteForTheSymmetricLaw) {
  for (const InstructionSet set : available_sets())
    for (const bool flat : {false, true})
      for (const double extent : {0.5, 2.0, 6.0})                                            // nested to apart
        for (const auto& [least, most] : {std::pair{1.0, 1.0}, {0.95, 1.05}, {0.1, 3.0}}) {  // equal to very unequal
          const Spheres spheres = crowd(25, extent, least, most, flat, 17);
          const Eigen::MatrixXd m = mobility_matrix(spheres, Mobility::zuk_2014, set);
          EXPECT_LE((m - m.transpose()).cwiseAbs().maxCoeff(), 1e-13 * m.cwiseAbs().maxCoeff());
          const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m).eigenvalues();
          EXPECT_GT(eigenvalues.minCoeff(), 1e-8 * eigenvalues.maxCoeff()) << extent << " " << most << " " << flat;
        }
}

TEST(MobilityMatrix, IsNotSymmetricForThePrintedLawWithUnequalRadii) {
  // Source's radius only (Eq. 3c): M_ij - M_ji = (2/3)(a_j^2 - a_i^2)(I - 3 dd/r^2)/(8 pi mu r^3).
  Spheres spheres{{{0, 0, 0}, {2.5 * a, 0, 0}}, {}, {1.05 * a, 0.95 * a}};
  for (const InstructionSet set : available_sets()) {
    const Eigen::MatrixXd m = mobility_matrix(spheres, Mobility::rotne_prager_1969, set);
    const double across = 0.75 * 2.0 / 3.0 * (0.95 * 0.95 - 1.05 * 1.05) / (2.5 * 2.5 * 2.5);
    EXPECT_NEAR(m(1, 4) - m(4, 1), across, 1e-14);
    EXPECT_NEAR(m(0, 3) - m(3, 0), -2 * across, 1e-14);
    spheres.radius = {a, a};
    const Eigen::MatrixXd equal = mobility_matrix(spheres, Mobility::rotne_prager_1969, set);
    EXPECT_LE((equal - equal.transpose()).cwiseAbs().maxCoeff(), 1e-15);
    spheres.radius = {1.05 * a, 0.95 * a};
  }
}

}  // namespace
}  // namespace talus::cloud

// SPDX-License-Identifier: Apache-2.0
/// Spheres, options and the oracle for the tests of the sum over pairs.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "models/cloud/pair_sum.hpp"
#include "physics/hydrodynamics/mobility.hpp"

namespace talus::cloud {

using hydrodynamics::Mobility;

inline constexpr double viscosity = 1.82e-5;  // Pa s
inline constexpr double a = 5e-3;             // m
inline constexpr Mobility both_laws[] = {Mobility::rotne_prager_1969, Mobility::zuk_2014};

inline std::vector<InstructionSet> available_sets() {
  std::vector<InstructionSet> sets;
  for (const auto set : {InstructionSet::avx512, InstructionSet::avx2, InstructionSet::portable})
    if (is_available(set)) sets.push_back(set);
  return sets;
}

template <class Check>
void for_every_set_and_precision(Check check) {
  for (const InstructionSet set : available_sets())
    for (const Precision precision : {Precision::double_precision, Precision::single_precision}) check(set, precision);
}

inline std::string name(const PairSum::Options& options) {
  std::string text;
  for (const std::string_view part : {choice_name(options.mobility), choice_name(options.motion),
                                      choice_name(options.precision), choice_name(options.instruction_set)})
    text += std::string(part) + " ";
  return text;
}

struct Spheres {
  std::vector<Vector3> position, force;
  std::vector<double> radius;
  std::size_t size() const { return radius.size(); }
};

/// Spheres of random radii (0.7 to 1.3 a) and forces, placed at random where no centre is nearer than a: many overlap.
inline Spheres random_spheres(std::size_t count, std::uint64_t seed, Motion motion) {
  Random random(seed);
  const double n = static_cast<double>(count);
  const double edge = motion == Motion::xyz ? 1.5 * a * std::cbrt(n) : 1.5 * a * std::sqrt(n);
  auto vector = [&](double size) {
    Vector3 v{random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
    if (motion == Motion::xy) v.z = 0;
    if (motion == Motion::xz) v.y = 0;
    return v;
  };
  Spheres spheres;
  while (spheres.size() < count) {
    const Vector3 x = vector(edge);
    if (std::any_of(spheres.position.begin(), spheres.position.end(),
                    [&](const Vector3& y) { return norm(x - y) < a; }))
      continue;
    spheres.position.push_back(x);
    spheres.force.push_back(vector(1e-4));
    spheres.radius.push_back(a * random.uniform(0.7, 1.3));
  }
  return spheres;
}

inline std::vector<Vector3> velocities(const Spheres& spheres, PairSum::Options options, int threads = 1,
                                       std::span<const std::uint32_t> order = {}) {
  options.viscosity = viscosity;
  ThreadTeam team(threads);
  PairSum sum(options, spheres.radius, order);
  std::vector<Vector3> velocity(spheres.size(), Vector3{7, 7, 7});
  sum.velocities(team, spheres.position, spheres.force, velocity);
  return velocity;
}

struct Expected {
  std::vector<Vector3> velocity;
  double scale = 0;  ///< largest sum over j of |M_ij F_j|
};

/// The sum pair by pair, the laws taken with plain doubles.
inline Expected oracle(const Spheres& spheres, Mobility mobility) {
  Expected expected;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    Vector3 sum;
    double size = 0;
    for (std::size_t j = 0; j < spheres.size(); ++j) {
      if (j == i) continue;
      const Vector3 d = spheres.position[i] - spheres.position[j];
      const double square = dot(d, d), inverse = 1 / std::sqrt(square), a_j = spheres.radius[j];
      const auto m = mobility == Mobility::zuk_2014
                         ? hydrodynamics::zuk_2014(square, inverse, spheres.radius[i], a_j)
                         : hydrodynamics::rotne_prager_1969(inverse, hydrodynamics::source_size(a_j));
      const Vector3& force = spheres.force[j];
      const Vector3 u = (1 / (8 * std::numbers::pi * viscosity)) * (m.isotropic * force + m.radial * dot(d, force) * d);
      sum += u;
      size += norm(u);
    }
    expected.velocity.push_back(sum);
    expected.scale = std::max(expected.scale, size);
  }
  return expected;
}

/// Largest |x_i - y_i|; not a number if one of them is not.
inline double max_difference(std::span<const Vector3> x, std::span<const Vector3> y) {
  double largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double difference = norm(x[i] - y[i]);
    if (!(difference <= largest)) largest = difference;
  }
  return largest;
}

}  // namespace talus::cloud

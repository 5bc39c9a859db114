// SPDX-License-Identifier: Apache-2.0
/// Clouds and the bound for the tests of the spectral sum.
#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "models/cloud/pair_sum_cases.hpp"
#include "models/cloud/spectral_sum.hpp"
#include "numerics/cell_grid.hpp"

namespace talus::cloud {

struct NamedCloud {
  std::string name;
  Spheres spheres;
};

/// Spheres of radii a (1 +- spread) in a box, its corner anywhere, none of which overlap, and random forces; with a
/// single layer in the plane.
inline NamedCloud box(const std::string& name, std::size_t columns, std::size_t rows, std::size_t layers,
                      double spacing, double spread, std::uint64_t seed) {
  Random random(seed);
  NamedCloud cloud{name, {}};
  const double play = std::max(0.0, 0.5 * spacing - (1 + spread)) * a, flat = layers == 1 ? 0 : 1;
  for (std::size_t l = 0; l < layers; ++l)
    for (std::size_t j = 0; j < rows; ++j)
      for (std::size_t i = 0; i < columns; ++i) {
        const auto along = [&](double corner, std::size_t n) {
          return corner + spacing * a * static_cast<double>(n) + random.uniform(-play, play);
        };
        const double x = along(-3.1, i), y = along(1.7, j), z = along(0.6, l);
        cloud.spheres.position.push_back({x, y, flat * z});
        cloud.spheres.radius.push_back(a * random.uniform(1 - spread, 1 + spread));
        const double f = random.uniform(-1e-4, 1e-4), g = random.uniform(-1e-4, 1e-4);
        cloud.spheres.force.push_back({f, g, flat * random.uniform(-1e-4, 1e-4)});
      }
  return cloud;
}

inline NamedCloud rectangle(const std::string& name, std::size_t columns, std::size_t rows, double spacing,
                            double spread, std::uint64_t seed) {
  return box(name, columns, rows, 1, spacing, spread, seed);
}

/// A disc, or a ball in space.
inline NamedCloud round_cloud(std::size_t across, double spread, Motion motion) {
  const bool space = motion == Motion::xyz;
  const NamedCloud all = box("", across, across, space ? across : 1, 2.8, spread, 3);
  NamedCloud round{space ? "ball" : "circle", {}};
  const double radius = 0.5 * 2.8 * a * static_cast<double>(across);
  const Vector3 centre{-3.1 + radius, 1.7 + radius, space ? 0.6 + radius : 0};
  for (std::size_t i = 0; i < all.spheres.size(); ++i) {
    if (norm(all.spheres.position[i] - centre) > radius) continue;
    round.spheres.position.push_back(all.spheres.position[i]);
    round.spheres.radius.push_back(all.spheres.radius[i]);
    round.spheres.force.push_back(all.spheres.force[i]);
  }
  return round;
}

inline NamedCloud two_clusters(const NamedCloud& one, const NamedCloud& other, const Vector3& apart) {
  NamedCloud cloud{"two distant clusters", one.spheres};
  for (std::size_t i = 0; i < other.spheres.size(); ++i) {
    cloud.spheres.position.push_back(other.spheres.position[i] + apart);
    cloud.spheres.radius.push_back(other.spheres.radius[i]);
    cloud.spheres.force.push_back(other.spheres.force[i]);
  }
  return cloud;
}

inline std::vector<NamedCloud> clouds_of_every_form(Motion motion) {
  std::vector<NamedCloud> clouds;
  if (motion == Motion::xyz) {
    clouds.push_back(round_cloud(14, 0.05, motion));
    clouds.push_back(box("slab", 3, 22, 22, 2.6, 0.05, 7));
    clouds.push_back(box("line along x", 1000, 1, 2, 2.5, 0.05, 8));
    clouds.push_back(box("rod along z", 3, 3, 130, 3.0, 0.05, 9));
    clouds.push_back(box("equal radii", 11, 11, 11, 2.6, 0, 11));
    clouds.push_back(box("radii 0.4 to 1.6", 11, 11, 11, 4.0, 0.6, 12));
    clouds.push_back({"overlapping", random_spheres(1200, 13, Motion::xyz)});
    clouds.push_back(
        two_clusters(box("", 9, 9, 9, 2.7, 0.05, 5), box("", 9, 9, 9, 2.7, 0.05, 6), {1500 * a, 700 * a, 300 * a}));
    return clouds;
  }
  clouds.push_back(round_cloud(42, 0.05, motion));
  clouds.push_back(rectangle("strip", 150, 8, 2.6, 0.05, 7));
  clouds.push_back(rectangle("line along x", 1200, 1, 2.5, 0.05, 8));
  clouds.push_back(rectangle("line along y", 1, 1200, 2.5, 0.05, 9));
  clouds.push_back(rectangle("1700 radii long, 17 wide", 486, 4, 3.5, 0.05, 10));
  clouds.push_back(rectangle("equal radii", 36, 36, 2.6, 0, 11));
  clouds.push_back(rectangle("radii 0.4 to 1.6", 36, 36, 4.0, 0.6, 12));
  clouds.push_back({"overlapping", random_spheres(1200, 13, Motion::xy)});
  clouds.push_back(
      two_clusters(rectangle("", 24, 24, 2.7, 0.05, 5), rectangle("", 24, 24, 2.7, 0.05, 6), {1500 * a, 700 * a, 0}));
  return clouds;
}

inline constexpr Motion plane_and_space[] = {Motion::xy, Motion::xyz};

/// What the error of each velocity may be: SpectralSum.
inline std::vector<double> error_bound(const Spheres& spheres, const SpectralAccuracy& accuracy, double cutoff) {
  std::vector<double> bound;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < spheres.size(); ++j) {
      const double r = norm(spheres.position[i] - spheres.position[j]), f = norm(spheres.force[j]);
      sum += accuracy.pair_error * f / std::max(r, cutoff);
      if (i == j || r > cutoff) continue;
      const double size =
          (2.0 / 3) * std::max(spheres.radius[i], spheres.radius[j]) * std::max(spheres.radius[i], spheres.radius[j]);
      sum += pair_rounding(accuracy) * cutoff / r * (2 / r + 4 * size / (r * r * r)) * f;
    }
    bound.push_back(sum / (8 * std::numbers::pi * viscosity));
  }
  return bound;
}

inline PairSum::Options options_of(Mobility mobility, Motion motion = Motion::xy) {
  return {.mobility = mobility, .motion = motion, .viscosity = viscosity};
}

inline std::vector<std::uint32_t> order_of(const Spheres& spheres) {
  return spatial_order(spheres.position, 4 * a);
}

inline double root_mean_square(std::span<const Vector3> v) {
  double sum = 0;
  for (const Vector3& x : v) sum += dot(x, x);
  return std::sqrt(sum / static_cast<double>(v.size()));
}

}  // namespace talus::cloud

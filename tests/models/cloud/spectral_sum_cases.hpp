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

struct PlaneCloud {
  std::string name;
  Spheres spheres;
};

/// Spheres of radii a (1 +- spread) in a rectangle, its corner anywhere, none of which overlap, and random forces.
inline PlaneCloud rectangle(const std::string& name, std::size_t columns, std::size_t rows, double spacing,
                            double spread, std::uint64_t seed) {
  Random random(seed);
  PlaneCloud cloud{name, {}};
  const double play = std::max(0.0, 0.5 * spacing - (1 + spread)) * a;
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < columns; ++i) {
      cloud.spheres.position.push_back({-3.1 + spacing * a * static_cast<double>(i) + random.uniform(-play, play),
                                        1.7 + spacing * a * static_cast<double>(j) + random.uniform(-play, play), 0});
      cloud.spheres.radius.push_back(a * random.uniform(1 - spread, 1 + spread));
      cloud.spheres.force.push_back({random.uniform(-1e-4, 1e-4), random.uniform(-1e-4, 1e-4), 0});
    }
  return cloud;
}

inline PlaneCloud disc_of(std::size_t across, double spread) {
  PlaneCloud all = rectangle("circle", across, across, 2.8, spread, 3), disc{"circle", {}};
  const double radius = 0.5 * 2.8 * a * static_cast<double>(across);
  const Vector3 centre{-3.1 + radius, 1.7 + radius, 0};
  for (std::size_t i = 0; i < all.spheres.size(); ++i) {
    if (norm(all.spheres.position[i] - centre) > radius) continue;
    disc.spheres.position.push_back(all.spheres.position[i]);
    disc.spheres.radius.push_back(all.spheres.radius[i]);
    disc.spheres.force.push_back(all.spheres.force[i]);
  }
  return disc;
}

inline PlaneCloud two_clusters() {
  PlaneCloud cloud = rectangle("two distant clusters", 24, 24, 2.7, 0.05, 5);
  const PlaneCloud other = rectangle("", 24, 24, 2.7, 0.05, 6);
  for (std::size_t i = 0; i < other.spheres.size(); ++i) {
    cloud.spheres.position.push_back(other.spheres.position[i] + Vector3{1500 * a, 700 * a, 0});
    cloud.spheres.radius.push_back(other.spheres.radius[i]);
    cloud.spheres.force.push_back(other.spheres.force[i]);
  }
  return cloud;
}

inline std::vector<PlaneCloud> plane_clouds() {
  std::vector<PlaneCloud> clouds;
  clouds.push_back(disc_of(42, 0.05));
  clouds.push_back(rectangle("strip", 150, 8, 2.6, 0.05, 7));
  clouds.push_back(rectangle("line along x", 1200, 1, 2.5, 0.05, 8));
  clouds.push_back(rectangle("line along y", 1, 1200, 2.5, 0.05, 9));
  clouds.push_back(rectangle("1700 radii long, 17 wide", 486, 4, 3.5, 0.05, 10));
  clouds.push_back(rectangle("equal radii", 36, 36, 2.6, 0, 11));
  clouds.push_back(rectangle("radii 0.4 to 1.6", 36, 36, 4.0, 0.6, 12));
  clouds.push_back({"overlapping", random_spheres(1200, 13, Motion::xy)});
  clouds.push_back(two_clusters());
  return clouds;
}

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

inline PairSum::Options in_plane_of(Mobility mobility, Motion motion = Motion::xy) {
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

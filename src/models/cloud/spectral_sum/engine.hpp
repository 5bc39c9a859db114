// SPDX-License-Identifier: Apache-2.0
/// The spectral sum in one precision.
#pragma once

#include <memory>

#include "models/cloud/spectral_sum.hpp"
#include "models/cloud/spectral_sum/cells.hpp"
#include "models/cloud/spectral_sum/convolution.hpp"
#include "models/cloud/spectral_sum/fourier.hpp"
#include "models/cloud/spectral_sum/kernel.hpp"

namespace talus::cloud {

class SpectralSum::Engine {
 public:
  Engine(const Options& options, const SpectralAccuracy& accuracy, std::span<const double> radius);
  virtual ~Engine() = default;
  virtual void velocities(ThreadTeam& team, const Lattice& lattice, std::span<const Vector3> position,
                          std::span<const Vector3> force, std::span<Vector3> velocity) = 0;

  Options options;
  SpectralAccuracy accuracy;
  std::size_t directions;  ///< in which spheres move: 2 or 3
  Axes axis;
  std::vector<double> radius;
  std::vector<double> size;  ///< m^2: what a sphere contributes to the finite size of a pair
  double mean_size = 0;      ///< m^2, of a pair
  double size_offset = 0;    ///< m^2: a sphere's deviation is its size less this
  Deviations deviations;
  std::vector<std::uint32_t> order;
  double cutoff = 0;
};

/// Nodes of the grid over some cells, with those that the splines of spheres at the rim reach.
inline std::size_t nodes_along(std::size_t cells, const SpectralAccuracy& accuracy) {
  return static_cast<std::size_t>(0.5 * accuracy.nodes * static_cast<double>(cells)) +
         static_cast<std::size_t>(accuracy.points);
}

std::unique_ptr<SpectralSum::Engine> make_engine(const SpectralSum::Options& options, const SpectralAccuracy& accuracy,
                                                 std::span<const double> radius);

}  // namespace talus::cloud

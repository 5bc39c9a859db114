// SPDX-License-Identifier: Apache-2.0
/// Grains as particles of a continuum: the fields that the kernel makes of them at any point, walls and plates by
/// images of the particles, as in the model. Kernel: the cubic spline with support 2 h of each particle.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/tensor.hpp"
#include "base/vector.hpp"
#include "numerics/cell_grid.hpp"
#include "numerics/geometry/domain.hpp"
#include "numerics/snapshot.hpp"
#include "numerics/sph/cubic_spline.hpp"
#include "numerics/sph/velocity_gradient.hpp"

namespace talus {

/// Particles, one entry per particle.
struct Particles {
  std::span<const Vector3> position;     ///< m
  std::vector<double> smoothing_length;  ///< h, m
  std::vector<double> volume;            ///< that a particle takes up, voids counted, m^3
  double solid_volume = 0;               ///< of the grains of a particle of mass ratio 1, m^3
  std::vector<double> mass_ratio = {};   ///< of each particle; empty: 1

  double solid_volume_of(std::size_t i) const { return MassRatios{mass_ratio}[i] * solid_volume; }
};

/// Particles of a bulk density each. \param density kg/m^3, above 0; \param mass of a particle, kg; \param
/// grain_density rho_p, kg/m^3; \param smoothing_length of all, m; not given: of each from its density, (m/rho)^(1/3)
/// \param mass_ratio to that mass
Particles particles_of_density(std::span<const Vector3> position, std::span<const double> density, double mass,
                               double grain_density, std::optional<double> smoothing_length = {},
                               const MassRatios& mass_ratio = {});

class ParticleField {
 public:
  /// \param domain with its gates in their state at that time
  /// \throws std::invalid_argument if a position is not finite or a smoothing length not above 0
  ParticleField(Particles particles, Domain domain);

  const Particles& particles() const { return particles_; }
  const Domain& domain() const { return domain_; }

  /// Packing fraction as the kernel deposits it: the sum of solid volume times W over particles and images.
  double packing(const Vector3& x) const;

  /// Mean of a column over the particles around x, weighted by volume times W; nan where there is none. Exact for a
  /// constant field. Vectors of images are turned as mirrors turn them. \param column one entry per particle
  double value(const Vector3& x, std::span<const double> column) const;
  Vector3 value(const Vector3& x, std::span<const Vector3> column) const;

 private:
  /// Calls visit(j, image, d) for each particle j and each of its images whose position x + d is visible from x and
  /// whose kernel reaches it.
  template <class Visit>
  void for_each_near(const Vector3& x, Visit&& visit) const;

  Particles particles_;
  Domain domain_;
  double reach_ = 0;
  Vector3 low_, high_;         // of the particles
  std::vector<Image> images_;  // the identity first
  CellGrid grid_;
};

/// du_i/dx_j at particles, in the order of `taken`, corrected so that it is exact for linear fields.
/// \param velocity one entry per particle, m/s \pre positions within the box, but for open faces
std::vector<Tensor3<>> velocity_gradients(const Particles& particles, const Domain& domain,
                                          std::span<const std::uint32_t> taken, std::span<const Vector3> velocity);

/// The particles whose x and z are within `reach` of a position, by index: enough of them for what a ParticleField says
/// there, if the box is not periodic along x and z.
std::vector<std::size_t> particles_around(std::span<const Vector3> position, const Vector3& centre, double reach);

/// Size of each particle's displacement since an earlier snapshot over the time between, m/s, in the order of `now`;
/// the least one of those by which a particle that passed a periodic face or a side of a sector may have come there.
/// Particles are known by the column "identity"; nan for one that was not there.
/// \param domain of the run, with its sector \throws std::invalid_argument if `before` is not earlier
std::vector<double> mean_speeds(const Snapshot& before, const Snapshot& now, const Domain& domain);

}  // namespace talus

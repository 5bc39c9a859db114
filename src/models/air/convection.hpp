// SPDX-License-Identifier: Apache-2.0
/// Convection of the velocities of the air on the faces of a grid.
#pragma once

#include "base/parallel.hpp"
#include "numerics/grid/face_apertures.hpp"

namespace talus::air {

/// Velocity and mass flux.
struct Stream {
  FaceField velocity;  ///< m/s
  FaceField mass;      ///< rho Phi u, kg/(m^2 s)
};

class Convection {
 public:
  explicit Convection(const FaceApertures& apertures);

  /// Fills the ghosts: periodic copies; beyond an open face the velocity within where the air leaves, none where it
  /// enters.
  void fill_ghosts(Stream& stream) const;

  /// force := -div(rho Phi u u), Eq. 18's convection, N/m^3, on the faces of an axis from `begin` on, a row along x;
  /// conservative. Ghosts must be filled. \param j, k of the row \param upwind 0 central, 1 third-order upwind-biased
  void find_force_of_row(const Stream& stream, int axis, int j, int k, std::ptrdiff_t begin, double upwind,
                         FaceField& force) const;

 private:
  const FaceApertures& apertures_;
};

}  // namespace talus::air

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

  /// force := -div(rho Phi u u), Eq. 18's convection, N/m^3; conservative. Ghosts must be filled.
  /// \param upwind 0 central, 1 third-order upwind-biased
  void find_force(ThreadTeam& team, const Stream& stream, double upwind, FaceField& force);

 private:
  void find_fluxes(ThreadTeam& team, const Stream& stream, int axis, int second, double upwind);

  const FaceApertures& apertures_;
  CellField flux_;
};

}  // namespace talus::air

// SPDX-License-Identifier: Apache-2.0
/// What convection and viscosity do to the air's velocities on the faces of a grid.
#pragma once

#include <vector>

#include "base/parallel.hpp"
#include "numerics/grid/passages.hpp"

namespace talus::air {

/// Velocity and what flows with it.
struct Stream {
  FaceField velocity;  ///< m/s
  FaceField mass;      ///< rho Phi u, kg/(m^2 s)
};

/// Two sums over a row of faces.
struct TwoSums {
  double first = 0, second = 0;
};

class Transport {
 public:
  explicit Transport(const Passages& passages);

  /// Fills the ghosts: periodic copies; beyond an open face the velocity within where the air leaves, none where it
  /// enters.
  void close(Stream& stream) const;

  /// rate := -div(rho Phi u u), Eq. 18's convection, N/m^3; what one face's volume gains another loses.
  /// \param upwind 0 central, 1 third-order upstream
  void convect(ThreadTeam& team, const Stream& stream, double upwind, FaceField& rate);

  /// stress := laplacian u + grad(div u)/3, with rough walls, 1/(m s); ghosts of the velocity closed
  void spread(ThreadTeam& team, const FaceField& velocity, FaceField& stress);

  /// Solves (u - start)/weight = amount (laplacian u + grad(div u)/3) for u, from a first guess; conjugate gradients.
  /// \param weight above 0 where faces are open; \param amount kinematic viscosity times time, m^2
  /// \returns iterations \throws NumericalError if it does not converge
  int spread_implicitly(ThreadTeam& team, const FaceField& start, const FaceField& weight, double amount,
                        FaceField& velocity);

 private:
  void find_flows(ThreadTeam& team, const Stream& stream, int axis, int second, double upwind);
  void laplace(ThreadTeam& team, double driven, const FaceField& velocity, FaceField& stress);

  const Passages& passages_;
  CellField flow_, divergence_;
  FaceField residual_, direction_, image_, per_weight_, per_diagonal_;  // of the implicit viscosity
  std::vector<TwoSums> row_sums_;
};

}  // namespace talus::air

// SPDX-License-Identifier: Apache-2.0
/// What convection and viscosity do to the air's velocities on the faces of a grid.
#pragma once

#include "base/parallel.hpp"
#include "numerics/grid/passages.hpp"

namespace talus::air {

/// Calls body(i, j, k, index) for the faces of an axis, in parallel by rows.
template <class Body>
void for_each_face(ThreadTeam& team, const Passages& passages, int axis, Body&& body) {
  const int nx = passages.faces(axis, 0), ny = passages.faces(axis, 1), nz = passages.faces(axis, 2);
  constexpr int rows_at_once = 16;
  const int rows = ny * nz;
  team.run(static_cast<std::size_t>((rows + rows_at_once - 1) / rows_at_once), [&](std::size_t block) {
    const int begin = static_cast<int>(block) * rows_at_once;
    for (int row = begin; row < std::min(begin + rows_at_once, rows); ++row) {
      const int j = row % ny, k = row / ny;
      const std::size_t first = passages.grid.index(0, j, k);
      for (int i = 0; i < nx; ++i) body(i, j, k, first + static_cast<std::size_t>(i));
    }
  });
}

/// Velocity and what flows with it.
struct Stream {
  FaceField velocity;  ///< m/s
  FaceField mass;      ///< rho Phi u, kg/(m^2 s)
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
  template <bool driven>
  void laplace(ThreadTeam& team, const FaceField& velocity, FaceField& stress);

  const Passages& passages_;
  CellField flux_, divergence_;
  FaceField residual_, direction_, image_, preconditioned_;
};

}  // namespace talus::air

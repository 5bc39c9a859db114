// SPDX-License-Identifier: Apache-2.0
/// Convection of the velocities of the air on the faces of a grid.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

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
  /// enters; beyond an inflow, of the components along it, what makes the advected one 0 at a given air.upwind.
  void fill_ghosts(Stream& stream, double upwind) const;

  /// The forces on rows of faces of an axis, one after another along y, then z: what flows between two of them is found
  /// once. Ghosts must be filled.
  class Rows {
   public:
    /// \param upwind 0 central, 1 third-order upwind-biased
    Rows(const FaceApertures& apertures, const Stream& stream, int axis, double upwind);

    /// -div(rho Phi u u), Eq. 18's convection, N/m^3, on the row (j, k), which begins at `begin`; conservative.
    /// \returns one number for each face of the row, until the next call
    const double* force(int j, int k, std::ptrdiff_t begin);

   private:
    /// What flows along an axis between a row of faces and the row before it, or between faces of a row.
    struct Fluxes {
      std::ptrdiff_t begin = -1;  ///< of the row
      std::vector<double> flux;   ///< N/m^2
    };
    const double* fluxes(Fluxes& kept, int second, std::size_t row, std::ptrdiff_t begin, int count) const;
    void find_force_at_end(int index, std::ptrdiff_t from, int count, double* force) const;

    const FaceApertures& apertures_;
    const Stream& stream_;
    int axis_;
    double upwind_;
    Fluxes along_x_;
    std::array<Fluxes, 2> along_y_;               // of the row and the next one, alternately
    std::vector<std::array<Fluxes, 2>> along_z_;  // of each row of a plane, and of that above it
    std::vector<double> force_;
  };
  Rows rows(const Stream& stream, int axis, double upwind) const { return {apertures_, stream, axis, upwind}; }

 private:
  const FaceApertures& apertures_;
};

}  // namespace talus::air

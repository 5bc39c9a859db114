// SPDX-License-Identifier: Apache-2.0
/// Viscous terms of the velocities of the air on the faces of a grid: explicit, or implicit where the viscous time
/// limit is shorter than the step.
#pragma once

#include <vector>

#include "base/parallel.hpp"
#include "models/air/part.hpp"
#include "models/air/viscosity_rows.hpp"
#include "numerics/grid/face_apertures.hpp"

namespace talus::air {

class Viscosity {
 public:
  /// \param part outlives this
  Viscosity(const FaceApertures& apertures, Part& part);

  /// What find_divergence_of_row() needs first: the divergence of the velocity, of which ghosts are filled, in all rows
  /// of cells along x (Grid::row), the first of which is at `begin`; then its ghosts.
  void find_velocity_divergence_of_row(std::size_t row, std::ptrdiff_t begin, const FaceField& velocity);
  void wrap_velocity_divergence() { apertures_.wrap(divergence_); }
  /// divergence := laplacian u + grad(div u)/3 (viscous_divergence()), with rough walls, 1/(m s), on `count` faces of
  /// an axis from `begin` on, in a row along x (Grid::row).
  void find_divergence_of_row(int axis, std::size_t row, std::ptrdiff_t begin, int count, const FaceField& velocity,
                              double* divergence) const;

  /// Solves (u - start)/weight = amount (laplacian u + grad(div u)/3) for u, from a first guess; conjugate gradients,
  /// preconditioned by the diagonal.
  /// \param weight above 0 where faces are open; \param amount kinematic viscosity times time, m^2
  /// Together, of several processes: the first guess on Part::midpoint, the others on the own faces; the solution there
  /// and around.
  /// \returns iterations \throws NumericalError if it does not converge
  int advance_implicitly(ThreadTeam& team, const FaceField& start, const FaceField& weight, double amount,
                         FaceField& velocity);

 private:
  struct System;
  struct Diagonal;
  enum class Walls { moving, at_rest };
  void find_divergence_of_row(Walls walls, int axis, std::size_t row, std::ptrdiff_t begin, int count,
                              const FaceField& velocity, double* divergence) const;
  void find_divergence(ThreadTeam& team, Walls walls, const FaceField& velocity, FaceField& divergence);
  template <class Body>
  void for_all_rows(ThreadTeam& team, Body&& body) const;
  template <class Body>
  TwoSums sum_over_rows(ThreadTeam& team, Body&& body);
  void wrap(FaceField& field) const;
  void refresh(FaceField& field);

  const FaceApertures& apertures_;
  Part& part_;
  CellField divergence_;  // of the velocity
  FaceField residual_, direction_, applied_, per_weight_,
      per_diagonal_;              // of the implicit step; made when it is asked for
  std::vector<double> row_sums_;  // two of each row
};

}  // namespace talus::air

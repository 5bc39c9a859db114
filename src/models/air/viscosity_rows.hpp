// SPDX-License-Identifier: Apache-2.0
/// The loops over a row of faces for the viscosity of the air and the conjugate gradients of its implicit form. They
/// are separate functions so that the compiler vectorises them; arrays begin with the first face or cell of the row.
#pragma once

#include <cstddef>

#include "base/vector.hpp"

namespace talus::air {

/// Two sums over a row of faces.
struct TwoSums {
  double first = 0, second = 0;
};

/// The divergence of the velocity in the cells of a row, where `inner`.
void find_divergence_of_row(int count, std::ptrdiff_t dy, std::ptrdiff_t dz, const Vector3& per_width, const double* u,
                            const double* v, const double* w, const double* inner, double* __restrict out);

/// Input of the viscous term on a row of faces.
struct ViscousRow {
  const double* velocity;  ///< m/s
  /// 1 where no wall separates a face from the one before, along each axis, and from the one after along y and z.
  const double *link_x, *link_y, *link_y_after, *link_z, *link_z_after;
  const double* wall;   ///< FaceApertures::wall, 1/m^2
  const double* drive;  ///< FaceApertures::drive, 1/(m s)
  const double* open;
  const double* divergence;  ///< of the velocity, in cells, 1/s
  std::ptrdiff_t along;      ///< from a cell to the next across a face
  double third;              ///< of the inverse of their distance, 1/m
};

/// \param driven 1, or 0: as if the walls were at rest
void find_viscous_divergence_of_row(int count, double driven, std::ptrdiff_t dy, std::ptrdiff_t dz,
                                    const Vector3& per_width, const ViscousRow& row, double* __restrict out);

/// Input of an implicit step.
struct ImplicitRow {
  const double *open, *wall, *drive;
  const double* weight;    ///< of the viscous force
  const double* start;     ///< the velocity without viscosity, m/s
  const double* velocity;  ///< the first guess, m/s
  const double* viscous;   ///< of the first guess, 1/(m s)
};

/// Residual of the first guess; sets the direction to zero.
/// \param amount kinematic viscosity times time, m^2; \param own diagonal of -(laplacian + grad div/3) away from rough
/// walls, 1/m^2; \returns square of the source
double begin_row(int count, double amount, double own, const ImplicitRow& row, double* __restrict per_weight,
                 double* __restrict per_diagonal, double* __restrict residual, double* __restrict direction);

/// \returns square of the residual, and its product with itself over the diagonal
TwoSums measure_residual_of_row(int count, const double* per_diagonal, const double* residual);

/// direction := residual/diagonal + beta direction.
void update_direction_row(int count, double beta, const double* per_diagonal, const double* residual,
                          double* __restrict direction);

/// \param applied in: the viscous divergence of the direction; \returns its product with the direction
double apply_row(int count, double amount, const double* per_weight, const double* direction,
                 double* __restrict applied);

void step_row(int count, double step, const double* direction, const double* applied, double* __restrict velocity,
              double* __restrict residual);

}  // namespace talus::air

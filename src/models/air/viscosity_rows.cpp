// SPDX-License-Identifier: Apache-2.0
#include "models/air/viscosity_rows.hpp"

#include "base/clones.hpp"
#include "base/registers.hpp"
#include "physics/air/momentum.hpp"

namespace talus::air {

namespace {

/// A sum over a row in eight interleaved ones, so that vectors of any width add in the same order.
struct InterleavedSum {
  static constexpr int count = 8;
  double part[count] = {};

  double total() const {
    return ((part[0] + part[4]) + (part[2] + part[6])) + ((part[1] + part[5]) + (part[3] + part[7]));
  }
};

/// Calls body(index, part) along a row.
template <class Body>
TALUS_INLINE void for_each_interleaved(int count, Body&& body) {
  int f = 0;
  for (; f + InterleavedSum::count <= count; f += InterleavedSum::count)
    for (int l = 0; l < InterleavedSum::count; ++l) body(f + l, l);
  for (int l = 0; f + l < count; ++l) body(f + l, l);
}

}  // namespace

TALUS_CLONES void find_divergence_of_row(int count, std::ptrdiff_t dy, std::ptrdiff_t dz, const Vector3& per_width,
                                         const double* u, const double* v, const double* w, const double* inner,
                                         double* __restrict out) {
  for (int c = 0; c < count; ++c)
    out[c] = inner[c] *
             ((u[c + 1] - u[c]) * per_width.x + (v[c + dy] - v[c]) * per_width.y + (w[c + dz] - w[c]) * per_width.z);
}

TALUS_CLONES void find_viscous_divergence_of_row(int count, double driven, std::ptrdiff_t dy, std::ptrdiff_t dz,
                                                 const Vector3& per_width, const ViscousRow& given,
                                                 double* __restrict out) {
  const double xx = per_width.x * per_width.x, yy = per_width.y * per_width.y, zz = per_width.z * per_width.z;
  const ViscousRow row = given;
  const double *u = row.velocity, *x = row.link_x, *y = row.link_y, *z = row.link_z;
  const double *y_after = row.link_y_after, *z_after = row.link_z_after;
  for (int f = 0; f < count; ++f) {
    const double laplacian = xx * (x[f + 1] * (u[f + 1] - u[f]) - x[f] * (u[f] - u[f - 1])) +
                             yy * (y_after[f] * (u[f + dy] - u[f]) - y[f] * (u[f] - u[f - dy])) +
                             zz * (z_after[f] * (u[f + dz] - u[f]) - z[f] * (u[f] - u[f - dz]));
    out[f] = row.open[f] * viscous_divergence(row.third * (row.divergence[f] - row.divergence[f - row.along]),
                                              row.wall[f] * u[f], driven * row.drive[f], laplacian);
  }
}

TALUS_CLONES double begin_row(int count, double amount, double own, const ImplicitRow& given,
                              double* __restrict per_weight, double* __restrict per_diagonal,
                              double* __restrict residual, double* __restrict direction) {
  const ImplicitRow row = given;
  InterleavedSum source;
  for_each_interleaved(count, [&](int f, int part) {
    const double open = row.open[f], inverse = open > 0 ? 1 / row.weight[f] : 0;
    const double known = open * (row.start[f] * inverse + amount * row.drive[f]);
    per_weight[f] = inverse;
    per_diagonal[f] = open > 0 ? 1 / (inverse + amount * (own + row.wall[f])) : 0;
    residual[f] = open * ((row.start[f] - row.velocity[f]) * inverse + amount * row.viscous[f]);
    direction[f] = 0;
    source.part[part] += known * known;
  });
  return source.total();
}

TALUS_CLONES TwoSums measure_residual_of_row(int count, const double* per_diagonal, const double* residual) {
  InterleavedSum square, product;
  for_each_interleaved(count, [&](int f, int part) {
    const double r = residual[f];
    square.part[part] += r * r;
    product.part[part] += r * r * per_diagonal[f];
  });
  return {square.total(), product.total()};
}

TALUS_CLONES void update_direction_row(int count, double beta, const double* per_diagonal, const double* residual,
                                       double* __restrict direction) {
  for (int f = 0; f < count; ++f) direction[f] = per_diagonal[f] * residual[f] + beta * direction[f];
}

TALUS_CLONES double apply_row(int count, double amount, const double* per_weight, const double* direction,
                              double* __restrict applied) {
  InterleavedSum product;
  for_each_interleaved(count, [&](int f, int part) {
    applied[f] = direction[f] * per_weight[f] - amount * applied[f];
    product.part[part] += direction[f] * applied[f];
  });
  return product.total();
}

TALUS_CLONES void step_row(int count, double step, const double* direction, const double* applied,
                           double* __restrict velocity, double* __restrict residual) {
  for (int f = 0; f < count; ++f) {
    velocity[f] += step * direction[f];
    residual[f] -= step * applied[f];
  }
}

}  // namespace talus::air

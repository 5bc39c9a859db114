// SPDX-License-Identifier: Apache-2.0
#include "models/air/viscosity.hpp"

#include <cmath>

#include "base/error.hpp"
#include "numerics/grid/conjugate_gradients.hpp"
#include "numerics/grid/loops.hpp"

namespace talus::air {

namespace {

/// Calls body(component, first face, faces, row of the component) for rows of a component.
template <class Body>
void for_rows_of(ThreadTeam& team, const FaceApertures& apertures, int axis, Slices rows, Body&& body) {
  const std::array<int, 3> faces = apertures.faces(axis);
  for_each_row(team, apertures.grid, faces, rows, [&](int j, int k, std::ptrdiff_t begin, std::ptrdiff_t end) {
    body(static_cast<std::size_t>(axis), begin, static_cast<int>(end - begin),
         static_cast<std::size_t>(k * faces[1] + j));
  });
}

}  // namespace

Viscosity::Viscosity(const FaceApertures& apertures, Part& part)
    : apertures_(apertures), part_(part), divergence_(apertures.grid.cell_field()) {}

void Viscosity::wrap(FaceField& field) const {
  for (auto& component : field) apertures_.wrap(component);
}

void Viscosity::refresh(FaceField& field) {
  part_.refresh(std::array{&field[0], &field[1], &field[2]});
}

/// Calls body(component, first face, faces) for the own rows.
template <class Body>
void Viscosity::for_all_rows(ThreadTeam& team, Body&& body) const {
  for (int axis = 0; axis < 3; ++axis)
    for_rows_of(team, apertures_, axis, part_.own,
                [&](std::size_t a, std::ptrdiff_t f, int count, std::size_t) { body(a, f, count); });
}

/// Adds up what body returns, in the order of the rows.
template <class Body>
TwoSums Viscosity::sum_over_rows(ThreadTeam& team, Body&& body) {
  TwoSums total;
  for (int axis = 0; axis < 3; ++axis) {
    row_sums_.assign(static_cast<std::size_t>(2 * apertures_.faces(axis, 1) * apertures_.faces(axis, 2)), 0);
    for_rows_of(team, apertures_, axis, part_.own, [&](std::size_t a, std::ptrdiff_t f, int count, std::size_t row) {
      const TwoSums sums = body(a, f, count);
      row_sums_[2 * row] = sums.first, row_sums_[2 * row + 1] = sums.second;
    });
    part_.ranks.add_up(row_sums_);
    for (std::size_t n = 0; n < row_sums_.size(); n += 2) total.first += row_sums_[n], total.second += row_sums_[n + 1];
  }
  return total;
}

void Viscosity::find_velocity_divergence_of_row(std::size_t row, std::ptrdiff_t begin, const FaceField& velocity) {
  const Grid& grid = apertures_.grid;
  const double* inner = apertures_.rows.inner.at(row);
  const Vector3 per_width{1 / grid.spacing.x, 1 / grid.spacing.y, 1 / grid.spacing.z};
  air::find_divergence_of_row(grid.count[0], grid.stride(1), grid.stride(2), per_width, velocity[0].data() + begin,
                              velocity[1].data() + begin, velocity[2].data() + begin, inner,
                              divergence_.data() + begin);
}

void Viscosity::find_divergence_of_row(int axis, std::size_t row, std::ptrdiff_t begin, int count,
                                       const FaceField& velocity, double* divergence) const {
  find_divergence_of_row(Walls::moving, axis, row, begin, count, velocity, divergence);
}

void Viscosity::find_divergence_of_row(Walls walls, int axis, std::size_t row, std::ptrdiff_t begin, int count,
                                       const FaceField& velocity, double* divergence) const {
  const Grid& grid = apertures_.grid;
  const Vector3 per_width{1 / grid.spacing.x, 1 / grid.spacing.y, 1 / grid.spacing.z};
  const auto a = static_cast<std::size_t>(axis);
  const auto from = [&](const CellField& field) { return field.data() + begin; };
  const FaceApertures::Rows& rows = apertures_.rows;
  const auto& link = rows.link[a];
  find_viscous_divergence_of_row(count, walls == Walls::moving ? 1 : 0, grid.stride(1), grid.stride(2), per_width,
                                 {.velocity = from(velocity[a]),
                                  .link_x = link[0].at(row),
                                  .link_y = link[1].at(row),
                                  .link_y_after = link[1].at(row + grid.row_stride(1)),
                                  .link_z = link[2].at(row),
                                  .link_z_after = link[2].at(row + grid.row_stride(2)),
                                  .wall = rows.wall[a].at(row),
                                  .drive = rows.drive[a].at(row),
                                  .open = rows.open[a].at(row),
                                  .divergence = from(divergence_),
                                  .along = grid.stride(axis),
                                  .third = per_width[axis] / 3},
                                 divergence);
}

void Viscosity::find_divergence(ThreadTeam& team, Walls walls, const FaceField& velocity, FaceField& divergence) {
  const Grid& grid = apertures_.grid;
  for_each_row(team, grid, grid.count, part_.beside, [&](int j, int k, std::ptrdiff_t first, std::ptrdiff_t) {
    find_velocity_divergence_of_row(grid.row(j, k), first, velocity);
  });
  wrap_velocity_divergence();
  for (int axis = 0; axis < 3; ++axis) {
    double* of_axis = divergence[static_cast<std::size_t>(axis)].data();
    for_each_row(team, grid, apertures_.faces(axis), part_.own,
                 [&](int j, int k, std::ptrdiff_t first, std::ptrdiff_t end) {
                   find_divergence_of_row(walls, axis, grid.row(j, k), first, static_cast<int>(end - first), velocity,
                                          of_axis + first);
                 });
  }
}

/// (1/weight - amount (laplacian + grad div/3)) u = start/weight, walls moving, for the conjugate gradients.
struct Viscosity::System {
  Viscosity& v;
  ThreadTeam& team;
  double amount;
  FaceField& velocity;
  double preconditioned = 0;  ///< r . M r of the last residual, M the inverse of the diagonal

  double residual_square() {
    const TwoSums sums = v.sum_over_rows(team, [&](std::size_t a, std::ptrdiff_t f, int count) {
      return measure_residual_of_row(count, &v.per_diagonal_[a][f], &v.residual_[a][f]);
    });
    preconditioned = sums.second;
    return sums.first;
  }
  double apply_to_direction() {
    v.refresh(v.direction_);
    v.wrap(v.direction_);
    v.find_divergence(team, Walls::at_rest, v.direction_, v.applied_);
    return v
        .sum_over_rows(
            team,
            [&](std::size_t a, std::ptrdiff_t f, int count) {
              return TwoSums{apply_row(count, amount, &v.per_weight_[a][f], &v.direction_[a][f], &v.applied_[a][f]), 0};
            })
        .first;
  }
  void advance(double step) {
    v.for_all_rows(team, [&](std::size_t a, std::ptrdiff_t f, int count) {
      step_row(count, step, &v.direction_[a][f], &v.applied_[a][f], &velocity[a][f], &v.residual_[a][f]);
    });
  }
};

/// The inverse of the diagonal as the preconditioner: its product is taken where the residual is measured.
struct Viscosity::Diagonal {
  Viscosity& v;
  ThreadTeam& team;
  const System& system;

  double apply(double) { return system.preconditioned; }
  void update_direction(double beta) {
    v.for_all_rows(team, [&](std::size_t a, std::ptrdiff_t f, int count) {
      update_direction_row(count, beta, &v.per_diagonal_[a][f], &v.residual_[a][f], &v.direction_[a][f]);
    });
  }
};

int Viscosity::advance_implicitly(ThreadTeam& team, const FaceField& start, const FaceField& weight, double amount,
                                  FaceField& velocity) {
  constexpr int max_iterations = 500;
  constexpr double tolerance = 1e-6;
  const Grid& grid = apertures_.grid;
  for (FaceField* field : {&residual_, &direction_, &applied_, &per_weight_, &per_diagonal_})
    if (field->front().empty()) *field = grid.face_field();
  double own = 0;  // of the Laplacian and of the gradient of the divergence
  for (int axis = 0; axis < 3; ++axis) own += 2 / (grid.spacing[axis] * grid.spacing[axis]);
  wrap(velocity);
  find_divergence(team, Walls::moving, velocity, applied_);
  const double source =
      sum_over_rows(team, [&](std::size_t a, std::ptrdiff_t f, int count) {
        const double width = grid.spacing[static_cast<int>(a)];
        return TwoSums{begin_row(count, amount, own + 2 / (3 * width * width),
                                 {.open = &apertures_.open[a][f],
                                  .wall = &apertures_.wall[a][f],
                                  .drive = &apertures_.drive[a][f],
                                  .weight = &weight[a][f],
                                  .start = &start[a][f],
                                  .velocity = &velocity[a][f],
                                  .viscous = &applied_[a][f]},
                                 &per_weight_[a][f], &per_diagonal_[a][f], &residual_[a][f], &direction_[a][f]),
                       0};
      }).first;
  System system{*this, team, amount, velocity};
  Diagonal diagonal{*this, team, system};
  const ConjugateGradients found =
      solve_by_conjugate_gradients(system, diagonal, tolerance * std::sqrt(source), max_iterations);
  if (found.convergence != Convergence::reached)
    throw NumericalError({.what = "the implicit viscosity of the air has not converged",
                          .term = "viscous term of Eq. 18",
                          .place = "the whole grid",
                          .advice = "a shorter air.max_step"});
  refresh(velocity);
  return found.iterations;
}

}  // namespace talus::air

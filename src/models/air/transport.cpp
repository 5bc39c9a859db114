// SPDX-License-Identifier: Apache-2.0
#include "models/air/transport.hpp"

#include <cmath>

#include "base/clones.hpp"
#include "base/error.hpp"
#include "base/registers.hpp"
#include "numerics/grid/loops.hpp"
#include "physics/air/momentum.hpp"

namespace talus::air {

namespace {

/// Calls body(index) for the cells of one layer across an axis and those next to them.
template <class Body>
void for_each_in_layer(const Grid& grid, int axis, int layer, Body&& body) {
  std::array<int, 3> low{-1, -1, -1}, high{grid.count[0] + 1, grid.count[1] + 1, grid.count[2] + 1};
  low[static_cast<std::size_t>(axis)] = layer, high[static_cast<std::size_t>(axis)] = layer + 1;
  for (int k = low[2]; k < high[2]; ++k)
    for (int j = low[1]; j < high[1]; ++j)
      for (int i = low[0]; i < high[0]; ++i) body(grid.index(i, j, k));
}

std::size_t plus(std::size_t index, std::ptrdiff_t by) {
  return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(index) + by);
}

// Rows of faces. Functions of their own, so that the compiler makes vectors of them.

/// What flows carry between the faces of a row and those before them.
TALUS_CLONES void find_flows_of_row(int count, std::ptrdiff_t along, std::ptrdiff_t across, double upwind,
                                    const double* u, const double* mass, const double* wide, double* __restrict flow) {
  for (int f = 0; f < count; ++f) {
    const double carrier = 0.5 * (mass[f] + mass[f - along]);
    flow[f] = carrier * carried_velocity(u[f - 2 * across], u[f - across], u[f], u[f + across], wide[f],
                                         carrier > 0 ? 1.0 : -1.0, upwind);
  }
}

TALUS_CLONES void subtract_difference(std::ptrdiff_t count, double factor, const double* below, const double* above,
                                      double* __restrict out) {
  for (std::ptrdiff_t f = 0; f < count; ++f) out[f] -= factor * (above[f] - below[f]);
}

TALUS_CLONES void find_divergence_of_row(int count, std::ptrdiff_t dy, std::ptrdiff_t dz, const Vector3& per_width,
                                         const double* u, const double* v, const double* w, const double* inner,
                                         double* __restrict out) {
  for (int c = 0; c < count; ++c)
    out[c] = inner[c] *
             ((u[c + 1] - u[c]) * per_width.x + (v[c + dy] - v[c]) * per_width.y + (w[c + dz] - w[c]) * per_width.z);
}

/// What the stress of a row of faces is made of, from its first face on.
struct StressRow {
  const double *u, *link_x, *link_y, *link_z, *wall, *drive, *open, *divergence;
  std::ptrdiff_t along;  ///< from a cell to the next across a face
  double third;          ///< of the inverse of their distance, 1/m
};

TALUS_CLONES void find_stress_of_row(int count, double driven, std::ptrdiff_t dy, std::ptrdiff_t dz,
                                     const Vector3& per_width, const StressRow& row, double* __restrict stress) {
  const double xx = per_width.x * per_width.x, yy = per_width.y * per_width.y, zz = per_width.z * per_width.z;
  const auto [u, x, y, z, wall, drive, open, divergence, along, third] = row;
  for (int f = 0; f < count; ++f) {
    const double own = third * (divergence[f] - divergence[f - along]) - wall[f] * u[f] + driven * drive[f];
    const double sum = xx * (x[f + 1] * (u[f + 1] - u[f]) - x[f] * (u[f] - u[f - 1])) +
                       yy * (y[f + dy] * (u[f + dy] - u[f]) - y[f] * (u[f] - u[f - dy])) +
                       zz * (z[f + dz] * (u[f + dz] - u[f]) - z[f] * (u[f] - u[f - dz]));
    stress[f] = open[f] * (own + sum);
  }
}

// Rows of the conjugate gradients of the implicit viscosity.

/// A sum over a row in eight lanes, so that vectors of any width add in the same order.
struct Lanes {
  static constexpr int count = 8;
  double lane[count] = {};

  double sum() const {
    return ((lane[0] + lane[4]) + (lane[2] + lane[6])) + ((lane[1] + lane[5]) + (lane[3] + lane[7]));
  }
};

/// Calls body(place, lane) along a row.
template <class Body>
TALUS_INLINE void for_each_in_lanes(int count, Body&& body) {
  int f = 0;
  for (; f + Lanes::count <= count; f += Lanes::count)
    for (int l = 0; l < Lanes::count; ++l) body(f + l, l);
  for (int l = 0; f + l < count; ++l) body(f + l, l);
}

struct BeginRow {
  const double *open, *wall, *drive, *weight, *start, *velocity, *stress;
};

/// \param amount kinematic viscosity times time, m^2; \param own diagonal of -(laplacian + grad div/3) away from rough
/// walls, 1/m^2; \returns square of the source
TALUS_CLONES TwoSums begin_row(int count, double amount, double own, const BeginRow& row, double* __restrict per_weight,
                               double* __restrict per_diagonal, double* __restrict residual,
                               double* __restrict direction) {
  const auto [open, wall, drive, weight, start, velocity, stress] = row;
  Lanes source;
  for_each_in_lanes(count, [&](int f, int lane) {
    const double inverse = open[f] > 0 ? 1 / weight[f] : 0;
    const double given = open[f] * (start[f] * inverse + amount * drive[f]);
    per_weight[f] = inverse;
    per_diagonal[f] = open[f] > 0 ? 1 / (inverse + amount * (own + wall[f])) : 0;
    residual[f] = open[f] * ((start[f] - velocity[f]) * inverse + amount * stress[f]);
    direction[f] = 0;
    source.lane[lane] += given * given;
  });
  return {source.sum(), 0};
}

/// \returns square of the residual, and its product with the preconditioned one
TALUS_CLONES TwoSums measure_residual_of_row(int count, const double* per_diagonal, const double* residual) {
  Lanes square, product;
  for_each_in_lanes(count, [&](int f, int lane) {
    const double r = residual[f];
    square.lane[lane] += r * r;
    product.lane[lane] += r * r * per_diagonal[f];
  });
  return {square.sum(), product.sum()};
}

TALUS_CLONES void turn_row(int count, double turn, const double* per_diagonal, const double* residual,
                           double* __restrict direction) {
  for (int f = 0; f < count; ++f) direction[f] = per_diagonal[f] * residual[f] + turn * direction[f];
}

/// \param image in: the stress of the direction; \returns its product with the direction
TALUS_CLONES TwoSums find_image_of_row(int count, double amount, const double* per_weight, const double* direction,
                                       double* __restrict image) {
  Lanes work;
  for_each_in_lanes(count, [&](int f, int lane) {
    image[f] = direction[f] * per_weight[f] - amount * image[f];
    work.lane[lane] += direction[f] * image[f];
  });
  return {work.sum(), 0};
}

TALUS_CLONES void step_row(int count, double step, const double* direction, const double* image,
                           double* __restrict velocity, double* __restrict residual) {
  for (int f = 0; f < count; ++f) {
    velocity[f] += step * direction[f];
    residual[f] -= step * image[f];
  }
}

}  // namespace

Transport::Transport(const Passages& passages)
    : passages_(passages), flow_(passages.grid.cell_field()), divergence_(flow_) {}

void Transport::close(Stream& stream) const {
  const Grid& grid = passages_.grid;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, 1}) {
      if (!passages_.boundaries.is_open(axis, side)) continue;
      const int n = grid.count[static_cast<std::size_t>(axis)];
      const std::ptrdiff_t outward = side == 0 ? -grid.stride(axis) : grid.stride(axis);
      const auto& through = stream.mass[static_cast<std::size_t>(axis)];
      for (int component = 0; component < 3; ++component) {
        const auto a = static_cast<std::size_t>(component);
        const int inside = side == 0 ? 0 : component == axis ? n : n - 1;
        const std::ptrdiff_t to_face = component == axis || side == 0 ? 0 : grid.stride(axis);
        const std::ptrdiff_t back = component == axis ? 0 : -grid.stride(component);
        for_each_in_layer(grid, axis, inside, [&](std::size_t c) {
          const std::size_t face = plus(c, to_face);
          // The flow through the end of the box beside this velocity, outward positive.
          const double outflow = (side == 0 ? -1 : 1) * (through[face] + through[plus(face, back)]);
          stream.mass[a][plus(c, outward)] = stream.mass[a][c];
          stream.velocity[a][plus(c, outward)] = outflow > 0 ? stream.velocity[a][c] : 0;
        });
      }
    }
  for (std::size_t a = 0; a < 3; ++a) passages_.wrap(stream.velocity[a]), passages_.wrap(stream.mass[a]);
}

void Transport::convect(ThreadTeam& team, const Stream& stream, double upwind, FaceField& rate) {
  const Grid& grid = passages_.grid;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double* u = stream.velocity[a].data();
    double* out = rate[a].data();
    for_each_face(team, passages_, axis, [&](std::ptrdiff_t f) { out[f] = 0; });
    for (int second = 0; second < 3; ++second) {
      const auto b = static_cast<std::size_t>(second);
      const std::ptrdiff_t across = grid.stride(second);
      const double* mass = stream.mass[b].data();
      find_flows(team, stream, axis, second, upwind);
      const double* flow = flow_.data();
      const double per_width = 1 / grid.spacing[second];
      for_each_run(team, passages_, axis, [&](const FaceRun& run) {
        if (second != axis || !run.is_end)
          return subtract_difference(run.end - run.begin, per_width, flow + run.begin, flow + run.begin + across,
                                     out + run.begin);
        // The volume of a face at an open end is half a cell, from the end inwards.
        const std::ptrdiff_t outward = run.place == 0 ? -across : across, inward = run.place == 0 ? across : 0;
        const double factor = (run.place == 0 ? 2 : -2) * per_width;
        for (auto f = run.begin; f < run.end; ++f)
          out[f] -= factor * (flow[f + inward] - mass[f] * 0.5 * (u[f] + u[f + outward]));
      });
    }
  }
}

/// The flow of momentum along an axis between each of its faces and the one before it along a second axis; for the
/// last within the box that to the one beyond, too.
void Transport::find_flows(ThreadTeam& team, const Stream& stream, int axis, int second, double upwind) {
  const auto a = static_cast<std::size_t>(axis), b = static_cast<std::size_t>(second);
  const Grid& grid = passages_.grid;
  std::array<int, 3> count = passages_.faces(axis);
  count[b] = grid.count[b] + 1;
  for_each_row(team, grid, count, [&](int, int, std::ptrdiff_t begin, std::ptrdiff_t) {
    find_flows_of_row(count[0], grid.stride(axis), grid.stride(second), upwind, stream.velocity[a].data() + begin,
                      stream.mass[b].data() + begin, passages_.wide[a][b].data() + begin, flow_.data() + begin);
  });
}

/// \param driven 1, or 0: as if the walls stood still
void Transport::laplace(ThreadTeam& team, double driven, const FaceField& velocity, FaceField& stress) {
  const Grid& grid = passages_.grid;
  const std::ptrdiff_t dy = grid.stride(1), dz = grid.stride(2);
  const Vector3 per_width{1 / grid.spacing.x, 1 / grid.spacing.y, 1 / grid.spacing.z};
  for_each_row(team, grid, grid.count, [&](int, int, std::ptrdiff_t begin, std::ptrdiff_t) {
    find_divergence_of_row(grid.count[0], dy, dz, per_width, velocity[0].data() + begin, velocity[1].data() + begin,
                           velocity[2].data() + begin, passages_.inner.data() + begin, divergence_.data() + begin);
  });
  passages_.wrap(divergence_);
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const auto& link = passages_.link[a];
    for_each_row(team, grid, passages_.faces(axis), [&](int, int, std::ptrdiff_t begin, std::ptrdiff_t end) {
      const auto from = [&](const CellField& field) { return field.data() + begin; };
      const StressRow row{from(velocity[a]),       from(link[0]),           from(link[1]),
                          from(link[2]),           from(passages_.wall[a]), from(passages_.drive[a]),
                          from(passages_.open[a]), from(divergence_),       grid.stride(axis),
                          per_width[axis] / 3};
      find_stress_of_row(static_cast<int>(end - begin), driven, dy, dz, per_width, row, stress[a].data() + begin);
    });
  }
}

void Transport::spread(ThreadTeam& team, const FaceField& velocity, FaceField& stress) {
  laplace(team, 1, velocity, stress);
}

int Transport::spread_implicitly(ThreadTeam& team, const FaceField& start, const FaceField& weight, double amount,
                                 FaceField& velocity) {
  constexpr int most_iterations = 500;
  constexpr double tolerance = 1e-6;
  const Grid& grid = passages_.grid;
  for (FaceField* field : {&residual_, &direction_, &image_, &per_weight_, &per_diagonal_})
    if (field->front().empty()) *field = grid.face_field();
  double own = 0;  // of the Laplacian and of the gradient of the divergence
  for (int axis = 0; axis < 3; ++axis) own += 2 / (grid.spacing[axis] * grid.spacing[axis]);
  // Calls body(component, first face, faces, row of the component) for all rows of a component.
  const auto over_rows = [&](int axis, auto&& body) {
    const std::array<int, 3> faces = passages_.faces(axis);
    for_each_row(team, grid, faces, [&](int j, int k, std::ptrdiff_t begin, std::ptrdiff_t end) {
      body(static_cast<std::size_t>(axis), begin, static_cast<int>(end - begin),
           static_cast<std::size_t>(k * faces[1] + j));
    });
  };
  const auto for_all_rows = [&](auto&& body) {
    for (int axis = 0; axis < 3; ++axis)
      over_rows(axis, [&](std::size_t a, std::ptrdiff_t f, int count, std::size_t) { body(a, f, count); });
  };
  // Adds up what body returns, in the order of the rows.
  const auto sum_over_rows = [&](auto&& body) {
    TwoSums total;
    for (int axis = 0; axis < 3; ++axis) {
      row_sums_.resize(static_cast<std::size_t>(passages_.faces(axis, 1) * passages_.faces(axis, 2)));
      over_rows(axis, [&](std::size_t a, std::ptrdiff_t f, int count, std::size_t row) {
        row_sums_[row] = body(a, f, count);
      });
      for (const TwoSums& row : row_sums_) total.first += row.first, total.second += row.second;
    }
    return total;
  };
  const auto wrap = [&](FaceField& field) {
    for (auto& component : field) passages_.wrap(component);
  };

  wrap(velocity);
  laplace(team, 1, velocity, image_);
  const double source =
      sum_over_rows([&](std::size_t a, std::ptrdiff_t f, int count) {
        const double width = grid.spacing[static_cast<int>(a)];
        return begin_row(count, amount, own + 2 / (3 * width * width),
                         {&passages_.open[a][f], &passages_.wall[a][f], &passages_.drive[a][f], &weight[a][f],
                          &start[a][f], &velocity[a][f], &image_[a][f]},
                         &per_weight_[a][f], &per_diagonal_[a][f], &residual_[a][f], &direction_[a][f]);
      }).first;
  double product = 0;
  for (int iteration = 0;; ++iteration) {
    const TwoSums left = sum_over_rows([&](std::size_t a, std::ptrdiff_t f, int count) {
      return measure_residual_of_row(count, &per_diagonal_[a][f], &residual_[a][f]);
    });
    if (left.first <= tolerance * tolerance * source) return iteration;
    if (iteration == most_iterations || !std::isfinite(left.first))
      throw NumericalError({.what = "the implicit viscosity of the air has not converged",
                            .term = "viscous term of Eq. 18",
                            .place = "the whole grid",
                            .advice = "a shorter air.longest_step"});
    const double turn = product > 0 ? left.second / product : 0;
    product = left.second;
    for_all_rows([&](std::size_t a, std::ptrdiff_t f, int count) {
      turn_row(count, turn, &per_diagonal_[a][f], &residual_[a][f], &direction_[a][f]);
    });
    wrap(direction_);
    laplace(team, 0, direction_, image_);
    const double work = sum_over_rows([&](std::size_t a, std::ptrdiff_t f, int count) {
                          return find_image_of_row(count, amount, &per_weight_[a][f], &direction_[a][f], &image_[a][f]);
                        }).first;
    for_all_rows([&](std::size_t a, std::ptrdiff_t f, int count) {
      step_row(count, product / work, &direction_[a][f], &image_[a][f], &velocity[a][f], &residual_[a][f]);
    });
  }
}

}  // namespace talus::air

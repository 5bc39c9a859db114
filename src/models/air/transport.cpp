// SPDX-License-Identifier: Apache-2.0
#include "models/air/transport.hpp"

#include <cmath>

#include "base/clones.hpp"
#include "base/error.hpp"
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
  for (FaceField* field : {&residual_, &direction_, &image_, &preconditioned_})
    if (field->front().empty()) *field = grid.face_field();
  double own = 0;  // of the Laplacian and of the gradient of the divergence
  for (int axis = 0; axis < 3; ++axis) own += 2 / (grid.spacing[axis] * grid.spacing[axis]);
  const auto dot = [&](const FaceField& x, const FaceField& y) {
    double total = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const auto layers = static_cast<std::size_t>(passages_.faces(axis, 2));
      std::vector<double> partial(layers, 0.0);
      team.run(layers, [&](std::size_t k) {
        double sum = 0;
        for (int j = 0; j < passages_.faces(axis, 1); ++j) {
          const std::size_t first = grid.index(0, j, static_cast<int>(k));
          for (std::size_t f = first; f < first + static_cast<std::size_t>(passages_.faces(axis, 0)); ++f)
            sum += x[a][f] * y[a][f];
        }
        partial[k] = sum;
      });
      for (const double part : partial) total += part;
    }
    return total;
  };
  const auto for_all = [&](auto&& body) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      for_each_face(team, passages_, axis, [&](std::ptrdiff_t f) { body(a, static_cast<std::size_t>(f)); });
    }
  };
  const auto is_open = [&](std::size_t a, std::size_t f) { return passages_.open[a][f] > 0; };
  const auto wrap = [&](FaceField& field) {
    for (auto& component : field) passages_.wrap(component);
  };

  wrap(velocity);
  laplace(team, 1, velocity, image_);
  for_all([&](std::size_t a, std::size_t f) {
    residual_[a][f] = is_open(a, f) ? (start[a][f] - velocity[a][f]) / weight[a][f] + amount * image_[a][f] : 0;
    direction_[a][f] = 0;
    image_[a][f] = is_open(a, f) ? start[a][f] / weight[a][f] + amount * passages_.drive[a][f] : 0;
  });
  const double enough = tolerance * std::sqrt(dot(image_, image_));
  double before = 0;
  for (int iteration = 0;; ++iteration) {
    const double norm = std::sqrt(dot(residual_, residual_));
    if (norm <= enough) return iteration;
    if (iteration == most_iterations || !std::isfinite(norm))
      throw NumericalError({.what = "the implicit viscosity of the air has not converged",
                            .term = "viscous term of Eq. 18",
                            .place = "the whole grid",
                            .advice = "a shorter air.longest_step"});
    for_all([&](std::size_t a, std::size_t f) {
      const double third = 2 / (3 * grid.spacing[static_cast<int>(a)] * grid.spacing[static_cast<int>(a)]);
      preconditioned_[a][f] =
          is_open(a, f) ? residual_[a][f] / (1 / weight[a][f] + amount * (own + third + passages_.wall[a][f])) : 0;
    });
    const double product = dot(residual_, preconditioned_);
    const double turn = before > 0 ? product / before : 0;
    before = product;
    for_all([&](std::size_t a, std::size_t f) { direction_[a][f] = preconditioned_[a][f] + turn * direction_[a][f]; });
    wrap(direction_);
    laplace(team, 0, direction_, image_);
    for_all([&](std::size_t a, std::size_t f) {
      image_[a][f] = is_open(a, f) ? direction_[a][f] / weight[a][f] - amount * image_[a][f] : 0;
    });
    const double step = product / dot(direction_, image_);
    for_all([&](std::size_t a, std::size_t f) {
      velocity[a][f] += step * direction_[a][f];
      residual_[a][f] -= step * image_[a][f];
    });
  }
}

}  // namespace talus::air

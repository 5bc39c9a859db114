// SPDX-License-Identifier: Apache-2.0
#include "models/air/transport.hpp"

#include <cmath>

#include "base/error.hpp"
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

}  // namespace

Transport::Transport(const Passages& passages)
    : passages_(passages), flux_(passages.grid.cell_field()), divergence_(flux_) {}

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
    for_each_face(team, passages_, axis, [&](int, int, int, std::size_t f) { rate[a][f] = 0; });
    for (int second = 0; second < 3; ++second) {
      const auto b = static_cast<std::size_t>(second);
      const std::ptrdiff_t along = grid.stride(axis), across = grid.stride(second);
      const double* mass = stream.mass[b].data();
      const double* wide = passages_.wide[a][b].data();
      const double per_width = 1 / grid.spacing[second];
      // Flow of momentum between a face and the one before it.
      const auto flow = [&](std::ptrdiff_t f) {
        const double carrier = 0.5 * (mass[f] + mass[f - along]);
        return carrier * carried_velocity(u[f - 2 * across], u[f - across], u[f], u[f + across], wide[f],
                                          carrier > 0 ? 1.0 : -1.0, upwind);
      };
      for_each_face(team, passages_, axis, [&](int i, int j, int k, std::size_t face) {
        const auto f = static_cast<std::ptrdiff_t>(face);
        const int place = axis == 0 ? i : axis == 1 ? j : k;
        // The volume of a face at an open end is half a cell, from the end inwards.
        const bool at_end = second == axis && passages_.is_end(axis, place);
        double below, above, width = per_width;
        if (!at_end) {
          below = flow(f), above = flow(f + across);
        } else {
          const auto end = [&](double neighbour) { return mass[f] * 0.5 * (u[f] + neighbour); };
          below = place == 0 ? end(u[f - across]) : flow(f);
          above = place == 0 ? flow(f + across) : end(u[f + across]);
          width = 2 * per_width;
        }
        rate[a][face] -= width * (above - below);
      });
    }
  }
}

template <bool driven>
void Transport::laplace(ThreadTeam& team, const FaceField& velocity, FaceField& stress) {
  const Grid& grid = passages_.grid;
  const std::array<std::ptrdiff_t, 3> stride{grid.stride(0), grid.stride(1), grid.stride(2)};
  const Vector3 h = grid.spacing;
  const auto [nx, ny, nz] = grid.count;
  const double *u = velocity[0].data(), *v = velocity[1].data(), *w = velocity[2].data();
  const int rows = ny * nz, n = nx;
  team.run(static_cast<std::size_t>((rows + 15) / 16), [&](std::size_t block) {
    for (int row = static_cast<int>(block) * 16; row < std::min(static_cast<int>(block + 1) * 16, rows); ++row) {
      const std::size_t first = grid.index(0, row % grid.count[1], row / grid.count[1]);
      for (std::size_t c = first; c < first + static_cast<std::size_t>(n); ++c)
        divergence_[c] = passages_.inner[c] * ((u[c + 1] - u[c]) / h.x + (v[plus(c, stride[1])] - v[c]) / h.y +
                                               (w[plus(c, stride[2])] - w[c]) / h.z);
    }
  });
  passages_.wrap(divergence_);
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double* x = velocity[a].data();
    const double third = 1 / (3 * h[axis]);
    for_each_face(team, passages_, axis, [&](int, int, int, std::size_t face) {
      const auto f = static_cast<std::ptrdiff_t>(face);
      double sum = third * (divergence_[face] - divergence_[plus(face, -stride[a])]) - passages_.wall[a][face] * x[f];
      if constexpr (driven) sum += passages_.drive[a][face];
      for (std::size_t b = 0; b < 3; ++b) {
        const double* link = passages_.link[a][b].data();
        const std::ptrdiff_t s = stride[b];
        const double square = h[static_cast<int>(b)] * h[static_cast<int>(b)];
        sum += (link[f + s] * (x[f + s] - x[f]) - link[f] * (x[f] - x[f - s])) / square;
      }
      stress[a][face] = passages_.open[a][face] * sum;
    });
  }
}

void Transport::spread(ThreadTeam& team, const FaceField& velocity, FaceField& stress) {
  laplace<true>(team, velocity, stress);
}

int Transport::spread_implicitly(ThreadTeam& team, const FaceField& start, const FaceField& weight, double amount,
                                 FaceField& velocity) {
  constexpr int most_iterations = 500;
  constexpr double tolerance = 1e-9;
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
      for_each_face(team, passages_, axis, [&](int, int, int, std::size_t f) { body(a, f); });
    }
  };
  const auto is_open = [&](std::size_t a, std::size_t f) { return passages_.open[a][f] > 0; };
  const auto wrap = [&](FaceField& field) {
    for (auto& component : field) passages_.wrap(component);
  };

  wrap(velocity);
  laplace<true>(team, velocity, image_);
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
    laplace<false>(team, direction_, image_);
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

// SPDX-License-Identifier: Apache-2.0
#include "models/air/convection.hpp"

#include "base/clones.hpp"
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

// Loops over rows of faces: separate functions so that the compiler vectorises them.

/// A row of faces and what flows between them and those before them along a second axis.
struct FluxRow {
  const double* velocity;        ///< m/s
  const double* mass;            ///< through the faces of the second axis, kg/(m^2 s)
  const double* wide;            ///< 1 where four velocities may be used
  std::ptrdiff_t along, across;  ///< to the next face along the axis of the velocity, and along the second
};

/// What flows carry between the faces of a row and those before them.
TALUS_CLONES void find_fluxes_of_row(int count, double upwind, const FluxRow& given, double* __restrict flux) {
  const FluxRow row = given;
  const double* u = row.velocity;
  const std::ptrdiff_t across = row.across;
  for (int f = 0; f < count; ++f) {
    const double mass = 0.5 * (row.mass[f] + row.mass[f - row.along]);
    flux[f] = convected_momentum(mass, advected_velocity(u[f - 2 * across], u[f - across], u[f], u[f + across],
                                                         row.wide[f], mass > 0 ? 1.0 : -1.0, upwind));
  }
}

TALUS_CLONES void subtract_difference(std::ptrdiff_t count, double factor, const double* low, const double* high,
                                      double* __restrict out) {
  for (std::ptrdiff_t f = 0; f < count; ++f) out[f] -= factor * (high[f] - low[f]);
}

}  // namespace

Convection::Convection(const FaceApertures& apertures) : apertures_(apertures), flux_(apertures.grid.cell_field()) {}

void Convection::fill_ghosts(Stream& stream) const {
  const Grid& grid = apertures_.grid;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, 1}) {
      if (!apertures_.boundaries.is_open(axis, side)) continue;
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
  for (std::size_t a = 0; a < 3; ++a) apertures_.wrap(stream.velocity[a]), apertures_.wrap(stream.mass[a]);
}

void Convection::find_force(ThreadTeam& team, const Stream& stream, double upwind, FaceField& force) {
  const Grid& grid = apertures_.grid;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double* u = stream.velocity[a].data();
    double* out = force[a].data();
    for_each_face(team, apertures_, axis, [&](std::ptrdiff_t f) { out[f] = 0; });
    for (int second = 0; second < 3; ++second) {
      const auto b = static_cast<std::size_t>(second);
      const std::ptrdiff_t across = grid.stride(second);
      const double* mass = stream.mass[b].data();
      find_fluxes(team, stream, axis, second, upwind);
      const double* flux = flux_.data();
      const double per_width = 1 / grid.spacing[second];
      for_each_run(team, apertures_, axis, [&](const FaceRun& run) {
        if (second != axis || !run.is_end)
          return subtract_difference(run.end - run.begin, per_width, flux + run.begin, flux + run.begin + across,
                                     out + run.begin);
        // The volume of a face at an open end is half a cell, from the end inwards.
        const std::ptrdiff_t outward = run.place == 0 ? -across : across, inward = run.place == 0 ? across : 0;
        const double factor = (run.place == 0 ? 2 : -2) * per_width;
        for (auto f = run.begin; f < run.end; ++f)
          out[f] -= factor * (flux[f + inward] - convected_momentum(mass[f], 0.5 * (u[f] + u[f + outward])));
      });
    }
  }
}

/// The flow of momentum along an axis between each of its faces and the one before it along a second axis; for the
/// last within the box that to the one beyond, too.
void Convection::find_fluxes(ThreadTeam& team, const Stream& stream, int axis, int second, double upwind) {
  const auto a = static_cast<std::size_t>(axis), b = static_cast<std::size_t>(second);
  const Grid& grid = apertures_.grid;
  std::array<int, 3> count = apertures_.faces(axis);
  count[b] = grid.count[b] + 1;
  for_each_row(team, grid, count, [&](int, int, std::ptrdiff_t begin, std::ptrdiff_t) {
    find_fluxes_of_row(count[0], upwind,
                       {.velocity = stream.velocity[a].data() + begin,
                        .mass = stream.mass[b].data() + begin,
                        .wide = apertures_.wide[a][b].data() + begin,
                        .along = grid.stride(axis),
                        .across = grid.stride(second)},
                       flux_.data() + begin);
  });
}

}  // namespace talus::air

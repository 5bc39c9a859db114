// SPDX-License-Identifier: Apache-2.0
#include "models/air/convection.hpp"

#include <algorithm>

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

/// A row of faces and what flows between them and those beside them along a second axis.
struct ForceRow {
  const double* velocity;        ///< m/s
  const double* mass;            ///< through the faces of the second axis, kg/(m^2 s)
  const double* wide;            ///< 1 where four velocities may be used
  std::ptrdiff_t along, across;  ///< to the next face along the axis of the velocity, and along the second
};

/// force -= per_width times the difference of what flows carry to the next face and from the one before.
TALUS_CLONES void subtract_difference(std::ptrdiff_t count, double per_width, double upwind, const ForceRow& given,
                                      double* __restrict force) {
  const ForceRow row = given;
  const std::ptrdiff_t along = row.along, across = row.across;
  const double *u = row.velocity, *u_ll = u - 2 * across, *u_l = u - across, *u_r = u + across, *u_rr = u + 2 * across;
  const double *mass = row.mass, *mass_low = mass - along, *mass_r = mass + across, *mass_low_r = mass_r - along;
  const double *wide = row.wide, *wide_r = wide + across;
  for (std::ptrdiff_t f = 0; f < count; ++f) {
    const double in = 0.5 * (mass[f] + mass_low[f]), out = 0.5 * (mass_r[f] + mass_low_r[f]);
    const double low =
        convected_momentum(in, advected_velocity(u_ll[f], u_l[f], u[f], u_r[f], wide[f], in > 0 ? 1.0 : -1.0, upwind));
    const double high = convected_momentum(
        out, advected_velocity(u_l[f], u[f], u_r[f], u_rr[f], wide_r[f], out > 0 ? 1.0 : -1.0, upwind));
    force[f] -= per_width * (high - low);
  }
}

}  // namespace

Convection::Convection(const FaceApertures& apertures) : apertures_(apertures) {}

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

void Convection::find_force_of_row(const Stream& stream, int axis, int j, int k, std::ptrdiff_t begin, double upwind,
                                   FaceField& force) const {
  const Grid& grid = apertures_.grid;
  const auto a = static_cast<std::size_t>(axis);
  const int count = apertures_.faces(axis)[0];
  const double* u = stream.velocity[a].data();
  const std::ptrdiff_t along = grid.stride(axis);
  const auto find = [&](std::ptrdiff_t from, std::ptrdiff_t to, bool at_end) {
    double* out = force[a].data();
    std::fill(out + from, out + to, 0.0);
    for (int second = 0; second < 3; ++second) {
      if (second == axis && at_end) continue;
      const auto b = static_cast<std::size_t>(second);
      subtract_difference(to - from, 1 / grid.spacing[second], upwind,
                          {.velocity = u + from,
                           .mass = stream.mass[b].data() + from,
                           .wide = apertures_.wide[a][b].data() + from,
                           .along = along,
                           .across = grid.stride(second)},
                          out + from);
    }
  };
  // The volume of a face at an open end is half a cell, from the end inwards.
  const auto find_at_end = [&](std::ptrdiff_t from, std::ptrdiff_t to, int place) {
    find(from, to, true);
    const std::ptrdiff_t outward = place == 0 ? -along : along, inward = place == 0 ? along : 0;
    const double factor = (place == 0 ? 2 : -2) / grid.spacing[axis];
    const double *mass = stream.mass[a].data(), *wide = apertures_.wide[a][a].data();
    double* out = force[a].data();
    for (auto f = from; f < to; ++f) {
      const auto at = f + inward;
      const double through = 0.5 * (mass[at] + mass[at - along]);
      const double flux =
          convected_momentum(through, advected_velocity(u[at - 2 * along], u[at - along], u[at], u[at + along],
                                                        wide[at], through > 0 ? 1.0 : -1.0, upwind));
      out[f] -= factor * (flux - convected_momentum(mass[f], 0.5 * (u[f] + u[f + outward])));
    }
  };
  if (axis > 0) {
    const int place = axis == 1 ? j : k;
    return apertures_.is_end(axis, place) ? find_at_end(begin, begin + count, place)
                                          : find(begin, begin + count, false);
  }
  const std::ptrdiff_t end = begin + count, skipped = apertures_.is_end(0, 0) ? 1 : 0;
  if (skipped == 1) find_at_end(begin, begin + 1, 0), find_at_end(end - 1, end, count - 1);
  find(begin + skipped, end - skipped, false);
}

}  // namespace talus::air

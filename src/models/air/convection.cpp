// SPDX-License-Identifier: Apache-2.0
#include "models/air/convection.hpp"

#include <algorithm>
#include <utility>

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

/// A row of faces and what flows between them and their neighbours along a second axis.
struct FluxRow {
  const double* velocity;        ///< m/s
  const double* mass;            ///< through the faces of the second axis, kg/(m^2 s)
  const double* wide;            ///< 1 where four velocities may be used
  std::ptrdiff_t along, across;  ///< to the next face along the axis of the velocity, and along the second
};

/// What flows carry to each face from the one before it along the second axis, N/m^2.
TALUS_CLONES void find_fluxes(std::ptrdiff_t count, double upwind, const FluxRow& given, double* __restrict flux) {
  const FluxRow row = given;
  const double *u = row.velocity, *u_ll = u - 2 * row.across, *u_l = u - row.across, *u_r = u + row.across;
  const double *mass = row.mass, *mass_low = mass - row.along, *wide = row.wide;
  for (std::ptrdiff_t f = 0; f < count; ++f) {
    const double in = 0.5 * (mass[f] + mass_low[f]);
    flux[f] =
        convected_momentum(in, advected_velocity(u_ll[f], u_l[f], u[f], u_r[f], wide[f], in > 0 ? 1.0 : -1.0, upwind));
  }
}

/// force -= per_width times the difference of what flows to the next face and from the one before.
TALUS_CLONES void subtract_difference(std::ptrdiff_t count, double per_width, const double* in, const double* out,
                                      double* __restrict force) {
  for (std::ptrdiff_t f = 0; f < count; ++f) force[f] -= per_width * (out[f] - in[f]);
}

/// The same of all three axes, where force is 0.
TALUS_CLONES void subtract_differences(std::ptrdiff_t count, const Vector3& per_width, const double* x,
                                       const double* y_in, const double* y_out, const double* z_in, const double* z_out,
                                       double* __restrict force) {
  const Vector3 per = per_width;
  for (std::ptrdiff_t f = 0; f < count; ++f)
    force[f] = 0 - per.x * (x[f + 1] - x[f]) - per.y * (y_out[f] - y_in[f]) - per.z * (z_out[f] - z_in[f]);
}

}  // namespace

Convection::Convection(const FaceApertures& apertures) : apertures_(apertures) {}

void Convection::fill_ghosts(Stream& stream, double upwind) const {
  const Grid& grid = apertures_.grid;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, 1}) {
      const int n = grid.count[static_cast<std::size_t>(axis)];
      const std::ptrdiff_t outward = side == 0 ? -grid.stride(axis) : grid.stride(axis);
      if (apertures_.boundaries.kind[static_cast<std::size_t>(2 * axis + side)] == FlowBoundary::inflow)
        for (int component = 0; component < 3; ++component)  // what comes in brings no velocity along the face
          if (auto& u = stream.velocity[static_cast<std::size_t>(component)]; component != axis)
            for_each_in_layer(grid, axis, side == 0 ? 0 : n - 1,
                              [&](std::size_t c) { u[plus(c, outward)] = -(1 - upwind) / (1 + upwind) * u[c]; });
      if (!apertures_.boundaries.is_open(axis, side)) continue;
      const auto& through = stream.mass[static_cast<std::size_t>(axis)];
      for (int component = 0; component < 3; ++component) {
        const auto a = static_cast<std::size_t>(component);
        const int inside = side == 0 ? 0 : component == axis ? n : n - 1;
        const std::ptrdiff_t to_face = component == axis || side == 0 ? 0 : grid.stride(axis);
        const std::ptrdiff_t back = component == axis ? 0 : -grid.stride(component);
        for_each_in_layer(grid, axis, inside, [&](std::size_t c) {
          const std::size_t face = plus(c, to_face);
          // The flow through the end of the box next to this velocity, outward positive.
          const double outflow = (side == 0 ? -1 : 1) * (through[face] + through[plus(face, back)]);
          stream.mass[a][plus(c, outward)] = stream.mass[a][c];
          stream.velocity[a][plus(c, outward)] = outflow > 0 ? stream.velocity[a][c] : 0;
        });
      }
    }
  for (std::size_t a = 0; a < 3; ++a) apertures_.wrap(stream.velocity[a]), apertures_.wrap(stream.mass[a]);
}

Convection::Rows::Rows(const FaceApertures& apertures, const Stream& stream, int axis, double upwind)
    : apertures_(apertures), stream_(stream), axis_(axis), upwind_(upwind) {
  const std::array<int, 3> faces = apertures.faces(axis);
  const auto count = static_cast<std::size_t>(faces[0]);
  force_.resize(count), along_x_.flux.resize(count + 1);
  along_z_.resize(static_cast<std::size_t>(faces[1]));
  for (Fluxes& kept : along_y_) kept.flux.resize(count);
  for (auto& pair : along_z_)
    for (Fluxes& kept : pair) kept.flux.resize(count);
}

const double* Convection::Rows::fluxes(Fluxes& kept, int second, std::size_t row, std::ptrdiff_t begin,
                                       int count) const {
  if (kept.begin != begin) {
    const auto a = static_cast<std::size_t>(axis_), b = static_cast<std::size_t>(second);
    find_fluxes(count, upwind_,
                {.velocity = stream_.velocity[a].data() + begin,
                 .mass = stream_.mass[b].data() + begin,
                 .wide = apertures_.rows.wide[a][b].at(row),
                 .along = apertures_.grid.stride(axis_),
                 .across = apertures_.grid.stride(second)},
                kept.flux.data());
    kept.begin = begin;
  }
  return kept.flux.data();
}

const double* Convection::Rows::force(int j, int k, std::ptrdiff_t begin) {
  const Grid& grid = apertures_.grid;
  const int count = apertures_.faces(axis_)[0];
  const std::size_t row = grid.row(j, k);
  const int index = axis_ == 1 ? j : k;
  const bool is_end = axis_ > 0 && apertures_.is_end(axis_, index);
  const double* x = fluxes(along_x_, 0, row, begin, count + 1);
  // The fluxes to the next row are those from the one before it, when its turn comes.
  const auto two = [&](std::array<Fluxes, 2>& kept, int second) -> std::array<const double*, 2> {
    if (is_end && second == axis_) return {};
    if (kept[1].begin == begin) std::swap(kept[0], kept[1]);
    return {fluxes(kept[0], second, row, begin, count),
            fluxes(kept[1], second, row + grid.row_stride(second), begin + grid.stride(second), count)};
  };
  const std::array<const double*, 2> y = two(along_y_, 1);
  const std::array<const double*, 2> z = two(along_z_[static_cast<std::size_t>(j)], 2);
  const Vector3 per_width{1 / grid.spacing.x, 1 / grid.spacing.y, 1 / grid.spacing.z};
  double* force = force_.data();
  if (!is_end) subtract_differences(count, per_width, x, y[0], y[1], z[0], z[1], force);
  // At an end of the box the fluxes along its axis are others.
  const auto along_others = [&](int from, int to) {
    std::fill(force + from, force + to, 0.0);
    if (axis_ != 0) subtract_difference(to - from, per_width.x, x + from, x + from + 1, force + from);
    if (axis_ != 1) subtract_difference(to - from, per_width.y, y[0] + from, y[1] + from, force + from);
    if (axis_ != 2) subtract_difference(to - from, per_width.z, z[0] + from, z[1] + from, force + from);
  };
  const auto at_end = [&](int from, int to, int end) {
    along_others(from, to);
    find_force_at_end(end, begin + from, to - from, force + from);
  };
  if (is_end) at_end(0, count, index);
  if (axis_ == 0 && apertures_.is_end(0, 0)) at_end(0, 1, 0), at_end(count - 1, count, count - 1);
  return force;
}

/// The volume of a face at an open end is half a cell, from the end inwards.
void Convection::Rows::find_force_at_end(int index, std::ptrdiff_t from, int count, double* force) const {
  const Grid& grid = apertures_.grid;
  const auto a = static_cast<std::size_t>(axis_);
  const std::ptrdiff_t along = grid.stride(axis_);
  const double *u = stream_.velocity[a].data(), *mass = stream_.mass[a].data(), *wide = apertures_.wide[a][a].data();
  const std::ptrdiff_t outward = index == 0 ? -along : along, inward = index == 0 ? along : 0;
  const double factor = (index == 0 ? 2 : -2) / grid.spacing[axis_];
  for (auto f = from; f < from + count; ++f, ++force) {
    const auto at = f + inward;
    const double through = 0.5 * (mass[at] + mass[at - along]);
    const double flux =
        convected_momentum(through, advected_velocity(u[at - 2 * along], u[at - along], u[at], u[at + along], wide[at],
                                                      through > 0 ? 1.0 : -1.0, upwind_));
    *force -= factor * (flux - convected_momentum(mass[f], 0.5 * (u[f] + u[f + outward])));
  }
}

}  // namespace talus::air

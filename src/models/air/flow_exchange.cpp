// SPDX-License-Identifier: Apache-2.0
/// The end of a step of the air: what the pressure does to its velocity, and what air and grains exchange.
#include <algorithm>
#include <array>

#include "models/air/flow.hpp"
#include "numerics/grid/loops.hpp"

namespace talus::air {

/// A row of faces at the end of the step.
struct AirFlow::Finished {
  std::ptrdiff_t begin = -1;               // of the row
  std::vector<double> velocity, momentum;  // of the air
  std::vector<double> received, drag;      // of finish_row

  explicit Finished(std::size_t count) : velocity(count), momentum(count), received(count), drag(count) {}
};

/// The row that begins at `begin`, unless `kept` has it.
/// \param state with the momentum at the start of the step and the pressure of the step, ghosts included
const AirFlow::Finished& AirFlow::finish_faces(Finished& kept, double dt, const AirState& state, int axis,
                                               std::size_t row, std::ptrdiff_t begin, int count) const {
  if (kept.begin == begin) return kept;
  kept.begin = begin;
  const auto a = static_cast<std::size_t>(axis);
  const DistinctRows& open = apertures_.rows.open[a];
  if (open.is_zero(row)) {
    for (auto* column : {&kept.velocity, &kept.momentum, &kept.received, &kept.drag})
      std::fill(column->begin(), column->end(), 0.0);
    return kept;
  }
  const Grid& grid = apertures_.grid;
  const double rho = parameters_.density();
  const auto from = [&](const FaceField& field) { return field[a].data() + begin; };
  const double* high = state.pressure.data() + begin;
  finish_row(count, dt, rho, dt / (rho * grid.spacing[axis]), grains_share(), grains_share() / grid.spacing[axis],
             {.open = open.at(row),
              .void_fraction = from(void_fraction_),
              .solid_fraction = from(solid_fraction_),
              .grain_velocity = from(grain_velocity_),
              .momentum = from(state.momentum),
              .decay = from(decay_),
              .mean = from(mean_),
              .after_drag = from(after_drag_),
              .velocity = from(stream_.velocity),
              .low = high - grid.stride(axis),
              .high = high},
             kept.velocity.data(), kept.momentum.data(), kept.received.data(), kept.drag.data());
  return kept;
}

/// The pressure acts on the velocity; its momentum, in `stream_`; and the impulse of the drag, and in model A of the
/// pressure, on the solid, per solid volume: first on faces, then as the mean in cells, so that it is distributed to
/// the particles with the weights by which their volume was deposited.
void AirFlow::finish(ThreadTeam& team, double dt, AirState& state, FaceField& impulse) {
  const Grid& grid = apertures_.grid;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const int count = apertures_.faces(axis, 0), n = grid.count[a];
    const bool ring = apertures_.boundaries.is_periodic(axis);
    // Two rows of faces for each row of cells of a plane along y: those below and above are the same for the next.
    const auto make = [&] {
      const std::array<Finished, 2> pair{Finished(static_cast<std::size_t>(count + 1)),
                                         Finished(static_cast<std::size_t>(count + 1))};
      return std::vector<std::array<Finished, 2>>(axis == 2 ? static_cast<std::size_t>(grid.count[1]) : 1, pair);
    };
    for_each_row(
        team, grid, grid.count, part_.own, make,
        [&](auto& kept, int j, int k, std::ptrdiff_t begin, std::ptrdiff_t end) {
          auto& [low, high] = kept[axis == 2 ? static_cast<std::size_t>(j) : 0];
          const std::size_t row = grid.row(j, k);
          const auto put = [&](const Finished& faces) {
            std::copy_n(faces.velocity.begin(), count, state.velocity[a].data() + faces.begin);
            std::copy_n(faces.momentum.begin(), count, stream_.mass[a].data() + faces.begin);
          };
          const auto average = [&](const Finished& below, const Finished& above, std::ptrdiff_t step) {
            average_row(end - begin, below.received.data(), above.received.data() + step, impulse[a].data() + begin);
            average_row(end - begin, below.drag.data(), above.drag.data() + step, state.drag[a].data() + begin);
          };
          if (high.begin == begin) std::swap(low, high);
          finish_faces(low, dt, state, axis, row, begin, count);
          put(low);
          if (axis == 0) {
            if (ring) low.received[static_cast<std::size_t>(n)] = low.received[0];
            if (ring) low.drag[static_cast<std::size_t>(n)] = low.drag[0];
            return average(low, low, 1);
          }
          const bool is_last = (axis == 1 ? j : k) == n - 1;
          const std::size_t rows = grid.row_stride(axis);
          const std::ptrdiff_t stride = grid.stride(axis);
          if (is_last && ring)
            finish_faces(high, dt, state, axis, row - rows * static_cast<std::size_t>(n - 1), begin - stride * (n - 1),
                         count);
          else
            finish_faces(high, dt, state, axis, row + rows, begin + stride, count);
          if (is_last && !ring) put(high);
          average(low, high, 0);
        });
  }
}

}  // namespace talus::air

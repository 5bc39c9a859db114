// SPDX-License-Identifier: Apache-2.0
#include "models/air/flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "models/air/flow_rows.hpp"
#include "numerics/grid/loops.hpp"
#include "physics/air/momentum.hpp"

namespace talus::air {

namespace {

std::array<bool, 3> periodic_axes(const FlowBoundaries& boundaries) {
  return {boundaries.is_periodic(0), boundaries.is_periodic(1), boundaries.is_periodic(2)};
}

/// Largest value(index) over the cells, at least 0.
template <class Value>
double largest(ThreadTeam& team, const Grid& grid, Value&& value) {
  const int ny = grid.count[1], rows = ny * grid.count[2];
  return reduce(
      team, static_cast<std::size_t>(rows), 0.0,
      [&](std::size_t row) {
        const auto begin =
            static_cast<std::ptrdiff_t>(grid.index(0, static_cast<int>(row) % ny, static_cast<int>(row) / ny));
        double most = 0;
        for (auto c = begin; c < begin + grid.count[0]; ++c) most = std::max(most, value(c));
        return most;
      },
      [](double a, double b) { return std::max(a, b); });
}

}  // namespace

AirFlow::AirFlow(const Grid& grid, const Parameters& parameters, const std::vector<Plate>& plates,
                 const std::vector<Panel>& panels)
    : parameters_(parameters),
      passages_(grid, parameters.boundaries, plates, panels),
      transport_(passages_),
      solver_(grid, periodic_axes(parameters.boundaries)),
      drag_(grid.cell_field()),
      source_(drag_),
      guess_(drag_) {
  for (FaceField* field : {&void_fraction_, &solid_, &grain_velocity_, &decay_, &pull_, &base_, &rate_, &stress_,
                           &conductance_, &stream_.velocity, &stream_.mass})
    *field = grid.face_field();
}

void AirFlow::set_walls(const std::vector<Plate>& plates, const std::vector<Panel>& panels) {
  passages_ = Passages(passages_.grid, parameters_.boundaries, plates, panels);
}

/// Void fraction, solid fraction and grains' velocity on the faces: means of the two cells, of the one within at an
/// end.
void AirFlow::take_solids(ThreadTeam& team, const Solids& solids) {
  const Grid& grid = passages_.grid;
  const double* fraction = solids.fraction.data();
  for_each_cell(team, grid, [&](int i, int j, int k, std::ptrdiff_t c) {
    const double s = fraction[c];
    if (s >= 0 && s < 1) return;
    const Vector3 x = grid.centre(i, j, k);
    throw NumericalError(
        {.what = fmt::format("the solid fraction is {:.4g}", s),
         .term = "void fraction of Eq. 18",
         .place = fmt::format("cell ({}, {}, {}) at ({:.4g}, {:.4g}, {:.4g}) m", i, j, k, x.x, x.y, x.z),
         .advice = "a stiffer law of the grains, or air cells no smaller than the grains' spacing"});
  });
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double* flux = solids.flux[a].data();
    double *solid = solid_[a].data(), *gap = void_fraction_[a].data(), *velocity = grain_velocity_[a].data();
    for_each_run(team, passages_, axis, [&](const FaceRun& run) {
      for (auto f = run.begin; f < run.end; ++f) {
        const double s = 0.5 * (fraction[f + run.before] + fraction[f + run.here]);
        const double through = 0.5 * (flux[f + run.before] + flux[f + run.here]);
        solid[f] = s, gap[f] = 1 - s;
        velocity[f] = s > 0 ? through / s : 0;
      }
    });
  }
}

/// beta of the cells, at the slip in their centres.
void AirFlow::measure_drag(ThreadTeam& team, const Solids& solids, const FaceField& velocity) {
  const Grid& grid = passages_.grid;
  const coupling::DragMedium medium = parameters_.medium();
  for_each_cell(team, grid, [&](int, int, int, std::ptrdiff_t place) {
    const auto c = static_cast<std::size_t>(place);
    const double s = solids.fraction[c];
    if (s <= 0) {
      drag_[c] = 0;
      return;
    }
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const double u = 0.5 * (velocity[a][c] + velocity[a][c + static_cast<std::size_t>(grid.stride(axis))]);
      const double slip = u - solids.flux[a][c] / s;
      square += slip * slip;
    }
    drag_[c] = coupling::drag_coefficient(parameters_.drag, medium, s, std::sqrt(square));
  });
}

/// Fills the ghosts of a pressure so that its difference across every face of the box, over the distance of two
/// centres, is the gradient there: to an end of the box the way is half as long.
void AirFlow::close(CellField& pressure) const {
  const Grid& grid = passages_.grid;
  passages_.wrap(pressure);
  for (int axis = 0; axis < 3; ++axis) {
    if (passages_.boundaries.is_periodic(axis)) continue;
    for (const int side : {0, 1}) {
      std::array<int, 3> layer = grid.count;
      layer[static_cast<std::size_t>(axis)] = 1;
      const int n = grid.count[static_cast<std::size_t>(axis)];
      const std::ptrdiff_t within = side == 0 ? 0 : (n - 1) * grid.stride(axis);
      const std::ptrdiff_t beyond = side == 0 ? -grid.stride(axis) : n * grid.stride(axis);
      const double outside = passages_.boundaries.pressure[static_cast<std::size_t>(2 * axis + side)];
      for (int k = 0; k < layer[2]; ++k)
        for (int j = 0; j < layer[1]; ++j)
          for (int i = 0; i < layer[0]; ++i) {
            double* p = pressure.data() + grid.index(i, j, k);
            p[beyond] = 2 * outside - p[within];
          }
    }
  }
}

/// From the momentum at the start of the step: velocity and pressure after dt, under the convection and viscosity of
/// `stream`, which is overwritten.
void AirFlow::stage(ThreadTeam& team, double dt, Stream& stream, const AirState& start, CellField& pressure) {
  const Grid& grid = passages_.grid;
  const double rho = parameters_.density();
  transport_.close(stream);
  transport_.convect(team, stream, parameters_.upwind, rate_);
  if (implicit_)
    before_ = stream.velocity;
  else
    transport_.spread(team, stream.velocity, stress_);
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double area_over_way = grid.face_area(axis) / grid.spacing[axis];
    const double viscosity = implicit_ ? 0 : parameters_.viscosity;
    const double *phi = void_fraction_[a].data(), *drag = drag_.data();
    double *decay = decay_[a].data(), *pull = pull_[a].data();
    for_each_run(team, passages_, axis, [&](const FaceRun& run) {
      for (auto f = run.begin; f < run.end; ++f) {
        const double between = 0.5 * (drag[f + run.before] + drag[f + run.here]);
        const coupling::SlipDecay slip =
            between > 0 ? coupling::slip_decay(between * dt / (rho * phi[f])) : coupling::SlipDecay{1, 1};
        decay[f] = slip.decay, pull[f] = slip.pull;
      }
      const auto from = [&](auto& field) { return field[a].data() + run.begin; };
      move_row(run.end - run.begin, dt, rho, viscosity, grains_share(), (run.is_end ? 2 : 1) * dt / rho * area_over_way,
               {from(passages_.open), from(void_fraction_), from(start.momentum), from(grain_velocity_), from(rate_),
                from(stress_), from(decay_), from(pull_)},
               from(base_), from(stream.velocity), from(conductance_));
    });
  }
  // Pressure's share of the velocity over dt.
  const auto press = [&](double share) {
    close(pressure);
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const double factor = share * dt / (rho * grid.spacing[axis]);
      for_each_row(team, grid, passages_.faces(axis), [&](int, int, std::ptrdiff_t begin, std::ptrdiff_t end) {
        const double* above = pressure.data() + begin;
        press_row(end - begin, factor, grains_share(), passages_.open[a].data() + begin,
                  void_fraction_[a].data() + begin, pull_[a].data() + begin, above - grid.stride(axis), above,
                  stream.velocity[a].data() + begin);
      });
    }
  };
  if (implicit_) {
    // With the guessed pressure at work: viscosity then meets the velocity to come, and a steady flow is exact.
    press(1);
    stress_ = stream.velocity;
    stream.velocity = before_;  // nearer to what comes than what viscosity has not met
    transport_.spread_implicitly(team, stress_, pull_, parameters_.viscosity / rho * dt, stream.velocity);
    press(-1);
  }
  project(team, stream, pressure);
  press(1);
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double *phi = void_fraction_[a].data(), *velocity = stream.velocity[a].data();
    double* mass = stream.mass[a].data();
    for_each_face(team, passages_, axis, [&](std::ptrdiff_t f) { mass[f] = rho * phi[f] * velocity[f]; });
  }
}

/// The volume flow through every face: of the mixture, or of the air.
void AirFlow::find_volume_flow(ThreadTeam& team, const FaceField& velocity, FaceField& flow) const {
  const double carried = parameters_.continuity == Continuity::mixture;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    for_each_row(team, passages_.grid, passages_.faces(axis), [&](int, int, std::ptrdiff_t begin, std::ptrdiff_t end) {
      const auto from = [&](const FaceField& field) { return field[a].data() + begin; };
      find_volume_flow_of_row(end - begin, carried, from(passages_.open), from(void_fraction_), from(velocity),
                              from(solid_), from(grain_velocity_), flow[a].data() + begin);
    });
    passages_.wrap(flow[a]);
  }
}

/// The pressure that takes the divergence from the volume flow of a stream that has not felt it yet.
void AirFlow::project(ThreadTeam& team, const Stream& stream, CellField& pressure) {
  const Grid& grid = passages_.grid;
  find_volume_flow(team, stream.velocity, rate_);
  for (auto& conductance : conductance_) passages_.wrap(conductance);
  const double *x = rate_[0].data(), *y = rate_[1].data(), *z = rate_[2].data();
  const Vector3 area{grid.face_area(0), grid.face_area(1), grid.face_area(2)};
  double* source = source_.data();
  for_each_row(team, grid, grid.count, [&](int, int, std::ptrdiff_t begin, std::ptrdiff_t) {
    find_source_of_row(grid.count[0], grid.stride(1), grid.stride(2), area, x + begin, y + begin, z + begin,
                       source + begin);
  });
  for (int axis = 0; axis < 3; ++axis)
    for_each_run(team, passages_, axis, [&](const FaceRun& run) {
      if (!run.is_end) return;
      const auto a = static_cast<std::size_t>(axis);
      const double outside = passages_.boundaries.pressure[2 * a + (run.place == 0 ? 0 : 1)];
      for (auto f = run.begin; f < run.end; ++f) source[f + run.here] += conductance_[a][f] * outside;
    });
  solver_.set_conductance(team, conductance_);
  // No smaller than what rounding leaves of the flows that the sources are differences of.
  const double flow = largest(team, grid, [&](std::ptrdiff_t c) {
    return std::abs(x[c]) * area.x + std::abs(y[c]) * area.y + std::abs(z[c]) * area.z;
  });
  const double rounding = 1e-15 * flow * std::sqrt(static_cast<double>(grid.cells()));
  iterations_ += solver_
                     .solve(team, source_, pressure,
                            {.tolerance = parameters_.tolerance,
                             .absolute = rounding,
                             .most_iterations = static_cast<int>(parameters_.most_iterations)})
                     .iterations;
}

/// What the air lost to drag, and in model A what the pressure does to the solid, over its volume: first on the faces,
/// then as the cells' means, so that it is handed out with the weights by which the solids were gathered.
/// \param velocity at the end of the step; the state's momentum is that of its start, its pressure the step's
void AirFlow::hand_over(ThreadTeam& team, double dt, const FaceField& velocity, AirState& state, FaceField& impulse) {
  const Grid& grid = passages_.grid;
  const double rho = parameters_.density();
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const std::ptrdiff_t stride = grid.stride(axis);
    for_each_row(team, grid, passages_.faces(axis), [&](int, int, std::ptrdiff_t begin, std::ptrdiff_t end) {
      const auto from = [&](const FaceField& field) { return field[a].data() + begin; };
      const double* above = state.pressure.data() + begin;
      hand_over_row(end - begin, dt, rho, grains_share() / grid.spacing[axis],
                    {from(passages_.open), from(solid_), from(void_fraction_), from(grain_velocity_), from(velocity),
                     from(state.momentum), from(decay_), from(pull_), from(base_), above - stride, above},
                    rate_[a].data() + begin, stress_[a].data() + begin);
    });
    passages_.wrap(rate_[a]);
    passages_.wrap(stress_[a]);
    for_each_row(team, grid, grid.count, [&](int, int, std::ptrdiff_t begin, std::ptrdiff_t end) {
      const double *received = rate_[a].data() + begin, *drag = stress_[a].data() + begin;
      average_row(end - begin, received, received + stride, impulse[a].data() + begin);
      average_row(end - begin, drag, drag + stride, state.drag[a].data() + begin);
    });
  }
}

void AirFlow::begin(ThreadTeam& team, const Solids& solids, AirState& state) {
  take_solids(team, solids);
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    for_each_face(team, passages_, axis, [&](std::ptrdiff_t face) {
      const auto f = static_cast<std::size_t>(face);
      state.velocity[a][f] *= passages_.open[a][f];
      state.momentum[a][f] = parameters_.density() * void_fraction_[a][f] * state.velocity[a][f];
    });
    passages_.wrap(state.velocity[a]);
    passages_.wrap(state.momentum[a]);
  }
}

double AirFlow::time_step(ThreadTeam& team, const Solids& solids, const AirState& state) {
  const Grid& grid = passages_.grid;
  measure_drag(team, solids, state.velocity);
  const auto fastest = [&](int axis, std::ptrdiff_t c) {
    const double* u = state.velocity[static_cast<std::size_t>(axis)].data();
    return std::max(std::abs(u[c]), std::abs(u[c + grid.stride(axis)])) / grid.spacing[axis];
  };
  const double moved =
      largest(team, grid, [&](std::ptrdiff_t c) { return fastest(0, c) + fastest(1, c) + fastest(2, c); });
  // A bed that dilates draws air through its pores; the pressure that this takes stops it at the rate
  // beta/(Phi^2 rho_b), whatever the wave length.
  const double* fraction = solids.fraction.data();
  const double response = largest(team, grid, [&](std::ptrdiff_t c) {
    const double phi = 1 - fraction[c];
    return fraction[c] > 0 ? drag_[c] / (phi * phi * fraction[c] * parameters_.grain_density) : 0;
  });
  double dt = parameters_.longest_step;
  if (moved > 0) dt = std::min(dt, parameters_.courant / moved);
  if (response > 0) dt = std::min(dt, parameters_.response / response);
  return dt;
}

void AirFlow::advance(ThreadTeam& team, double dt, const Solids& solids, AirState& state, FaceField& impulse) {
  const Grid& grid = passages_.grid;
  if (parameters_.motion == Motion::frozen) {
    measure_drag(team, solids, state.velocity);
    for_each_cell(team, grid, [&](int, int, int, std::ptrdiff_t place) {
      const auto c = static_cast<std::size_t>(place);
      const double s = solids.fraction[c];
      for (std::size_t a = 0; a < 3; ++a) {
        state.drag[a][c] = s > 0 ? -drag_[c] * solids.flux[a][c] / s : 0;
        impulse[a][c] = s > 0 ? dt * state.drag[a][c] / s : 0;
      }
    });
    return;
  }
  double stiffness = 0;  // of the Laplacian, 1/m^2
  for (int axis = 0; axis < 3; ++axis) stiffness += 4 / (grid.spacing[axis] * grid.spacing[axis]);
  implicit_ = dt * parameters_.viscosity / parameters_.density() * stiffness > 1;
  iterations_ = 0;
  take_solids(team, solids);

  stream_.velocity = state.velocity, stream_.mass = state.momentum;
  measure_drag(team, solids, stream_.velocity);
  guess_ = state.pressure;
  stage(team, 0.5 * dt, stream_, state, guess_);
  for (std::size_t a = 0; a < 3; ++a) passages_.wrap(stream_.velocity[a]);
  measure_drag(team, solids, stream_.velocity);
  state.pressure = guess_;
  stage(team, dt, stream_, state, state.pressure);
  hand_over(team, dt, stream_.velocity, state, impulse);
  for (std::size_t a = 0; a < 3; ++a) {
    passages_.wrap(stream_.velocity[a]), passages_.wrap(stream_.mass[a]);
    std::swap(state.velocity[a], stream_.velocity[a]), std::swap(state.momentum[a], stream_.mass[a]);
  }
}

Vector3 AirFlow::momentum(const AirState& state) const {
  Vector3 total;
  const Grid& grid = passages_.grid;
  for (int axis = 0; axis < 3; ++axis)
    for (int k = 0; k < passages_.faces(axis, 2); ++k)
      for (int j = 0; j < passages_.faces(axis, 1); ++j)
        for (int i = 0; i < passages_.faces(axis, 0); ++i) {
          const int place = axis == 0 ? i : axis == 1 ? j : k;
          total[axis] += state.momentum[static_cast<std::size_t>(axis)][grid.index(i, j, k)] * grid.volume() *
                         (passages_.is_end(axis, place) ? 0.5 : 1);
        }
  return total;
}

double AirFlow::largest_divergence(const Solids& solids, const AirState& state) {
  ThreadTeam alone;
  const Grid& grid = passages_.grid;
  take_solids(alone, solids);
  find_volume_flow(alone, state.velocity, rate_);
  return largest(alone, grid, [&](std::ptrdiff_t c) {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double* flow = rate_[static_cast<std::size_t>(axis)].data();
      sum += (flow[c + grid.stride(axis)] - flow[c]) / grid.spacing[axis];
    }
    return std::abs(sum);
  });
}

}  // namespace talus::air

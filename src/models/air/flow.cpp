// SPDX-License-Identifier: Apache-2.0
#include "models/air/flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "physics/air/momentum.hpp"

namespace talus::air {

namespace {

std::size_t plus(std::size_t index, std::ptrdiff_t by) {
  return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(index) + by);
}

std::array<bool, 3> periodic_axes(const FlowBoundaries& boundaries) {
  return {boundaries.is_periodic(0), boundaries.is_periodic(1), boundaries.is_periodic(2)};
}

/// Calls body(i, j, k, index) for the cells, in parallel.
template <class Body>
void for_each_cell(ThreadTeam& team, const Grid& grid, Body&& body) {
  const int nx = grid.count[0], ny = grid.count[1], rows = ny * grid.count[2];
  constexpr int rows_at_once = 16;
  team.run(static_cast<std::size_t>((rows + rows_at_once - 1) / rows_at_once), [&](std::size_t block) {
    const int begin = static_cast<int>(block) * rows_at_once;
    for (int row = begin; row < std::min(begin + rows_at_once, rows); ++row) {
      const int j = row % ny, k = row / ny;
      const std::size_t first = grid.index(0, j, k);
      for (int i = 0; i < nx; ++i) body(i, j, k, first + static_cast<std::size_t>(i));
    }
  });
}

/// Largest value(i, j, k, index) over the cells.
template <class Value>
double largest(ThreadTeam& team, const Grid& grid, Value&& value) {
  const int ny = grid.count[1], rows = ny * grid.count[2];
  return reduce(
      team, static_cast<std::size_t>(rows), 0.0,
      [&](std::size_t row) {
        const int j = static_cast<int>(row) % ny, k = static_cast<int>(row) / ny;
        double most = 0;
        for (int i = 0; i < grid.count[0]; ++i) most = std::max(most, value(i, j, k, grid.index(i, j, k)));
        return most;
      },
      [](double a, double b) { return std::max(a, b); });
}

}  // namespace

AirFlow::AirFlow(const Grid& grid, const Parameters& parameters, const std::vector<Plate>& plates)
    : parameters_(parameters),
      passages_(grid, parameters.boundaries, plates),
      transport_(passages_),
      solver_(grid, periodic_axes(parameters.boundaries)),
      drag_(grid.cell_field()),
      source_(drag_),
      guess_(drag_) {
  for (FaceField* field : {&void_fraction_, &solid_, &grain_velocity_, &decay_, &pull_, &base_, &rate_, &stress_,
                           &conductance_, &stream_.velocity, &stream_.mass})
    *field = grid.face_field();
}

void AirFlow::set_plates(const std::vector<Plate>& plates) {
  passages_ = Passages(passages_.grid, parameters_.boundaries, plates);
}

/// Void fraction, solid fraction and grains' velocity on the faces: means of the two cells, of the one within at an
/// end.
void AirFlow::take_solids(ThreadTeam& team, const Solids& solids) {
  const Grid& grid = passages_.grid;
  for_each_cell(team, grid, [&](int i, int j, int k, std::size_t c) {
    const double s = solids.fraction[c];
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
    const int n = grid.count[a];
    const std::ptrdiff_t stride = grid.stride(axis);
    const bool ring = parameters_.boundaries.is_periodic(axis);
    for_each_face(team, passages_, axis, [&](int i, int j, int k, std::size_t f) {
      const int place = axis == 0 ? i : axis == 1 ? j : k;
      const std::size_t before = place > 0 ? plus(f, -stride) : ring ? plus(f, stride * (n - 1)) : f;
      const std::size_t here = place < n ? f : before;
      const double s = 0.5 * (solids.fraction[before] + solids.fraction[here]);
      const double flux = 0.5 * (solids.flux[a][before] + solids.flux[a][here]);
      solid_[a][f] = s;
      void_fraction_[a][f] = 1 - s;
      grain_velocity_[a][f] = s > 0 ? flux / s : 0;
    });
  }
}

/// beta of the cells, at the slip in their centres.
void AirFlow::measure_drag(ThreadTeam& team, const Solids& solids, const FaceField& velocity) {
  const Grid& grid = passages_.grid;
  const coupling::DragMedium medium = parameters_.medium();
  for_each_cell(team, grid, [&](int, int, int, std::size_t c) {
    const double s = solids.fraction[c];
    if (s <= 0) {
      drag_[c] = 0;
      return;
    }
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const double u = 0.5 * (velocity[a][c] + velocity[a][plus(c, grid.stride(axis))]);
      const double slip = u - solids.flux[a][c] / s;
      square += slip * slip;
    }
    drag_[c] = coupling::drag_coefficient(parameters_.drag, medium, s, std::sqrt(square));
  });
}

/// Difference of the pressure across a face over the way, Pa/m.
double AirFlow::pressure_step(int axis, int place, std::size_t face, const CellField& pressure) const {
  const Grid& grid = passages_.grid;
  const int n = grid.count[static_cast<std::size_t>(axis)];
  const std::ptrdiff_t stride = grid.stride(axis);
  const double width = grid.spacing[axis];
  if (!parameters_.boundaries.is_periodic(axis)) {
    const auto outside = [&](int side) {
      return parameters_.boundaries.pressure[static_cast<std::size_t>(2 * axis + side)];
    };
    if (place == 0) return (pressure[face] - outside(0)) / (0.5 * width);
    if (place == n) return (outside(1) - pressure[plus(face, -stride)]) / (0.5 * width);
  }
  const std::size_t before = place == 0 ? plus(face, stride * (n - 1)) : plus(face, -stride);
  return (pressure[face] - pressure[before]) / width;
}

/// From the momentum at the start of the step: velocity and pressure after dt, under the convection and viscosity of
/// `stream`, which is overwritten.
void AirFlow::stage(ThreadTeam& team, double dt, Stream& stream, const AirState& start, CellField& pressure) {
  const Grid& grid = passages_.grid;
  const double rho = parameters_.density();
  transport_.close(stream);
  transport_.convect(team, stream, parameters_.upwind, rate_);
  if (!implicit_) transport_.spread(team, stream.velocity, stress_);
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const int n = grid.count[a];
    const std::ptrdiff_t stride = grid.stride(axis);
    const bool ring = parameters_.boundaries.is_periodic(axis);
    const double area_over_way = grid.face_area(axis) / grid.spacing[axis];
    for_each_face(team, passages_, axis, [&](int i, int j, int k, std::size_t f) {
      const int place = axis == 0 ? i : axis == 1 ? j : k;
      if (passages_.open[a][f] <= 0) {
        stream.velocity[a][f] = base_[a][f] = conductance_[a][f] = 0, decay_[a][f] = 0, pull_[a][f] = 1;
        return;
      }
      const std::size_t before = place > 0 ? plus(f, -stride) : ring ? plus(f, stride * (n - 1)) : f;
      const double drag = 0.5 * (drag_[before] + drag_[place < n ? f : before]);
      const double phi = void_fraction_[a][f], mass = rho * phi;
      const coupling::SlipDecay slip = drag > 0 ? coupling::slip_decay(drag * dt / mass) : coupling::SlipDecay{1, 1};
      decay_[a][f] = slip.decay, pull_[a][f] = slip.pull;
      base_[a][f] = slip.decay * start.momentum[a][f] / mass + (1 - slip.decay) * grain_velocity_[a][f];
      double force = rate_[a][f];
      if (!implicit_) force += phi * parameters_.viscosity * stress_[a][f];
      stream.velocity[a][f] = base_[a][f] + slip.pull * dt * force / mass;
      conductance_[a][f] =
          air_share(phi) * slip.pull * dt / rho * area_over_way * (passages_.is_end(axis, place) ? 2 : 1);
    });
  }
  // Pressure's share of the velocity over dt.
  const auto press = [&](double sign, FaceField& velocity) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      for_each_face(team, passages_, axis, [&](int i, int j, int k, std::size_t f) {
        if (passages_.open[a][f] <= 0) return;
        const int place = axis == 0 ? i : axis == 1 ? j : k;
        const double phi = void_fraction_[a][f];
        velocity[a][f] -=
            sign * pull_[a][f] * dt / rho * (air_share(phi) / phi) * pressure_step(axis, place, f, pressure);
      });
    }
  };
  if (implicit_) {
    // With the guessed pressure at work: viscosity then meets the velocity to come, and a steady flow is exact.
    press(1, stream.velocity);
    stress_ = stream.velocity;
    transport_.spread_implicitly(team, stress_, pull_, parameters_.viscosity / rho * dt, stream.velocity);
    press(-1, stream.velocity);
  }

  // The volume flow without this step's pressure: that of the mixture, or of the air.
  const double carried = parameters_.continuity == Continuity::mixture;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    for_each_face(team, passages_, axis, [&](int, int, int, std::size_t f) {
      rate_[a][f] = passages_.open[a][f] *
                    (void_fraction_[a][f] * stream.velocity[a][f] + carried * solid_[a][f] * grain_velocity_[a][f]);
    });
    passages_.wrap(rate_[a]);
    passages_.wrap(conductance_[a]);
  }
  for_each_cell(team, grid, [&](int i, int j, int k, std::size_t c) {
    const std::array<int, 3> place{i, j, k};
    double source = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const std::size_t above = plus(c, grid.stride(axis));
      source -= (rate_[a][above] - rate_[a][c]) * grid.face_area(axis);
      if (passages_.boundaries.is_open(axis, 0) && place[a] == 0)
        source += conductance_[a][c] * parameters_.boundaries.pressure[2 * a];
      if (passages_.boundaries.is_open(axis, 1) && place[a] == grid.count[a] - 1)
        source += conductance_[a][above] * parameters_.boundaries.pressure[2 * a + 1];
    }
    source_[c] = source;
  });
  solver_.set_conductance(team, conductance_);
  // No smaller than what rounding leaves of the flows that the sources are differences of.
  const double flow = largest(team, grid, [&](int, int, int, std::size_t c) {
    return std::abs(rate_[0][c]) * grid.face_area(0) + std::abs(rate_[1][c]) * grid.face_area(1) +
           std::abs(rate_[2][c]) * grid.face_area(2);
  });
  const double rounding = 1e-15 * flow * std::sqrt(static_cast<double>(grid.cells()));
  iterations_ += solver_
                     .solve(team, source_, pressure,
                            {.tolerance = parameters_.tolerance,
                             .absolute = rounding,
                             .most_iterations = static_cast<int>(parameters_.most_iterations)})
                     .iterations;

  press(1, stream.velocity);
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    for_each_face(team, passages_, axis, [&](int, int, int, std::size_t f) {
      stream.mass[a][f] = rho * void_fraction_[a][f] * stream.velocity[a][f];
    });
  }
}

/// What the air lost to drag, and in model A what the pressure does to the solid, over the solid's volume: first on the
/// faces, then as the cells' means, so that it is handed out with the weights by which the solids were gathered. \param
/// velocity at the end of the step; the state's momentum is that of its start, its pressure the step's
void AirFlow::hand_over(ThreadTeam& team, double dt, const FaceField& velocity, AirState& state, FaceField& impulse) {
  const Grid& grid = passages_.grid;
  const double rho = parameters_.density();
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    for_each_face(team, passages_, axis, [&](int i, int j, int k, std::size_t f) {
      const int place = axis == 0 ? i : axis == 1 ? j : k;
      double received = 0, drag = 0;
      if (passages_.open[a][f] > 0) {
        if (parameters_.formulation == Formulation::model_a)
          received = -dt * pressure_step(axis, place, f, state.pressure);
        if (solid_[a][f] > 0) {
          const double mass = rho * void_fraction_[a][f];
          // All but drag, as an acceleration times dt: what makes the slip's decay end at the velocity found.
          const double push = (velocity[a][f] - base_[a][f]) / pull_[a][f];
          const double slip = state.momentum[a][f] / mass - grain_velocity_[a][f];
          drag = mass * (slip * (1 - decay_[a][f]) + (1 - pull_[a][f]) * push);
          received += drag / solid_[a][f];
        }
      }
      rate_[a][f] = received, stress_[a][f] = drag / dt;
    });
    passages_.wrap(rate_[a]);
    passages_.wrap(stress_[a]);
    for_each_cell(team, grid, [&](int, int, int, std::size_t c) {
      const std::size_t above = plus(c, grid.stride(axis));
      impulse[a][c] = 0.5 * (rate_[a][c] + rate_[a][above]);
      state.drag[a][c] = 0.5 * (stress_[a][c] + stress_[a][above]);
    });
  }
}

void AirFlow::begin(ThreadTeam& team, const Solids& solids, AirState& state) {
  take_solids(team, solids);
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    for_each_face(team, passages_, axis, [&](int, int, int, std::size_t f) {
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
  const double moved = largest(team, grid, [&](int, int, int, std::size_t c) {
    double rate = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto& u = state.velocity[static_cast<std::size_t>(axis)];
      rate += std::max(std::abs(u[c]), std::abs(u[plus(c, grid.stride(axis))])) / grid.spacing[axis];
    }
    return rate;
  });
  // A bed that dilates draws air through its pores; the pressure that this takes stops it at the rate
  // beta/(Phi^2 rho_b), whatever the wave length.
  const double response = largest(team, grid, [&](int, int, int, std::size_t c) {
    const double phi = 1 - solids.fraction[c];
    return solids.fraction[c] > 0 ? drag_[c] / (phi * phi * solids.fraction[c] * parameters_.grain_density) : 0;
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
    for_each_cell(team, grid, [&](int, int, int, std::size_t c) {
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
    state.velocity[a] = stream_.velocity[a], state.momentum[a] = stream_.mass[a];
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
  const double carried = parameters_.continuity == Continuity::mixture;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    for_each_face(alone, passages_, axis, [&](int, int, int, std::size_t f) {
      rate_[a][f] = passages_.open[a][f] *
                    (void_fraction_[a][f] * state.velocity[a][f] + carried * solid_[a][f] * grain_velocity_[a][f]);
    });
    passages_.wrap(rate_[a]);
  }
  return largest(alone, grid, [&](int, int, int, std::size_t c) {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto& flow = rate_[static_cast<std::size_t>(axis)];
      sum += (flow[plus(c, grid.stride(axis))] - flow[c]) / grid.spacing[axis];
    }
    return std::abs(sum);
  });
}

}  // namespace talus::air

// SPDX-License-Identifier: Apache-2.0
#include "models/air/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus::air {

namespace {

/// Calls body(index, i, j, k) for the cells.
template <class Body>
void for_each_place(const std::array<int, 3>& count, const Grid& grid, Body&& body) {
  for (int k = 0; k < count[2]; ++k)
    for (int j = 0; j < count[1]; ++j)
      for (int i = 0; i < count[0]; ++i) body(grid.index(i, j, k), i, j, k);
}

Vector3 face_centre(const Grid& grid, int axis, int i, int j, int k) {
  Vector3 x = grid.centre(i, j, k);
  x[axis] -= 0.5 * grid.spacing[axis];
  return x;
}

Vector3 wave_numbers(const ModelParameters& p) {
  return {2 * std::numbers::pi / p.box.width, 0, 2 * std::numbers::pi / p.box.height};
}

struct Extremes {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  void take(double value) { least = std::min(least, value), most = std::max(most, value); }
};

/// Velocity along an axis on the line through the middle of the box along another: of the cells or faces next to it,
/// their mean where it runs between two.
Extremes on_middle_line(const Grid& grid, const AirState& state, int component, int along) {
  std::array<int, 3> low{}, high{};
  for (std::size_t a = 0; a < 3; ++a) {
    const int n = grid.count[a];
    // Velocities along `component` are on faces: number n/2 is in the middle where n is even.
    const bool on_face = static_cast<int>(a) == component;
    low[a] = on_face ? n / 2 : (n - 1) / 2;
    high[a] = on_face ? (n + 1) / 2 : n / 2;
  }
  Extremes extremes;
  const auto& u = state.velocity[static_cast<std::size_t>(component)];
  for (int m = 0; m < grid.count[static_cast<std::size_t>(along)]; ++m) {
    low[static_cast<std::size_t>(along)] = high[static_cast<std::size_t>(along)] = m;
    extremes.take(0.5 * (u[grid.index(low[0], low[1], low[2])] + u[grid.index(high[0], high[1], high[2])]));
  }
  return extremes;
}

}  // namespace

std::vector<Problem> check(const ModelParameters& p) {
  std::vector<Problem> problems = check(p.gas);
  constexpr const char* names[6] = {"left", "right", "front", "rear", "floor", "top"};
  const auto is_periodic = [&](std::size_t face) { return p.gas.boundaries.kind[face] == FlowBoundary::periodic; };
  for (std::size_t face = 0; face < 6; face += 2)
    if (is_periodic(face) != is_periodic(face + 1))
      problems.push_back({.key = fmt::format("air.{}", names[is_periodic(face) ? face + 1 : face]),
                          .what = "is not periodic, but its opposite is",
                          .allowed = "both or neither"});
  if (!(p.box.width > 0 && p.box.depth > 0 && p.box.height > 0 && p.cell > 0)) return problems;
  const Grid grid = grid_of(p);
  for (Problem& problem : check_inflows(p.gas, grid)) problems.push_back(std::move(problem));
  for (int axis = 0; axis < 3; ++axis) {
    const int count = grid.count[static_cast<std::size_t>(axis)];
    if (is_periodic(static_cast<std::size_t>(2 * axis)) && count > 1 && count % 2 == 1)
      problems.push_back({.key = "air.cell",
                          .what = fmt::format("makes {} cells along {}, where the air is periodic", count, "xyz"[axis]),
                          .allowed = "an even number, or one"});
  }
  if (p.start.flow == InitialFlow::taylor_green)
    for (const std::size_t face : {0, 4})
      if (!is_periodic(face))
        problems.push_back({.key = fmt::format("air.{}", names[face]),
                            .what = "is not periodic, but the vortices of the start are",
                            .allowed = "\"periodic\" for left, right, floor and top"});
  return problems;
}

Grid grid_of(const ModelParameters& p) {
  Grid grid;
  const Vector3 size{p.box.width, p.box.depth, p.box.height};
  for (int axis = 0; axis < 3; ++axis) {
    const int count = std::max(1, static_cast<int>(std::lround(size[axis] / p.cell)));
    grid.count[static_cast<std::size_t>(axis)] = count;
    grid.spacing[axis] = size[axis] / count;
  }
  return grid;
}

Vector3 taylor_green(const ModelParameters& p, const Vector3& x, double time) {
  const Vector3 k = wave_numbers(p);
  const double speed = p.start.speed * std::exp(-p.gas.viscosity / p.gas.density() * dot(k, k) * time);
  return {speed * std::sin(k.x * x.x) * std::cos(k.z * x.z), 0,
          -speed * k.x / k.z * std::cos(k.x * x.x) * std::sin(k.z * x.z)};
}

AirModel::AirModel(const ModelParameters& parameters)
    : parameters_(parameters), grid_(grid_of(parameters)), none_(grid_), impulse_(grid_.face_field()) {
  state_.flow = AirState(grid_);
}

void AirModel::begin(ThreadTeam& team) {
  flow_ = std::make_unique<AirFlow>(grid_, parameters_.gas);
  if (parameters_.start.flow == InitialFlow::taylor_green)
    for (int axis = 0; axis < 3; ++axis)
      for_each_place(flow_->apertures().faces(axis), grid_, [&](std::size_t face, int i, int j, int k) {
        state_.flow.velocity[static_cast<std::size_t>(axis)][face] =
            taylor_green(parameters_, face_centre(grid_, axis, i, j, k), 0)[axis];
      });
  flow_->begin(team, none_, state_.flow);
}

void AirModel::resume(ThreadTeam&) {
  flow_ = std::make_unique<AirFlow>(grid_, parameters_.gas);
}

void AirModel::advance(ThreadTeam& team) {
  const double dt = flow_->time_step(team, none_, state_.flow);
  try {
    flow_->advance(team, dt, none_, state_.flow, impulse_);
  } catch (const NumericalError& error) {
    NumericalError::Report report = error.report();
    report.step = state_.step, report.time = state_.time;
    throw NumericalError(report);
  }
  state_.time += dt, ++state_.step;
  state_.iterations = static_cast<std::uint64_t>(flow_->iterations());
}

std::vector<NamedValue> AirModel::totals() const {
  const AirState& s = state_.flow;
  double energy = 0, exact_energy = 0, error = 0, speed = 0;
  const bool vortices = parameters_.start.flow == InitialFlow::taylor_green;
  for (int axis = 0; axis < 3; ++axis)
    for_each_place(grid_.count, grid_, [&](std::size_t face, int i, int j, int k) {
      const double u = s.velocity[static_cast<std::size_t>(axis)][face];
      energy += u * u;
      if (!vortices) return;
      const double exact = taylor_green(parameters_, face_centre(grid_, axis, i, j, k), state_.time)[axis];
      exact_energy += exact * exact;
      error = std::max(error, std::abs(u - exact));
    });
  Extremes pressure;
  for_each_place(grid_.count, grid_, [&](std::size_t c, int, int, int) {
    Vector3 u;
    for (int axis = 0; axis < 3; ++axis) u[axis] = s.cell_velocity(grid_, axis, c);
    speed = std::max(speed, norm(u));
    pressure.take(s.pressure[c]);
  });
  const Extremes u = on_middle_line(grid_, s, 0, 2), w = on_middle_line(grid_, s, 2, 0);
  std::vector<NamedValue> values = {{"step_size", "s", state_.flow.last_step},
                                    {"kinetic_energy", "J", 0.5 * parameters_.gas.density() * energy * grid_.volume()},
                                    {"air_speed_max", "m/s", speed},
                                    {"air_pressure_min", "Pa", pressure.least},
                                    {"air_pressure_max", "Pa", pressure.most},
                                    {"air_divergence_max", "1/s", flow_->max_divergence(none_, s)},
                                    {"air_iterations", "1", static_cast<double>(state_.iterations)},
                                    {"middle_u_min", "m/s", u.least},
                                    {"middle_u_max", "m/s", u.most},
                                    {"middle_w_min", "m/s", w.least},
                                    {"middle_w_max", "m/s", w.most}};
  if (vortices)
    values.insert(values.end(), {{"taylor_green_error", "1", error / parameters_.start.speed},
                                 {"taylor_green_energy", "1", energy / exact_energy}});
  return values;
}

std::optional<GridSnapshot> AirModel::grid() const {
  GridSnapshot snapshot{.time = state_.time,
                        .step = state_.step,
                        .count = grid_.count,
                        .low = grid_.low,
                        .spacing = grid_.spacing,
                        .columns = {}};
  std::vector<Vector3> velocity;
  std::vector<double> pressure;
  for_each_place(grid_.count, grid_, [&](std::size_t c, int, int, int) {
    Vector3 u;
    for (int axis = 0; axis < 3; ++axis) u[axis] = state_.flow.cell_velocity(grid_, axis, c);
    velocity.push_back(u), pressure.push_back(state_.flow.pressure[c]);
  });
  snapshot.columns = {{"velocity", "m/s", std::move(velocity)}, {"pressure", "Pa", std::move(pressure)}};
  return snapshot;
}

std::vector<RegimeLine> AirModel::regime(const RunRecord&) const {
  double speed = 0;
  for_each_place(grid_.count, grid_, [&](std::size_t c, int, int, int) {
    for (int axis = 0; axis < 3; ++axis) speed = std::max(speed, std::abs(state_.flow.cell_velocity(grid_, axis, c)));
  });
  const double rho = parameters_.gas.density();
  const double mach = speed / std::sqrt(1.4 * parameters_.gas.pressure / rho);
  std::vector<RegimeLine> lines = regime_of_case(parameters_);
  lines.push_back({"Mach number", fmt::format("{:.3g}", mach),
                   "of the last state; the air is taken for incompressible, up to about 0.3", mach > 0.3});
  return lines;
}

}  // namespace talus::air

// SPDX-License-Identifier: Apache-2.0
#include "models/air/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "models/air/parameters.hpp"
#include "physics/air/gas.hpp"

namespace talus::air {

namespace {

constexpr const char* names[6] = {"left", "right", "front", "rear", "floor", "top"};

Vector3 extent_of(const Grid& grid) {
  Vector3 extent;
  for (const int axis : {0, 1, 2}) extent[axis] = grid.spacing[axis] * grid.count[static_cast<std::size_t>(axis)];
  return extent;
}

/// The narrowest distance between two walls that face each other, m; infinite where there are none.
double narrowest_passage(const Parameters& p, const Vector3& extent) {
  double narrowest = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto& kind = p.boundaries.kind;
    if (kind[2 * axis] == FlowBoundary::no_slip && kind[2 * axis + 1] == FlowBoundary::no_slip)
      narrowest = std::min(narrowest, extent[static_cast<int>(axis)]);
  }
  return narrowest;
}

/// How fast the largest difference of pressure between open faces drives air, by Bernoulli, m/s.
double speed_by_pressure(const Parameters& p) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (std::size_t face = 0; face < 6; ++face)
    if (p.boundaries.kind[face] == FlowBoundary::open) {
      const double pressure = p.boundaries.pressure[face];
      least = std::min(least, pressure), most = std::max(most, pressure);
    }
  return most > least ? std::sqrt(2 * (most - least) / p.density()) : 0;
}

/// Cells of a face through which air comes in.
std::int64_t cells_of_inflow(const Parameters& p, const Grid& grid, std::size_t face) {
  std::array<int, 3> low{}, high = grid.count;
  const std::size_t axis = face / 2;
  low[axis] = face % 2 == 0 ? 0 : grid.count[axis] - 1, high[axis] = low[axis] + 1;
  std::int64_t cells = 0;
  for (int k = low[2]; k < high[2]; ++k)
    for (int j = low[1]; j < high[1]; ++j)
      for (int i = low[0]; i < high[0]; ++i) cells += comes_in_at(p, grid, face, {i, j, k}) ? 1 : 0;
  return cells;
}

/// What of a face lies within the box of the inflow, m^2.
double area_of_inflow(const Parameters& p, const Grid& grid, std::size_t face) {
  double area = 1;
  for (std::size_t b = 0; b < 3; ++b) {
    if (b == face / 2) continue;
    const double extent = extent_of(grid)[static_cast<int>(b)];
    const double low = p.inflow_low ? std::max(0.0, (*p.inflow_low)[b]) : 0,
                 high = p.inflow_high ? std::min(extent, (*p.inflow_high)[b]) : extent;
    area *= std::max(0.0, high - low);
  }
  return area;
}

}  // namespace

double given_speed(const ModelParameters& p) {
  if (p.start.flow == InitialFlow::taylor_green) return p.start.speed;
  double speed = 0;
  for (const auto& v : p.gas.wall_velocity) speed = std::max(speed, std::hypot(v[0], v[1], v[2]));
  return std::max(speed, speed_by_pressure(p.gas));
}

std::vector<RegimeLine> regime_of_faces(const Parameters& p, const Grid& grid) {
  constexpr double max_difference = 0.05;
  std::vector<RegimeLine> lines;
  if (const double passage = narrowest_passage(p, extent_of(grid)); std::isfinite(passage)) {
    const double knudsen = mean_free_path(p.viscosity, p.pressure, p.temperature) / passage;
    lines.push_back({"Knudsen number", fmt::format("{:.3g}", knudsen),
                     "mean free path of the molecules over the distance of two walls; above about 0.01 the air slips "
                     "along walls, which the model leaves out",
                     knudsen > 0.01});
  }
  for (std::size_t face = 0; face < 6; ++face) {
    if (p.boundaries.kind[face] != FlowBoundary::inflow || !(p.inflow_low || p.inflow_high)) continue;
    const auto axis = static_cast<int>(face / 2);
    const double area = static_cast<double>(cells_of_inflow(p, grid, face)) * grid.face_area(axis),
                 asked = area_of_inflow(p, grid, face), speed = std::abs(p.wall_velocity[face][face / 2]);
    lines.push_back({fmt::format("air that comes in at the face {}", names[face]),
                     fmt::format("{:.4g} m3/s", area * speed),
                     fmt::format("through whole cells, {:.4g} mm2; within inflow_low and inflow_high lie {:.4g} mm2",
                                 area * 1e6, asked * 1e6),
                     std::abs(area - asked) > max_difference * asked});
  }
  return lines;
}

std::vector<RegimeLine> regime_of_case(const ModelParameters& p) {
  const double rho = p.gas.density(), speed = given_speed(p);
  const double mach = speed / std::sqrt(1.4 * p.gas.pressure / rho);
  const double reynolds = rho * speed * grid_of(p).spacing.x / p.gas.viscosity;
  std::vector<RegimeLine> lines = {
      {"Mach number of the case", fmt::format("{:.3g}", mach),
       "speed of the walls, of what comes in, by differences of pressure or of the start over that of sound; the air "
       "is taken for incompressible, up to about 0.3",
       mach > 0.3},
      {"Reynolds number of a cell", fmt::format("{:.3g}", reynolds),
       "speed of the walls, of what comes in, by differences of pressure or of the start times cell over kinematic "
       "viscosity; central convection (air.upwind = 0) may "
       "oscillate above 2, most where layers are thin (Patankar 1980)",
       p.gas.upwind == 0 && reynolds > 2}};
  for (RegimeLine& line : regime_of_faces(p.gas, grid_of(p))) lines.push_back(std::move(line));
  return lines;
}

namespace {

void check_inflow(const Parameters& p, std::size_t face, const char* name, std::vector<Problem>& problems) {
  const auto& velocity = p.wall_velocity[face];
  const std::size_t axis = face / 2;
  const std::string key = fmt::format("air.{}_velocity", name);
  if (!((face % 2 == 0 ? 1 : -1) * velocity[axis] > 0))
    problems.push_back({.key = key,
                        .what = fmt::format("no air would come in: {:g} m/s along {}", velocity[axis], "xyz"[axis]),
                        .allowed = fmt::format("{} 0 m/s along {}", face % 2 == 0 ? "above" : "below", "xyz"[axis])});
  for (std::size_t b = 0; b < 3; ++b)
    if (b != axis && velocity[b] != 0)
      problems.push_back({.key = key,
                          .what = fmt::format("air would come in aslant: {:g} m/s along {}", velocity[b], "xyz"[b]),
                          .allowed = fmt::format("0 m/s along {}", "xyz"[b])});
  const auto& kinds = p.boundaries.kind;
  const bool is_vented = std::find(kinds.begin(), kinds.end(), FlowBoundary::open) != kinds.end();
  if (p.motion == Motion::frozen)
    problems.push_back({.key = fmt::format("air.{}", name),
                        .what = "air comes in, but it is frozen",
                        .allowed = "air.motion = \"flowing\""});
  else if (!is_vented && p.compressibility == Compressibility::none)
    problems.push_back({.key = fmt::format("air.{}", name),
                        .what = "air comes in, and none of the faces lets it out",
                        .allowed = "another face \"open\"; among grains also air.compressibility = \"isothermal\""});
}

}  // namespace

std::vector<Problem> check_inflows(const Parameters& p, const Grid& grid) {
  std::vector<Problem> problems;
  for (std::size_t face = 0; face < 6; ++face)
    if (p.boundaries.kind[face] == FlowBoundary::inflow && cells_of_inflow(p, grid, face) == 0)
      problems.push_back({.key = p.inflow_low ? "air.inflow_low" : "air.inflow_high",
                          .what = fmt::format("no middle of a cell at the face air.{} is within the box", names[face]),
                          .allowed = fmt::format("a box that holds one of these cells, {:.4g} mm long",
                                                 1e3 * std::max({grid.spacing.x, grid.spacing.y, grid.spacing.z}))});
  return problems;
}

std::vector<Problem> check(const Parameters& p) {
  std::vector<Problem> problems;
  for (std::size_t face = 0; face < 6; ++face) {
    const auto& velocity = p.wall_velocity[face];
    const bool moves = velocity != std::array<double, 3>{};
    const std::string key = fmt::format("air.{}_velocity", names[face]);
    const FlowBoundary kind = p.boundaries.kind[face];
    if (kind == FlowBoundary::inflow) {
      check_inflow(p, face, names[face], problems);
      continue;
    }
    if (moves && kind != FlowBoundary::no_slip)
      problems.push_back({.key = key,
                          .what = fmt::format("given, but air.{} is \"{}\"", names[face], choice_name(kind)),
                          .allowed = fmt::format("air.{} = \"wall\" or \"inflow\"", names[face])});
    if (velocity[face / 2] != 0)
      problems.push_back({.key = key,
                          .what = fmt::format("the wall would move along {}, across itself", "xyz"[face / 2]),
                          .allowed = fmt::format("0 m/s along {}", "xyz"[face / 2])});
  }
  return problems;
}

}  // namespace talus::air

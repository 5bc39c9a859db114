// SPDX-License-Identifier: Apache-2.0
/// The model `air`: air alone in a box, for flows with known solutions (driven cavities, channels, decaying vortices).
/// It is the same AirFlow that moves around grains in the model `continuum`.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "models/air/flow.hpp"
#include "models/model.hpp"
#include "numerics/field.hpp"
#include "numerics/run_record.hpp"
#include "numerics/snapshot.hpp"

namespace talus::air {

enum class InitialFlow {
  rest,
  taylor_green  ///< u = U sin(2 pi x/W) cos(2 pi z/H), w = -U H/W cos(2 pi x/W) sin(2 pi z/H)
};

struct ModelParameters {
  struct BoxSize {
    double width = 0, depth = 0, height = 0;
  } box;
  double cell = 0;
  struct Start {
    InitialFlow flow = InitialFlow::rest;
    double speed = 1;
  } start;
  Parameters gas;
};

template <class Visit, class P>
requires requires(P& p) {
  p.gas;
}
void for_each_parameter(Visit&& visit, P& p) {
  visit(Parameter{"box.width", dimension::length, above(0), "extent along x, from the left face at 0", true},
        p.box.width);
  visit(Parameter{"box.depth", dimension::length, above(0), "extent along y, from the front face at 0", true},
        p.box.depth);
  visit(Parameter{"box.height", dimension::length, above(0), "extent along z, from the floor at 0", true},
        p.box.height);
  visit(Parameter{"air.cell", dimension::length, above(0),
                  "size of the cells, fitted to whole numbers along each side of the box", true},
        p.cell);
  visit(Parameter{"start.flow",
                  {},
                  {},
                  "the flow at the start: rest, or Taylor and Green's vortices, one period along x and z"},
        p.start.flow);
  visit(Parameter{"start.speed", dimension::velocity, above(0), "largest velocity along x of the vortices"},
        p.start.speed);
  for_each_parameter_of_flow(visit, visit, p.gas);
}

/// Contradictions between keys; empty if there are none.
std::vector<Problem> check(const ModelParameters& parameters);

Grid grid_of(const ModelParameters& parameters);

/// Velocity of Taylor and Green's vortices, an exact solution of the equations of Navier and Stokes in a box that is
/// periodic along x and z: the initial velocity times exp(-nu (k_x^2 + k_z^2) t) (Taylor & Green 1937).
Vector3 taylor_green(const ModelParameters& parameters, const Vector3& position, double time);

struct ModelState {
  double time = 0;         ///< s
  std::uint64_t step = 0;  ///< steps taken
  AirState flow;
  std::uint64_t iterations = 0;  ///< of the pressure, last step
};

template <class Visit, class S>
requires requires(S& s) {
  s.flow;
}
void for_each_field(Visit&& visit, S& s) {
  constexpr std::array<std::string_view, 3> velocity{"air_velocity_x", "air_velocity_y", "air_velocity_z"};
  constexpr std::array<std::string_view, 3> momentum{"air_momentum_x", "air_momentum_y", "air_momentum_z"};
  constexpr std::array<std::string_view, 3> before{"air_momentum_before_x", "air_momentum_before_y",
                                                   "air_momentum_before_z"};
  const auto grid = [&](std::string_view name, std::string_view unit, auto& field) {
    visit(FieldInfo{name, unit, FieldRole::kept, false, false}, field);
  };
  visit(FieldInfo{"time", "s"}, s.time);
  visit(FieldInfo{"step", "1"}, s.step);
  grid("air_pressure", "Pa", s.flow.pressure);
  grid("air_pressure_before", "Pa", s.flow.pressure_before);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    grid(velocity[axis], "m/s", s.flow.velocity[axis]);
    grid(momentum[axis], "kg/(m2 s)", s.flow.momentum[axis]);
    grid(before[axis], "kg/(m2 s)", s.flow.momentum_before[axis]);
  }
  visit(FieldInfo{"last_step", "s"}, s.flow.last_step);
  visit(FieldInfo{"air_iterations", "1"}, s.iterations);
}

class AirModel {
 public:
  using Parameters = ModelParameters;
  using State = ModelState;

  explicit AirModel(const ModelParameters& parameters);

  const ModelState& state() const { return state_; }
  ModelState& mutable_state() { return state_; }
  double time_origin() const { return 0; }
  double latest_origin() const { return 0; }
  NumericalError::Report step_limit() const { return flow_->step_limit(none_, state_.flow); }
  void begin(ThreadTeam& team);
  void resume(ThreadTeam& team);
  void advance(ThreadTeam& team);

  /// Step, kinetic energy, largest speed, range of the pressure, remaining divergence, iterations; extremes of u on the
  /// upright middle line and of w on the level one; of Taylor and Green's vortices the largest error of a face's
  /// velocity over start.speed, and the energy over the exact one.
  std::vector<NamedValue> totals() const;
  std::optional<GridSnapshot> grid() const;
  std::vector<RegimeLine> regime(const RunRecord& record) const;

 private:
  ModelParameters parameters_;
  Grid grid_;
  ModelState state_;
  Solids none_;
  FaceField impulse_;
  std::unique_ptr<AirFlow> flow_;  // made by begin or resume
};

static_assert(Model<AirModel>);

/// Speed of the walls, or of the vortices at the start, m/s: what a case says of its flow before it has run.
double given_speed(const ModelParameters& parameters);

std::vector<RegimeLine> regime_of_case(const ModelParameters& parameters);

}  // namespace talus::air

namespace talus {
template <>
inline constexpr auto choices<air::InitialFlow> = std::to_array<std::string_view>({"rest", "taylor-green"});
}  // namespace talus

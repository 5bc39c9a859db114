// SPDX-License-Identifier: Apache-2.0
/// The air around the particles: it takes what they fill of its cells and how they move, goes on by a step of its own
/// while they wait, and gives each particle the impulse that its drag and pressure fixed, spread evenly over the
/// particles' steps of the same time. What the air loses they gain, to round-off.
#pragma once

#include <span>
#include <vector>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "models/air/flow.hpp"
#include "models/continuum/parameters.hpp"
#include "models/continuum/state.hpp"
#include "physics/coupling/deposition.hpp"

namespace talus::continuum {

/// The cells of a case's air: air.cell, fitted to whole numbers of cells along each side of the box; where it is left
/// out, along z to the plate too, if that takes no more than a tenth.
Grid air_grid(const Parameters& parameters);

/// Contradictions between the air's keys and the others; empty without air.
std::vector<Problem> check_air(const Parameters& parameters);

class Atmosphere {
 public:
  explicit Atmosphere(const Parameters& parameters);

  /// \param time from the opening of the case's gate, s
  void open_gates(double time);

  /// Air at rest around the particles of a new state.
  void begin(ThreadTeam& team, std::span<const double> smoothing_length, State& state);

  /// Where the particles have come to the end of the air's step, moves the air on by the next one: a whole number of
  /// steps of the particles, which are all of one length. \param dt the particles' step as they would have it, s;
  /// \returns as it is to be \throws NumericalError for a void fraction out of range, or a pressure that does not
  /// converge: cell and residual
  double advance(ThreadTeam& team, std::span<const double> smoothing_length, double dt, State& state);

  /// What holds the air's last step, and in which cell.
  NumericalError::Report step_limit(const State& state) const {
    return flow_.step_limit(state.air.solids, state.air.flow);
  }

 private:
  void move_air(ThreadTeam& team, std::span<const double> smoothing_length, double& dt, State& state);
  void deposit(ThreadTeam& team, std::span<const double> smoothing_length, State& state);
  void measure_slip(ThreadTeam& team, State& state);

  Domain domain_;
  double grain_density_;
  coupling::DragMedium medium_;
  coupling::Deposition deposition_;
  air::AirFlow flow_;
  FaceField per_solid_volume_;  // of cells: impulse, then slip
  std::vector<Vector3> received_;
};

}  // namespace talus::continuum

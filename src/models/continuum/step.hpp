// SPDX-License-Identifier: Apache-2.0
/// One time step of the grains: density by Eq. 16, velocity by Eq. 17, stress by the law, walls, phases.
#pragma once

#include <memory>
#include <vector>

#include "base/parallel.hpp"
#include "models/continuum/atmosphere.hpp"
#include "models/continuum/material.hpp"
#include "models/continuum/parameters.hpp"
#include "models/continuum/state.hpp"
#include "models/continuum/sweep.hpp"

namespace talus::continuum {

/// What a step needs beside the state; made anew from the state when a run is resumed.
struct Workspace {
  Material material;
  double sound_speed;   ///< bound for the time step, m/s
  double loading_time;  ///< over which gravity comes on, s
  Sweep sweep;
  Rates rates;                      ///< of the state, between steps
  std::unique_ptr<Atmosphere> air;  ///< none in a vacuum

  /// The state in the middle of a step.
  std::vector<Vector3> position, velocity;
  std::vector<double> density;
  MaterialColumns columns;
  std::vector<double> smoothing_length;

  /// Only if the strain comes from displacements.
  std::vector<SymmetricTensor3<>> measured_strain;
  std::vector<double> resets;  ///< of each particle at the start of the step

  Workspace(const Parameters& parameters, const State& state);

  /// \param time from the opening of the case's gate, s
  void open_gates(double time) {
    sweep.open_gates(time);
    if (air) air->open_gates(time);
  }
};

/// Completes a new state: neighbour lists, rates, derived columns.
void begin(ThreadTeam& team, const Parameters& parameters, State& state, Workspace& workspace);

/// Recomputes what follows from kept fields, after a checkpoint was read.
void derive(ThreadTeam& team, const Parameters& parameters, State& state, Workspace& workspace);

/// The step that the Courant number allows, s, or the fixed one; air may ask for another.
double time_step(ThreadTeam& team, const Parameters& parameters, const State& state, const Workspace& workspace);

/// What holds the last step as short as it is, and where: the Courant number of the grains, or the air.
NumericalError::Report step_limit(const Parameters& parameters, const State& state, const Workspace& workspace);

/// Advances by one step.
/// \throws NumericalError for a velocity or density that is not finite, or a bed that does not settle in time
void advance(ThreadTeam& team, const Parameters& parameters, State& state, Workspace& workspace);

}  // namespace talus::continuum

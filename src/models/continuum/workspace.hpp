// SPDX-License-Identifier: Apache-2.0
/// What a step needs beside the state, and how it is brought up to it.
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

/// Made anew from the state when a run is resumed. It owns the model's only Domain: the sweep, the air and observers
/// refer to it, so that a gate that opens there is open for all.
struct Workspace {
  Domain domain;
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
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;
};

/// Smoothing lengths of the state's densities.
void measure(ThreadTeam& team, const State& state, Workspace& workspace);

/// Builds the neighbour lists, of particles sorted now and then.
void find_neighbours(ThreadTeam& team, const Parameters& parameters, State& state, Workspace& workspace);

/// The rates of the state, with what derives from them.
void evaluate(ThreadTeam& team, const Parameters& parameters, State& state, Workspace& workspace);

/// From the gradients last evaluated: with the leapfrog those in the middle of the step, which the state at its end
/// cannot give again. A resumed run has it from its checkpoint.
void measure_shear_rate(ThreadTeam& team, State& state, const Workspace& workspace);

}  // namespace talus::continuum

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
#include "numerics/geometry/domain.hpp"
#include "physics/coupling/deposition.hpp"

namespace talus::continuum {

/// The cells of a case's air: air.cell, fitted to whole numbers of cells along each side of the box; where it is left
/// out, along z to the plate too, if that takes no more than a tenth.
Grid air_grid(const Parameters& parameters);

/// Contradictions between the air's keys and the others; empty without air.
std::vector<Problem> check_air(const Parameters& parameters);

class Atmosphere {
 public:
  /// \param domain outlives the atmosphere; gates that open in it are open to the air from its next step on
  Atmosphere(const Parameters& parameters, const Domain& domain);

  /// Air at rest around the particles of a new state.
  void begin(ThreadTeam& team, std::span<const double> smoothing_length, State& state);

  /// Whether the particles have come to the end of the air's step.
  bool is_due(const State& state) const { return state.air.steps_left == 0; }

  /// Where it is due: takes up the particles as they are now.
  void take_grains(ThreadTeam& team, std::span<const double> smoothing_length, State& state);

  /// The longest step of the air among the particles last taken up, s.
  double longest_step() const { return longest_; }

  /// Where it is due, moves the air on by the next step: as many steps of the particles as are within the longest, all
  /// of one length. Counts one of them as taken. \param dt the particles' step, s, at most longest_step()
  /// \throws NumericalError for a void fraction out of range, or a pressure that does not converge: cell and residual
  void advance(ThreadTeam& team, double dt, State& state);

  /// What holds the air's last step, and in which cell.
  NumericalError::Report step_limit(const State& state) const {
    return flow_.step_limit(state.air.solids, state.air.flow);
  }

 private:
  void move_air(ThreadTeam& team, double dt, State& state);
  void deposit(ThreadTeam& team, std::span<const double> smoothing_length, State& state);
  void measure_slip(ThreadTeam& team, State& state);

  const Domain& domain_;
  int openings_;  // of the domain, that the air has taken up
  double grain_density_;
  coupling::DragMedium medium_;
  coupling::Deposition deposition_;
  air::AirFlow flow_;
  FaceField per_solid_volume_;  // of cells: impulse, then slip
  std::vector<Vector3> received_;
  double longest_ = 0;
};

}  // namespace talus::continuum

// SPDX-License-Identifier: Apache-2.0
/// The continuum model: grains as lumps of a continuum that carry stress (Yuu & Umekage 2011, in a vacuum).
#pragma once

#include <optional>
#include <vector>

#include "models/continuum/initial.hpp"
#include "models/continuum/parameters.hpp"
#include "models/continuum/state.hpp"
#include "models/continuum/step.hpp"
#include "models/model.hpp"

namespace talus::continuum {

class Continuum {
 public:
  using Parameters = continuum::Parameters;
  using State = continuum::State;

  /// Fills the bed.
  explicit Continuum(const Parameters& parameters);

  const State& state() const { return state_; }
  State& mutable_state() { return state_; }
  /// When the gate opened, s.
  double time_origin() const;
  void begin(ThreadTeam& team);
  void resume(ThreadTeam& team);
  void advance(ThreadTeam& team);

  /// Of the last step: step_size, speed_max, density extremes, packing_max (kernel), momentum; since the start:
  /// gate_time (-1: shut), mass_outside (beyond open faces: what has left), the impulses of gravity and damping, and by
  /// wall what it received ("impulse_floor_z", N s).
  std::vector<NamedValue> totals() const;

  /// How far the run is from what the model assumes: Courant and Mach numbers, packing range, inertial numbers.
  std::vector<RegimeLine> regime() const;

 private:
  Parameters parameters_;
  State state_;
  std::optional<Workspace> workspace_;  // made by begin or resume
};

static_assert(Model<Continuum>);

}  // namespace talus::continuum

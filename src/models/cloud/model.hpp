// SPDX-License-Identifier: Apache-2.0
/// The cloud model: grains that interact through a viscous fluid (Niiya, Awazu & Nishimori 2020).
#pragma once

#include <optional>
#include <vector>

#include "models/cloud/initial.hpp"
#include "models/cloud/parameters.hpp"
#include "models/cloud/state.hpp"
#include "models/cloud/step.hpp"
#include "models/model.hpp"

namespace talus::cloud {

class Cloud {
 public:
  using Parameters = cloud::Parameters;
  using State = cloud::State;

  /// \param grains places and radii at the start; a resumed run replaces them
  Cloud(const Parameters& parameters, Grains grains);

  const State& state() const { return state_; }
  State& mutable_state() { return state_; }
  double time_origin() const { return 0; }
  double latest_origin() const { return 0; }
  NumericalError::Report step_limit() const;
  void begin(ThreadTeam& team);
  void resume(ThreadTeam& team);
  void advance(ThreadTeam& team);

  /// Of the last step: step_size, stages, evaluations, spectral_radius, overlap_max (m), speed_max, centre_x.
  std::vector<NamedValue> totals() const;

  /// Whether the run is within the assumptions of the model: Reynolds and Stokes numbers, overlaps, contact over
  /// weight.
  std::vector<RegimeLine> regime(const RunRecord& record) const;

 private:
  Parameters parameters_;
  State state_;
  std::optional<Workspace> workspace_;  // made by begin or resume, when the number of grains is known
};

static_assert(Model<Cloud>);

}  // namespace talus::cloud

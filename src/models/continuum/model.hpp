// SPDX-License-Identifier: Apache-2.0
/// The continuum model: grains as particles of a continuum that carry stress (Yuu & Umekage 2011, in a vacuum).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "models/continuum/setup/initial.hpp"
#include "models/continuum/setup/parameters.hpp"
#include "models/continuum/state.hpp"
#include "models/continuum/step.hpp"
#include "models/model.hpp"
#include "numerics/snapshot.hpp"
#include "ranks/ranks.hpp"

namespace talus::continuum {

class Continuum {
 public:
  using Parameters = continuum::Parameters;
  using State = continuum::State;

  /// Fills the bed. \param ranks outlive the model
  explicit Continuum(std::shared_ptr<const Setup> setup, const Ranks& ranks = one_process());
  explicit Continuum(const Parameters& parameters) : Continuum(std::make_shared<const Setup>(parameters)) {}

  /// With several processes: the part of this one.
  const State& state() const { return state_; }
  /// Of all particles.
  const State& whole_state() const { return ranks_.is_alone() ? state_ : gathered_; }
  State& mutable_state() { return state_; }
  /// Where the particles are, its gates as they are now. \pre begun or resumed
  const Domain& domain() const { return workspace_->boundary.domain(); }
  /// When the gate opened, s; infinite while it is shut.
  double time_origin() const;
  double latest_origin() const;
  /// Why nothing is left to compute; nothing while there is.
  std::optional<std::string> ended() const;
  NumericalError::Report step_limit() const;
  void begin(ThreadTeam& team);
  void resume(ThreadTeam& team);
  void advance(ThreadTeam& team);

  /// With several processes: makes the whole state at the first one. What is asked of the model from here on, until the
  /// next step, is of this state. Of all processes together.
  void gather();

  /// What the processes shared, in words (Share::account), as gathered; empty of one.
  const std::string& sharing() const { return account_; }
  /// Since it began or resumed.
  const TimeOfSteps& time_of_steps() const { return workspace_->share.time(); }

  /// Of the last step: step_size, speed_max, density extremes, packing_max (kernel), momentum; since the start:
  /// gate_time (-1: shut), mass_outside (beyond open faces: what has left), the impulses of gravity and damping, and by
  /// wall what it received ("impulse_floor_z", N s).
  /// With air: impulse_air since the start; of the air's last step its force on the grains, size, largest speed,
  /// extreme pressures (against the surroundings) and iterations of the pressure; its steps and a grain's largest
  /// Reynolds number since the start.
  std::vector<NamedValue> totals() const;

  /// The particles: in a sector those of the whole vessel, as all totals are. Valid until the next step.
  Snapshot snapshot() const;

  /// The same as files hold it: of a sector its particles once (part_of(), sector.hpp). Valid until the next step.
  PointSource stored() const;

  /// The air's cells as its last step left them: velocity and pressure (against air.pressure), solid_fraction, velocity
  /// of the grains (0 where there are none), drag on the grains in a unit volume (N/m3). Nothing in a vacuum.
  std::optional<GridSnapshot> grid() const;

  /// What the walls of the vessel bear (vessel_loads.hpp). Nothing without one.
  std::optional<SurfaceSnapshot> walls() const;

  /// How far the run is from what the model assumes: Courant and Mach numbers, packing range, inertial numbers.
  std::vector<RegimeLine> regime(const RunRecord& record) const;

 private:
  void make_workspace();
  Snapshot part() const;  // of a sector
  /// Of all particles, m.
  std::vector<double> smoothing_lengths() const;
  /// From when on the packing is that of a bed that has settled, or fallen by a spacing: beside walls and about a
  /// sector's axis the lattice of the start may lie closer than grains can. s
  double has_moved_from() const;

  const Ranks& ranks_;
  std::shared_ptr<const Setup> setup_;
  State state_, gathered_;
  std::string account_;
  std::unique_ptr<Workspace> workspace_;          // made by begin or resume
  std::optional<Domain> around_whole_;            // of a sector, with its workspace
  mutable std::optional<PointSet> part_, whole_;  // of the present state, if they were asked for
};

static_assert(Model<Continuum>);

}  // namespace talus::continuum

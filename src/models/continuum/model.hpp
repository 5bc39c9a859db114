// SPDX-License-Identifier: Apache-2.0
/// The continuum model: grains as particles of a continuum that carry stress (Yuu & Umekage 2011, in a vacuum).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "models/continuum/gas/atmosphere.hpp"
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
  Continuum(std::shared_ptr<const Setup> setup, ThreadTeam& team, const Ranks& ranks = one_process());
  /// By one thread.
  explicit Continuum(std::shared_ptr<const Setup> setup, const Ranks& ranks = one_process());
  explicit Continuum(const Parameters& parameters) : Continuum(std::make_shared<const Setup>(parameters)) {}

  /// With several processes: the part of this one; numbers are those of all, once gathered, and at the first one the
  /// air, once gather_fields() has brought it.
  const State& state() const { return state_; }
  State& mutable_state() { return state_; }
  /// Where the particles are, its gates as they are now. \pre begun or resumed
  const Domain& domain() const { return workspace_->boundary.domain(); }
  /// When the gate opened, s; infinite while it is shut.
  double time_origin() const;
  double latest_origin() const;
  /// Why nothing is left to compute; nothing while there is.
  std::optional<std::string> ended() const;
  NumericalError::Report step_limit() const;  ///< together, of several processes
  void begin(ThreadTeam& team);
  void resume(ThreadTeam& team);
  void advance(ThreadTeam& team);
  /// The next step builds the neighbour lists, though they hold: for forecasts.
  void drop_lists() { workspace_->drops_lists = true; }

  std::size_t particles() const { return workspace_->share.of_all(state_.position.size()); }

  // Several processes. Particles stay where they are: the first process reads them piece by piece.

  /// Together: totals, regime and loads of walls are of all particles from here on, until the next step.
  void gather();
  /// Together: the first process has the air of all, until the next step.
  void gather_fields();
  /// At the first process. \param announce has the others call send() with the same piece
  void lead(std::function<void(const ColumnPiece&)> announce) { announce_ = std::move(announce); }
  void send(const ColumnPiece& piece) const { workspace_->share.read(state_, piece, nullptr); }
  /// At the first process: a column of all particles; nothing with one process, which has it.
  /// \param number of it among the columns of particles
  std::optional<ColumnSource> column_of_all(const FieldInfo& field, ColumnSource::Kind kind,
                                            std::uint64_t number) const;

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

  /// The particles of snapshot(), piece by piece. \param columns that are asked for, positions among them
  void visit(std::span<const std::string> columns, const std::function<void(const Snapshot&)>& take) const;

  /// The air's cells as its last step left them: velocity and pressure (against air.pressure), solid_fraction, velocity
  /// of the grains (0 where there are none), drag on the grains in a unit volume (N/m3). Nothing in a vacuum.
  std::optional<GridSnapshot> grid() const;

  /// What the walls of the vessel bear (vessel_loads.hpp). Nothing without one.
  std::optional<SurfaceSnapshot> walls() const;

  /// How far the run is from what the model assumes: Courant and Mach numbers, packing range, inertial numbers.
  std::vector<RegimeLine> regime(const RunRecord& record) const;

 private:
  /// Found in one pass over the particles of all processes: a row of the series needs them every few steps.
  struct Totals {
    double max_speed = 0;                          ///< m/s
    Vector3 momentum;                              ///< N s
    double min_density, max_density, max_packing;  ///< kg/m^3, 1
    double mass_outside = 0;                       ///< beyond the open faces of the box: what has left, kg
  };
  /// For the validity report, of all particles.
  struct AtEnd {
    double min_smoothing_length;  ///< m
    double max_pressure;          ///< without the stress by collisions, Pa
    double too_fast;              ///< share of those that bear a pressure which the law's range leaves out
    double mass;                  ///< kg
  };
  Totals find_totals() const;
  AtEnd find_at_end() const;
  AirTotals find_air_totals() const;
  void make_workspace();
  Snapshot part() const;  // of a sector; of several processes all particles
  /// From when on the packing is that of a bed that has settled, or fallen by a spacing: beside walls and about a
  /// sector's axis the lattice of the start may lie closer than grains can. s
  double has_moved_from() const;

  const Ranks& ranks_;
  std::shared_ptr<const Setup> setup_;
  State state_;
  Totals totals_;  // as gathered
  AtEnd at_end_;
  AirTotals air_totals_;
  std::function<void(const ColumnPiece&)> announce_;
  std::string account_;
  std::unique_ptr<Workspace> workspace_;          // made by begin or resume
  std::optional<Domain> around_whole_;            // of a sector, with its workspace
  mutable std::optional<PointSet> part_, whole_;  // of the present state, if they were asked for
};

static_assert(Model<Continuum>);

}  // namespace talus::continuum

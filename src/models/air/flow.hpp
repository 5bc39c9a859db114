// SPDX-License-Identifier: Apache-2.0
/// The air between grains, one time step at a time (Yuu & Umekage 2011, Eqs 18-21). It knows the grains only by the
/// solid volume and its flow in every cell, and answers with the impulse that a unit of solid volume receives there.
///
/// A step. Momentum rho Phi u of every face is kept from the step before; the void fraction is the new one. Convection
/// and viscosity act as they were at the start for half the step, then as in the middle for the whole (second-order
/// Runge-Kutta). In each of the two, drag acts as the exact solution of its own decay, and the pressure is the one
/// that makes the mixture's volume flow without divergence, div(Phi u + (1 - Phi) u_p) = 0: Eq. 19 with the grains'
/// own continuity, and without the noisy dPhi/dt. Where the viscous time limit is shorter than the step, viscosity is
/// implicit and of first order. What the drag and, in model A, the pressure take from the air the grains receive, to
/// round-off.
///
/// completed: Eq. 18 is silent on the void fraction at a face (mean of the two cells), on boundaries (FlowBoundary) and
/// on grains that move within the step (they keep their velocity; time_step() keeps that short against their response).
#pragma once

#include <vector>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "models/air/convection.hpp"
#include "models/air/parameters.hpp"
#include "models/air/state.hpp"
#include "models/air/viscosity.hpp"
#include "numerics/grid/passages.hpp"
#include "numerics/grid/poisson.hpp"

namespace talus::air {

class AirFlow {
 public:
  /// \param plates, panels their openings decide where the air passes
  AirFlow(const Grid& grid, const Parameters& parameters, const std::vector<Plate>& plates,
          const std::vector<Panel>& panels = {});
  AirFlow(const AirFlow&) = delete;
  AirFlow& operator=(const AirFlow&) = delete;

  /// Takes plates and panels anew, after a gate has opened.
  void set_walls(const std::vector<Plate>& plates, const std::vector<Panel>& panels = {});

  /// Momentum of air with the state's velocities between these solids.
  void begin(ThreadTeam& team, const Solids& solids, AirState& state);

  /// The longest step that the air's movement, the grains' response and the parameters allow, s.
  double time_step(ThreadTeam& team, const Solids& solids, const AirState& state);

  /// What holds such a step, and in which cell; the rest of the report is empty. After a step has been taken.
  NumericalError::Report step_limit(const Solids& solids, const AirState& state) const;

  /// Advances by dt.
  /// \param impulse out: momentum that a unit of solid volume in a cell receives from drag and pressure, by component,
  ///        N s/m^3
  /// \throws NumericalError for a void fraction out of range, or a pressure that does not converge
  void advance(ThreadTeam& team, double dt, const Solids& solids, AirState& state, FaceField& impulse);

  /// What continuity lacks of the last step: adds to every cell the volume of air that has left it in dt, net of what
  /// its pressure made of it, over the cell's volume.
  void add_outflow(ThreadTeam& team, double dt, const AirState& state, CellField& sum);

  /// Momentum of all the air, N s.
  Vector3 momentum(const AirState& state) const;

  /// Largest sum over a cell's faces of what flows out, over its volume, 1/s: what the pressure left.
  double largest_divergence(const Solids& solids, const AirState& state);

  /// Of the last step: iterations of the pressure, of both of its solutions; whether viscosity was implicit.
  int iterations() const { return iterations_; }
  bool is_viscosity_implicit() const { return implicit_; }
  const Passages& passages() const { return passages_; }

 private:
  struct Rates;
  void set_solids(ThreadTeam& team, const Solids& solids);
  void measure_drag(ThreadTeam& team, const Solids& solids, const FaceField& velocity);
  void stage(ThreadTeam& team, double dt, Stream& stream, const AirState& start, CellField& pressure);
  void exchange_momentum(ThreadTeam& team, double dt, const FaceField& velocity, AirState& state, FaceField& impulse);
  void find_volume_flow(ThreadTeam& team, bool with_grains, const FaceField& velocity, FaceField& flow) const;
  void project(ThreadTeam& team, double dt, const Stream& stream, CellField& pressure);
  void find_storage(ThreadTeam& team, double dt);
  void fill_ghosts(CellField& pressure) const;
  /// Whether the grains have a share, that of their volume, in the pressure's gradient: 1, or 0 in model B.
  double grains_share() const { return parameters_.formulation == Formulation::model_a ? 1 : 0; }

  Parameters parameters_;
  Passages passages_;
  Convection convection_;
  Viscosity viscosity_;
  PoissonSolver solver_;
  bool implicit_ = false;
  int iterations_ = 0;

  FaceField void_fraction_, solid_fraction_, grain_velocity_;  // on faces
  CellField drag_;                                             // beta of cells, kg/(m^3 s)
  FaceField decay_, mean_, after_drag_, rate_, viscous_;       // of a stage, on faces
  FaceField before_;                                           // velocity before a stage, where viscosity is implicit
  FaceField conductance_;
  CellField source_, guess_;
  CellField cell_void_fraction_, start_pressure_, storage_;  // where the air is compressible
  Stream stream_;
};

}  // namespace talus::air

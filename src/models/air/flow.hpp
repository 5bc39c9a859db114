// SPDX-License-Identifier: Apache-2.0
/// The air between the grains (Yuu & Umekage 2011, Eqs 18-21). Its input is the solid volume and the solid flux in
/// every cell, its output the impulse per solid volume in every cell.
///
/// A step. The momentum rho Phi u of every face is from the previous step; the void fraction is the new one.
/// Convection, viscosity and the coefficient of the drag are evaluated once, at the midpoint of the step, with the
/// momentum extrapolated there from the starts of this step and the last (of second order as Adams and Bashforth's
/// method, for steps of any length; the first step is of first order). Drag is the exact solution of the linear decay
/// of the slip, and the pressure makes the volume flow of the mixture divergence-free, div(Phi u + (1 - Phi) u_p) = 0:
/// Eq. 19 with the continuity of the grains, and without the noisy dPhi/dt. Where the viscous time limit is shorter
/// than the step, viscosity is implicit and of first order. The momentum that drag and, in model A, the pressure remove
/// from the air is transferred to the grains, to round-off.
///
/// completed: Eq. 18 does not say how the void fraction is taken at a face (mean of the two cells), what the boundaries
/// are (FlowBoundary), and how grains move within the step (with constant velocity; time_step() keeps the step short
/// compared with their response).
///
/// Several processes share the rows of cells (Part).
#pragma once

#include <vector>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "models/air/convection.hpp"
#include "models/air/flow_rows.hpp"
#include "models/air/parameters.hpp"
#include "models/air/part.hpp"
#include "models/air/state.hpp"
#include "models/air/viscosity.hpp"
#include "numerics/grid/face_apertures.hpp"
#include "numerics/grid/loops.hpp"
#include "numerics/grid/poisson.hpp"

namespace talus::air {

class AirFlow {
 public:
  /// \param walls, surface closed to the air but for their openings and open patches
  /// \param ranks that share the cells; outlive the flow
  AirFlow(const Grid& grid, const Parameters& parameters, const std::vector<Wall>& walls = {},
          const Surface& surface = Surface::none(), const Ranks& ranks = one_process());
  AirFlow(const AirFlow&) = delete;
  AirFlow& operator=(const AirFlow&) = delete;

  /// Whether air comes in through the faces that are an inflow; it does until told otherwise.
  void let_in(bool comes_in) { comes_in_ = comes_in; }

  /// Replaces the walls after a gate has opened.
  void set_walls(const std::vector<Wall>& walls, const Surface& surface = Surface::none());

  /// The rows of this process.
  const Part& part() const { return part_; }

  // Of several processes, calls together. Each gives the solids where the halo of its part is, the state as the last
  // step has left it, and gets what is new of its own rows, of the state also of those around them.

  /// Initial momentum from the velocities of the state; of all rows.
  void begin(ThreadTeam& team, const Solids& solids, AirState& state);

  /// The longest step allowed by convection, the response of the grains and the parameters, s.
  double time_step(ThreadTeam& team, const Solids& solids, const AirState& state);

  /// The condition that limits the step, and its cell; the rest of the report is empty. Valid after a step.
  NumericalError::Report step_limit(const Solids& solids, const AirState& state) const;

  /// Advances by dt.
  /// \param impulse out: momentum per solid volume that the grains of a cell receive by drag and pressure, N s/m^3
  /// \throws NumericalError for a void fraction out of range, or a pressure that does not converge
  void advance(ThreadTeam& team, double dt, const Solids& solids, AirState& state, FaceField& impulse);

  /// Continuity error of the last step: adds to every cell the volume of air that has left it in dt, less its
  /// expansion, over the volume of the cell.
  void add_outflow(ThreadTeam& team, double dt, const AirState& state, CellField& sum);

  /// Largest divergence of the volume flow in a cell, 1/s: the residual of the pressure solver. For one process.
  double max_divergence(const Solids& solids, const AirState& state);

  /// The cells from `begin` on in a row along x.
  CellRow cells_from(std::ptrdiff_t begin, const Solids& solids, const FaceField& velocity) const;

  /// Of the last step: iterations of the pressure; whether viscosity was implicit.
  int iterations() const { return iterations_; }
  bool is_viscosity_implicit() const { return implicit_; }
  const FaceApertures& apertures() const { return apertures_; }

 private:
  void set_solids(ThreadTeam& team, const Solids& solids);
  void check_fractions(ThreadTeam& team, Slices rows, const CellField& fraction) const;
  void find_solids(const Solids& solids, int axis, int j, int k, std::ptrdiff_t begin, std::ptrdiff_t end);
  void measure_drag_of_row(std::ptrdiff_t begin, const CellRow& row);
  Rates rates(std::ptrdiff_t begin, std::ptrdiff_t count, const CellRow& row) const;
  void drag_alone(ThreadTeam& team, double dt, const Solids& solids, AirState& state, FaceField& impulse);
  void extrapolate(ThreadTeam& team, double dt, const Solids& solids, const AirState& state);
  void move(ThreadTeam& team, double dt, AirState& state);
  void close_row(int axis, std::ptrdiff_t begin, std::ptrdiff_t end);
  void add_pressure(ThreadTeam& team, double dt, CellField& pressure);
  struct Finished;
  void finish(ThreadTeam& team, double dt, AirState& state, FaceField& impulse);
  const Finished& finish_faces(Finished& kept, double dt, const AirState& state, int axis, std::size_t row,
                               std::ptrdiff_t begin, int count) const;
  double find_source(ThreadTeam& team, bool with_grains, const FaceField& velocity);
  void project(ThreadTeam& team, double dt, AirState& state);
  void find_storage(ThreadTeam& team, double dt);
  void find_inflow();
  void set_inflow(FaceField& velocity) const;
  void set_inflow(FaceField& velocity, FaceField& mass) const;
  void exchange_at_inflow(double dt, AirState& state, FaceField& impulse) const;
  void fill_ghosts(CellField& pressure) const;
  /// 1 if the pressure gradient acts on the grains by their volume fraction, 0 in model B.
  double grains_share() const { return parameters_.formulation == Formulation::model_a ? 1 : 0; }

  Parameters parameters_;
  coupling::DragMedium medium_;
  FaceApertures apertures_;
  Convection convection_;
  PoissonSolver solver_;
  Part part_;
  Viscosity viscosity_;
  bool implicit_ = false;
  int iterations_ = 0;

  FaceField void_fraction_, solid_fraction_, grain_velocity_;  // on faces
  CellField drag_;                                             // beta of cells, kg/(m^3 s)
  FaceField decay_, mean_, after_drag_;                        // of a step, on faces
  FaceField predicted_;                                        // velocity before the pressure; then the midpoint's
  FaceField start_;                                            // of the implicit viscosity
  FaceField conductance_;
  CellField source_;
  std::vector<double> max_flow_;  // of each row of cells
  std::vector<Rates> max_of_row_;
  CellField cell_void_fraction_, start_pressure_, storage_;  // where the air is compressible
  Stream stream_;
  struct Inflow {
    std::size_t axis, face, cell, row;
    double velocity, into;  // of the volume flow along the axis, m/s; into the cell, m^3/s
  };
  std::vector<Inflow> inflow_;
  bool comes_in_ = true;
};

}  // namespace talus::air

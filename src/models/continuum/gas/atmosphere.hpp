// SPDX-License-Identifier: Apache-2.0
/// The air around the particles. It takes longer steps than they do: from the solid volume and flux of the particles at
/// the start of its step it computes the impulse of drag and pressure on each particle, which is applied evenly over
/// the particle steps of the same time. The momentum that the air loses is gained by the particles, to round-off.
///
/// Several processes share the rows of its cells (air::Part), unless they are few: then each has the whole air, and all
/// compute the same.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "models/air/flow.hpp"
#include "models/continuum/boundary/boundary.hpp"
#include "models/continuum/gas/cell_exchange.hpp"
#include "models/continuum/setup/levels.hpp"
#include "models/continuum/setup/parameters.hpp"
#include "models/continuum/share.hpp"
#include "models/continuum/state.hpp"
#include "physics/coupling/deposition.hpp"

namespace talus::continuum {

/// The cells of the air: air.cell, adjusted to whole numbers of cells along each side of the box; if it is left out,
/// along z also to the plate, if that changes it by at most a tenth.
Grid air_grid(const Parameters& parameters);

/// Contradictions between the air's keys and the others; empty without air.
std::vector<Problem> check_air(const Parameters& parameters);

/// Whether several processes share the cells.
bool is_air_shared(const Grid& grid);

/// Of all cells of the air, found in one pass.
struct AirTotals {
  double max_speed = 0;                       ///< m/s
  double min_pressure = 0, max_pressure = 0;  ///< Pa
  /// Volume that grains have left or taken without air that came or went, m^3: half of the sum over the cells of what
  /// continuity lacks, since what one lacks another has too much.
  double imbalance = 0;
};

class Atmosphere {
 public:
  /// All but the parameters outlive the atmosphere. \param boundary gates opened in it are open to the air from its
  /// next step on \param share in the particles
  Atmosphere(const Parameters& parameters, const Levels& levels, const Boundary& boundary, const Share& share);

  /// Air at rest around the particles of a new state.
  void begin(ThreadTeam& team, std::span<const double> smoothing_length, State& state);

  /// Whether the particles have reached the end of the step of the air.
  bool is_due(const State& state) const { return state.air.steps_left == 0; }

  // Calls together, of several processes.

  /// If due: deposits the particles on the cells.
  void take_grains(ThreadTeam& team, std::span<const double> smoothing_length, State& state);

  /// The longest step of the air with the particles last deposited, s.
  double max_step() const { return max_step_; }

  /// If due, advances the air by its next step: as many equal particle steps as fit within the longest step. Counts one
  /// of them as taken. \param dt the particles' step, s, at most max_step()
  /// \throws NumericalError for a void fraction out of range, or a pressure that does not converge: cell and residual
  void advance(ThreadTeam& team, double dt, State& state);

  /// The condition that limits the last step of the air, and its cell.
  NumericalError::Report step_limit(const State& state) const {
    return flow_.step_limit(state.air.solids, state.air.flow);
  }

  AirTotals totals(const AirAround& air) const;

  /// Brings the first process the fields of all cells.
  void gather(AirAround& air) const;

 private:
  void move_air(ThreadTeam& team, double dt, State& state);
  void find_weights(ThreadTeam& team, std::span<const double> smoothing_length, const State& state);
  void deposit(ThreadTeam& team, State& state) const;
  void add_up(air::Solids& solids);
  void add_up_all(air::Solids& solids) const;
  void bring(std::span<CellField* const> fields);
  void leave_overfull(air::Solids& solids);
  void measure_slip(ThreadTeam& team, State& state);

  const Levels& levels_;
  const Boundary& boundary_;
  const Share& share_;
  int openings_;  // known to the air
  double grain_density_;
  double max_solid_fraction_;  // of a cell beside the vessel
  struct Overfull {
    std::size_t cell;
    double share;  // of its grains, that the air meets
  };
  std::vector<Overfull> overfull_;
  coupling::DragMedium medium_;
  coupling::Deposition deposition_;
  air::AirFlow flow_;
  CellExchange exchange_;
  std::vector<double> deposited_length_;  // with levels: smoothing lengths of deposition, m
  FaceField per_solid_volume_;            // of cells: impulse, then slip
  CellField slip_square_;
  std::vector<Vector3> received_;
  double max_step_ = 0;
};

// Sums over the cells.

inline constexpr int turns_of_cells = 8;

/// Calls body(cell, turn) for rows of cells. Largest numbers and sums over the cells go on in several places in turn,
/// so that one does not wait for the last.
template <class Body>
void for_each_air_cell(const Grid& grid, const RowRange& rows, Body&& body) {
  for (std::size_t row = rows.begin; row < rows.end; ++row) {
    const int j = static_cast<int>(row) % grid.count[1], k = static_cast<int>(row) / grid.count[1];
    const std::size_t begin = grid.index(0, j, k), end = begin + static_cast<std::size_t>(grid.count[0]);
    std::size_t c = begin;
    for (; c + turns_of_cells <= end; c += turns_of_cells)
      for (std::size_t n = 0; n < turns_of_cells; ++n) body(c + n, n);
    for (; c < end; ++c) body(c, 0);
  }
}

}  // namespace talus::continuum

// SPDX-License-Identifier: Apache-2.0
/// What a run of the continuum will take, from its parameters and the number of its particles alone: nothing is placed.
#pragma once

#include <optional>

#include "base/error.hpp"
#include "models/continuum/setup/setup.hpp"

namespace talus::continuum {

/// Of the bed at the start, s.
double time_step_of(const Setup& setup);

struct Forecast {
  double particles = 0;           ///< that are computed
  double written = 0;             ///< of a snapshot: in a sector those of the whole vessel
  double cells = 0;               ///< of the air
  double wall_points = 0;         ///< of the walls of a vessel, of all sets together
  double triangles = 0;           ///< of these walls
  double drawn_triangles = 0;     ///< of a snapshot of the walls, about
  double load_fields = 0;         ///< of these walls: load_fields(Layout)
  double settling_steps = 0;      ///< until the gate opens; at least so many
  double max_settling_steps = 0;  ///< the same, unless the bed settles without damping: when it rests is not known then
  double flow_steps = 0;          ///< from then on
};

/// Of grains that inlets bring, what the bed leaves room for below the highest of them, kg: within the extent of the
/// vessel, where the floor of the box is open.
double room_for_inlets(const Setup& setup);

/// \param end s, from the opening of the gate; \pre the case is valid: check()
Forecast forecast(const Setup& setup, double end);

/// Problems of a time step with a case that is valid otherwise: one that no run survives, or so short that no machine
/// comes to run.end.
std::vector<Problem> check_steps(const Setup& setup, double end);

/// Of the particles' time step: sound speed times step over smoothing length, in the bed as it is laid.
double courant_number(const Setup& setup);

/// Bytes that a run takes, the program itself among them.
double memory_of(const Forecast& forecast);

/// The same vessel and bed with about so many, larger particles. The share of them beside the walls is that of the case
/// times the ratio of the spacings. \pre the case has more
Parameters coarser(const Layout& layout, double particles);

/// A bed of the same particles and cells in a plain box, so small that a machine's speed is measured in a moment.
/// \param particles about so many, or as many as the bed has if these are fewer
Parameters sample(const Layout& layout, double particles);

}  // namespace talus::continuum

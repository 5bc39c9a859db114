// SPDX-License-Identifier: Apache-2.0
/// Which particles there are, and in which order: those that come in through inlets, those that are taken away. Both
/// follow from the state alone: a run that is resumed goes on with the same.
#pragma once

#include "models/continuum/setup/parameters.hpp"
#include "models/continuum/state.hpp"
#include "models/continuum/workspace.hpp"

namespace talus::continuum {

/// At the start: nothing has come or gone.
Population initial_population(const Layout& layout, std::size_t particles);

/// Adds the layers of inlets that are due at the time of the state. \returns whether there are new particles
bool feed(const Parameters& parameters, State& state, Workspace& workspace);

/// Takes away the particles that [removal] says. \returns whether any were taken away \pre no halo
bool remove_particles(const Parameters& parameters, State& state, Workspace& workspace);

/// Whether all particles have been taken away, and no inlet will bring more. \param particles that there are
bool has_emptied(const Parameters& parameters, const State& state, std::size_t particles);

/// Makes the workspace one for as many particles as the state has.
void fit(const Parameters& parameters, const State& state, Workspace& workspace);

/// The mass that inlets can bring until then, kg. \param end of the run, \param gate when its clock begins, s
double mass_to_come(const Parameters& parameters, double end, double gate);

/// Sorts every column of the state along a space-filling curve: particles near in space are near in memory, on which
/// half of the time of the pair sums of many particles depends. With several processes they get their places in that
/// order, and are sorted when they are distributed. \param cell_size of its cells, m \pre no halo
void sort_for_locality(State& state, Share& share, double cell_size);

}  // namespace talus::continuum

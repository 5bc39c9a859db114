// SPDX-License-Identifier: Apache-2.0
/// Particles that come in through inlets, and those that are taken away. Both follow from the state alone: a run that
/// is resumed goes on with the same.
#pragma once

#include "models/continuum/setup/parameters.hpp"
#include "models/continuum/state.hpp"
#include "models/continuum/workspace.hpp"

namespace talus::continuum {

/// At the start: nothing has come or gone.
Population initial_population(const Layout& layout, std::size_t particles);

/// Adds the layers of inlets that are due at the time of the state. \returns whether there are new particles
bool feed(const Parameters& parameters, State& state, Workspace& workspace);

/// Takes away the particles that [removal] says. \returns whether any were taken away
bool remove_particles(const Parameters& parameters, State& state, Workspace& workspace);

/// Whether all particles have been taken away, and no inlet will bring more.
bool has_emptied(const Parameters& parameters, const State& state);

/// The mass that inlets can bring until then, kg. \param end of the run, \param gate when its clock begins, s
double mass_to_come(const Parameters& parameters, double end, double gate);

}  // namespace talus::continuum

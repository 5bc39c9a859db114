// SPDX-License-Identifier: Apache-2.0
/// The workspace of a step, and its update from the state.
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "base/parallel.hpp"
#include "models/continuum/boundary/boundary.hpp"
#include "models/continuum/boundary/vessel_loads.hpp"
#include "models/continuum/gas/atmosphere.hpp"
#include "models/continuum/pairs/pair_sums.hpp"
#include "models/continuum/setup/setup.hpp"
#include "models/continuum/share.hpp"
#include "models/continuum/state.hpp"

namespace talus::continuum {

/// What limits the step of the grains.
struct GrainLimits {
  double min_smoothing_length = std::numeric_limits<double>::infinity();  ///< m
  double max_square_speed = 0;                                            ///< of the particles within the box, m^2/s^2
};

/// Recomputed from the state when a run is resumed. It owns the only boundary of the model whose gates open: the pair
/// sums, the air and observers refer to it, so that a gate is opened for all of them at once.
struct Workspace {
  Share share;
  Boundary boundary;
  const Material& material;
  Levels levels;
  double contact_distance;  ///< at which walls hold a particle (physics/sph/wall_contact.hpp), m
  double lasting_time;      ///< a shear that turns back sooner draws no density, s
  std::vector<InletLayer> inlets;
  SurfaceFields load_fields;  ///< of the vessel
  std::vector<LoadBand> load_bands;
  std::optional<FieldMesh> load_mesh;  ///< of the loads in snapshots; made for the first
  PairSums pairs;
  bool drops_lists = false;           ///< at the next step, though they hold
  Rates rates;                        ///< of the state, between steps
  std::optional<GrainLimits> limits;  ///< of all particles as they are; none: not known yet
  std::unique_ptr<Atmosphere> air;    ///< none in a vacuum

  /// The state at the midpoint of a step; all but positions of the midpoint rule only.
  std::vector<Vector3> position, velocity;
  std::vector<double> density;
  std::vector<double> midpoint_smoothing_length;  ///< of these densities, m
  MaterialColumns columns;
  std::vector<double> smoothing_length;  ///< of the densities of the state, m

  /// Only if the strain comes from displacements.
  std::vector<SymmetricTensor3<>> measured_strain;
  std::vector<double> resets;  ///< of each particle at the start of the step

  /// \param setup, ranks outlive it
  Workspace(const Setup& setup, const State& state, const Ranks& ranks = one_process());
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;
};

/// Those of the workspace, from the densities of the state.
void update_smoothing_lengths(ThreadTeam& team, const State& state, Workspace& workspace);

/// Steps in which a particle moves as far as its margin in the lists, if its speed and the skin allow it.
inline constexpr double steps_of_margin = 20;

/// Notes where neighbour lists are built, and how far each particle may move before the next ones: those that are fast
/// farther than those at rest, so that lists of a bed are short and those of a stream hold for some steps.
void set_list_reference(const Parameters& parameters, State& state, const Workspace& workspace);

/// Removes the halo where there is one, with what the workspace has of it.
void drop_halo(const Parameters& parameters, State& state, Workspace& workspace);

/// Builds the neighbour lists from where they are to be built, each particle with its owner.
/// \param carried more columns of the particles, which go with them \pre no halo
void build_lists(ThreadTeam& team, const Parameters& parameters, State& state, Workspace& workspace,
                 std::vector<std::vector<double>*> carried = {});

/// Builds the neighbour lists; sorts the particles at intervals.
void find_neighbours(ThreadTeam& team, const Parameters& parameters, State& state, Workspace& workspace);

/// Columns of the particles as pair sums read them.
struct SummedColumns {
  std::vector<Vector3>&position, &velocity;
  std::vector<double>&density, &smoothing_length;
  MaterialColumns& material;
  std::vector<double>& mass_ratio;

  ParticleView view() const { return {position, velocity, density, smoothing_length, material, {mass_ratio}}; }
};

/// Gives these columns the halo's values, in one message.
void refresh_halo(Workspace& workspace, const SummedColumns& columns);

/// The rates of the state, with what derives from them.
void evaluate(ThreadTeam& team, const Parameters& parameters, State& state, Workspace& workspace);

/// (2 D':D')^(1/2), 1/s. \param rate D', a deviator, 1/s
inline double shear_of(const SymmetricTensor3<>& rate) {
  return std::sqrt(2 * double_dot(rate, rate));
}

/// From the last velocity gradients: with the leapfrog those at the midpoint of the step, which cannot be recomputed
/// from the state at its end. A resumed run reads it from its checkpoint. The rate that lasts is its mean over what
/// went before, weighted by exp(-t/lasting_time).
void measure_shear_rate(ThreadTeam& team, State& state, const Workspace& workspace);

}  // namespace talus::continuum

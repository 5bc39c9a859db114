// SPDX-License-Identifier: Apache-2.0
/// The cloud model: grains that interact through a viscous fluid (Niiya, Awazu & Nishimori 2020), their initial
/// positions, and the cost of a run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/vector.hpp"
#include "models/cloud/parameters.hpp"
#include "models/cloud/state.hpp"
#include "models/cloud/step.hpp"
#include "models/model.hpp"
#include "ranks/ranks.hpp"

namespace talus::cloud {

struct Grains {
  std::vector<Vector3> position;  ///< m
  std::vector<double> radius;     ///< m
};

/// Packs the shape of the case by random sequential addition: one grain after another is placed at random until it
/// overlaps none placed before. All radii are drawn before the first position. With a slope, shapes on it (triangle,
/// wedge, dome; any shape in the plane xz) keep every grain above it. \throws NumericalError if a grain finds no
/// position after 10^6 trials (the fraction is too high)
Grains pack(const Parameters& parameters);

/// Problems of grains that come from a file: radii not positive, positions not finite, out of the plane of motion, too
/// far apart, or within each other or the slope deeper than integration.max_overlap.
std::vector<Problem> check_grains(const Parameters& parameters, const Grains& grains);

class Cloud {
 public:
  using Parameters = cloud::Parameters;
  using State = cloud::State;

  /// \param grains positions and radii at the start; a resumed run replaces them
  /// \param ranks processes that share the sum over pairs. Each has all grains and takes the same steps; on several
  /// processes `begin`, `resume`, `advance` and `gather` are calls together. Outlive it
  Cloud(const Parameters& parameters, Grains grains, const Ranks& ranks = one_process());

  const State& state() const { return state_; }
  State& mutable_state() { return state_; }
  double time_origin() const { return 0; }
  double latest_origin() const { return 0; }
  NumericalError::Report step_limit() const;
  void begin(ThreadTeam& team);
  void resume(ThreadTeam& team);
  void advance(ThreadTeam& team);
  void gather();
  /// Of several processes what sharing takes, as gathered, in words; empty of one.
  const std::string& sharing() const { return account_; }

  /// Of the last step: step_size, stages, evaluations, spectral_radius, overlap_max (m), speed_max, centre_x.
  std::vector<NamedValue> totals() const;

  /// Whether the run is within the assumptions of the model: Reynolds and Stokes numbers, overlaps, contact over
  /// weight.
  std::vector<RegimeLine> regime(const RunRecord& record) const;

 private:
  const Ranks& ranks_;
  Parameters parameters_;
  State state_;
  std::optional<Workspace> workspace_;  // made by begin or resume, when the number of grains is known
  double seconds_ = 0;                  // of processor time of the main thread, of the steps
  std::string account_;
};

static_assert(Model<Cloud>);

struct Forecast {
  double steps = 0;
  double evaluations = 0;  ///< of all velocities
};

/// Steps and evaluations of a run up to a time. A free cloud takes the largest step, with the stages required by
/// contacts that form within a step. A cloud that gravity presses against a slope first collapses onto it, in steps
/// limited by the growth of overlaps; its contacts relax faster, the more so the more grains interact: the layer on the
/// slope moves collectively, with a mobility that grows with its extent (a sum of 1/r over it). Measured:
/// docs/design/forecast.md.
/// \param end s; \param grains how many
Forecast forecast(const Parameters& parameters, double end, double grains);

/// A problem if a run would take more steps than is possible: run.end over the longest step.
std::optional<Problem> check_steps(const Parameters& parameters, double end);

/// Memory of a run in bytes, including the program itself.
double memory_of(double grains);

/// Grains on a regular lattice, in the plane of motion or in space, that almost touch: the sample on which the speed of
/// the machine is measured.
Grains sample(const Parameters& parameters, std::size_t count);

}  // namespace talus::cloud

// SPDX-License-Identifier: Apache-2.0
/// A run of a cloud of grains: an avalanche, with the speed of its front, or a cloud that falls in free space. Heads
/// and frontal angles of Niiya, Awazu & Nishimori (2020) are measured by validation/niiya2020/measures.py.
#pragma once

#include <span>
#include <vector>

#include "analysis/curve.hpp"
#include "analysis/measure.hpp"
#include "base/vector.hpp"
#include "numerics/snapshot.hpp"

namespace talus {

// A cloud of grains that falls freely through a viscous fluid: how fast, how much it leaves behind, and whether it has
// become a torus. Compare Metzger, Nicolas & Guazzelli, J. Fluid Mech. 580, 283-301 (2007), who describe the leakage
// from the rear and the torus; the measures here are choices.

struct FallingCloud {
  double fall_speed = 0;       ///< mean velocity along gravity of the grains of the cloud, m/s
  double leaked_fraction = 0;  ///< share of the grains more than two initial radii behind the median of all
  /// Number of grains of the cloud within 0.3 of its lateral radius from its axis, over what a disc of even density
  /// would have there: 1.27 for an even sphere, below 1 with a hole. The lateral radius holds 90 % of the grains.
  double axial_density = 0;
  double flatness = 0;  ///< root mean square lateral distance, over sqrt(2) times that along gravity: 1 for a sphere
};

/// \param position, velocity m, m/s, one per grain, at least one \param gravity unit vector
/// \param initial_radius of the cloud, m
FallingCloud measure_falling_cloud(std::span<const Vector3> position, std::span<const Vector3> velocity,
                                   const Vector3& gravity, double initial_radius);

/// Units of the paper's numbers, Eq. 5.
struct AvalancheScales {
  double mean_radius = 0;   ///< a, of the case, m
  double stokes_speed = 0;  ///< v_s, m/s
  double time() const { return mean_radius / stokes_speed; }
};

/// On a slope, falling in free space, or neither.
enum class CloudMotion { on_slope, falling, other };

/// A snapshot of a cloud that falls in free space.
struct FallSnapshot {
  FallingCloud cloud;
  double stokes_speed = 0;  ///< v_s, m/s
};

struct AvalancheRun {
  using Snapshot = FallSnapshot;
  using Numbers = SnapshotNumbers<FallSnapshot>;

  AvalancheScales scales;
  CloudMotion motion = CloudMotion::on_slope;
  double end = 0;                 ///< a/v_s
  Curve front_speed = {};         ///< v_s against a/v_s, at 0.25, 0.5, ... after the start
  Numbers snapshots = {};         ///< of a fall, against the time in a/v_s: the state at the start, then the data
  double overlap_max = no_value;  ///< over a

  /// Whether the run went on to that time, but for a step.
  bool reaches(double time) const { return end >= time * (1 - 1e-3); }
};

/// A run without snapshots: its scales and the front's speed. \param front m against s, from the start; from above it
/// is front_position, from the side front_position_on_slope with a layer of 2 a \param end of the run, s
AvalancheRun avalanche_run(const Curve& front, double end, const AvalancheScales& scales);

/// Every measure of one run, each once; a number that a run does not have is nan.
std::span<const Measure<AvalancheRun>> avalanche_measures();

}  // namespace talus

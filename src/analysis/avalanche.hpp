// SPDX-License-Identifier: Apache-2.0
/// A run of a cloud of grains: an avalanche as evaluated by Niiya, Awazu & Nishimori (2020), its front's speed and, in
/// each snapshot, the heads from above or head, tail and frontal angle from the side; or a cloud that falls in free
/// space. Estimators: validation/niiya2020/reference.toml.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "analysis/curve.hpp"
#include "analysis/falling_cloud.hpp"
#include "analysis/head_tail.hpp"
#include "analysis/heads.hpp"
#include "analysis/measure.hpp"
#include "analysis/vortices.hpp"
#include "base/vector.hpp"
#include "numerics/snapshot.hpp"

namespace talus {

/// Units of the paper's numbers, Eq. 5.
struct AvalancheScales {
  double mean_radius = 0;   ///< a, of the case, m
  double stokes_speed = 0;  ///< v_s, m/s
  double time() const { return mean_radius / stokes_speed; }
};

/// On a slope seen from above, in the plane x, y, or from the side, x, z; in free space; or not at all.
enum class AvalancheView { from_above, from_the_side, falling, unseen };

/// One snapshot of a run, and what several measures need of it, made when it is first asked for.
class AvalancheSnapshot {
 public:
  /// \param now with the columns position, radius, velocity \param speed of the front at its time, m/s
  AvalancheSnapshot(const AvalancheScales& of, AvalancheView seen, Snapshot grains, double speed);

  const AvalancheScales scales;
  const AvalancheView view;
  const Snapshot now;
  const double front_speed;             ///< m/s; nan before a first window has passed
  std::span<const Vector3> start = {};  ///< positions at the start of the run, the same grains in the same order, m
  Vector3 gravity = {0, 0, -1};         ///< unit vector

  std::span<const Vector3> position() const;         ///< as seen: from the side without y
  const std::vector<GrainSet>& heads() const;        ///< find_heads()
  const std::optional<HeadSize>& head_size() const;  ///< of the largest head; nothing without one
  const HeadMotion& head_motion() const;
  const ThicknessProfile& profile() const;
  const HeadTailMotion& head_tail_motion() const;
  const FallingCloud& fall() const;

 private:
  std::vector<Vector3> projected_;
  mutable std::optional<std::vector<GrainSet>> heads_;
  mutable std::optional<std::optional<HeadSize>> head_size_;
  mutable std::optional<HeadMotion> head_motion_;
  mutable std::optional<ThicknessProfile> profile_;
  mutable std::optional<HeadTailMotion> head_tail_motion_;
  mutable std::optional<FallingCloud> fall_;
};

struct AvalancheRun {
  using Snapshot = AvalancheSnapshot;
  using Numbers = SnapshotNumbers<AvalancheSnapshot>;
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  AvalancheScales scales;
  AvalancheView view = AvalancheView::from_above;
  double grains = 0;
  double end = 0;                        ///< a/v_s
  Curve front_speed = {};                ///< v_s against a/v_s, at 0.25, 0.5, ... after the start
  double front_speed_last = none;        ///< v_s, over the last window of the run; nan if it is shorter
  Numbers snapshots = {};                ///< against the time in a/v_s: the state at the start, then the data
  std::vector<double> head_widths = {};  ///< of every head at the end, m
  double overlap_max = none;             ///< over a
  double contact_weight_ratio = none;    ///< from the case alone

  /// Whether the run went on to that time, but for a step.
  bool reaches(double time) const { return end >= time * (1 - 1e-3); }
  /// A number of the snapshots after the start.
  Curve curve(Numbers::Number number) const { return snapshots.curve(number, {}, 1); }
};

/// A run without snapshots: its scales and the front's speed. \param front m against s, from the start; from above it
/// is front_position, from the side front_position_on_slope with a layer of 2 a \param end of the run, s
AvalancheRun avalanche_run(const Curve& front, double end, const AvalancheScales& scales, std::size_t grains);

/// Speed of the front at a time, over the window that ends there, m/s; nan unless the front was there all the time.
double front_speed_at(const Curve& front, double time, const AvalancheScales& scales);

/// The mean of the members' curves and numbers at equal times, as a run. Widths of single heads are left out. A number
/// that one member lacks the mean lacks too.
/// \throws std::invalid_argument if there is no member, or if they differ in their number of data or windows
AvalancheRun mean_run(std::span<const AvalancheRun> members);

/// Every measure of one run, each once; a number that a run does not have is nan.
std::span<const Measure<AvalancheRun>> avalanche_measures();
/// Of the members of an ensemble together, or of ensembles at several radii.
std::span<const GroupMeasure<AvalancheRun>> avalanche_group_measures();

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
/// A run of an avalanche as Niiya, Awazu & Nishimori (2020) look at it: the front's speed and, at each snapshot, the
/// heads from above or head, tail and frontal angle from the side. Estimators: validation/niiya2020/reference.toml.
#pragma once

#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "analysis/curve.hpp"
#include "base/vector.hpp"

namespace talus {

/// Units of the paper's numbers, Eq. 5.
struct AvalancheScales {
  double mean_radius = 0;   ///< a, of the case, m
  double stokes_speed = 0;  ///< v_s, m/s
  double time() const { return mean_radius / stokes_speed; }
};

enum class AvalancheView { from_above, from_the_side };  ///< grains in the plane x, y or x, z

/// The grains at one time, one entry a grain.
struct GrainsInMotion {
  double time = 0;                    ///< s
  std::span<const Vector3> position;  ///< m
  std::span<const double> radius;     ///< m
  std::span<const Vector3> velocity;  ///< m/s
};

/// Numbers of one snapshot; nan where they have no meaning: in the other view, or without a head.
struct AvalancheFrame {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  double time = 0;            ///< a/v_s
  double front_speed = none;  ///< v_s
  // From above, of the largest head
  double head_count = none;
  double head_particles = none;
  double head_width = none;      ///< m
  double head_thickness = none;  ///< m
  double head_concavity = none;
  double head_curl_left = none, head_curl_right = none;  ///< v_s/a
  double head_rear_relative_velocity = none;             ///< v_s
  double head_front_outward_velocity = none;             ///< v_s
  std::vector<double> head_widths = {};                  ///< of every head, m
  // From the side
  double front_rear_thickness_ratio = none;
  double head_upper_relative_velocity = none, head_lower_relative_velocity = none,
         tail_relative_velocity = none;  ///< v_s
  double frontal_angle = none;           ///< deg
};

/// The numbers of a frame by name; those that quantities.hpp lists mean what it says there.
inline constexpr struct {
  std::string_view name;
  double AvalancheFrame::*number;
} avalanche_frame_numbers[] = {
    {"time", &AvalancheFrame::time},
    {"front_speed", &AvalancheFrame::front_speed},
    {"head_count", &AvalancheFrame::head_count},
    {"head_particles", &AvalancheFrame::head_particles},
    {"head_width", &AvalancheFrame::head_width},
    {"head_thickness", &AvalancheFrame::head_thickness},
    {"head_concavity", &AvalancheFrame::head_concavity},
    {"head_curl_left", &AvalancheFrame::head_curl_left},
    {"head_curl_right", &AvalancheFrame::head_curl_right},
    {"head_rear_relative_velocity", &AvalancheFrame::head_rear_relative_velocity},
    {"head_front_outward_velocity", &AvalancheFrame::head_front_outward_velocity},
    {"front_rear_thickness_ratio", &AvalancheFrame::front_rear_thickness_ratio},
    {"head_upper_relative_velocity", &AvalancheFrame::head_upper_relative_velocity},
    {"head_lower_relative_velocity", &AvalancheFrame::head_lower_relative_velocity},
    {"tail_relative_velocity", &AvalancheFrame::tail_relative_velocity},
    {"frontal_angle", &AvalancheFrame::frontal_angle},
};

/// \param front where the front was until the snapshot, m against s. From above it is front_position, from the side
/// front_position_on_slope with a layer of 2 a. Before a first window has passed there is no front speed.
AvalancheFrame avalanche_frame(const GrainsInMotion& grains, const Curve& front, const AvalancheScales& scales,
                               AvalancheView view);

struct AvalancheRun {
  AvalancheScales scales;
  double grains = 0;
  Curve front_speed = {};                              ///< v_s against a/v_s, at 0.25, 0.5, ... after the start
  double front_speed_end = 0;                          ///< v_s, over the last window of the run; nan if it is shorter
  std::vector<AvalancheFrame> frames = {};             ///< the state at the start, then the data
  double displacement_spread = AvalancheFrame::none;   ///< over the mean displacement along x
  double displacement_lateral = AvalancheFrame::none;  ///< over a
  double overlap_max = AvalancheFrame::none;           ///< over a

  /// The frames after the start. \throws std::invalid_argument if there is none
  std::span<const AvalancheFrame> data() const;
  /// A number of the frames against time, from frame `first` on.
  Curve curve(double AvalancheFrame::*number, std::size_t first = 1) const;
};

/// A run without frames: its scales and the front's speed. \param front m against s, from the start; \param end of the
/// run, s
AvalancheRun avalanche_run(const Curve& front, double end, const AvalancheScales& scales, std::size_t grains);

/// Fills in how far the grains have moved apart. Positions of the same grains in the same order.
void set_displacements(AvalancheRun& run, std::span<const Vector3> before, std::span<const Vector3> after);

/// The mean of the members' curves and numbers at equal times, as a run. Widths of single heads are left out. A number
/// that one member lacks the mean lacks too.
/// \throws std::invalid_argument if there is no member, or if they differ in their number of data or windows
AvalancheRun mean_run(std::span<const AvalancheRun> members);

}  // namespace talus

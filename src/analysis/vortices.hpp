// SPDX-License-Identifier: Apache-2.0
/// How the grains of a head circulate: the curl of their velocities, and their motion relative to the front (Niiya,
/// Awazu & Nishimori 2020, section 3.1, Figure 5b). In the plane x, y; y points to the left of the way down.
#pragma once

#include <optional>
#include <span>

#include "analysis/heads.hpp"
#include "analysis/links.hpp"
#include "base/vector.hpp"

namespace talus {

/// Gradient of a velocity in the plane, 1/s: `yx` is the change of v_y along x.
struct PlaneGradient {
  double xx = 0, xy = 0, yx = 0, yy = 0;

  double curl() const { return yx - xy; }
};

/// Gradient of the affine velocity field nearest, in the sense of least squares, to those of grain i and the grains
/// linked to it, all with the same weight. Nothing if they are fewer than three or lie on one line.
std::optional<PlaneGradient> velocity_gradient(std::span<const Vector3> position, std::span<const Vector3> velocity,
                                               const Links& links, std::size_t i);

/// Means over parts of a head; nan where there is no grain.
struct HeadMotion {
  double curl_left = 0, curl_right = 0;  ///< of the grains left (y larger) and right of the head's centre, 1/s
  /// v_x less the front's speed, of the grains in the central half and the rear half of the layer, m/s. Positive: the
  /// rear moves to the front.
  double rear_relative_velocity = 0;
  double front_outward_velocity = 0;  ///< v_y away from the centre, of the grains in the front half of the layer, m/s
};

/// \param links all grains' neighbours, with the reach of the gradient (4 a in the paper's comparison)
/// \param front_speed m/s
HeadMotion head_motion(std::span<const Vector3> position, std::span<const Vector3> velocity, const Links& links,
                       const GrainSet& head, const HeadSize& size, double front_speed);

}  // namespace talus

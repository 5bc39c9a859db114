// SPDX-License-Identifier: Apache-2.0
/// What grains leave a vessel through.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/vector.hpp"
#include "numerics/geometry/box.hpp"
#include "numerics/geometry/gate_times.hpp"

namespace talus::continuum {

struct Parameters;
struct Layout;

struct VesselOutlet {
  std::string name;             ///< of the part that it is an opening of, or that shuts it
  Vector3 middle;               ///< m
  double width = 0, depth = 0;  ///< along x and y; of a round one its diameter, m
  bool round = false;
  double narrow = 0, length = 0;  ///< the narrower side and the other one, at any angle, m
  /// Whether it goes on beyond both faces of the box that it reaches, along x or y: a slot without ends.
  bool endless_along_x = false, endless_along_y = false;
  std::optional<GateTimes> gate = {};  ///< of one that a gate shuts

  /// Whether a place is above or below it, or no farther beside than a margin, m.
  bool is_beside(const Vector3& x, double margin) const;
};

/// All of them, the lowest first. A gate that is level, a disc or a plate, or the hole that it covers: the lower end of
/// a cone or a pyramid, the hole of a disc, or a level rim of an STL file, at its height and no larger than it. Without
/// such a gate the lowest of these holes but for those of files, and others at its height.
std::vector<VesselOutlet> outlets_of_vessel(const Parameters& parameters);
/// When the first of them opens, s after the opening of the gate; 0 where there are none.
double first_opening(const std::vector<VesselOutlet>& outlets);
/// How far the walls are apart between which a slot ends at two faces of the box: with a mirror at one of them it is
/// twice their distance, with mirrors at both there are none. m
double distance_of_walls(FaceKind a, FaceKind b, double extent);

/// Share of an outlet below which a wall of the vessel or the floor is nearer than the outlet is across, 0 to 1: grains
/// do not fall freely there. Gates are taken to be open.
double share_blocked_below(const Layout& layout, const VesselOutlet& outlet);
/// Share of it that a wall of the vessel covers, in its plane or closer above than two spacings: what is open is
/// narrower than it.
double share_covered(const Layout& layout, const VesselOutlet& outlet);

}  // namespace talus::continuum

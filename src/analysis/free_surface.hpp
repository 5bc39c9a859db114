// SPDX-License-Identifier: Apache-2.0
/// The free surface of grains in a vessel: the height Z(x) at which the packing passes a level, and how it slopes.
#pragma once

#include <vector>

#include "analysis/depth_mean.hpp"

namespace talus {

/// Packing on the free surface: half of a loose bed's.
inline constexpr double surface_packing = 0.3;

/// A height at each x; nan where there is no surface.
struct FreeSurface {
  std::vector<double> x, z;  ///< m

  /// Height at x, linear between finite neighbours; nan beyond them.
  double height(double at) const;
};

/// Where a vessel is in a section, and from where its surface is looked for.
struct Vessel {
  double bottom = 0, top = 0;  ///< z, m
  /// From above: the highest place, in a vessel above which nothing falls. From below: the first one above the bottom,
  /// so that grains in the air do not count; a column of grains that reaches the top of the vessel, as a dense stream
  /// does, has none.
  enum class Search { from_above, from_below } search = Search::from_above;
};

/// One height a column of the section, linear between the centres of two rows.
FreeSurface free_surface(const Section& packing, const Vessel& vessel, double level = surface_packing);

/// The surface's slope as a whole: the angle whose tangent is the mean of the sizes of the slopes of two least-squares
/// lines, through the heights left and right of `middle`; rad. Of one half alone if the other has fewer than three
/// heights; nan if both have.
double surface_angle(const FreeSurface& surface, double middle);

}  // namespace talus

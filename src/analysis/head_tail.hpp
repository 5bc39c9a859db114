// SPDX-License-Identifier: Apache-2.0
/// An avalanche seen from the side: how much thicker its front is than its rear, and which of its parts outrun the
/// front (Niiya, Awazu & Nishimori 2020, section 3.3, Figure 7a). x points down the slope, z away from it. How front,
/// rear and upper head are distinguished is not stated in the paper: all of it is a choice, fixed in
/// validation/niiya2020/reference.toml.
#pragma once

#include <span>
#include <vector>

#include "base/vector.hpp"

namespace talus {

struct HeadTailRule {
  double column = 4;               ///< length of a column along the slope, in mean radii
  double stragglers = 0.05;        ///< share of the grains, the rearmost, that the rear does not reach back to
  double head_share = 0.5;         ///< of the head's thickness, down to which columns behind it belong to it
  double upper_share = 2.0 / 3.0;  ///< of the head's thickness, above which a grain belongs to the upper head
};

/// Thickness along the slope. Columns are counted backwards from the foremost centre to the one that holds the
/// last grain which is no straggler.
struct ThicknessProfile {
  double front = 0;               ///< x of the foremost centre, m
  double column = 0;              ///< length of a column, m
  std::vector<double> thickness;  ///< of each column, foremost first: the highest upper edge, 0 where it is empty; m
  std::size_t crest = 0;          ///< the thickest column of the front half (rounded up), of equal ones the foremost
  std::size_t head_columns = 0;   ///< those ahead of the crest, the crest, and the thick ones behind it without a gap

  std::size_t column_of(double x) const { return static_cast<std::size_t>((front - x) / column); }
  double head_thickness() const { return thickness[crest]; }
  /// Median over the columns of the rear half; nan for a single column.
  double rear_thickness() const;
};

/// \param position at least one, m; z from the slope \param mean_radius of the case, > 0, m
/// \throws std::invalid_argument without grains
ThicknessProfile thickness_profile(std::span<const Vector3> position, std::span<const double> radius,
                                   double mean_radius, const HeadTailRule& rule = {});

/// Mean of v_x less the front's speed, m/s; nan where there is no grain.
struct HeadTailMotion {
  double upper_head = 0, lower_head = 0, tail = 0;
};
/// \param front_speed m/s
HeadTailMotion head_tail_motion(std::span<const Vector3> position, std::span<const Vector3> velocity,
                                const ThicknessProfile& profile, double front_speed, const HeadTailRule& rule = {});

}  // namespace talus

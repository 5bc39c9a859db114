// SPDX-License-Identifier: Apache-2.0
#include "analysis/head_tail.hpp"

#include <algorithm>
#include <stdexcept>

#include "analysis/statistics.hpp"

namespace talus {

double ThicknessProfile::rear_thickness() const {
  const std::size_t front_columns = (thickness.size() + 1) / 2;
  return median(std::span(thickness).subspan(front_columns));
}

ThicknessProfile thickness_profile(std::span<const Vector3> position, std::span<const double> radius,
                                   double mean_radius, const HeadTailRule& rule) {
  if (position.empty()) throw std::invalid_argument("a thickness needs grains");
  std::vector<double> along;
  for (const Vector3& x : position) along.push_back(x.x);
  ThicknessProfile profile;
  profile.front = *std::max_element(along.begin(), along.end());
  profile.column = rule.column * mean_radius;
  profile.thickness.assign(profile.column_of(quantile(along, rule.stragglers)) + 1, 0.0);
  for (std::size_t i = 0; i < position.size(); ++i) {
    const std::size_t column = profile.column_of(position[i].x);
    if (column >= profile.thickness.size()) continue;
    profile.thickness[column] = std::max(profile.thickness[column], position[i].z + radius[i]);
  }
  const auto front_end = profile.thickness.begin() + static_cast<std::ptrdiff_t>((profile.thickness.size() + 1) / 2);
  profile.crest =
      static_cast<std::size_t>(std::max_element(profile.thickness.begin(), front_end) - profile.thickness.begin());
  profile.head_columns = profile.crest + 1;
  while (profile.head_columns < profile.thickness.size() &&
         profile.thickness[profile.head_columns] >= rule.head_share * profile.head_thickness())
    ++profile.head_columns;
  return profile;
}

HeadTailMotion head_tail_motion(std::span<const Vector3> position, std::span<const Vector3> velocity,
                                const ThicknessProfile& profile, double front_speed, const HeadTailRule& rule) {
  std::vector<double> upper, lower, tail;
  for (std::size_t i = 0; i < position.size(); ++i) {
    const std::size_t column = profile.column_of(position[i].x);
    std::vector<double>& group = column >= profile.head_columns                                ? tail
                                 : position[i].z > rule.upper_share * profile.head_thickness() ? upper
                                                                                               : lower;
    group.push_back(velocity[i].x - front_speed);
  }
  return {mean(upper), mean(lower), mean(tail)};
}

}  // namespace talus

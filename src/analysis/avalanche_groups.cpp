// SPDX-License-Identifier: Apache-2.0
/// Measures of avalanches together: of the members of an ensemble, of ensembles at several radii.
#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/avalanche_numbers.hpp"
#include "analysis/row_values.hpp"
#include "analysis/statistics.hpp"

namespace talus {

namespace {

using Run = AvalancheRun;
using Groups = std::span<const std::vector<Run>>;

std::vector<double> widths_in_radii(std::span<const Run> members) {
  std::vector<double> widths;
  for (const Run& member : members)
    for (const double width : member.head_widths) widths.push_back(width / member.scales.mean_radius);
  return widths;
}

std::optional<double> front_speed_spread(Groups groups, const Window& window) {
  if (groups[0].size() < 2) return std::nullopt;
  std::vector<Curve> curves;
  for (const Run& member : groups[0]) curves.push_back(part(member.front_speed, window.from, window.to));
  const CurveSpread result = spread(common_part(std::move(curves)));
  std::vector<double> ratio;
  for (std::size_t n = 0; n < result.deviation.size(); ++n) ratio.push_back(result.deviation[n] / result.mean.value[n]);
  return mean(ratio);
}

/// Standard deviation of the frontal angle over the members, mean over the last quarter of the data over the first.
std::optional<double> frontal_angle_spread_ratio(Groups groups, const Window&) {
  const std::vector<Run>& members = groups[0];
  if (members.size() < 2) return std::nullopt;
  std::vector<double> deviation;
  const std::size_t data = mean_run(members).snapshots.time().size();  // of every member
  for (std::size_t n = 1; n < data; ++n) {
    std::vector<double> angle;
    for (const Run& member : members) angle.push_back(member.snapshots.value(n, avalanche::frontal_angle, {}));
    deviation.push_back(standard_deviation(finite_values(std::move(angle))));
  }
  const std::size_t quarter = deviation.size() / 4;
  return mean(std::span(deviation).last(quarter)) / mean(std::span(deviation).first(quarter));
}

/// A line through the mean widths, m, against the radius, and the medians in radii; nothing for fewer than three radii.
struct WidthsOfRadii {
  std::vector<double> radius, mean_width, median;
};
std::optional<WidthsOfRadii> widths_of_radii(Groups groups) {
  if (groups.size() < 3) return std::nullopt;
  WidthsOfRadii result;
  for (const std::vector<Run>& members : groups) {
    const std::vector<double> widths = widths_in_radii(members);
    result.radius.push_back(members[0].scales.mean_radius);
    result.mean_width.push_back(mean(widths) * result.radius.back());
    result.median.push_back(median(widths));
  }
  return result;
}

template <Line (*fit)(std::span<const double>, std::span<const double>)>
std::optional<double> r_squared(Groups groups, const Window&) {
  const auto widths = widths_of_radii(groups);
  return widths ? std::optional(fit(widths->radius, widths->mean_width).r_squared) : std::nullopt;
}

std::optional<double> median_spread(Groups groups, const Window&) {
  const auto widths = widths_of_radii(groups);
  if (!widths) return std::nullopt;
  const auto [least, largest] = std::minmax_element(widths->median.begin(), widths->median.end());
  return (*largest - *least) / mean(widths->median);
}

const GroupMeasure<Run> list[] = {
    {"front_speed_spread", "1",
     "standard deviation of the front speed between members over its mean, mean over the window", front_speed_spread},
    {"frontal_angle_spread_ratio", "1",
     "spread of the frontal angle between members, last quarter of the run over first", frontal_angle_spread_ratio},
    {"head_width_normality_p_value", "1", "Anderson-Darling test of the widths of all heads of all members at the end",
     [](Groups groups, const Window&) { return std::optional(anderson_darling(widths_in_radii(groups[0])).p_value); }},
    {"head_width_skewness", "1", "skewness of them",
     [](Groups groups, const Window&) { return std::optional(skewness(widths_in_radii(groups[0]))); }},
    {"head_width_median_spread", "1", "range of the radii's median widths (in a) over their mean", median_spread},
    {"head_width_line_r_squared", "1", "R² of the line of the mean width against the radius", r_squared<fit_line>},
    {"head_width_line_origin_r_squared", "1", "the same through the origin", r_squared<fit_line_through_origin>},
};

}  // namespace

std::span<const GroupMeasure<Run>> avalanche_group_measures() {
  return list;
}

}  // namespace talus

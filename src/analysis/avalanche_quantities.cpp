// SPDX-License-Identifier: Apache-2.0
#include "analysis/avalanche_quantities.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "analysis/quantities.hpp"
#include "analysis/statistics.hpp"

namespace talus {

namespace {

constexpr double none = AvalancheFrame::none;

[[noreturn]] void unknown(std::string_view name, std::string_view of) {
  throw std::out_of_range("'" + std::string(name) + "' is no quantity of " + std::string(of));
}

const AvalancheFrame& frame_at(const AvalancheRun& run, const Window& window) {
  const double at = window.at.value_or(Window::end_of_run);
  if (std::isinf(at)) return run.data().back();
  std::vector<double> time;
  for (const AvalancheFrame& frame : run.data()) time.push_back(frame.time);
  return run.data()[nearest_point(time, at)];
}

Curve within(const Curve& curve, const Window& window) {
  return part(curve, window.from, window.to);
}

Curve aspect_ratio(const AvalancheRun& run) {
  Curve ratio = run.curve(&AvalancheFrame::head_width);
  for (std::size_t n = 0; n < ratio.value.size(); ++n) ratio.value[n] /= run.data()[n].head_thickness;
  return ratio;
}

/// Slopes of the lines through the first and the second half of a curve; the middle of the time belongs to the first.
struct Slopes {
  double early, late;
};
Slopes slopes(const Curve& curve) {
  const double end = curve.time.back();
  const Curve early = part(curve, 0, 0.5 * end), late = part(curve, 0.5 * end, end);
  return {fit_line(early.time, early.value).slope, fit_line(late.time, late.value).slope};
}

/// Rank correlation of the head's grains with the front speed over the data; if asked from the largest speed on.
double head_speed_correlation(const AvalancheRun& run, bool from_largest) {
  const Curve speed = run.curve(&AvalancheFrame::front_speed);
  const Curve particles = run.curve(&AvalancheFrame::head_particles);
  const auto first = from_largest ? std::max_element(speed.value.begin(), speed.value.end()) - speed.value.begin() : 0;
  return spearman_correlation(std::span(particles.value).subspan(static_cast<std::size_t>(first)),
                              std::span(speed.value).subspan(static_cast<std::size_t>(first)));
}

std::vector<double> widths_in_radii(std::span<const AvalancheRun> members, const Window& window) {
  std::vector<double> widths;
  for (const AvalancheRun& member : members)
    for (const double width : frame_at(member, window).head_widths) widths.push_back(width / member.scales.mean_radius);
  return widths;
}

double front_speed_spread(std::span<const AvalancheRun> members, const Window& window) {
  std::vector<Curve> curves;
  for (const AvalancheRun& member : members) curves.push_back(within(member.front_speed, window));
  const CurveSpread result = spread(common_part(std::move(curves)));
  std::vector<double> ratio;
  for (std::size_t n = 0; n < result.deviation.size(); ++n) ratio.push_back(result.deviation[n] / result.mean.value[n]);
  return mean(ratio);
}

/// A front of fewer than three grains has no angle. Such members are left out, as long as they are the fewer: if not,
/// there is none at all.
std::vector<double> angles_that_are(std::vector<double> angles) {
  const std::size_t members = angles.size();
  std::erase_if(angles, [](double angle) { return std::isnan(angle); });
  if (2 * angles.size() < members) angles.clear();
  return angles;
}

/// Standard deviation of the frontal angle over the members, mean over the last quarter of the data over the first.
double frontal_angle_spread_ratio(std::span<const AvalancheRun> members) {
  std::vector<double> deviation;
  const std::size_t data = mean_run(members).data().size();  // of every member
  for (std::size_t n = 0; n < data; ++n) {
    std::vector<double> angle;
    for (const AvalancheRun& member : members) angle.push_back(member.data()[n].frontal_angle);
    deviation.push_back(standard_deviation(angles_that_are(std::move(angle))));
  }
  const std::size_t quarter = deviation.size() / 4;
  return mean(std::span(deviation).last(quarter)) / mean(std::span(deviation).first(quarter));
}

}  // namespace

double run_quantity(std::string_view name, const AvalancheRun& run, const Window& window) {
  for (const auto& entry : avalanche_frame_numbers)
    if (entry.name == name) return frame_at(run, window).*entry.number;
  if (name == "front_speed_end") return run.front_speed_end;
  if (name == "displacement_spread") return run.displacement_spread;
  if (name == "displacement_lateral") return run.displacement_lateral;
  if (name == "overlap_max") return run.overlap_max;

  if (name.starts_with("front_speed_")) {
    const Curve speed = within(run.front_speed, window);
    if (speed.time.empty()) return none;
    const Extremes found = extremes(speed);
    if (name == "front_speed_max") return found.largest;
    if (name == "front_speed_min") return found.least;
    if (name == "front_speed_max_time") return found.largest_time;
    if (name == "front_speed_rise") return found.largest / run.front_speed.value.front();
    if (name == "front_speed_fall") return found.largest / run.front_speed_end;
    if (name == "front_speed_slope_early") return slopes(run.front_speed).early;
    if (name == "front_speed_slope_change") return slopes(run.front_speed).late - slopes(run.front_speed).early;
  }
  if (name.starts_with("head_aspect_ratio")) {
    const Curve ratio = within(aspect_ratio(run), window);
    if (name == "head_aspect_ratio") return mean(ratio.value);
    if (ratio.time.empty()) return none;
    if (name == "head_aspect_ratio_min") return extremes(ratio).least;
    if (name == "head_aspect_ratio_max") return extremes(ratio).largest;
  }
  if (name == "head_particles_first") return run.data().front().head_particles / run.grains;
  if (name == "head_particles_half_time")
    return first_time_at_or_below(run.curve(&AvalancheFrame::head_particles, 0), 0.5 * run.grains);
  if (name == "head_particles_trend") {
    const Curve data = run.curve(&AvalancheFrame::head_particles);
    return spearman_correlation(data.value, data.time);
  }
  if (name == "head_particles_front_speed_correlation") return head_speed_correlation(run, true);
  if (name == "head_particles_front_speed_correlation_all") return head_speed_correlation(run, false);
  if (name == "frontal_angle_first") return run.data().front().frontal_angle;
  unknown(name, "a run");
}

std::optional<double> ensemble_quantity(const ComparisonRow& row, std::span<const AvalancheRun> members) {
  if (members.empty()) return std::nullopt;
  if (row.from == From::each) {
    if (row.statistic == Statistic::standard_deviation && members.size() < 2) return std::nullopt;
    std::vector<double> numbers;
    for (const AvalancheRun& member : members) numbers.push_back(run_quantity(row.quantity, member, row.window));
    if (row.quantity == "frontal_angle" || row.quantity == "frontal_angle_first") {
      numbers = angles_that_are(std::move(numbers));
      if (numbers.empty()) return AvalancheFrame::none;
    }
    return evaluate(row.statistic, numbers);
  }
  if (row.from == From::curves) {
    if (row.quantity == "front_speed_spread" || row.quantity == "frontal_angle_spread_ratio") {
      if (members.size() < 2) return std::nullopt;
      return row.quantity == "front_speed_spread" ? front_speed_spread(members, row.window)
                                                  : frontal_angle_spread_ratio(members);
    }
    return run_quantity(row.quantity, mean_run(members), row.window);
  }
  if (row.from == From::values) {
    const std::vector<double> widths = widths_in_radii(members, row.window);
    if (row.quantity == "head_width_normality_p_value") return anderson_darling(widths).p_value;
    if (row.quantity == "head_width_skewness") return skewness(widths);
  }
  unknown(row.quantity, "an ensemble");
}

std::optional<double> radii_quantity(const ComparisonRow& row, std::span<const std::vector<AvalancheRun>> ensembles) {
  if (ensembles.size() < 3) return std::nullopt;
  std::vector<double> radius, width, median_width;
  for (const std::vector<AvalancheRun>& members : ensembles) {
    if (members.empty()) return std::nullopt;
    const std::vector<double> widths = widths_in_radii(members, row.window);
    radius.push_back(members[0].scales.mean_radius);
    width.push_back(mean(widths) * radius.back());
    median_width.push_back(median(widths));
  }
  if (row.quantity == "head_width_line_r_squared") return fit_line(radius, width).r_squared;
  if (row.quantity == "head_width_line_origin_r_squared") return fit_line_through_origin(radius, width).r_squared;
  if (row.quantity == "head_width_median_spread") {
    const auto [least, largest] = std::minmax_element(median_width.begin(), median_width.end());
    return (*largest - *least) / mean(median_width);
  }
  unknown(row.quantity, "several radii");
}

std::vector<NamedValue> avalanche_summary(const AvalancheRun& run, AvalancheView view) {
  std::vector<std::string_view> names = {"front_speed_max", "front_speed_min", "front_speed_end"};
  if (view == AvalancheView::from_above)
    names.insert(names.end(), {"head_count", "head_particles", "head_width", "head_thickness", "head_aspect_ratio"});
  else
    names.push_back("frontal_angle");
  names.push_back("overlap_max");
  std::vector<NamedValue> summary;
  for (const std::string_view name : names) {
    const Window window = name == "head_aspect_ratio" ? Window{.from = 6} : Window{};
    summary.push_back({std::string(name), std::string(find_quantity(name)->unit), run_quantity(name, run, window)});
  }
  return summary;
}

}  // namespace talus

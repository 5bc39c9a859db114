// SPDX-License-Identifier: Apache-2.0
#include "app/reproduction/niiya2020_heads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/statistics.hpp"

namespace talus::app {

namespace {

using namespace figure;

constexpr double bin = 2;  // a

/// The widths of the heads of all members at the end, in a.
std::vector<double> widths_at_end(const AvalancheEnsemble& ensemble) {
  std::vector<double> widths;
  for (const AvalancheRun& run : ensemble.runs)
    if (!run.frames.empty())
      for (const double width : run.frames.back().head_widths) widths.push_back(width / run.scales.mean_radius);
  return widths;
}

double largest(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

figure::Line dashed(std::vector<double> x, std::vector<double> y, const std::string& label) {
  return {.x = std::move(x), .y = std::move(y), .label = label, .colour = ink, .dash = Dash::dashed, .width = 1};
}

/// One number of the snapshots against another.
Points phase_points(const AvalancheEnsemble& ensemble, std::size_t k, const MembersCurve& x, const MembersCurve& y) {
  Points points = points_of_radius(ensemble, k);
  points.x = x.mean, points.x_error = x.deviation;
  points.y = y.mean, points.y_error = y.deviation;
  return points;
}

}  // namespace

Chart front_speed_of_head(const Radii& radii) {
  Chart chart{.x = {.label = "grains in the head", .low = 0}, .y = {.label = "front speed *ṽ*_{f}", .low = 0}};
  for (std::size_t k = 0; k < radii.size(); ++k)
    chart.series.push_back(phase_points(*radii[k], k, members_curve(*radii[k], &AvalancheFrame::head_particles),
                                        members_curve(*radii[k], &AvalancheFrame::front_speed)));
  return chart;
}

Chart width_against_thickness(const Radii& radii) {
  Chart chart{.x = {.label = "thickness *l̃*_{h}", .low = 0}, .y = {.label = "width *w̃*_{h}", .low = 0}};
  double most = 0;
  for (std::size_t k = 0; k < radii.size(); ++k) {
    const MembersCurve thickness = members_curve_in_radii(*radii[k], &AvalancheFrame::head_thickness);
    most = std::max(most, largest(thickness.mean));
    chart.series.push_back(
        phase_points(*radii[k], k, thickness, members_curve_in_radii(*radii[k], &AvalancheFrame::head_width)));
  }
  chart.series.push_back(dashed({0, most}, {0, 4 * most}, "*w̃*_{h} = 4 *l̃*_{h}, printed"));
  return chart;
}

Chart width_distributions(const Radii& radii) {
  double most = 0;
  for (const AvalancheEnsemble* ensemble : radii) most = std::max(most, largest(widths_at_end(*ensemble)));
  const auto bins = static_cast<std::size_t>(std::ceil(most / bin)) + 1;
  const double end = bin * static_cast<double>(bins);
  Chart chart{.x = {.label = "width *w̃*_{h}", .low = 0, .high = 1.7 * end},  // the legend stands on the right
              .y = {.label = "probability density", .low = 0}};
  for (std::size_t k = 0; k < radii.size(); ++k) {
    const std::vector<double> widths = widths_at_end(*radii[k]);
    if (widths.empty()) continue;
    const Histogram h = histogram(widths, 0, end, bins);
    Points points = points_of_radius(*radii[k], k);
    for (std::size_t b = 0; b < bins; ++b) {
      points.x.push_back(h.middle(b));
      points.y.push_back(h.density(b));
    }
    chart.series.push_back(figure::Line{.x = points.x, .y = points.y, .colour = points.colour, .width = 1});
    points.label += fmt::format(", {} heads", widths.size());
    chart.series.push_back(std::move(points));
    const Gaussian fit = gaussian_of_least_squares(h);
    if (k + 1 < radii.size() || !std::isfinite(fit.mean)) continue;
    std::vector<double> x, y;
    for (int n = 0; n <= 120; ++n) {
      x.push_back(end * n / 120);
      y.push_back(fit.density(x.back()));
    }
    chart.series.push_back(dashed(x, y, fmt::format("Gaussian {:.1f} ± {:.1f}", fit.mean, fit.deviation)));
  }
  return chart;
}

Chart width_against_radius(const Radii& radii) {
  Chart chart{.x = {.label = "radius *a*_{p}", .unit = "mm", .low = 0},
              .y = {.label = "width *w*_{h}", .unit = "mm", .low = 0}};
  Points points{.label = "all heads at the end", .colour = palette_colour(0)};
  for (const AvalancheEnsemble* ensemble : radii) {
    const std::vector<double> widths = widths_at_end(*ensemble);
    const double radius = 1000 * ensemble->runs.front().scales.mean_radius;
    points.x.push_back(radius);
    points.y.push_back(radius * mean(widths));
    points.y_error.push_back(radius * standard_deviation(widths));
  }
  const double slope = fit_line_through_origin(points.x, points.y).slope, most = 1.1 * largest(points.x);
  chart.series.push_back(std::move(points));
  chart.series.push_back(dashed({0, most}, {0, slope * most}, fmt::format("*w*_{{h}} = {:.1f} *a*_{{p}}", slope)));
  return chart;
}

Chart head_counts(const Radii& radii) {
  Points computed{.label = "computed", .colour = palette_colour(0)};
  for (const AvalancheEnsemble* ensemble : radii) {
    std::vector<double> counts;
    for (const AvalancheRun& run : ensemble->runs)
      if (!run.frames.empty()) counts.push_back(run.frames.back().head_count);
    computed.x.push_back(1000 * ensemble->runs.front().scales.mean_radius);
    computed.y.push_back(mean(counts));
    computed.y_error.push_back(standard_deviation(counts));
  }
  constexpr double beside = 0.12;  // mm, so that the error bars are told apart
  Points printed{.x = {1 + beside, 2.5 + beside, 5 + beside},
                 .y = {17.20, 13.95, 14.85},
                 .y_error = {1.69, 1.94, 1.35},
                 .label = "printed",
                 .colour = ink,
                 .symbol = Symbol::open_square};
  return {.x = {.label = "radius *a*_{p}", .unit = "mm", .low = 0, .high = 5.6},
          .y = {.label = "heads at the end", .low = 0, .high = 26},
          .series = {std::move(computed), std::move(printed)}};
}

}  // namespace talus::app

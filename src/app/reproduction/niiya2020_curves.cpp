// SPDX-License-Identifier: Apache-2.0
#include "app/reproduction/niiya2020_curves.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/statistics.hpp"

namespace talus::app {

namespace {

using namespace figure;

constexpr const char* time_label = "*t̃* = *t* *v*_{s}/*a*_{p}";

std::string name_of(const StudiedEnsemble& ensemble) {
  return "*a*_{p} = " + ensemble.radius;
}

Points error_bars(const StudiedEnsemble& ensemble, const MembersCurve& curve, std::size_t colour) {
  return {.x = curve.time,
          .y = curve.mean,
          .y_error = curve.deviation,
          .label = name_of(ensemble),
          .colour = palette_colour(colour),
          .size = 4};
}

MembersCurve in_radii(MembersCurve curve, double radius) {
  for (double& value : curve.mean) value /= radius;
  for (double& value : curve.deviation) value /= radius;
  return curve;
}

/// The widths of the heads of all members at the end, in a.
std::vector<double> widths_at_end(const StudiedEnsemble& ensemble) {
  std::vector<double> widths;
  for (const AvalancheRun& run : ensemble.runs)
    for (const double width : run.frames.back().head_widths) widths.push_back(width / run.scales.mean_radius);
  return widths;
}

double largest(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

figure::Line straight(const std::string& label, double slope, double intercept, double to) {
  return {.x = {0, to},
          .y = {intercept, intercept + slope * to},
          .label = label,
          .colour = ink,
          .dash = Dash::dashed,
          .width = 1};
}

}  // namespace

Radii radii_of(const std::vector<StudiedEnsemble>& ensembles, const std::string& case_name) {
  Radii radii;
  for (const StudiedEnsemble& ensemble : ensembles)
    if (ensemble.case_name == case_name && !ensemble.runs.empty()) radii.push_back(&ensemble);
  std::sort(radii.begin(), radii.end(), [](const StudiedEnsemble* a, const StudiedEnsemble* b) {
    return a->runs.front().scales.mean_radius < b->runs.front().scales.mean_radius;
  });
  return radii;
}

MembersCurve members_curve(const StudiedEnsemble& ensemble, double AvalancheFrame::*number, std::size_t first) {
  MembersCurve curve;
  std::size_t frames = ensemble.runs.front().frames.size();
  for (const AvalancheRun& run : ensemble.runs) frames = std::min(frames, run.frames.size());
  for (std::size_t n = first; n < frames; ++n) {
    std::vector<double> times, values;
    for (const AvalancheRun& run : ensemble.runs) {
      times.push_back(run.frames[n].time);
      if (const double value = run.frames[n].*number; std::isfinite(value)) values.push_back(value);
    }
    curve.time.push_back(mean(times));
    curve.mean.push_back(mean(values));
    curve.deviation.push_back(standard_deviation(values));
  }
  return curve;
}

Chart front_speeds(const Radii& radii, double printed_low, double printed_high) {
  Chart chart{.x = {.label = time_label, .low = 0}, .y = {.label = "front speed *ṽ*_{f}"}};
  if (printed_low < printed_high)
    chart.series.push_back(figure::Reference{.low = printed_low, .high = printed_high, .label = "printed range"});
  for (std::size_t k = 0; k < radii.size(); ++k) {
    std::vector<Curve> curves;
    for (const AvalancheRun& run : radii[k]->runs) curves.push_back(run.front_speed);
    const CurveSpread members = spread(common_part(std::move(curves)));
    chart.series.push_back(figure::Line{.x = members.mean.time,
                                        .y = members.mean.value,
                                        .spread = members.deviation,
                                        .label = name_of(*radii[k]),
                                        .colour = palette_colour(k)});
  }
  return chart;
}

Chart head_particles(const Radii& radii) {
  Chart chart{.x = {.label = time_label, .low = 0}, .y = {.label = "grains in the head", .low = 0}};
  for (std::size_t k = 0; k < radii.size(); ++k)
    chart.series.push_back(error_bars(*radii[k], members_curve(*radii[k], &AvalancheFrame::head_particles), k));
  return chart;
}

Chart head_sizes(const Radii& radii) {
  Chart chart{.x = {.label = time_label, .low = 0},
              .y = {.label = "width *w̃*_{h} (open), thickness *l̃*_{h} (filled)", .low = 0}};
  for (std::size_t k = 0; k < radii.size(); ++k) {
    const double radius = radii[k]->runs.front().scales.mean_radius;
    Points width = error_bars(*radii[k], in_radii(members_curve(*radii[k], &AvalancheFrame::head_width), radius), k);
    width.symbol = Symbol::circle;
    width.label.clear();
    chart.series.push_back(std::move(width));
    chart.series.push_back(
        error_bars(*radii[k], in_radii(members_curve(*radii[k], &AvalancheFrame::head_thickness), radius), k));
  }
  return chart;
}

Chart front_speed_of_head(const Radii& radii) {
  Chart chart{.x = {.label = "grains in the head", .low = 0}, .y = {.label = "front speed *ṽ*_{f}", .low = 0}};
  for (std::size_t k = 0; k < radii.size(); ++k) {
    const MembersCurve particles = members_curve(*radii[k], &AvalancheFrame::head_particles);
    const MembersCurve speed = members_curve(*radii[k], &AvalancheFrame::front_speed);
    chart.series.push_back(Points{.x = particles.mean,
                                  .y = speed.mean,
                                  .x_error = particles.deviation,
                                  .y_error = speed.deviation,
                                  .label = name_of(*radii[k]),
                                  .colour = palette_colour(k),
                                  .size = 4});
  }
  return chart;
}

Chart width_against_thickness(const Radii& radii) {
  Chart chart{.x = {.label = "thickness *l̃*_{h}", .low = 0}, .y = {.label = "width *w̃*_{h}", .low = 0}};
  double most = 0;
  for (std::size_t k = 0; k < radii.size(); ++k) {
    const double radius = radii[k]->runs.front().scales.mean_radius;
    const MembersCurve width = in_radii(members_curve(*radii[k], &AvalancheFrame::head_width), radius);
    const MembersCurve thickness = in_radii(members_curve(*radii[k], &AvalancheFrame::head_thickness), radius);
    most = std::max(most, largest(thickness.mean));
    chart.series.push_back(Points{.x = thickness.mean,
                                  .y = width.mean,
                                  .x_error = thickness.deviation,
                                  .y_error = width.deviation,
                                  .label = name_of(*radii[k]),
                                  .colour = palette_colour(k),
                                  .size = 4});
  }
  chart.series.push_back(straight("*w̃*_{h} = 4 *l̃*_{h}, printed", 4, 0, most));
  return chart;
}

Chart width_distributions(const Radii& radii) {
  double most = 0;
  for (const StudiedEnsemble* ensemble : radii) most = std::max(most, largest(widths_at_end(*ensemble)));
  Chart chart{.x = {.label = "width *w̃*_{h}", .low = 0, .high = 1.6 * most + 1},  // the legend stands on the right
              .y = {.label = "probability density", .low = 0}};
  const double bin = 2;  // a_p
  const auto bins = static_cast<std::size_t>(std::ceil(most / bin)) + 1;
  for (std::size_t k = 0; k < radii.size(); ++k) {
    const std::vector<double> widths = widths_at_end(*radii[k]);
    if (widths.empty()) continue;
    const Histogram h = histogram(widths, 0, bin * static_cast<double>(bins), bins);
    figure::Line line{.label = name_of(*radii[k]), .colour = palette_colour(k)};
    for (std::size_t b = 0; b < bins; ++b) {
      line.x.push_back(h.middle(b));
      line.y.push_back(h.density(b));
    }
    chart.series.push_back(std::move(line));
    if (k + 1 < radii.size()) continue;
    const Gaussian fit = gaussian_of_least_squares(h);
    figure::Line gaussian{
        .label = "Gaussian fitted to " + radii[k]->radius, .colour = ink, .dash = Dash::dashed, .width = 1};
    for (int n = 0; n <= 120; ++n) {
      gaussian.x.push_back(bin * static_cast<double>(bins) * n / 120);
      gaussian.y.push_back(fit.density(gaussian.x.back()));
    }
    chart.series.push_back(std::move(gaussian));
  }
  return chart;
}

Chart width_against_radius(const Radii& radii) {
  Chart chart{.x = {.label = "radius *a*_{p}", .unit = "mm", .low = 0},
              .y = {.label = "width *w*_{h}", .unit = "mm", .low = 0}};
  Points points{.label = "heads at the end", .colour = palette_colour(0)};
  for (const StudiedEnsemble* ensemble : radii) {
    const std::vector<double> widths = widths_at_end(*ensemble);
    const double radius = 1000 * ensemble->runs.front().scales.mean_radius;
    points.x.push_back(radius);
    points.y.push_back(radius * mean(widths));
    points.y_error.push_back(radius * standard_deviation(widths));
  }
  const talus::Line fit = fit_line_through_origin(points.x, points.y);
  const double most = largest(points.x);
  chart.series.push_back(std::move(points));
  if (radii.size() > 1) chart.series.push_back(straight("line through the origin", fit.slope, 0, 1.1 * most));
  return chart;
}

Chart frontal_angles(const Radii& radii) {
  Chart chart{.x = {.label = time_label, .low = 0},
              .y = {.label = "frontal angle *φ*_{f}", .unit = "°", .low = 0, .high = 120}};
  chart.series.push_back(figure::Reference{.low = 60, .high = 60, .label = "printed at the end"});
  for (std::size_t k = 0; k < radii.size(); ++k)
    chart.series.push_back(error_bars(*radii[k], members_curve(*radii[k], &AvalancheFrame::frontal_angle, 0), k));
  return chart;
}

}  // namespace talus::app

// SPDX-License-Identifier: Apache-2.0
#include "app/reproduction/niiya2020_curves.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/statistics.hpp"

namespace talus::app {

namespace {

using namespace figure;

constexpr double tick_of_time = 5;  // a/v_s: the axis ends at a multiple of it

/// The axis ends at a round time at or after the last one; the last snapshot is that after the end, by a step.
Axis time_axis(const Radii& radii) {
  double last = 0;
  for (const AvalancheEnsemble* ensemble : radii)
    for (const AvalancheRun& run : ensemble->runs)
      if (!run.frames.empty()) last = std::max(last, run.frames.back().time);
  Axis axis{.label = "time *t̃* = *t* *v*_{s}/*a*_{p}", .low = 0};
  if (last > 0) axis.high = tick_of_time * std::ceil((1 - 1e-3) * last / tick_of_time);
  return axis;
}

}  // namespace

Radii radii_of(const std::vector<AvalancheEnsemble>& ensembles, const std::string& case_name) {
  Radii radii;
  for (const AvalancheEnsemble& ensemble : ensembles)
    if (ensemble.case_name == case_name && !ensemble.runs.empty() && !ensemble.runs.front().frames.empty())
      radii.push_back(&ensemble);
  std::sort(radii.begin(), radii.end(), [](const AvalancheEnsemble* a, const AvalancheEnsemble* b) {
    return a->runs.front().scales.mean_radius < b->runs.front().scales.mean_radius;
  });
  return radii;
}

MembersCurve members_curve(const AvalancheEnsemble& ensemble, const FrameNumber& number, std::size_t first) {
  MembersCurve curve;
  std::size_t frames = ensemble.runs.front().frames.size();
  for (const AvalancheRun& run : ensemble.runs) frames = std::min(frames, run.frames.size());
  for (std::size_t n = first; n < frames; ++n) {
    std::vector<double> times, values;
    for (const AvalancheRun& run : ensemble.runs) {
      times.push_back(run.frames[n].time);
      if (const double value = number(run.frames[n]); std::isfinite(value)) values.push_back(value);
    }
    curve.time.push_back(mean(times));
    curve.mean.push_back(mean(values));
    curve.deviation.push_back(standard_deviation(values));
  }
  return curve;
}

MembersCurve members_curve_in_radii(const AvalancheEnsemble& ensemble, const FrameNumber& length, std::size_t first) {
  const double radius = ensemble.runs.front().scales.mean_radius;
  return members_curve(
      ensemble, [&](const AvalancheFrame& frame) { return length(frame) / radius; }, first);
}

std::string label_of(const AvalancheEnsemble& ensemble) {
  return "*a*_{p} = " + ensemble.radius;
}

Points points_of_radius(const AvalancheEnsemble& ensemble, std::size_t k, bool open) {
  constexpr Symbol filled_symbols[] = {Symbol::disc, Symbol::square, Symbol::triangle};
  constexpr Symbol open_symbols[] = {Symbol::circle, Symbol::open_square, Symbol::open_triangle};
  return {.label = label_of(ensemble),
          .colour = palette_colour(k),
          .symbol = (open ? open_symbols : filled_symbols)[k % 3],
          .size = 4.5};
}

Chart front_speeds(const Radii& radii, double printed_low, double printed_high) {
  Chart chart{.x = time_axis(radii), .y = {.label = "front speed *ṽ*_{f}"}};
  if (printed_low < printed_high)
    chart.series.push_back(figure::Reference{.low = printed_low, .high = printed_high, .label = "printed range"});
  for (std::size_t k = 0; k < radii.size(); ++k) {
    std::vector<Curve> curves;
    for (const AvalancheRun& run : radii[k]->runs) curves.push_back(run.front_speed);
    const CurveSpread members = spread(common_part(std::move(curves)));
    // The third is dashed, so that one below it is seen.
    chart.series.push_back(figure::Line{.x = members.mean.time,
                                        .y = members.mean.value,
                                        .spread = members.deviation,
                                        .label = label_of(*radii[k]),
                                        .colour = palette_colour(k),
                                        .dash = k == 2 ? Dash::dashed : Dash::solid});
  }
  return chart;
}

Chart over_time(const Radii& radii, Axis axis, const std::vector<DrawnNumber>& numbers, std::size_t first) {
  Chart chart{.x = time_axis(radii), .y = std::move(axis)};
  for (const DrawnNumber& drawn : numbers) {
    for (std::size_t k = 0; k < radii.size(); ++k) {
      const MembersCurve curve = drawn.in_radii ? members_curve_in_radii(*radii[k], drawn.number, first)
                                                : members_curve(*radii[k], drawn.number, first);
      Points points = points_of_radius(*radii[k], k, drawn.open);
      points.x = curve.time, points.y = curve.mean, points.y_error = curve.deviation;
      if (&drawn != &numbers.front()) points.label.clear();
      chart.series.push_back(std::move(points));
    }
  }
  for (const DrawnNumber& drawn : numbers)
    if (!drawn.label.empty())
      chart.series.push_back(Points{
          .label = drawn.label, .colour = ink, .symbol = drawn.open ? Symbol::circle : Symbol::disc, .size = 4.5});
  return chart;
}

Chart head_particles(const Radii& radii) {
  return over_time(radii, {.label = "grains in the head", .low = 0}, {{&AvalancheFrame::head_particles}});
}

Chart head_sizes(const Radii& radii) {
  return over_time(radii, {.label = "size of the head", .unit = "*a*_{p}", .low = 0},
                   {{.number = &AvalancheFrame::head_thickness, .label = "thickness *l̃*_{h}", .in_radii = true},
                    {.number = &AvalancheFrame::head_width, .label = "width *w̃*_{h}", .open = true, .in_radii = true}});
}

Chart head_aspect_ratios(const Radii& radii) {
  Chart chart = over_time(radii, {.label = "*w̃*_{h} / *l̃*_{h}", .low = 0, .high = 6.5},
                          {{[](const AvalancheFrame& frame) { return frame.head_width / frame.head_thickness; }}});
  chart.series.push_back(figure::Reference{.low = 4, .high = 4, .label = "printed"});
  return chart;
}

Chart thickness_ratios(const Radii& radii) {
  Chart chart = over_time(radii, {.label = "thickness, head over rear", .low = 0},
                          {{&AvalancheFrame::front_rear_thickness_ratio}});
  chart.series.push_back(figure::Reference{.low = 2, .high = 2, .label = "printed: more than 2"});
  return chart;
}

Chart frontal_angles(const Radii& radii) {
  Chart chart = over_time(radii, {.label = "frontal angle *φ*_{f}", .unit = "°", .low = 30, .high = 120},
                          {{&AvalancheFrame::frontal_angle}}, 0);
  chart.x.low = -1;  // the start is seen whole
  chart.series.push_back(figure::Reference{.low = 60, .high = 60, .label = "printed at the end"});
  return chart;
}

Chart head_curls(const Radii& radii) {
  return over_time(radii, {.label = "mean curl", .unit = "*v*_{s}/*a*_{p}"},
                   {{.number = &AvalancheFrame::head_curl_left, .label = "left half of the head"},
                    {.number = &AvalancheFrame::head_curl_right, .label = "right half", .open = true}});
}

Chart head_motions(const Radii& radii) {
  Chart chart =
      over_time(radii, {.label = "relative velocity", .unit = "*v*_{s}"},
                {{.number = &AvalancheFrame::head_rear_relative_velocity, .label = "rear, forwards"},
                 {.number = &AvalancheFrame::head_front_outward_velocity, .label = "front, outwards", .open = true}});
  chart.series.push_back(figure::Reference{});
  return chart;
}

Chart layer_motions(const Radii& radii) {
  Chart chart =
      over_time(radii, {.label = "*ṽ*_{x} − *ṽ*_{f}", .low = -16, .high = 1},
                {{.number = &AvalancheFrame::head_upper_relative_velocity, .label = "upper head"},
                 {.number = &AvalancheFrame::head_lower_relative_velocity, .label = "lower head", .open = true}});
  chart.series.push_back(figure::Reference{});
  return chart;
}

Chart tail_motions(const Radii& radii) {
  return over_time(radii, {.label = "*ṽ*_{x} − *ṽ*_{f} of the tail", .high = 0},
                   {{&AvalancheFrame::tail_relative_velocity}});
}

}  // namespace talus::app

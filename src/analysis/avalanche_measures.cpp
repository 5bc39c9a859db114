// SPDX-License-Identifier: Apache-2.0
/// The list of measures of a cloud of grains. A row: name, unit, what it means, how it is made; where a summary lists
/// it. Times in a/v_s, velocities over v_s.
#include <algorithm>
#include <cmath>

#include "analysis/avalanche_numbers.hpp"
#include "analysis/statistics.hpp"

namespace talus {

namespace {

using namespace avalanche;
using Run = AvalancheRun;
using Row = Measure<Run>;
using Number = Run::Numbers::Number;

constexpr double none = Run::none;

/// The datum nearest the window's time, of two the earlier; the start counts only where it is all there is.
double value_at_window(Number number, const Run& run, const Window& window) {
  const std::vector<double>& time = run.snapshots.time();
  if (time.empty()) return none;
  const double at = window.at.value_or(Window::end_of_run);
  const std::size_t first = std::min<std::size_t>(1, time.size() - 1);
  const std::size_t n = std::isinf(at) ? time.size() - 1 : first + nearest_point(std::span(time).subspan(first), at);
  return run.snapshots.value(n, number, {});
}

Estimator<Run> at(Number number) {
  return {[=](const Run& run, const Place&, const Window& w) { return value_at_window(number, run, w); }, number};
}

/// At the first of the data.
Estimator<Run> first_of(Number number) {
  return {[=](const Run& run, const Place&, const Window&) {
    return run.snapshots.time().size() > 1 ? run.snapshots.value(1, number, {}) : none;
  }};
}

Estimator<Run> of_front_speed(double (*of)(const Run& run, const Curve& within)) {
  return {[=](const Run& run, const Place&, const Window& w) {
    const Curve speed = part(run.front_speed, w.from, w.to);
    return speed.time.empty() ? none : of(run, speed);
  }};
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

Estimator<Run> of_aspect_ratio(double (*of)(const Curve& within)) {
  return {[=](const Run& run, const Place&, const Window& w) {
    Curve ratio = run.curve(head<&HeadSize::width>);
    const Curve thickness = run.curve(head<&HeadSize::thickness>);
    for (std::size_t n = 0; n < ratio.value.size(); ++n) ratio.value[n] /= thickness.value[n];
    ratio = part(ratio, w.from, w.to);
    return ratio.time.empty() ? none : of(ratio);
  }};
}

/// Rank correlation of the head's grains with the front speed over the data; if asked from the largest speed on.
double head_speed_correlation(const Run& run, bool from_largest) {
  const Curve speed = run.curve(front_speed), particles = run.curve(head_particles);
  const auto first = from_largest ? std::max_element(speed.value.begin(), speed.value.end()) - speed.value.begin() : 0;
  return spearman_correlation(std::span(particles.value).subspan(static_cast<std::size_t>(first)),
                              std::span(speed.value).subspan(static_cast<std::size_t>(first)));
}

bool on_slope(const Run& run) {
  return run.view == AvalancheView::from_above || run.view == AvalancheView::from_the_side;
}
bool from_above(const Run& run) {
  return run.view == AvalancheView::from_above;
}
bool from_the_side(const Run& run) {
  return run.view == AvalancheView::from_the_side;
}
bool falling(const Run& run) {
  return run.view == AvalancheView::falling;
}
bool always(const Run&) {
  return true;
}
Window second_half(const Run& run) {
  return {.from = 0.5 * run.end};
}
const std::vector<Row> list = {
    Row("front_speed_max", "1",
        "largest front speed over v_s. Front: the largest x of a grain's centre, seen from the side of those lower "
        "than 2 a; speed: its displacement over 0.25 a/v_s, one every 0.25 a/v_s",
        of_front_speed([](const Run&, const Curve& speed) { return extremes(speed).largest; }), {{on_slope}}),
    Row("front_speed_min", "1", "the least of them",
        of_front_speed([](const Run&, const Curve& speed) { return extremes(speed).least; }), {{on_slope}}),
    Row("front_speed_end", "1", "the last of them",
        of_front_speed([](const Run&, const Curve& speed) { return speed.value.back(); }), {{on_slope}}),
    Row("front_speed_max_time", "1", "time of the largest front speed, in a/v_s",
        of_front_speed([](const Run&, const Curve& speed) { return extremes(speed).largest_time; })),
    Row("front_speed_rise", "1", "largest front speed over the first one",
        of_front_speed(
            [](const Run& run, const Curve& s) { return extremes(s).largest / run.front_speed.value.front(); })),
    Row("front_speed_fall", "1", "largest front speed over that of the run's last 0.25 a/v_s",
        of_front_speed([](const Run& run, const Curve& s) { return extremes(s).largest / run.front_speed_last; })),
    Row("front_speed_slope_early", "1",
        "slope of the line through the first half of the front-speed curve, in v_s per a/v_s",
        of_front_speed([](const Run& run, const Curve&) { return slopes(run.front_speed).early; })),
    Row("front_speed_slope_change", "1", "that of the second half less it",
        of_front_speed(
            [](const Run& run, const Curve&) { return slopes(run.front_speed).late - slopes(run.front_speed).early; })),
    Row("front_speed", "1", "front speed over v_s at the snapshot", at(front_speed)),
    Row("head_count", "1",
        "number of heads: connected sets (link 4 a) of at least 5 grains whose n' is above a quarter of the largest in "
        "their part of the avalanche; n' is the sum of the neighbours' numbers of neighbours, within 4 a",
        at(head_count), {{from_above}}),
    Row("head_particles", "1", "grains of the largest head", at(head_particles), {{from_above}}),
    Row("head_width", "m", "width of the largest head across the slope, outer edge to outer edge",
        at(head<&HeadSize::width>), {{from_above}}),
    Row("head_thickness", "m",
        "of the largest head, from its foremost edge to the most advanced point of its rear boundary in the central "
        "half",
        at(head<&HeadSize::thickness>), {{from_above}}),
    Row("head_aspect_ratio", "1", "width over thickness of the largest head, mean over the snapshots",
        of_aspect_ratio([](const Curve& ratio) { return mean(ratio.value); }), {{from_above, second_half}}),
    Row("head_aspect_ratio_min", "1", "the least of them",
        of_aspect_ratio([](const Curve& ratio) { return extremes(ratio).least; })),
    Row("head_aspect_ratio_max", "1", "the largest of them",
        of_aspect_ratio([](const Curve& ratio) { return extremes(ratio).largest; })),
    Row("head_concavity", "1",
        "how far the head's rear boundary is ahead at its centre of its two sides, over the thickness; positive for a "
        "crescent",
        at(head<&HeadSize::concavity>)),
    Row("head_curl_left", "1", "mean curl of the velocity in the left half of the head, in v_s/a",
        at(head_curl<&HeadMotion::curl_left>)),
    Row("head_curl_right", "1", "mean curl of the velocity in the right half of the head, in v_s/a",
        at(head_curl<&HeadMotion::curl_right>)),
    Row("head_rear_relative_velocity", "1", "how much faster than the front the head's central rear runs, over v_s",
        at(head_motion<&HeadMotion::rear_relative_velocity>)),
    Row("head_front_outward_velocity", "1", "velocity away from the centre line in the head's front half, over v_s",
        at(head_motion<&HeadMotion::front_outward_velocity>)),
    Row("head_particles_first", "1", "share of the grains in the largest head at the first data",
        {[](const Run& r, const Place& p, const Window& w) {
          return first_of(head_particles).of(r, p, w) / r.grains;
        }}),
    Row("head_particles_half_time", "1", "time at which the largest head holds half of the grains, in a/v_s",
        {[](const Run& r, const Place&, const Window&) {
          return first_time_at_or_below(r.snapshots.curve(head_particles, {}), 0.5 * r.grains);
        }}),
    Row("head_particles_trend", "1", "rank correlation of the largest head's grains with time",
        {[](const Run& r, const Place&, const Window&) {
          const Curve data = r.curve(head_particles);
          return spearman_correlation(data.value, data.time);
        }}),
    Row("head_particles_front_speed_correlation", "1",
        "rank correlation of the largest head's grains with the front speed, from its largest value on",
        {[](const Run& r, const Place&, const Window&) { return head_speed_correlation(r, true); }}),
    Row("head_particles_front_speed_correlation_all", "1",
        "rank correlation of the largest head's grains with the front speed, over the whole run",
        {[](const Run& r, const Place&, const Window&) { return head_speed_correlation(r, false); }}),
    Row("front_rear_thickness_ratio", "1",
        "thickness of the head over the median thickness of the rear half, from the side",
        at(front_rear_thickness_ratio)),
    Row("head_upper_relative_velocity", "1", "how much faster than the front the upper head runs, over v_s",
        at(parts_motion<&HeadTailMotion::upper_head>)),
    Row("head_lower_relative_velocity", "1", "how much faster than the front the lower head runs, over v_s",
        at(parts_motion<&HeadTailMotion::lower_head>)),
    Row("tail_relative_velocity", "1", "how much faster than the front the tail runs, over v_s",
        at(parts_motion<&HeadTailMotion::tail>)),
    Row("frontal_angle", "deg",
        "seen from the side: angle between the slope behind the front and the line through the surface grains from the "
        "foremost up to the top; below 90 the front leans back",
        at(frontal_angle), {{from_the_side}}, {}, true),
    Row("frontal_angle_first", "deg", "frontal_angle at the first data", first_of(frontal_angle), {}, {}, true),
    Row("displacement_spread", "1",
        "largest difference of a grain's displacement from the mean, along x, over the mean; from the start on",
        {[](const Run& r, const Place&, const Window& w) { return value_at_window(displacement_spread, r, w); }}),
    Row("displacement_lateral", "1", "largest difference of a grain's displacement from the mean, along y, over a",
        {[](const Run& r, const Place&, const Window& w) { return value_at_window(displacement_lateral, r, w); }}),
    Row("fall_speed", "1", "mean velocity along gravity over v_s, of the grains that have not leaked", at(fall_speed)),
    Row("fall_speed_start", "1",
        "mean velocity along gravity over v_s at the start, of the grains that have not leaked",
        {[](const Run& r, const Place&, const Window&) {
          return r.snapshots.time().empty() ? none : r.snapshots.value(0, fall_speed, {});
        }},
        {{falling}}),
    Row("fall_speed_end", "1", "mean velocity along gravity over v_s at the end, of the grains that have not leaked",
        {[](const Run& r, const Place&, const Window& w) { return value_at_window(fall_speed, r, w); }}, {{falling}}),
    Row("leaked_fraction", "1", "share of the grains more than two initial radii behind the median of all",
        at(of_fall<&FallingCloud::leaked_fraction>), {{falling}}),
    Row("axial_density", "1",
        "grains within 0.3 of the lateral radius (that holds 90 %) of the axis, over those of an even disc: 1.27 for a "
        "sphere, below 1 for a torus",
        at(of_fall<&FallingCloud::axial_density>), {{falling}}),
    Row("flatness", "1", "root mean square lateral distance over √2 times that along gravity: 1 for a sphere",
        at(of_fall<&FallingCloud::flatness>), {{falling}}),
    Row("overlap_max", "1", "largest overlap of two grains, or of a grain and the slope, over a, at any step",
        {[](const Run& r, const Place&, const Window&) { return r.overlap_max; }}, {{always}}),
    Row("contact_weight_ratio", "1",
        "contact force at an overlap of 0.01 a over a grain's weight in the fluid: the γ of Niiya et al. 2020, Eq. 9",
        {[](const Run& r, const Place&, const Window&) { return r.contact_weight_ratio; }}),
};

}  // namespace

std::span<const Measure<Run>> avalanche_measures() {
  return list;
}

std::vector<MeasureText> texts_of_avalanche_measures() {
  return texts_of(avalanche_measures(), avalanche_group_measures());
}

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
/// The list of measures of a cloud of grains. A row: name, unit, what it means, how it is made; where a summary lists
/// it. Times in a/v_s, velocities over v_s.
#include <algorithm>
#include <cmath>

#include "analysis/avalanche.hpp"
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
  return run.snapshots.value(n, number);
}

Estimator<Run> at(Number number) {
  return {[=](const Run& run, const Window& w) { return value_at_window(number, run, w); }, number};
}

Estimator<Run> of_front_speed(double (*of)(const Curve& within)) {
  return {[=](const Run& run, const Window& w) {
    const Curve speed = part(run.front_speed, w.from, w.to);
    return speed.time.empty() ? none : of(speed);
  }};
}

/// Width over thickness of the largest head, mean over the snapshots after the start.
double head_aspect_ratio(const Run& run, const Window& window) {
  Curve ratio = run.snapshots.curve(head<&HeadSize::width>, 1);
  const Curve thickness = run.snapshots.curve(head<&HeadSize::thickness>, 1);
  for (std::size_t n = 0; n < ratio.value.size(); ++n) ratio.value[n] /= thickness.value[n];
  return mean(part(ratio, window.from, window.to).value);
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
        of_front_speed([](const Curve& speed) { return extremes(speed).max; }), {on_slope}),
    Row("front_speed_min", "1", "the smallest of them",
        of_front_speed([](const Curve& speed) { return extremes(speed).min; }), {on_slope}),
    Row("front_speed_end", "1", "the last of them",
        of_front_speed([](const Curve& speed) { return speed.value.back(); }), {on_slope}),
    Row("head_count", "1",
        "number of heads: connected sets (link 4 a) of at least 5 grains whose n' is above a quarter of the largest in "
        "their part of the avalanche; n' is the sum of the neighbours' numbers of neighbours, within 4 a",
        at(head_count), {from_above}),
    Row("head_particles", "1", "grains of the largest head", at(head_particles), {from_above}),
    Row("head_width", "m", "width of the largest head across the slope, outer edge to outer edge",
        at(head<&HeadSize::width>), {from_above}),
    Row("head_thickness", "m",
        "of the largest head, from its foremost edge to the most advanced point of its rear boundary in the central "
        "half",
        at(head<&HeadSize::thickness>), {from_above}),
    Row("head_aspect_ratio", "1", "width over thickness of the largest head, mean over the snapshots",
        {head_aspect_ratio}, {from_above, second_half}),
    Row("frontal_angle", "deg",
        "seen from the side: angle between the slope behind the front and the line through the surface grains from the "
        "foremost up to the top; below 90 the front leans back",
        at(frontal_angle), {from_the_side}, true),
    Row("fall_speed_start", "1",
        "mean velocity along gravity over v_s at the start, of the grains that have not leaked",
        {[](const Run& r, const Window&) {
          return r.snapshots.time().empty() ? none : r.snapshots.value(0, fall_speed);
        }},
        {falling}),
    Row("fall_speed_end", "1", "mean velocity along gravity over v_s at the end, of the grains that have not leaked",
        {[](const Run& r, const Window& w) { return value_at_window(fall_speed, r, w); }}, {falling}),
    Row("leaked_fraction", "1", "share of the grains more than two initial radii behind the median of all",
        at(of_fall<&FallingCloud::leaked_fraction>), {falling}),
    Row("axial_density", "1",
        "grains within 0.3 of the lateral radius (that holds 90 %) of the axis, over those of an even disc: 1.27 for a "
        "sphere, below 1 for a torus",
        at(of_fall<&FallingCloud::axial_density>), {falling}),
    Row("flatness", "1", "root mean square lateral distance over √2 times that along gravity: 1 for a sphere",
        at(of_fall<&FallingCloud::flatness>), {falling}),
    Row("overlap_max", "1", "largest overlap of two grains, or of a grain and the slope, over a, at any step",
        {[](const Run& r, const Window&) { return r.overlap_max; }}, {always}),
};

}  // namespace

std::span<const Measure<Run>> avalanche_measures() {
  return list;
}

std::vector<MeasureText> texts_of_avalanche_measures() {
  return texts_of(avalanche_measures());
}

}  // namespace talus

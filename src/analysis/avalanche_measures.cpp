// SPDX-License-Identifier: Apache-2.0
/// The list of measures of a cloud of grains. A row: name, unit, what it means, how it is made; where a summary lists
/// it. Times in a/v_s, velocities over v_s.
#include <algorithm>
#include <cmath>

#include "analysis/avalanche.hpp"
#include "analysis/statistics.hpp"

namespace talus {

namespace {

using Run = AvalancheRun;
using Row = Measure<Run>;
using Number = Run::Numbers::Number;

/// The datum nearest the window's time, of two the earlier; the start counts only where it is all there is.
double value_at_window(Number number, const Run& run, const Window& window) {
  const std::vector<double>& time = run.snapshots.time();
  if (time.empty()) return no_value;
  const double at = window.at.value_or(Window::end_of_run);
  const std::size_t first = std::min<std::size_t>(1, time.size() - 1);
  const std::size_t n = std::isinf(at) ? time.size() - 1 : first + nearest_point(std::span(time).subspan(first), at);
  return run.snapshots.value(n, number);
}

template <double FallingCloud::*of>
double number(const FallSnapshot& s) {
  return s.cloud.*of;
}
double fall_speed(const FallSnapshot& s) {
  return s.cloud.fall_speed / s.stokes_speed;
}

Estimator<Run> at(Number of) {
  return {[=](const Run& run, const Window& w) { return value_at_window(of, run, w); }, of};
}

Estimator<Run> of_front_speed(double (*of)(const Curve& within)) {
  return {[=](const Run& run, const Window& w) {
    const Curve speed = part(run.front_speed, w.from, w.to);
    return speed.time.empty() ? no_value : of(speed);
  }};
}

bool on_slope(const Run& run) {
  return run.motion == CloudMotion::on_slope;
}
bool falling(const Run& run) {
  return run.motion == CloudMotion::falling;
}
bool always(const Run&) {
  return true;
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
    Row("fall_speed_start", "1",
        "mean velocity along gravity over v_s at the start, of the grains that have not leaked",
        {[](const Run& r, const Window&) {
          return r.snapshots.time().empty() ? no_value : r.snapshots.value(0, fall_speed);
        }},
        {falling}),
    Row("fall_speed_end", "1", "mean velocity along gravity over v_s at the end, of the grains that have not leaked",
        {[](const Run& r, const Window& w) { return value_at_window(fall_speed, r, w); }}, {falling}),
    Row("leaked_fraction", "1", "share of the grains more than two initial radii behind the median of all",
        at(number<&FallingCloud::leaked_fraction>), {falling}),
    Row("axial_density", "1",
        "grains within 0.3 of the lateral radius (that holds 90 %) of the axis, over those of an even disc: 1.27 for a "
        "sphere, below 1 for a torus",
        at(number<&FallingCloud::axial_density>), {falling}),
    Row("flatness", "1", "root mean square lateral distance over √2 times that along gravity: 1 for a sphere",
        at(number<&FallingCloud::flatness>), {falling}),
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

// SPDX-License-Identifier: Apache-2.0
#include "analysis/hopper_estimators.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/discharge.hpp"
#include "analysis/spectrum.hpp"
#include "analysis/statistics.hpp"
#include "analysis/wall_loads.hpp"

namespace talus::hopper {

namespace {

constexpr double none = HopperRun::none;

// Of the averaging time: length and interval of the means whose maximum is sought, interval of data of which periods
// are, and the periods (the paper's: 6 ms, 0.2 ms; 5000 a second; 2 to 20 ms).
constexpr double extreme_mean = 0.3, extreme_every = 0.01, interval_of_data = 0.01, shortest_period = 0.1;
constexpr double begins_to_incline = 1;             // deg
constexpr double repose_printed = 30;               // deg
constexpr double begins_to_flow = 0.1, half = 0.5;  // of what passes the outlet
constexpr double plateau_spread = 0.1;

double end_of(const Window& window, const HopperRun& run) {
  return std::min(window.to, run.end());
}

/// The time that a window names, or the end; nan if the run ended before it, but for a few steps.
double time_of(const Window& window, const HopperRun& run) {
  const double at = window.at.value_or(Window::end_of_run), end = run.end();
  return at > end + averages(run).trend && !std::isinf(at) ? none : std::min(at, end);
}

std::vector<double> within(Number number, const HopperRun& run, const Place& place, const Window& window) {
  return part(run.curve(number, place), window.from, window.to).value;
}

/// The curve up to its first value after `from` that is not finite: the place has run empty.
Curve while_there_are_grains(Curve curve, double from) {
  std::size_t n = 0;
  while (n < curve.time.size() && (curve.time[n] <= from || std::isfinite(curve.value[n]))) ++n;
  curve.time.resize(n);
  curve.value.resize(n);
  return curve;
}

/// A hundred data in T over the window, or as much of it as there are grains at the place; none if that is not half.
Curve swinging_part(const HopperRun& run, std::string_view column, const Window& window) {
  const Curve whole = run.curve(column);
  const Curve curve = while_there_are_grains(whole, window.from);
  if (!covers(curve, window.from, 0.5 * (window.from + window.to))) return {};
  return at_equal_times(curve, 1 / (interval_of_data * run.setting.averaging_time), window.from,
                        std::min(window.to, curve.time.back()));
}

double first_time_at_or_above(const Curve& curve, double level) {
  return first_time_at_or_below(scaled(curve, -1), -level);
}

/// Means over a length of time of a curve that has data now and then.
std::vector<double> coarse_means(const Curve& curve, double length) {
  std::map<long, std::vector<double>> groups;
  for (std::size_t n = 0; n < curve.time.size(); ++n)
    groups[std::lround(std::floor(curve.time[n] / length))].push_back(curve.value[n]);
  std::vector<double> means;
  for (const auto& [group, values] : groups) means.push_back(mean(values));
  return means;
}

}  // namespace

Window while_it_flows(const HopperRun& run) {
  const Curve mass = discharged_mass(run);
  const double all = mass.value.empty() ? 0 : mass.value.back();
  if (!(all > 0)) return {.at = 0.5 * run.end(), .from = 0.5 * run.end(), .to = run.end()};
  const double from = first_time_at_or_above(mass, begins_to_flow * all), to = first_time_at_or_above(mass, half * all);
  return {.at = 0.5 * (from + to), .from = from, .to = to};
}

namespace {

/// M and what has come in, kg.
double mass_at_end(const HopperRun& run) {
  const Curve fed = run.curve("fed_mass");
  return run.setting.mass() + (fed.value.empty() ? 0 : fed.value.back());
}

}  // namespace

FlowEnd flow_end(const HopperRun& run) {
  constexpr double hardly = 0.01, emptied = 0.99, rest = 3;  // rest: of the time scale
  const Curve mass = discharged_mass(run), share = discharged_share(run);
  if (mass.value.empty()) return {};
  const double end = run.end(), length = std::min(run.setting.time_scale, 0.25 * end);
  const auto at_end = [](const Curve& curve) { return curve.value.back(); };
  const double passed = at_end(mass);
  FlowEnd flow{.discharged = at_end(share), .left = std::max(0.0, mass_at_end(run) - passed)};
  if (!(passed > 0) || !(length > 0)) return flow;
  const Curve means = mean_rates(mass, length, 0.25 * length, 0, end);
  double largest = run.setting.hand_discharge;
  for (const double mean : means.value) largest = std::max(largest, mean);
  double last = 0;  // end of the last window through which grains passed
  for (std::size_t n = 0; n < means.value.size(); ++n)
    if (means.value[n] > hardly * largest) last = std::min(end, means.time[n] + 0.5 * length);
  if (!(last > 0)) return flow;
  flow.state = flow.discharged >= emptied ? FlowState::has_emptied : FlowState::flows;
  if (end - last < rest * run.setting.time_scale) return flow;
  if (flow.state == FlowState::flows) flow.state = FlowState::has_stopped;
  flow.stop_time = first_time_at_or_above(mass, value_at(mass, std::max(last, mass.time.front())));
  return flow;
}

Plateau steady_discharge(const HopperRun& run) {
  const Curve share = discharged_share(run);
  if (share.value.empty()) return {};
  const double from = first_time_at_or_above(share, steady_from);
  if (!std::isfinite(from)) return {};
  // A vessel that is fed stays full: its share discharged says nothing of its height.
  const bool is_fed = mass_at_end(run) > run.setting.mass();
  const double low = is_fed ? none : first_time_at_or_above(share, steady_to);
  const Curve passed = passed_mass(run);
  const Plateau found =
      find_plateau(passed, run.setting.averaging_time, plateau_spread, from, std::isfinite(low) ? low : run.end());
  if (!std::isfinite(found.value)) return found;
  return found.value * (found.to - found.from) >= steady_least * mass_at_end(run) ? found : Plateau{};
}

double value_at_window(Number number, const HopperRun& run, const Place& place, const Window& window) {
  const std::vector<double>& time = run.snapshots.time();
  if (time.empty()) return none;
  const double at = window.at.value_or(Window::end_of_run), last = time.back();
  if (std::isinf(at)) return run.snapshots.value(time.size() - 1, number, place);
  const double interval = time.size() > 1 ? last - time[time.size() - 2] : 0;
  return at > last + 0.5 * interval ? none : run.snapshots.value(nearest_point(time, at), number, place);
}

Estimator<HopperRun> at(Number number) {
  return {[=](const HopperRun& run, const Place& p, const Window& w) { return value_at_window(number, run, p, w); },
          number};
}

Estimator<HopperRun> largest_of(Number number) {
  return {[=](const HopperRun& run, const Place& p, const Window& w) { return quantile(within(number, run, p, w), 1); },
          number};
}

Estimator<HopperRun> mean_of(Number number) {
  return {[=](const HopperRun& run, const Place& p, const Window& w) { return mean(within(number, run, p, w)); },
          number};
}

Estimator<HopperRun> period_of(std::string_view column) {
  return {[=](const HopperRun& run, const Place&, const Window& window) {
    const Curve part = swinging_part(run, column, window);
    const double longest = run.setting.averaging_time;
    return part.time.empty() ? none : dominant_period(part, shortest_period * longest, longest);
  }};
}

Estimator<HopperRun> crossing_period_of(std::string_view column) {
  return {[=](const HopperRun& run, const Place&, const Window& window) {
    const Curve part = swinging_part(run, column, window);
    return crossing_period(about_running_mean(part, averages(run).largest, window.from, window.to));
  }};
}

double narrowing(const HopperRun& run, const Place& place, const Window& window) {
  const double free = length_of(place, "below_from");
  const auto width = [&](const char* from, const char* to) {
    return mean(within(stream_width, run,
                       {{"from", length_of(place, from)}, {"to", length_of(place, to)}, {"free", free}}, window));
  };
  return width("below_from", "below_to") / width("above_from", "above_to");
}

double foot_speed(const HopperRun& run, const Place& place, const Window& window) {
  const Curve reach = part(run.curve(foot_reach, place), window.from, window.to);
  Curve between;
  for (std::size_t n = 0; n < reach.time.size(); ++n)
    if (reach.value[n] >= length_of(place, "from") && reach.value[n] <= length_of(place, "to")) {
      between.time.push_back(reach.time[n]);
      between.value.push_back(reach.value[n]);
    }
  return between.time.size() < 3 ? none : fit_line(between.time, between.value).slope;
}

LargestMean largest_discharge(const HopperRun& run, const Window& window) {
  const Averages of = averages(run);
  const Curve means = mean_rates(passed_mass(run), of.largest, of.largest_every, window.from, end_of(window, run));
  if (means.time.empty()) return {};
  const Extremes found = extremes(means);
  return {found.largest, found.largest_time};
}

double discharge_share_of_largest(const HopperRun& run, const Place&, const Window& window) {
  const Curve passed = passed_mass(run),
              means = mean_rates(passed, window.to - window.from, averages(run).largest_every, 0, run.end());
  return means.time.empty() ? none : mean_rate(passed, window.from, window.to) / extremes(means).largest;
}

double extreme_time(const Curve& cumulative, const HopperRun& run, const Window& window) {
  const double length = extreme_mean * run.setting.averaging_time, every = extreme_every * run.setting.averaging_time;
  return first_maximum_time(mean_rates(cumulative, length, every, window.from, end_of(window, run)), length);
}

double discharge_fall(const HopperRun& run, const Place&, const Window& window) {
  const Curve passed = passed_mass(run);
  return mean_rate(passed, window.from, window.to) - mean_rate(passed, 2 * window.from - window.to, window.from);
}

double share_at(const HopperRun& run, const Place&, const Window& window) {
  const Curve share = discharged_share(run);
  const double at = time_of(window, run);
  return covers(share, at, at) ? value_at(share, at) : none;
}

double floor_arrival(const HopperRun& run, const Place&, const Window&) {
  return first_time_at_or_above(run.curve("mass_near_floor"), 1e-3 * run.setting.mass());
}

double settled_force(const HopperRun& run) {
  double force = 0;
  for (const std::string& wall : walls_of(run.series))
    if (wall == "floor" || wall == "plate")
      force -= wall_force(run.series, wall, run.gate_time - averages(run).load, run.gate_time).z;
  return force;
}

double settled_stress_ratio(const HopperRun& run, const Place& place, const Window&) {
  const std::vector<double>& time = run.snapshots.time();
  std::size_t settled = 0;
  for (std::size_t n = 0; n < time.size(); ++n)
    if (time[n] <= 0) settled = n;
  return !time.empty() && time[settled] <= averages(run).load ? run.snapshots.value(settled, stress_ratio, place)
                                                              : none;
}

double balance_error(const HopperRun& run, const Place&, const Window& window) {
  const double to = run.gate_time + time_of(window, run);
  return weight_balance_error(run.series, run.setting.mass() * run.setting.gravity, to - averages(run).load, to);
}

double largest_fall(const Curve& angle, double length) {
  std::size_t first = 0;
  while (first < angle.value.size() && angle.value[first] <= begins_to_incline) ++first;
  if (first == angle.value.size()) return none;
  double largest = angle.value[first], fall = 0;
  for (const double mean : coarse_means(part(angle, angle.time[first], Window::end_of_run), length)) {
    largest = std::max(largest, mean);
    fall = std::max(fall, largest - mean);
  }
  return fall;
}

double repose(const HopperRun& run, const Window& window, bool nearer) {
  const double bin = value_at_window(repose_angle_in<Where::bin, &ReposeAngle::mean>, run, {}, window);
  const double hopper = value_at_window(repose_angle_in<Where::hopper, &ReposeAngle::mean>, run, {}, window);
  if (std::isnan(bin) || std::isnan(hopper)) return nearer ? std::fmax(bin, hopper) : none;
  const bool bin_is_nearer = std::abs(bin - repose_printed) <= std::abs(hopper - repose_printed);
  return bin_is_nearer == nearer ? bin : hopper;
}

namespace {

/// Mean over the members, of which the kth of one group stands beside the kth of the other, the fewer again from the
/// first on.
template <class Number>
double mean_over_members(Pair runs, const Number& of) {
  const std::size_t count = std::max(runs[0].size(), runs[1].size());
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) sum += of(runs[0][k % runs[0].size()], runs[1][k % runs[1].size()]);
  return sum / static_cast<double>(count);
}

double ratio_of_rates(const HopperRun& first, const HopperRun& second, const Window& window) {
  const LargestMean largest = largest_discharge(first, window);
  const double half_mean = 0.5 * averages(first).largest;
  const double from = largest.time - half_mean, to = largest.time + half_mean;
  return largest.value / mean_rate(passed_mass(second), from, to);
}

double share_in_which_larger(const HopperRun& first, const HopperRun& second, const Window& window) {
  const double to = std::min({window.to, first.end(), second.end()});
  const Averages of = averages(first);
  const Curve a = mean_rates(passed_mass(first), of.largest, of.largest_every, window.from, to);
  const Curve b = mean_rates(passed_mass(second), of.largest, of.largest_every, window.from, to);
  if (a.value.empty() || a.value.size() != b.value.size()) return none;
  double larger = 0;
  for (std::size_t n = 0; n < a.value.size(); ++n) larger += a.value[n] > b.value[n];
  return larger / static_cast<double>(a.value.size());
}

double largest_difference_of_shares(const HopperRun& first, const HopperRun& second, const Window& window) {
  const Curve a = discharged_share(first), b = discharged_share(second);
  const double to = std::min({window.to, first.end(), second.end()});
  double largest = none;
  for (std::size_t n = 0;; ++n) {
    const double t = window.from + static_cast<double>(n) * averages(first).largest_every;
    if (t > to) return largest;
    if (covers(a, t, t) && covers(b, t, t)) largest = std::fmax(largest, std::abs(value_at(a, t) - value_at(b, t)));
  }
}

}  // namespace

std::optional<double> ratio_at_largest(Pair runs, const Window& window) {
  return mean_over_members(runs, [&](const auto& a, const auto& b) { return ratio_of_rates(a, b, window); });
}

std::optional<double> share_of_larger(Pair runs, const Window& window) {
  return mean_over_members(runs, [&](const auto& a, const auto& b) { return share_in_which_larger(a, b, window); });
}

std::optional<double> largest_share_difference(Pair runs, const Window& window) {
  return mean_over_members(runs,
                           [&](const auto& a, const auto& b) { return largest_difference_of_shares(a, b, window); });
}

}  // namespace talus::hopper

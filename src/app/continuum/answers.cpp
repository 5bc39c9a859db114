// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "analysis/hopper.hpp"
#include "io/series.hpp"

namespace talus::app {

namespace {

using continuum::VesselPart;
using continuum::VesselShape;

constexpr double mass_flow = 0.99;  // of the particles move: measure share_that_moves

/// A quantity of the summary; nan if it has none.
double value_of(const std::vector<NamedValue>& quantities, std::string_view name) {
  const auto found =
      std::find_if(quantities.begin(), quantities.end(), [&](const NamedValue& q) { return q.name == name; });
  return found != quantities.end() ? found->value : HopperRun::none;
}

std::string formula_of_discharge(const continuum::Parameters& p) {
  const auto outlet = continuum::outlet_of_vessel(p);
  if (!outlet || !outlet->round) return "Beverloo, by the hydraulic diameter";
  return std::any_of(p.vessel.begin(), p.vessel.end(), [](const VesselPart& v) { return v.shape == VesselShape::cone; })
             ? "Beverloo; Rose & Tanaka"
             : "Beverloo";
}

/// Of each wall of the vessel the band with the largest pressure at rest.
std::vector<Answer> answers_of_walls(const continuum::Parameters& p, const std::filesystem::path& table) {
  if (!std::filesystem::exists(table)) return {};
  const Series loads = read_series(table);
  const auto patch = loads.column("patch"), low = loads.column("low"), high = loads.column("high"),
             pressure = loads.column("pressure_at_rest"), by_hand = loads.column("pressure_at_rest_by_hand");
  std::vector<Answer> answers;
  for (std::size_t v = 0; v < p.vessel.size(); ++v) {
    std::size_t largest = patch.size();
    for (std::size_t n = 0; n < patch.size(); ++n)
      if (patch[n] == static_cast<double>(v + 1) && pressure[n] > 0 && high[n] > low[n] &&
          (largest == patch.size() || pressure[n] > pressure[largest]))
        largest = n;
    if (largest == patch.size()) continue;
    Answer answer{
        .question = "largest pressure at rest, " + p.vessel[v].name,
        .answer = fmt::format("{:.3g} Pa at z = {:.3g} mm", pressure[largest], 500 * (low[largest] + high[largest])),
        .by_hand = {}};
    if (std::isfinite(by_hand[largest]))
      answer.by_hand = fmt::format("{:.3g} Pa ({})", by_hand[largest],
                                   p.vessel[v].shape == VesselShape::cone ? "Walker" : "Janssen");
    answers.push_back(std::move(answer));
  }
  return answers;
}

}  // namespace

std::vector<Answer> answers_of(const continuum::Parameters& p, const std::vector<NamedValue>& quantities,
                               const std::filesystem::path& run_folder) {
  if (p.vessel.empty()) return {};
  const auto value = [&](std::string_view name) { return value_of(quantities, name); };
  std::vector<Answer> answers;
  if (const double rate = value("discharge_steady"); std::isfinite(rate)) {
    answers.push_back(
        {"steady discharge", fmt::format("{:.3g} ± {:.2g} kg/s", rate, value("discharge_steady_error")), {}});
    if (const double hand = value("discharge_rate_beverloo"); hand > 0)
      answers.back().by_hand = fmt::format("{:.3g} kg/s ({})", hand, formula_of_discharge(p));
  }
  if (const double left = value("residual_fraction"); std::isfinite(left)) {
    const double time = value("emptying_time"), hand = value("emptying_time_by_hand");
    answers.push_back(
        {"99 % have left", std::isfinite(time) ? fmt::format("after {:.3g} s", time) : "not by the end", {}});
    if (hand > 0) answers.back().by_hand = fmt::format("{:.3g} s (at that discharge)", hand);
    answers.push_back({"above the outlet at the end", fmt::format("{:.1f} % of the bed", 100 * std::abs(left)), {}});
  }
  if (const double share = value("share_that_moves"); std::isfinite(share)) {
    answers.push_back(
        {share >= mass_flow ? "mass flow" : "funnel flow", fmt::format("{:.0f} % of it moves", 100 * share), {}});
    if (const double angle = value("mass_flow_half_angle_jenike"); std::isfinite(angle))
      answers.back().by_hand = fmt::format("mass flow up to {:.0f} degrees (Jenike)", angle);
  }
  if (const double error = value("weight_balance_error_at_rest"); std::isfinite(error))
    answers.push_back({"walls bear at rest", fmt::format("{:.1f} % of the weight", 100 * (1 + error)), "100 %"});
  std::vector<Answer> walls = answers_of_walls(p, run_folder / "analysis" / "wall_loads.csv");
  answers.insert(answers.end(), walls.begin(), walls.end());
  return answers;
}

}  // namespace talus::app

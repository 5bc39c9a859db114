// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "analysis/hopper.hpp"
#include "app/continuum/hand_formulas.hpp"
#include "io/series.hpp"

namespace talus::app {

namespace {

using continuum::VesselShape;

constexpr double hardly = 0.01;     // of the largest pressure
constexpr double mass_flow = 0.99;  // of the particles move: measure share_that_moves

/// A quantity of the summary; nan if it has none.
double value_of(const std::vector<NamedValue>& quantities, std::string_view name) {
  const auto found =
      std::find_if(quantities.begin(), quantities.end(), [&](const NamedValue& q) { return q.name == name; });
  return found != quantities.end() ? found->value : HopperRun::none;
}

/// Three digits, and the error to the same place.
std::string with_error(double number, double error) {
  const int places = number > 0 ? std::max(0, 2 - static_cast<int>(std::floor(std::log10(number)))) : 3;
  return fmt::format("{:.{}f} ± {:.{}f}", number, places, error, places);
}

std::string formula_of_discharge(const continuum::Parameters& p) {
  const auto outlet = continuum::outlet_of_vessel(p);
  if (!outlet || !outlet->round) return "Beverloo by the hydraulic diameter, flat bottom";
  return half_angle_of_cone(p) < std::numbers::pi / 4 ? "Beverloo; Rose & Tanaka" : "Beverloo";  // nan: no cone
}

const char* kind_of(bool all_moves) {
  return all_moves ? "mass flow" : "funnel flow";
}

/// Of each of several outlets what passes it.
std::vector<Answer> answers_of_outlets(const continuum::Parameters& p, const std::vector<NamedValue>& quantities) {
  std::vector<Answer> answers;
  for (const continuum::VesselOutlet& outlet : continuum::outlets_of_vessel(p)) {
    const double rate = value_of(quantities, "discharge_rate_" + outlet.name),
                 hand = value_of(quantities, "discharge_rate_beverloo_" + outlet.name);
    if (!std::isfinite(rate)) continue;
    answers.push_back({"steady discharge through " + outlet.name, fmt::format("{:.3g} kg/s", rate), {}});
    if (hand > 0) answers.back().by_hand = fmt::format("{:.3g} kg/s", hand);
  }
  return answers;
}

/// Of each wall of the vessel the band with the largest pressure at rest; walls that bear next to none are left out.
std::vector<Answer> answers_of_walls(const continuum::Parameters& p, const std::filesystem::path& table) {
  if (!std::filesystem::exists(table)) return {};
  const Series loads = read_series(table);
  const auto patch = loads.column("patch"), low = loads.column("low"), high = loads.column("high"),
             pressure = loads.column("pressure_at_rest"), by_hand = loads.column("pressure_at_rest_by_hand");
  const double most = std::accumulate(pressure.begin(), pressure.end(), 0.0,
                                      [](double a, double b) { return b > a ? b : a; });  // some may be nan
  std::vector<Answer> answers;
  for (std::size_t v = 0; v < p.vessel.size(); ++v) {
    std::size_t largest = patch.size();
    for (std::size_t n = 0; n < patch.size(); ++n)
      if (patch[n] == static_cast<double>(v + 1) && pressure[n] > hardly * most && high[n] > low[n] &&
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
    answers.push_back({"steady discharge", with_error(rate, value("discharge_steady_error")) + " kg/s", {}});
    if (const double hand = value("discharge_rate_beverloo"); hand > 0)
      answers.back().by_hand = fmt::format("{:.3g} kg/s ({})", hand, formula_of_discharge(p));
  }
  for (Answer& answer : answers_of_outlets(p, quantities)) answers.push_back(std::move(answer));
  if (const double left = value("residual_fraction"); std::isfinite(left)) {
    const double time = value("emptying_time"), hand = value("emptying_time_by_hand");
    answers.push_back(
        {"99 % have left", std::isfinite(time) ? fmt::format("after {:.3g} s", time) : "not by the end", {}});
    if (hand > 0) answers.back().by_hand = fmt::format("{:.3g} s (at the discharge by hand)", hand);
    answers.push_back({"above the outlet at the end", fmt::format("{:.1f} % of the bed", 100 * std::abs(left)), {}});
  }
  if (const double share = value("share_that_moves"); std::isfinite(share)) {
    answers.push_back(
        {"kind of flow", fmt::format("{}, {:.0f} % of the bed moves", kind_of(share >= mass_flow), 100 * share), {}});
    const double own = half_angle_of_cone(p) * 180 / std::numbers::pi, most = value("mass_flow_half_angle_jenike");
    if (std::isfinite(own) && std::isfinite(most))
      answers.back().by_hand =
          fmt::format("{}, {:.3g} degrees of at most {:.0f} (Jenike, grains of {:.3g} degrees in plane strain)",
                      kind_of(own <= most), own, most, internal_friction_by_hand(p) * 180 / std::numbers::pi);
  }
  if (const double error = value("weight_balance_error_at_rest"); std::isfinite(error))
    answers.push_back({"walls bear at rest", fmt::format("{:.1f} % of the weight", 100 * (1 + error)), "100 %"});
  std::vector<Answer> walls = answers_of_walls(p, run_folder / "analysis" / "wall_loads.csv");
  answers.insert(answers.end(), walls.begin(), walls.end());
  return answers;
}

}  // namespace talus::app

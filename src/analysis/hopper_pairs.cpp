// SPDX-License-Identifier: Apache-2.0
/// Two runs from a hopper against each other: with air and without, coarse and fine, soft and stiff.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "analysis/discharge.hpp"
#include "analysis/hopper_quantities.hpp"

namespace talus {

namespace {

constexpr double none = HopperFrame::none;
constexpr double length_of_mean = 20e-3, every = 1e-3;  // s, estimator.discharge_rate_comparison

double share_of_larger(const HopperRun& first, const HopperRun& second, const Window& window) {
  const double to = std::min({window.to, first.end(), second.end()});
  const Curve a = mean_rates(passed_mass(first), length_of_mean, every, window.from, to);
  const Curve b = mean_rates(passed_mass(second), length_of_mean, every, window.from, to);
  if (a.value.empty() || a.value.size() != b.value.size()) return none;
  double larger = 0;
  for (std::size_t n = 0; n < a.value.size(); ++n) larger += a.value[n] > b.value[n];
  return larger / static_cast<double>(a.value.size());
}

double ratio_at_largest(const HopperRun& first, const HopperRun& second, const Window& window) {
  const double time = hopper_quantity("discharge_rate_max_time", first, window);
  return hopper_quantity("discharge_rate_max", first, window) /
         mean_rate(passed_mass(second), time - 0.5 * length_of_mean, time + 0.5 * length_of_mean);
}

double largest_share_difference(const HopperRun& first, const HopperRun& second, const Window& window) {
  const Curve a = discharged_share(first), b = discharged_share(second);
  const double to = std::min({window.to, first.end(), second.end()});
  double largest = none;
  for (std::size_t n = 0;; ++n) {
    const double t = window.from + static_cast<double>(n) * every;
    if (t > to) return largest;
    if (covers(a, t, t) && covers(b, t, t)) largest = std::fmax(largest, std::abs(value_at(a, t) - value_at(b, t)));
  }
}

}  // namespace

double hopper_pair_quantity(std::string_view name, const HopperRun& first, const HopperRun& second,
                            const Window& window) {
  const auto ratio = [&](std::string_view of) {
    return hopper_quantity(of, first, window) / hopper_quantity(of, second, window);
  };
  const auto difference = [&](std::string_view of) {
    return hopper_quantity(of, first, window) - hopper_quantity(of, second, window);
  };
  if (name == "discharge_rate_max_ratio") return ratio("discharge_rate_max");
  if (name == "discharge_rate_ratio_at_max") return ratio_at_largest(first, second, window);
  if (name == "discharge_rate_share_larger") return share_of_larger(first, second, window);
  if (name == "discharge_resolution_difference") return largest_share_difference(first, second, window);
  if (name == "slit_velocity_fluctuation_ratio") return ratio("slit_velocity_fluctuation");
  // The stiffened run stands second; the ratio is its period over the other's.
  if (name == "period_stiffness_ratio") return 1 / ratio("period_discharge");
  if (name == "hopper_velocity_ratio") return ratio("hopper_velocity");
  if (name == "hopper_packing_ratio") return ratio("hopper_packing");
  if (name == "surface_slope_500ms_difference") return difference("surface_slope_500ms");
  if (name == "surface_slope_difference") return difference("surface_slope");
  throw std::out_of_range("'" + std::string(name) + "' is no quantity of two runs from a hopper");
}

}  // namespace talus

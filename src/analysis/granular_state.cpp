// SPDX-License-Identifier: Apache-2.0
#include "analysis/granular_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/curve.hpp"
#include "analysis/statistics.hpp"

namespace talus {

namespace {
constexpr double quasistatic = 1e-2;  // Yuu & Umekage 2011, section 2.1
constexpr double dense = 0.5;         // packing from which stresses act, section 5.1
}  // namespace

double inertial_number(double shear_rate, double pressure, double diameter, double grain_density) {
  if (!(pressure > 0)) return std::numeric_limits<double>::infinity();
  return shear_rate * diameter * std::sqrt(grain_density / pressure);
}

namespace {
/// \param rate particle -> rate of shear, 1/s
template <class Rate>
std::vector<double> inertial_numbers_of(const Snapshot& snapshot, Rate&& rate, double diameter, double grain_density) {
  const auto xx = snapshot.scalars("stress_xx"), yy = snapshot.scalars("stress_yy"), zz = snapshot.scalars("stress_zz");
  std::vector<double> numbers(snapshot.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    numbers[i] = inertial_number(rate(i), (xx[i] + yy[i] + zz[i]) / 3, diameter, grain_density);
  return numbers;
}
}  // namespace

std::vector<double> inertial_numbers(const Snapshot& snapshot, double diameter, double grain_density) {
  const auto rate = snapshot.scalars("shear_rate");
  return inertial_numbers_of(
      snapshot, [&](std::size_t i) { return rate[i]; }, diameter, grain_density);
}

double inertial_share(std::span<const double> inertial, const std::vector<bool>& taken, const MassRatios& weight) {
  double all = 0, slow = 0;
  for (std::size_t i = 0; i < inertial.size(); ++i) {
    if (!taken[i]) continue;
    all += weight[i];
    if (inertial[i] < quasistatic) slow += weight[i];
  }
  return all > 0 ? slow / all : no_value;
}

std::vector<bool> quasistatic_particles(const Snapshot& snapshot, std::span<const double> inertial,
                                        const QuasistaticRule& rule) {
  const auto zz = snapshot.scalars("stress_zz"), packing = snapshot.scalars("packing");
  std::vector<bool> chosen;
  for (std::size_t i = 0; i < zz.size(); ++i)
    chosen.push_back(packing[i] > rule.packing && inertial[i] < rule.inertial_number && zz[i] > rule.stress_zz);
  return chosen;
}

double stress_ratio(const Snapshot& snapshot, const std::vector<bool>& taken) {
  const auto xx = snapshot.scalars("stress_xx"), zz = snapshot.scalars("stress_zz");
  const MassRatios weight = snapshot.mass_ratios();
  double horizontal = 0, vertical = 0;
  for (std::size_t i = 0; i < xx.size(); ++i) {
    if (!taken[i]) continue;
    horizontal += weight[i] * xx[i];
    vertical += weight[i] * zz[i];
  }
  return vertical > 0 ? horizontal / vertical : no_value;
}

GradientSizes velocity_gradient_sizes(std::span<const Tensor3<>> gradients, std::span<const double> packing,
                                      double diameter, double gravity) {
  std::vector<double> shear, normal;
  const double unit = std::sqrt(diameter / gravity);
  for (std::size_t i = 0; i < packing.size(); ++i) {
    if (!(packing[i] > dense)) continue;
    const Tensor3<>& l = gradients[i];
    const auto largest = [&](std::initializer_list<double> components) {
      double size = 0;
      for (const double c : components) size = std::max(size, unit * std::abs(c));
      return size;
    };
    shear.push_back(largest({l.xy, l.xz, l.yx, l.yz, l.zx, l.zy}));
    normal.push_back(largest({l.xx, l.yy, l.zz}));
  }
  return {quantile(shear, 1), quantile(normal, 1)};
}

double density_drift(std::span<const double> density, std::span<const double> packing, double grain_density,
                     const std::vector<bool>& taken) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < density.size(); ++i)
    if (taken[i]) differences.push_back(std::abs(density[i] / (packing[i] * grain_density) - 1));
  return mean(differences);
}

double quantile_of(std::span<const double> values, const std::vector<bool>& taken, double probability) {
  std::vector<double> chosen;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (taken[i]) chosen.push_back(values[i]);
  return quantile(chosen, probability);
}

}  // namespace talus

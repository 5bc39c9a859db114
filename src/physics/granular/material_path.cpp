// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/material_path.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace talus::granular {

namespace {

/// Steps between two recorded points, so that none deforms or turns the point too far.
int steps_between(const PathStretch& stretch, const PathOptions& options) {
  const Tensor3<> spin = antisymmetric_part(stretch.velocity_gradient);
  const double rate = norm(symmetric_part(stretch.velocity_gradient));
  const double turn = std::sqrt(spin.xy * spin.xy + spin.yz * spin.yz + spin.zx * spin.zx);
  const double steps = stretch.duration / options.points * std::max(rate, turn / 1000) / options.largest_increment;
  return std::max(1, static_cast<int>(std::ceil(steps)));
}

template <class Law>
PathPoint record(double time, double density, const SymmetricTensor3<>& strain, MaterialPoint<Law> point) {
  PathPoint recorded{time, density, strain, point.stress, {}};
  Law::for_each_slot([&](HistorySlot, double& value) { recorded.history.push_back(value); }, point.history);
  return recorded;
}

template <class Law>
std::vector<PathPoint> follow(const Law& law, std::span<const PathStretch> path, const PathOptions& options) {
  MaterialPoint<Law> point{};
  SymmetricTensor3<> strain;
  double time = 0, density = options.density;
  std::vector<PathPoint> points{record<Law>(time, density, strain, point)};
  for (const PathStretch& stretch : path) {
    const double start = time, start_density = density, rate = trace(stretch.velocity_gradient);
    const int steps = steps_between(stretch, options);
    const double step = stretch.duration / options.points / steps;
    for (int k = 1; k <= options.points; ++k) {
      for (int n = 1; n <= steps; ++n) {
        density = start_density * std::exp(-rate * step * ((k - 1) * static_cast<double>(steps) + n));
        strain = transported_strain(strain, stretch.velocity_gradient, step);
        point = law.update(point, stretch.velocity_gradient, density, step);
      }
      time = start + stretch.duration * k / options.points;
      points.push_back(record<Law>(time, density, strain, point));
    }
  }
  return points;
}

}  // namespace

std::vector<HistorySlot> history_of(const AnyLaw& law) {
  return std::visit(
      []<class Law>(const Law&) {
        std::vector<HistorySlot> slots;
        typename Law::template History<double> history{};
        Law::for_each_slot([&](HistorySlot slot, double&) { slots.push_back(slot); }, history);
        return slots;
      },
      law);
}

std::vector<PathPoint> follow_path(const AnyLaw& law, std::span<const PathStretch> path, const PathOptions& options) {
  if (!(options.density > 0) || !(options.largest_increment > 0) || options.points < 1)
    throw std::invalid_argument("a path needs a positive density, increment and number of points");
  for (const PathStretch& stretch : path)
    if (!(stretch.duration >= 0) || !std::isfinite(stretch.duration))
      throw std::invalid_argument("a stretch of a path lasts a finite time, at least 0");
  return std::visit([&](const auto& one) { return follow(one, path, options); }, law);
}

double work_of_path(std::span<const PathStretch> path, std::span<const PathPoint> points) {
  const std::size_t each = path.empty() ? 0 : (points.size() - 1) / path.size();
  double work = 0;
  for (std::size_t s = 0; s < path.size(); ++s) {
    const SymmetricTensor3<> rate = symmetric_part(path[s].velocity_gradient);
    for (std::size_t k = s * each; k < (s + 1) * each; ++k) {
      const PathPoint &from = points[k], &to = points[k + 1];
      const auto power = [&](const PathPoint& point) {
        return -double_dot(point.stress, rate) * points[0].density / point.density;
      };
      work += 0.5 * (power(from) + power(to)) * (to.time - from.time);
    }
  }
  return work;
}

}  // namespace talus::granular

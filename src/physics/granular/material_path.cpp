// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/material_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "physics/granular/kinematics.hpp"

namespace talus::granular {

namespace {

/// Steps between two recorded points, so that none deforms or turns the point too far.
double steps_between(const PathStretch& stretch, const PathOptions& options) {
  const Tensor3<> spin = antisymmetric_part(stretch.velocity_gradient);
  const double rate = norm(symmetric_part(stretch.velocity_gradient));
  const double turn = std::sqrt(spin.xy * spin.xy + spin.yz * spin.yz + spin.zx * spin.zx);
  const double steps = stretch.duration / options.points * std::max(rate, turn / 1000) / options.max_increment;
  return std::max(1.0, std::ceil(steps));
}

template <class Law>
PathPoint record(double time, double density, const SymmetricTensor3<>& strain, MaterialPoint<Law> point) {
  PathPoint recorded{time, density, strain, point.stress, {}};
  Law::for_each_slot([&](HistorySlot, double& value) { recorded.history.push_back(value); }, point.history);
  return recorded;
}

/// F a time step later: exp(L dt) F, to the fourth order.
Tensor3<> deformed(const Tensor3<>& deformation, const Tensor3<>& velocity_gradient, double time_step) {
  Tensor3<> result = deformation, term = deformation;
  for (int k = 1; k <= 4; ++k) {
    term = (time_step / k) * (velocity_gradient * term);
    result = result + term;
  }
  return result;
}

/// The law over a step, with the strain from displacements if it requires that.
template <class Law>
MaterialPoint<Law> updated(const Law& law, const MaterialPoint<Law>& old, Tensor3<>& deformation,
                           const Tensor3<>& velocity_gradient, double density, double step) {
  if constexpr (requires { law.by_displacements(); })
    if (law.by_displacements()) {
      const Tensor3<> unit = full(isotropic(1.0));
      deformation = deformed(deformation, velocity_gradient, step);
      const auto point =
          law.update_at_strain(old, almansi_strain(deformation - unit), velocity_gradient, density, step);
      if (point.history.resets > old.history.resets) deformation = unit;
      return point;
    }
  return law.update(old, velocity_gradient, density, step);
}

template <class Law>
std::vector<PathPoint> follow(const Law& law, std::span<const PathStretch> path, const PathOptions& options) {
  MaterialPoint<Law> point{};
  SymmetricTensor3<> strain;
  Tensor3<> deformation = full(isotropic(1.0));  // since the last reset
  double time = 0, density = options.density;
  std::vector<PathPoint> points{record<Law>(time, density, strain, point)};
  for (const PathStretch& stretch : path) {
    const double start = time, start_density = density, rate = trace(stretch.velocity_gradient);
    const auto steps = static_cast<std::int64_t>(steps_between(stretch, options));
    const double step = stretch.duration / options.points / static_cast<double>(steps);
    for (int k = 1; k <= options.points; ++k) {
      for (std::int64_t n = 1; n <= steps; ++n) {
        density = start_density * std::exp(-rate * step * (static_cast<double>((k - 1) * steps + n)));
        strain = transported_strain(strain, stretch.velocity_gradient, step);
        point = updated(law, point, deformation, stretch.velocity_gradient, density, step);
      }
      time = start + stretch.duration * k / options.points;
      points.push_back(record<Law>(time, density, strain, point));
    }
  }
  return points;
}

}  // namespace

double steps_of_path(std::span<const PathStretch> path, const PathOptions& options) {
  double steps = 0;
  for (const PathStretch& stretch : path) steps += options.points * steps_between(stretch, options);
  return steps;
}

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
  if (!(options.density > 0) || !(options.max_increment > 0) || options.points < 1)
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

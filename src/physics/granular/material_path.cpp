// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/material_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "base/error.hpp"
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

constexpr double Tensor3<>::*controlled_rate[4] = {&Tensor3<>::xx, &Tensor3<>::yy, &Tensor3<>::zz, &Tensor3<>::xz};
constexpr double SymmetricTensor3<>::*controlled_stress[4] = {&SymmetricTensor3<>::xx, &SymmetricTensor3<>::yy,
                                                              &SymmetricTensor3<>::zz, &SymmetricTensor3<>::zx};
using Targets = std::array<std::optional<double>, 4>;  // Pa

double density_after(double density, const Tensor3<>& velocity_gradient, double step) {
  return density * std::exp(-trace(velocity_gradient) * step);
}

/// Up to four linear equations, by elimination with pivots. \returns false if they are singular
bool solve(std::array<std::array<double, 5>, 4>& rows, std::size_t n, std::array<double, 4>& x) {
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t r = k + 1; r < n; ++r)
      if (std::abs(rows[r][k]) > std::abs(rows[pivot][k])) pivot = r;
    std::swap(rows[k], rows[pivot]);
    if (!(std::abs(rows[k][k]) > 0)) return false;
    for (std::size_t r = k + 1; r < n; ++r)
      for (std::size_t c = n + 1; c-- > k;) rows[r][c] -= rows[r][k] / rows[k][k] * rows[k][c];
  }
  for (std::size_t k = n; k-- > 0;) {
    x[k] = rows[k][n];
    for (std::size_t c = k + 1; c < n; ++c) x[k] -= rows[k][c] * x[c];
    x[k] /= rows[k][k];
  }
  return true;
}

/// A step whose stress has prescribed components: Newton's method for the rates of these, with halved steps where the
/// law has a kink. \param gradient with a first guess of them; left as found \param modulus K of the law, Pa
template <class Law>
MaterialPoint<Law> controlled(const Law& law, const MaterialPoint<Law>& old, Tensor3<>& gradient, double& density,
                              const Targets& target, double step, double modulus, double time) {
  std::vector<std::size_t> unknown;
  double scale = 0;
  for (std::size_t k = 0; k < 4; ++k)
    if (target[k]) unknown.push_back(k), scale = std::max({scale, std::abs(*target[k]), norm(old.stress)});
  const double tolerance = 1e-8 * scale + 1e-12 * modulus, probe = -1e-9 / step;  // grains that just touch are pressed
  constexpr int max_iterations = 60, max_halvings = 12;
  using Misfit = std::array<double, 4>;
  const auto at = [&](const Tensor3<>& l, Misfit& misfit) {
    const auto point = law.update(old, l, density_after(density, l, step), step);
    double most = 0;
    for (std::size_t n = 0; n < unknown.size(); ++n) {
      misfit[n] = point.stress.*controlled_stress[unknown[n]] - *target[unknown[n]];
      most = std::fmax(most, std::abs(misfit[n]));
    }
    return std::pair{point, most};
  };
  Misfit misfit{}, probed{};
  auto [point, most] = at(gradient, misfit);
  for (int iteration = 0; iteration < max_iterations && most > tolerance; ++iteration) {
    std::array<std::array<double, 5>, 4> rows{};
    for (std::size_t c = 0; c < unknown.size(); ++c) {
      Tensor3<> other = gradient;
      other.*controlled_rate[unknown[c]] += probe;
      at(other, probed);
      for (std::size_t r = 0; r < unknown.size(); ++r) rows[r][c] = (probed[r] - misfit[r]) / probe;
    }
    for (std::size_t r = 0; r < unknown.size(); ++r) rows[r][unknown.size()] = -misfit[r];
    std::array<double, 4> change{};
    if (!solve(rows, unknown.size(), change)) break;
    double share = 1;
    for (int halving = 0;; ++halving, share *= 0.5) {
      Tensor3<> tried = gradient;
      for (std::size_t n = 0; n < unknown.size(); ++n) tried.*controlled_rate[unknown[n]] += share * change[n];
      Misfit misfit_tried{};
      const auto [point_tried, most_tried] = at(tried, misfit_tried);
      if (!(most_tried < most) && halving < max_halvings) continue;
      gradient = tried, misfit = misfit_tried, point = point_tried, most = most_tried;
      break;
    }
  }
  if (!(most <= tolerance))
    throw NumericalError(
        {.what = "the law bears no such stress",
         .term = "law " + std::string(Law::name) + " under a prescribed stress",
         .place = "one material point",
         .step = 0,
         .time = time,
         .advice = "less stress, path.packing left out, so that the grains just touch, a smaller path.max_increment"});
  density = density_after(density, gradient, step);
  return point;
}

template <class Law>
std::vector<PathPoint> follow(const Law& law, const PathPoint& from, std::span<const PathStretch> path,
                              const PathOptions& options) {
  MaterialPoint<Law> point{from.stress, {}};
  std::size_t slot = 0;
  const auto read = [&](HistorySlot, double& value) { value = from.history[slot++]; };
  if (!from.history.empty()) Law::for_each_slot(read, point.history);
  SymmetricTensor3<> strain = from.strain;
  Tensor3<> deformation = full(isotropic(1.0));  // since the last reset
  double time = from.time, density = from.density;
  const double speed = law.sound_speed(density), modulus = density * speed * speed;
  std::vector<PathPoint> points{record<Law>(time, density, strain, point)};
  for (const PathStretch& stretch : path) {
    const double start = time, start_density = density, rate = trace(stretch.velocity_gradient);
    const SymmetricTensor3<> start_stress = point.stress;
    Tensor3<> gradient = stretch.velocity_gradient;
    const auto steps = static_cast<std::int64_t>(steps_between(stretch, options));
    const double step = stretch.duration / options.points / static_cast<double>(steps);
    for (int k = 1; k <= options.points; ++k) {
      Tensor3<> sum{};
      for (std::int64_t n = 1; n <= steps; ++n) {
        const double done = static_cast<double>((k - 1) * steps + n);
        if (stretch.is_controlled() && step > 0) {
          const double share = done / static_cast<double>(options.points * steps);
          Targets target = stretch.stress;
          for (std::size_t c = 0; c < 4; ++c)
            if (target[c]) target[c] = std::lerp(start_stress.*controlled_stress[c], *target[c], share);
          point = controlled(law, point, gradient, density, target, step, modulus, start + step * done);
        } else {
          density = start_density * std::exp(-rate * step * done);
          point = updated(law, point, deformation, gradient, density, step);
        }
        strain = transported_strain(strain, gradient, step);
        sum = sum + gradient;
      }
      time = start + stretch.duration * k / options.points;
      points.push_back(record<Law>(time, density, strain, point));
      points.back().velocity_gradient =
          stretch.is_controlled() ? (1 / static_cast<double>(steps)) * sum : stretch.velocity_gradient;
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
  return follow_path(law, {.time = 0, .density = options.density, .strain = {}, .stress = {}, .history = {}}, path,
                     options);
}

std::vector<PathPoint> follow_path(const AnyLaw& law, const PathPoint& from, std::span<const PathStretch> path,
                                   const PathOptions& options) {
  if (!(from.density > 0) || !(options.max_increment > 0) || options.points < 1)
    throw std::invalid_argument("a path needs a positive density, increment and number of points");
  for (const PathStretch& stretch : path)
    if (!(stretch.duration >= 0) || !std::isfinite(stretch.duration))
      throw std::invalid_argument("a stretch of a path lasts a finite time, at least 0");
  return std::visit([&](const auto& one) { return follow(one, from, path, options); }, law);
}

double work_of_path(std::span<const PathStretch> path, std::span<const PathPoint> points) {
  const std::size_t each = path.empty() ? 0 : (points.size() - 1) / path.size();
  double work = 0;
  for (std::size_t s = 0; s < path.size(); ++s) {
    for (std::size_t k = s * each; k < (s + 1) * each; ++k) {
      const PathPoint &from = points[k], &to = points[k + 1];
      const SymmetricTensor3<> rate = symmetric_part(to.velocity_gradient);
      const auto power = [&](const PathPoint& point) {
        return -double_dot(point.stress, rate) * points[0].density / point.density;
      };
      work += 0.5 * (power(from) + power(to)) * (to.time - from.time);
    }
  }
  return work;
}

}  // namespace talus::granular

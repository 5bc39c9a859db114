// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace talus::continuum {

namespace {

/// A particle of no or of hardly any density reaches past plates and faces; one that jumps over its neighbours in a
/// step was thrown by stresses that cannot be.
struct Limits {
  const Box& box;
  double min_density;  // of a particle of State::mass, kg/m^3
  double max_speed;    // m/s

  Limits(const Parameters& p, const Domain& domain, const State& s, double dt)
      : box(domain.box()),
        min_density(p.sph.smoothing == Smoothing::fixed
                        ? 0
                        : s.mass * std::pow(0.5 * (domain.max_reach() - p.integration.skin * p.bed.spacing) /
                                                p.sph.smoothing_ratio,
                                            -3)),
        max_speed(p.bed.spacing / dt) {}

  bool allow_density(const State& s, std::size_t i) const {
    const double value = s.density[i];
    return value > size_ratio(s.ratios()[i]) * min_density && std::isfinite(value);
  }
  /// What has left the box falls on, and meets nobody.
  bool allow_velocity(const Vector3& v, const Vector3& x) const {
    const double speed = norm(v);
    return speed <= max_speed || (std::isfinite(speed) && !box.contains(x));
  }
};

NumericalError::Report report_at(const Parameters& p, const State& s, const Limits& limits, std::size_t i) {
  const Vector3& x = s.position[i];
  const bool density = !limits.allow_density(s, i);
  const double speed = norm(s.velocity[i]);
  const bool left = !limits.box.contains(x);
  const bool can_be_removed = left && !p.removal.outside && !p.air.enabled;
  return {.what = density                ? fmt::format("the bulk density is {:.4g} kg/m3", s.density[i])
                  : std::isfinite(speed) ? fmt::format("the speed is {:.4g} m/s, more than a spacing a step", speed)
                                         : "the velocity is not finite",
          .term = density ? "continuity, Eq. 16" : "momentum, Eq. 17",
          .place = fmt::format("particle {} at ({:.6g}, {:.6g}, {:.6g}) m{}", s.identity[i], x.x, x.y, x.z,
                               left ? ", outside the box" : ""),
          .step = s.step,
          .time = s.time,
          .advice = fmt::format("{}a smaller {}, a larger sph.viscosity_alpha",
                                can_be_removed ? "removal.outside = true, which takes away what has left; " : "",
                                p.integration.step ? "integration.step" : "integration.courant")};
}

}  // namespace

std::optional<std::size_t> find_fault(ThreadTeam& team, const Parameters& p, const Domain& domain, const Share& share,
                                      const State& s, double dt) {
  const Limits limits(p, domain, s, dt);
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  const std::size_t first = reduce(
      team, s.position.size(), none,
      [&](std::size_t i) {
        const bool allowed = limits.allow_velocity(s.velocity[i], s.position[i]) && limits.allow_density(s, i);
        return allowed || !share.owns(i) ? none : i;
      },
      [](std::size_t a, std::size_t b) { return std::min(a, b); });
  return first == none ? std::nullopt : std::optional(first);
}

NumericalError::Report report_of(const Parameters& p, const Domain& domain, const State& s, double dt, std::size_t i) {
  return report_at(p, s, Limits(p, domain, s, dt), i);
}

}  // namespace talus::continuum

// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/cloud/parameters.hpp"
#include "numerics/runge_kutta.hpp"

namespace talus::cloud {

namespace {

constexpr double max_steps = 1e12;  // at a microsecond each, twelve days
constexpr double impact_steps = 7;  // over integration.overlap_growth
constexpr double max_impact_steps = 1e6;
// Steps of Dormand and Prince's pair are held by the tolerance, not by max_step; measured on a disc of 100 grains
// without contacts, the steps that are tried again included.
constexpr double dormand_prince_steps = 1.8;
constexpr double dormand_prince_evaluations = 8;
constexpr double impact_time = 4;              // in a_p/v_s
constexpr double impact_stages = 10;           // of those steps
constexpr double contact_rate_on_slope = 3.2;  // over contact_rate(), in a plane
// The same in space over the number of grains to this power: heaps of 60 to 10,000 grains, whose evaluations it gives
// within 1.4 times.
constexpr double contact_rate_in_heap = 0.2, heap_power = 0.53;
constexpr double stiffness_estimates = 0.4;  // evaluations a step, of one in five

bool lies_on_slope(const Parameters& p) {
  return p.slope.enabled && p.contact.enabled && p.motion != Motion::xy;
}

double max_rate(const Parameters& p, double grains) {
  const double floor = contact_rate(p);
  if (!lies_on_slope(p) || p.fluid.mobility == hydrodynamics::Mobility::none) return floor;
  return floor * (p.motion == Motion::xyz ? std::max(1.0, contact_rate_in_heap * std::pow(grains, heap_power))
                                          : contact_rate_on_slope);
}

double max_step(const Parameters& p, double rate) {
  const double step = p.integration.max_step * scales(p).stokes_time;
  return rate > 0 ? std::min(step, max_stable_step(p, rate)) : step;
}

/// \param stiffness the step times the stiffest rate
double evaluations_of_step(const Parameters& p, double stiffness) {
  if (p.integration.method == Method::dormand_prince) return dormand_prince_evaluations;
  return p.integration.method == Method::euler || !(stiffness < 1e12) ? 1 : stages_for(stiffness, stage_damping);
}

}  // namespace

Forecast forecast(const Parameters& p, double end, double grains) {
  const double rate = max_rate(p, grains);
  const double step = max_step(p, rate);
  const double stages = evaluations_of_step(p, step * rate);
  const double more = p.integration.method == Method::dormand_prince ? dormand_prince_steps : 1;
  Forecast f{.steps = std::ceil(more * end / step), .evaluations = 0};
  f.evaluations = f.steps * (stages + stiffness_estimates);
  if (lies_on_slope(p)) {
    const double share = 1 - std::exp(-end / (impact_time * scales(p).stokes_time));
    const double steps = std::round(share * std::min(impact_steps / p.integration.overlap_growth, max_impact_steps));
    f.steps += steps;
    f.evaluations += steps * std::min(stages, impact_stages);
  }
  return f;
}

std::optional<Problem> check_steps(const Parameters& p, double end) {
  const double time = scales(p).stokes_time, step = max_step(p, max_rate(p, 1));
  if (!(time > 0 && std::isfinite(time)))
    return Problem{.key = "particles.radius",
                   .what = fmt::format("the unit of time a_p/v_s is {} s (particles.density, fluid.density, "
                                       "fluid.viscosity, gravity.acceleration)",
                                       time),
                   .allowed = "grains with a Stokes speed"};
  if (end / step <= max_steps) return std::nullopt;
  return Problem{.key = "run.end",
                 .what = fmt::format("{:.3g} s takes {:.2g} steps of at most {:.2g} s (integration.max_step of "
                                     "a_p/v_s, which fluid.viscosity and the grains' weight make {:.2g} s)",
                                     end, end / step, step, scales(p).stokes_time),
                 .allowed = fmt::format("at most {:.2g} s: {:.0e} steps", max_steps * step, max_steps)};
}

double memory_of(double grains) {
  return 22e6 + 1500 * grains;  // libraries; columns, packed copies, accumulators and contacts of a grain
}

Grains sample(const Parameters& p, std::size_t count) {
  const double spacing = 2.02 * p.particles.radius;
  const bool plane = p.motion != Motion::xyz;
  const auto side = static_cast<std::size_t>(std::ceil(std::pow(static_cast<double>(count), plane ? 0.5 : 1.0 / 3)));
  Grains grains;
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t row = n / side, layer = row / side;
    const double i = static_cast<double>(n % side), j = static_cast<double>(row % side), k = static_cast<double>(layer);
    const double x = i * spacing, across = (j + 0.5) * spacing;
    grains.position.push_back(p.motion == Motion::xy   ? Vector3{x, across, 0}
                              : p.motion == Motion::xz ? Vector3{x, 0, across}
                                                       : Vector3{x, across, (k + 0.5) * spacing});
  }
  grains.radius.assign(count, p.particles.radius);
  return grains;
}

}  // namespace talus::cloud

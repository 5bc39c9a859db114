// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/hopper_design.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/unit.hpp"
#include "physics/granular/silo.hpp"

namespace talus::granular {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double least_flow_factor = 1.1;
constexpr double air_density = 1.204, air_viscosity = 1.82e-5;  // SI

/// A wall rougher than the grains counts as rough as they.
double wall_angle(double friction, double internal) {
  return std::min(std::atan(friction), internal);
}

/// Where a function that rises passes 0 between two positive numbers.
template <class Function>
double crossing(Function&& rising, double low, double high) {
  for (int n = 0; n < 200; ++n) {
    const double middle = std::sqrt(low * high);
    (rising(middle) > 0 ? high : low) = middle;
  }
  return std::sqrt(low * high);
}

double area_of(HopperShape shape, double width, double length) {
  return shape == HopperShape::cone ? 0.25 * pi * width * width : width * length;
}

}  // namespace

double mass_flow_half_angle(HopperShape shape, double friction, double internal) {
  if (shape == HopperShape::cone) return mass_flow_half_angle(friction, internal);
  const double wall = wall_angle(friction, internal) / degree;
  const double limit = (std::exp(3.75 * std::pow(1.01, internal / degree / 10 - 3)) - wall) /
                       (0.725 * std::pow(std::tan(internal), 0.2));
  return std::max(0.0, limit) * degree;
}

double outlet_factor(HopperShape shape, double half_angle) {
  return shape == HopperShape::cone ? 2 + half_angle / degree / 60 : 1 + half_angle / degree / 180;
}

double flow_factor(HopperShape shape, double half_angle, double friction, double internal) {
  const double sine = std::sin(internal), wall = wall_angle(friction, internal);
  const double beta = 0.5 * (wall + std::asin(std::min(std::sin(wall) / sine, 1.0))), sum = beta + half_angle;
  const int m = shape == HopperShape::cone ? 1 : 0;
  // (1 - sin delta) times X - 1 and Y: it is left out of both.
  const double x = (m + 1) * sine * (std::sin(2 * beta + half_angle) / std::sin(half_angle) + 1) - (1 - sine);
  if (!(x > 0)) return std::numeric_limits<double>::infinity();
  const double y =
      ((m ? 2 * (1 - std::cos(sum)) : sum) * std::sin(half_angle) + std::sin(beta) * std::pow(std::sin(sum), 1 + m)) /
      std::pow(std::sin(sum), 2 + m);
  return std::max(least_flow_factor,
                  y * (1 + sine) * outlet_factor(shape, half_angle) / (2 * x * std::sin(half_angle)));
}

YieldLocus steady_locus(const CriticalStateParameters& law, double load) {
  const auto shear = [&](double normal) { return law.static_friction * (normal + law.consolidated(load)); };
  const std::array<YieldPoint, 2> points = {{{0.25 * load, shear(0.25 * load)}, {0.75 * load, shear(0.75 * load)}}};
  return evaluated({load, shear(load)}, points);
}

CriticalOutlet critical_outlet(HopperShape shape, double half_angle, double wall_friction,
                               const CriticalStateParameters& law, double weight) {
  if (!law.has_cohesion()) return {};
  CriticalOutlet outlet;
  // Of the consolidation over the strength that it leaves, more than an arch bears.
  const auto excess = [&](double load) {
    const YieldLocus locus = steady_locus(law, load);
    outlet.major = locus.major, outlet.strength = locus.strength, outlet.effective_angle = locus.effective_angle;
    outlet.factor = flow_factor(shape, half_angle, wall_friction, locus.effective_angle);
    outlet.width = outlet_factor(shape, half_angle) * locus.strength / weight;
    return locus.major - outlet.factor * locus.strength;
  };
  constexpr double low = 1e-3, high = 1e9, step = 1.1;  // Pa
  const bool any_flows = excess(low) > 0;
  double begin = any_flows ? low : 0, end = 0;  // of the loads under which it flows; 0: none
  for (double load = low; load < high && !(end > 0); load *= step)
    if ((excess(step * load) > 0) == !(begin > 0)) (begin > 0 ? end : begin) = load;
  if (end > 0) {
    excess(crossing([&](double load) { return -excess(load); }, end, step * end));
    outlet.widest = outlet.width;
  }
  if (begin > 0 && !any_flows) {
    excess(crossing(excess, begin, step * begin));
    return outlet;
  }
  excess(any_flows ? low : high);
  outlet.major = outlet.strength = 0;
  outlet.width = any_flows ? 0 : std::numeric_limits<double>::infinity();
  return outlet;
}

double rathole_diameter(const CriticalStateParameters& law, double major, double weight) {
  if (!law.has_cohesion()) return 0;
  const double load =
      crossing([&](double tried) { return steady_locus(law, tried).major - major; }, 1e-6 * major, major);
  const YieldLocus locus = steady_locus(law, load);
  return 4.3 * std::tan(locus.angle) * locus.strength / weight;
}

double johanson_discharge(HopperShape shape, double half_angle, double width, double length, double bulk_density,
                          double gravity, double critical_width) {
  const double share = std::max(0.0, 1 - critical_width / width);
  const double shapes = shape == HopperShape::cone ? 2 : 1;
  return bulk_density * area_of(shape, width, length) *
         std::sqrt(width * gravity * share / (2 * shapes * std::tan(half_angle)));
}

double carleton_discharge(double half_angle, double width, double bulk_density, double gravity, double grain_density,
                          double grain_diameter) {
  const double drag = 15 * std::cbrt(air_density) * std::cbrt(air_viscosity * air_viscosity) /
                      (grain_density * std::pow(grain_diameter, 5.0 / 3));
  const double speed = crossing(
      [&](double v) { return 4 * v * v * std::sin(half_angle) / width + drag * std::pow(v, 4.0 / 3) - gravity; }, 1e-9,
      1e3);
  return bulk_density * area_of(HopperShape::cone, width, 0) * speed;
}

}  // namespace talus::granular

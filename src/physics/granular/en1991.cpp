// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/en1991.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace talus::granular::en1991 {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double share_not_mobilised = 0.2;  // b of a hopper after filling

/// 1: the upper value makes the load largest, -1: the lower.
struct Signs {
  int friction, ratio, internal;
};

Signs signs_of(Load load) {
  switch (load) {
    case Load::wall_pressure:
      return {-1, 1, -1};
    case Load::wall_shear:
      return {1, 1, -1};
    case Load::bottom:
      return {-1, -1, 1};
    case Load::hopper_filling:
      return {-1, -1, -1};
    case Load::hopper_discharge:
      return {-1, 1, 1};
  }
  return {0, 0, 0};
}

/// The integral of (1 + u)^n over u, from 0.
double integral_of_power(double u, double n) {
  return std::abs(n + 1) < 1e-9 ? std::log1p(u) : (std::pow(1 + u, n + 1) - 1) / (n + 1);
}

/// Loads with Y_R, below the highest contact with the wall, h_o.
Stresses filling_below_a_pile(double weight, const Values& values, double characteristic, double contact, double repose,
                              double depth) {
  const double below = depth - contact, slope = 1 + std::tan(repose);
  // Smooth walls, z_o without end: the limits of both.
  if (std::isinf(characteristic)) return {weight * values.ratio * slope * below, 0, weight * depth};
  const double rest = characteristic - contact, n = -slope * (1 - contact / characteristic);
  const double pressure = weight * values.ratio * characteristic * (1 - std::pow(1 + below / rest, n));
  return {pressure, values.friction * pressure, weight * (contact + rest * integral_of_power(below / rest, n))};
}

}  // namespace

Solid unknown_solid(double internal) {
  return {.repose = std::min(internal, 0.25 * pi),
          .internal = internal,
          .internal_factor = 1.3,
          .ratio = 1.1 * (1 - std::sin(internal)),
          .ratio_factor = 1.5,
          .friction_factor = 1.4,
          .patch = 1};
}

double weight_for(const Solid& solid, double weight, Limit limit) {
  return limit == Limit::upper ? std::max(weight, solid.max_weight) : weight;
}

Values values_for(const Solid& solid, double friction, Load load, Limit limit) {
  const int side = limit == Limit::upper ? 1 : limit == Limit::lower ? -1 : 0;
  const Signs signs = signs_of(load);
  const auto internal = [&](int sign) {
    return std::min(solid.internal * std::pow(solid.internal_factor, side * sign), 0.5 * pi);
  };
  return {
      std::min(friction * std::pow(solid.friction_factor, side * signs.friction), std::tan(internal(signs.friction))),
      std::min(1.0, solid.ratio * std::pow(solid.ratio_factor, side * signs.ratio)), internal(signs.internal)};
}

Class class_of(const Silo& silo) {
  const double slenderness = silo.slenderness();
  constexpr double rounding = 1e-9;  // a bed of two diameters is slender
  if (slenderness >= 2 - rounding) return Class::slender;
  if (slenderness > 1 + rounding) return Class::intermediate;
  return slenderness <= 0.4 + rounding && silo.has_flat_bottom ? Class::retaining : Class::squat;
}

double characteristic_depth(const Silo& silo, const Values& values) {
  const double held = silo.circumference * values.ratio * values.friction;
  return held > 0 ? silo.area / held : std::numeric_limits<double>::infinity();
}

double contact_depth(const Silo& silo, double repose) {
  if (class_of(silo) == Class::slender) return 0;
  return silo.width / (silo.is_round ? 6 : 4) * std::tan(repose);
}

Stresses filling(const Silo& silo, double repose, const Values& values, double weight, double depth) {
  const double contact = contact_depth(silo, repose);
  if (!(depth > contact)) return {0, 0, weight * std::max(0.0, depth)};
  const double characteristic = characteristic_depth(silo, values);
  if (class_of(silo) != Class::slender)
    return filling_below_a_pile(weight, values, characteristic, contact, repose, depth);
  const double vertical = janssen_stress(weight, characteristic, depth), pressure = values.ratio * vertical;
  return {pressure, values.friction * pressure, vertical};
}

DischargeFactors discharge_factors(const Silo& silo) {
  const Class kind = class_of(silo);
  if (kind == Class::slender) return {1.15, 1.10};
  if (kind != Class::intermediate) return {};
  const double above = silo.slenderness() - 1;
  return {1 + 0.15 * above, 1 + 0.1 * above};
}

namespace {

double patch(double factor, const Silo& silo, double solid_factor, double E) {
  return std::max(0.0, factor * solid_factor * (1 + 2 * E * E) * (1 - std::exp(-1.5 * (silo.slenderness() - 1))));
}

}  // namespace

double patch_of_filling(const Silo& silo, double solid_factor, double eccentricity) {
  return patch(0.21, silo, solid_factor, 2 * eccentricity / silo.width);
}

double patch_of_discharge(const Silo& silo, double solid_factor, double eccentricity) {
  const double E = 2 * eccentricity / silo.width;
  if (silo.slenderness() > 1.2) return patch(0.42, silo, solid_factor, E);
  return std::max(0.0, 0.272 * solid_factor * (silo.slenderness() - 1 + E));
}

double patch_extent(const Silo& silo) {
  return pi * silo.width / 16;
}

FlowChannel flow_channel(double radius, double share, const Values& values) {
  const double friction = std::tan(values.internal), rough = std::clamp(values.friction / friction, 0.0, 1.0);
  FlowChannel channel{.radius = share * radius, .ratio = values.ratio};
  const double r = radius, r_c = channel.radius;
  const double e_c = r * (1 - share) * (rough + std::sqrt(1 - rough));
  channel.offset = e_c;
  // Both angles of the triangle of the two axes and a point where the channel meets the wall, by its sides: the arc
  // sine of sin psi alone would leave two.
  const double theta = std::acos(std::clamp((r * r + e_c * e_c - r_c * r_c) / (2 * r * e_c), -1.0, 1.0));
  const double inside = std::acos(std::clamp((e_c * e_c + r_c * r_c - r * r) / (2 * e_c * r_c), -1.0, 1.0));
  const double psi = pi - inside;
  channel.half_angle = theta;
  channel.on_wall = 2 * theta * r;
  channel.on_bed = 2 * r_c * inside;
  channel.area = inside * r_c * r_c + theta * r * r - r * r_c * std::sin(psi - theta);
  channel.depth = channel.area / (values.ratio * (channel.on_wall * rough * friction + channel.on_bed * friction));
  return channel;
}

double channel_pressure(const FlowChannel& channel, double weight, double depth) {
  return channel.ratio * janssen_stress(weight, channel.depth, depth);
}

bool is_steep(double half_angle, double friction, double ratio) {
  return 2 * friction * std::tan(half_angle) < 1 - ratio;
}

double hopper_friction(double half_angle, double friction, double ratio) {
  return is_steep(half_angle, friction, ratio) ? friction : std::max(0.0, (1 - ratio) / (2 * std::tan(half_angle)));
}

namespace {

ConeBearing bearing(double shape, double ratio, double half_angle, double friction) {
  return {ratio, shape * (ratio * (1 + friction / std::tan(half_angle)) - 1)};
}

}  // namespace

ConeBearing hopper_filling(double shape, double half_angle, double friction, double ratio) {
  const double mu = hopper_friction(half_angle, friction, ratio), tangent = std::tan(half_angle);
  // 1 - b/(1 + tan beta/mu), written for mu = 0 too; n is then S (1 - b) mu/tan beta.
  return bearing(shape, 1 - share_not_mobilised * mu / (mu + tangent), half_angle, mu);
}

ConeBearing hopper_discharge(double shape, double half_angle, const Values& values) {
  if (!is_steep(half_angle, values.friction, values.ratio))
    return hopper_filling(shape, half_angle, values.friction, values.ratio);
  return bearing(shape, cone_in_flow(half_angle, values.friction, values.internal).ratio, half_angle, values.friction);
}

double bottom_pressure(const Silo& silo, double repose, const Values& values, double weight) {
  const double at_bottom = filling(silo, repose, values, weight, silo.height).vertical;
  if (class_of(silo) == Class::slender) return at_bottom;
  const double contact = contact_depth(silo, repose), pile = contact * (silo.is_round ? 3 : 2);
  // p_vho = gamma h_o: z_V is h_o there.
  return at_bottom + weight * (pile - contact) * (2 - silo.slenderness()) / (2 - pile / silo.width);
}

}  // namespace talus::granular::en1991

// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/hand_formulas.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

#include "base/error.hpp"
#include "physics/granular/enstad.hpp"
#include "physics/granular/material_path.hpp"
#include "physics/granular/silo.hpp"

namespace talus::app {

namespace {

using continuum::VesselPart;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double usual_angle = 30 * std::numbers::pi / 180;  // where the law has no friction of its own

/// Janssen's stress at a place, Pa, wall by wall from the bed's top down; nan where no upright walls reach from there
/// to the top, and below the silo's end.
double janssen_at(const SiloShape& shape, double ratio, double top, const Vector3& place) {
  const continuum::Parameters& p = shape.layout.given;
  const SiloPiece* wall = shape.upright_at(place);
  const double height = place.z;
  if (!wall || wall->bottom > height + p.bed.spacing || top <= height ||
      shape.bottom_of(*wall, top) > height + p.bed.spacing)
    return no_value;
  const double weight = bulk_density(p) * p.gravity.acceleration;
  double stress = 0;
  for (const SiloShape::Ring& ring : shape.rings_above(*wall, height, top)) {
    const double length = ring.friction > 0 ? wall->hydraulic_radius() / (ring.friction * ratio) : infinity;
    stress = granular::janssen_stress(weight, length, ring.height, stress);
  }
  return stress;
}

PressureByHand pressure_of_hopper(const SiloShape& shape, const SiloPiece& hopper, double ratio, double top,
                                  double height) {
  const continuum::Parameters& p = shape.layout.given;
  const double angle = std::atan(hopper.tangent), apex = hopper.apex(), end = std::min(top, hopper.top) - apex;
  const double above = top > hopper.top ? janssen_at(shape, ratio, top, {hopper.axis.x, hopper.axis.y, hopper.top}) : 0;
  const double weight = bulk_density(p) * p.gravity.acceleration;
  const auto pressure = [&](granular::ConeBearing bearing) {
    bearing.exponent *= 0.5 * hopper.shape();
    return bearing.ratio * granular::cone_stress(bearing, weight, height - apex, end, above);
  };
  const double internal = internal_friction_by_hand(p);
  const auto arcs = granular::arc_bearing(hopper.shape(), angle, hopper.friction, internal);
  return {pressure(granular::cone_at_rest(angle, hopper.friction)),
          pressure(granular::cone_in_flow(angle, hopper.friction, internal)),
          arcs ? granular::arc_pressure(*arcs, weight, height - apex, end, above) : no_value};
}

/// The cone that ends at a round outlet, the pyramid that ends at another.
const VesselPart* hopper_above(const continuum::Parameters& p, const continuum::VesselOutlet& outlet) {
  for (const VesselPart& v : p.vessel) {
    if (outlet.round ? !is_cone(v) : v.shape != continuum::VesselShape::pyramid) continue;
    const Vector3 axis = continuum::on_axis(p, v);
    if (std::abs(v.bottom - outlet.middle.z) <= p.bed.spacing && outlet.is_beside(axis, 0) &&
        std::hypot(axis.x - outlet.middle.x, axis.y - outlet.middle.y) <
            0.1 * (outlet.round ? outlet.width : outlet.narrow))
      return &v;
  }
  return nullptr;
}

/// The cone that ends at an outlet.
const VesselPart* cone_above(const continuum::Parameters& p, const continuum::VesselOutlet& outlet) {
  return outlet.round ? hopper_above(p, outlet) : nullptr;
}

/// The cone through which the vessel empties.
const VesselPart* emptying_cone(const continuum::Layout& layout) {
  return layout.vessel_outlets.empty() ? nullptr : cone_above(layout.given, layout.vessel_outlets.front());
}

/// What a slit of a plate across the box discharges: half of one twice as wide where it begins at a face.
double discharge_of_slit(const continuum::Layout& layout) {
  const continuum::Parameters& p = layout.given;
  const auto& outlet = layout.outlet;
  if (!p.plate.height || p.wedge.half_angle || !p.plates.empty() || !outlet) return 0;
  const auto cut = [](FaceKind face, double distance) { return face != FaceKind::open && distance <= 0; };
  const double halves = cut(p.box.left, outlet->left) || cut(p.box.right, p.box.width - outlet->right) ? 2 : 1;
  return granular::rectangular_discharge(halves * (outlet->right - outlet->left), p.box.depth, true, bulk_density(p),
                                         p.gravity.acceleration, p.grains.diameter) /
         halves;
}

}  // namespace

double discharge_by_hand(const continuum::Layout& layout, const continuum::VesselOutlet& outlet) {
  const continuum::Parameters& p = layout.given;
  const auto inside = [](double middle, double width, double extent) {
    return std::max(0.0, std::min(middle + 0.5 * width, extent) - std::max(middle - 0.5 * width, 0.0)) / width;
  };
  const double of_width = inside(outlet.middle.x, outlet.width, p.box.width),
               of_depth = inside(outlet.middle.y, outlet.depth, p.box.depth);
  const auto rectangular = [&](double width, double length, bool endless) {
    return granular::rectangular_discharge(width, length, endless, bulk_density(p), p.gravity.acceleration,
                                           p.grains.diameter);
  };
  if (outlet.endless_along_x) return of_depth * rectangular(outlet.depth, p.box.width, true);
  if (outlet.endless_along_y) return of_width * rectangular(outlet.width, p.box.depth, true);
  if (!outlet.round) return of_width * of_depth * rectangular(outlet.narrow, outlet.length, false);
  const VesselPart* cone = cone_above(p, outlet);
  return of_width * of_depth * (cone ? granular::factor_of_cone(tangent_of(*cone)) : 1) *
         granular::orifice_discharge(outlet.width, bulk_density(p), p.gravity.acceleration, p.grains.diameter);
}

double discharge_by_hand(const continuum::Layout& layout) {
  if (layout.given.vessel.empty()) return discharge_of_slit(layout);
  double rate = 0;
  const double first = continuum::first_opening(layout.vessel_outlets);
  for (const continuum::VesselOutlet& outlet : layout.vessel_outlets)
    if (!outlet.gate || !(outlet.gate->opens_after > first)) rate += discharge_by_hand(layout, outlet);
  return rate;
}

double discharged_by_hand(const continuum::Layout& layout, double until) {
  if (layout.given.vessel.empty()) return discharge_of_slit(layout) * until;
  double mass = 0;
  for (const continuum::VesselOutlet& outlet : layout.vessel_outlets)
    mass += discharge_by_hand(layout, outlet) * (outlet.gate ? outlet.gate->time_away(until) : until);
  return mass;
}

double time_of_discharge_by_hand(const continuum::Layout& layout, double mass) {
  constexpr double latest = 1e12;  // s
  if (!(mass > 0)) return no_value;
  double before = 0, after = 1;
  while (!(discharged_by_hand(layout, after) >= mass)) {
    before = after, after *= 2;
    if (after > latest) return no_value;
  }
  for (double middle = 0.5 * (before + after); before < middle && middle < after; middle = 0.5 * (before + after))
    (discharged_by_hand(layout, middle) < mass ? before : after) = middle;
  return after;
}

double internal_friction_by_hand(const continuum::Parameters& p, granular::FrictionTest test) {
  double friction = 0;
  if (p.law.is<granular::CriticalState>()) friction = p.law.of<granular::CriticalState>().static_friction;
  if (p.law.is<granular::DruckerPrager>()) friction = p.law.of<granular::DruckerPrager>().friction;
  if (test == granular::FrictionTest::plane_strain) friction = std::min(friction, 1.0);
  return friction > 0 ? granular::angle_of_friction(test, friction) : usual_angle;
}

double pressure_ratio_at_rest(const continuum::Layout& layout) {
  const continuum::Parameters& p = layout.given;
  if (!p.law.is<granular::CriticalState>()) return no_value;
  const auto& law = p.law.of<granular::CriticalState>();
  const double load = bulk_density(p) * p.gravity.acceleration * layout.depth;
  if (!(load > 0)) return no_value;
  const granular::PathStretch settling{1, {}, {std::nullopt, std::nullopt, load, std::nullopt}};  // in a second
  const double packing = std::max(p.bed.packing, law.reference_packing);                          // where grains touch
  try {
    const SymmetricTensor3<> stress =
        granular::follow_path(granular::CriticalState(law, p.grains.density, p.grains.diameter),
                              std::span(&settling, 1), {.density = packing * p.grains.density, .points = 200})
            .back()
            .stress;
    return stress.xx / stress.zz;
  } catch (const NumericalError&) {  // grains too soft for the load: an estimate ends no run
    return no_value;
  }
}

double mass_flow_half_angle_by_hand(const continuum::Layout& layout) {
  const VesselPart* cone = emptying_cone(layout);
  return cone ? granular::mass_flow_half_angle(friction_of(layout, *cone), internal_friction_by_hand(layout.given))
              : no_value;
}

std::optional<granular::CriticalOutlet> critical_outlet_by_hand(const continuum::Layout& layout) {
  const continuum::Parameters& p = layout.given;
  if (!continuum::has_cohesion(p)) return std::nullopt;
  const auto outlet = [&](granular::HopperShape shape, double half_angle, double friction) {
    return granular::critical_outlet(shape, half_angle, friction, p.law.of<granular::CriticalState>(),
                                     bulk_density(p) * p.gravity.acceleration);
  };
  if (p.wedge.half_angle) return outlet(granular::HopperShape::wedge, *p.wedge.half_angle, p.walls.coefficient);
  if (layout.vessel_outlets.empty()) return std::nullopt;
  const continuum::VesselOutlet& first = layout.vessel_outlets.front();
  const VesselPart* const hopper = hopper_above(p, first);
  if (!hopper) return std::nullopt;
  const double friction = friction_of(layout, *hopper);
  if (first.round) return outlet(granular::HopperShape::cone, half_angle_of_cone(layout), friction);
  // Of a square outlet as of a round one; of a slot, at least three times as long as wide, as of a wedge.
  const double opens =
      0.5 * std::max(hopper->upper_width - hopper->lower_width, hopper->upper_depth - hopper->lower_depth);
  const bool is_slot = first.endless_along_x || first.endless_along_y || first.length >= 3 * first.narrow;
  return outlet(!is_slot ? granular::HopperShape::cone : granular::HopperShape::wedge,
                std::atan(opens / (hopper->top - hopper->bottom)), friction);
}

double half_angle_of_cone(const continuum::Layout& layout) {
  const VesselPart* cone = emptying_cone(layout);
  return cone ? std::atan(tangent_of(*cone)) : no_value;
}

Vector3 middle_of(const SiloShape& shape, std::size_t part, double height) {
  const SiloPiece* const piece = shape.of_part(part, height);
  if (piece && !piece->is_hopper())
    return {piece->axis.x, piece->axis.y, std::clamp(height, piece->bottom, std::nextafter(piece->top, piece->bottom))};
  const continuum::Parameters& p = shape.layout.given;
  const VesselPart& v = p.vessel[part];
  if (v.shape != continuum::VesselShape::plate) {
    const Vector3 axis = continuum::on_axis(p, v);
    return {axis.x, axis.y, height};
  }
  return {v.corner[0] + 0.5 * (v.first_edge[0] + v.second_edge[0]),
          v.corner[1] + 0.5 * (v.first_edge[1] + v.second_edge[1]), height};
}

std::optional<WallOfBand> wall_of(const SiloShape& shape, const BandOfWall& band, double height) {
  constexpr double slack = 0.05, level = 1 - 1e-3;
  const SiloPiece* const piece = shape.of_part(band.patch, height);
  const bool fits = piece ? std::abs(band.sine - std::sin(std::atan(piece->tangent))) < slack : band.sine > level;
  const WallOfBand found{piece, middle_of(shape, band.patch, height)};
  if (!fits || (piece && !piece->is_hopper() && shape.upright_at(found.place) != piece)) return std::nullopt;
  return found;
}

PressureByHand pressure_by_hand(const SiloShape& shape, const BandOfWall& band, double ratio, double top,
                                double height) {
  const auto on = height < top ? wall_of(shape, band, height) : std::nullopt;
  if (!on) return {};
  if (on->piece && on->piece->is_hopper()) return pressure_of_hopper(shape, *on->piece, ratio, top, height);
  const double vertical = janssen_at(shape, ratio, top, on->place);
  if (on->piece) return {ratio * vertical, ratio * vertical, no_value};
  return {vertical, no_value, no_value};
}

}  // namespace talus::app

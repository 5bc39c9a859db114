// SPDX-License-Identifier: Apache-2.0
/// Analytical estimates of a case, to compare with what Talus computes.
#pragma once

#include <optional>

#include "analysis/hopper.hpp"
#include "app/continuum/silo_shape.hpp"
#include "physics/granular/friction_angle.hpp"
#include "physics/granular/hopper_design.hpp"

namespace talus::app {

/// What leaves, kg/s (physics/granular/silo.hpp): of a vessel with round or rectangular outlets; of a
/// level plate with a slit, which goes on beyond the faces that it ends at. Of an outlet that is cut by planes of
/// symmetry, what leaves on this side of them. \returns 0 where there is no formula, as for a wedge
double discharge_by_hand(const continuum::Layout& layout);
/// Of one of the outlets of a vessel; discharge_by_hand() adds them up.
double discharge_by_hand(const continuum::Layout& layout, const continuum::VesselOutlet& outlet);
/// Mass that all outlets pass at these rates while their gates are open, kg. \param until from the opening of the gate,
/// s
double discharged_by_hand(const continuum::Layout& layout, double until);
/// When it comes to a mass, > 0, s from the opening of the gate; nan: never.
double time_of_discharge_by_hand(const continuum::Layout& layout, double mass);

/// The angle of internal friction of the law, rad (physics/granular/friction_angle.hpp); 30 degrees where it has none.
/// \param test Walker's, Enstad's and Jenike's formulas take Mohr's circle in plane strain, in which a friction counts
/// up to 1; EN 1991-4 takes a shear tester's angle
double internal_friction_by_hand(const continuum::Parameters& parameters,
                                 granular::FrictionTest test = granular::FrictionTest::plane_strain);

/// K of a bed that settles without strain to the sides, under the weight of its depth: of a point of the law
/// critical-state; nan of other laws, and where it does not bear that. Below yield it is (1 - 2G/3B)/(1 + 4G/3B), and
/// larger where grains yield.
double pressure_ratio_at_rest(const continuum::Layout& layout);

/// The largest half angle of mass flow in a cone (physics/granular/silo.hpp), rad; nan if the vessel empties
/// through no cone.
double mass_flow_half_angle_by_hand(const continuum::Layout& layout);

/// The outlet of a cone or a wedge below which grains that stick together arch (physics/granular/hopper_design.hpp);
/// nothing without cohesion, or without such a hopper.
std::optional<granular::CriticalOutlet> critical_outlet_by_hand(const continuum::Layout& layout);

/// The half angle that it has, rad; nan without such a cone.
double half_angle_of_cone(const continuum::Layout& layout);

/// At a height, the axis of the walls that a part of the vessel belongs to, or its own middle, m.
Vector3 middle_of(const SiloShape& shape, std::size_t part, double height);

/// What formulas take a band for.
struct WallOfBand {
  const SiloPiece* piece = nullptr;  ///< null: a level floor
  Vector3 place;                     ///< middle_of() its part, m
};
/// Nothing where no formula is for it: a band as steep as no piece, such as one of a file that spans two walls, and
/// upright walls that are not those about a bed (SiloShape::upright_at). \param height m
std::optional<WallOfBand> wall_of(const SiloShape& shape, const BandOfWall& band, double height);

/// The analytical estimate of the pressure on a band, Pa; nan where there is no formula for it.
struct PressureByHand {
  double at_rest = no_value, in_flow = no_value;
  double in_flow_enstad = no_value;  ///< of a hopper, beside Walker's
};

/// On upright walls K times Janssen's stress; on a level band that stress; on a hopper Walker's pressure and Enstad's
/// (physics/granular/enstad.hpp), the bed above it a surcharge by Janssen. \param ratio K, as measured in the bed at
/// rest \param top of the bed, m \param height of the place, m
PressureByHand pressure_by_hand(const SiloShape& shape, const BandOfWall& band, double ratio, double top,
                                double height);

}  // namespace talus::app

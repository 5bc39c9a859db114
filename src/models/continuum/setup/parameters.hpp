// SPDX-License-Identifier: Apache-2.0
/// What a case of the continuum model says: grains as a continuum of particles that move and carry stress, in a box
/// with a plate across it (Yuu & Umekage 2011). SI, angles in radians; the initial values are the defaults.
#pragma once

#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/instruction_set.hpp"
#include "base/parameter.hpp"
#include "models/air/parameters.hpp"
#include "models/continuum/boundary/inner_walls.hpp"
#include "models/continuum/inlets.hpp"
#include "models/continuum/setup/bed.hpp"
#include "models/continuum/setup/choices.hpp"
#include "models/continuum/setup/levels.hpp"
#include "models/continuum/setup/vessel.hpp"
#include "numerics/geometry/domain.hpp"
#include "physics/granular/collisional_stress.hpp"
#include "physics/granular/law.hpp"
#include "physics/sph/balance.hpp"

namespace talus::continuum {

struct Parameters {
  std::optional<Accuracy> accuracy;
  struct BoxSize {
    double width = 0, depth = 0, height = 0;
    std::optional<double> sector = std::nullopt;
    FaceKind left = FaceKind::wall, right = FaceKind::wall;
    FaceKind front = FaceKind::symmetry, rear = FaceKind::symmetry;
    FaceKind floor = FaceKind::wall, top = FaceKind::open;
  } box;
  Plate plate;
  Wedge wedge;
  std::vector<InclinedPlate> plates;
  std::vector<VesselPart> vessel;
  std::vector<Inlet> inlets;
  Removal removal;
  struct Gate {
    GateOpens opens = GateOpens::when_settled;
    double time = 0;
  } gate;
  struct Grains {
    std::optional<GrainMaterial> material;
    double density = 2500;
    double diameter = 200e-6;
    MaterialRange range;  ///< of the material. Not a key: who reads the case fills it in
  } grains;
  BedParameters bed;
  std::vector<TaggedBed> beds;  ///< besides
  LevelParameters levels;
  std::int64_t seed = 1;
  granular::LawParameters law;
  granular::CollisionParameters collisions;
  struct Sph {
    Smoothing smoothing = Smoothing::local;
    double smoothing_ratio = 1;
    sph::StressForm stress_form = sph::StressForm::balanced;
    double viscosity_alpha = 0.1;  // Setup::default_viscosity where a case leaves it out
    double density_relaxation = 1;
    double stress_regularisation = 0;
    double artificial_stress = 1;
  } sph;
  struct Walls {
    Friction friction = Friction::coulomb;
    std::optional<WallMaterial> material;
    double coefficient = 0.3;
    double adhesion = 0;
    FrictionFrom friction_from = FrictionFrom::gate;
  } walls;
  struct Gravity {
    double acceleration = 9.81;
    double tilt = 0;
  } gravity;
  struct Air {
    bool enabled = false;
    std::optional<double> cell, cell_depth;
    air::Parameters gas;  ///< of which the grains' size and density stand in `grains`
  } air;
  struct Settle {
    std::optional<double> speed, duration, max_time;  ///< left out: time_scale.hpp
    std::optional<double> loading_time;
    Filling filling = Filling::at_once;
    std::optional<double> damping_time, viscosity_alpha = std::nullopt;
  } settle;
  struct Analysis {
    std::optional<double> averaging_time;  ///< left out: time_scale.hpp
  } analysis;
  struct Integration {
    Method method = Method::leapfrog;
    double courant = default_courant(Method::leapfrog);
    std::optional<double> step;
    double skin = 0.4;
    double skin_at_rest = 0.25;
    PairPrecision pair_precision = PairPrecision::in_double;
    InstructionSet instruction_set = InstructionSet::automatic;
  } integration;
};

/// Every key, once: parsing, ranges, defaults, schema, reference page and `talus check` follow from this list.
template <class Visit, class P>
void for_each_parameter(Visit&& visit, P& p) {
  visit(Parameter{"accuracy",
                  {},
                  {},
                  "sets keys that the case leaves out: 8, 12 or 20 particles across the outlet, the moduli of the law "
                  "critical-state and, but for a reference, single precision, a sector of an axisymmetric vessel and "
                  "coarser particles away from the outlet (talus check lists them); left out: none"},
        p.accuracy);
  visit(Parameter{"box.width", dimension::length, above(0), "extent along x, from the left face at 0 to the right face",
                  true},
        p.box.width);
  visit(
      Parameter{"box.depth", dimension::length, above(0), "extent along y, from the front face at 0 to the rear", true},
      p.box.depth);
  visit(Parameter{"box.height", dimension::length, above(0), "extent along z, from the floor at 0 to the top", true},
        p.box.height);
  visit(
      Parameter{"box.sector", dimension::angle, between(Sector::min_angle, Sector::max_angle),
                "angle of a sector about the upright axis through the middle of the box, computed in place of the "
                "whole of an axisymmetric [[vessel]]: a whole part of 360 deg; what leaves through one of its faces "
                "comes in through the other, all results are those of the whole vessel, and the box has no side faces; "
                "left out: the whole"},
      p.box.sector);
  auto sided = only_if({"box.sector", "is given", "left out", !p.box.sector}, visit);
  sided(Parameter{"box.left",
                  {},
                  {},
                  "kind of the left face: a wall (with friction), a symmetry plane, periodic (with its opposite), free "
                  "as printed (mirror without reversing the velocity), or open"},
        p.box.left);
  sided(Parameter{"box.right", {}, {}, "the right face"}, p.box.right);
  sided(Parameter{"box.front", {}, {}, "the front face"}, p.box.front);
  sided(Parameter{"box.rear", {}, {}, "the rear face"}, p.box.rear);
  visit(Parameter{"box.floor", {}, {}, "the floor"}, p.box.floor);
  visit(Parameter{"box.top", {}, {}, "the top"}, p.box.top);
  for_each_parameter_of_inner_walls(visit, p);
  for_each_parameter_of_vessel(visit, p.vessel);
  for_each_parameter_of_inlets(visit, p.inlets, p.removal);
  visit(Parameter{"gate.opens", {}, {}, "when the gate of slit, wedge or vessel opens"}, p.gate.opens);
  auto timed = only_if(where("gate.opens", p.gate.opens, GateOpens::at_time), visit);
  timed(Parameter{"gate.time", dimension::time, at_least(0),
                  "time at which the gate opens, with gate.opens = \"at-time\""},
        p.gate.time);
  visit(
      Parameter{
          "grains.material",
          {},
          {},
          "what the grains are: density, diameter, packing, law and friction on walls follow where the case "
          "does not give them (talus materials, or the file my-powder.toml of another, as talus calibrate writes it); "
          "left out: the defaults below"},
      p.grains.material);
  visit(Parameter{"grains.density", dimension::density, above(0), "true density of the grains, rho_p"},
        p.grains.density);
  visit(Parameter{"grains.diameter", dimension::length, above(0), "diameter of the grains, D_p"}, p.grains.diameter);

  for_each_parameter_of_bed(visit, p.bed, p.seed, !p.inlets.empty() || !p.beds.empty());
  for_each_parameter_of_beds(visit, p.beds);
  for_each_parameter_of_levels(visit, p.levels);

  granular::for_each_parameter(visit, p.law);
  granular::for_each_parameter(visit, p.collisions);

  visit(
      Parameter{
          "sph.smoothing",
          {},
          {},
          "smoothing length: of each particle from its density, h = (m/rho_b)^(1/3), or fixed at its initial value"},
      p.sph.smoothing);
  visit(
      Parameter{"sph.smoothing_ratio", dimension::none, between(1, 1.5),
                "smoothing length in units of (m/rho_b)^(1/3), the paper's: a wider kernel sums over more neighbours"},
      p.sph.smoothing_ratio);
  auto flowing = only_if({"law.name", "is " + value_text(p.law.name), "of grains that flow",
                          p.law.template is<granular::CriticalState>() || !granular::bears_tension(p.law)},
                         visit);
  flowing(Parameter{"sph.density_relaxation", dimension::none, at_least(0),
                    "share of the difference between the kernel's sum and the density that a shear strain of "
                    "1 takes back, of grains that stick together only where the sum is more; 0, as printed: both drift "
                    "apart as the grains flow"},
          p.sph.density_relaxation);
  visit(Parameter{"sph.stress_form",
                  {},
                  {},
                  "factor of the stress in Eq. 17: balanced (the floor carries the weight) or as printed"},
        p.sph.stress_form);
  visit(Parameter{"sph.viscosity_alpha", dimension::none, at_least(0),
                  "Monaghan's viscosity, linear coefficient; with 0.01 a stream that strikes a wall throws grains a "
                  "few spacings above the head that they came with; left out: 0.1, or less, down to 0.01, so that it "
                  "takes 1.7 % of the discharge through an outlet"},
        p.sph.viscosity_alpha);
  auto of_critical_state = only_if(
      {"law.name", "is " + value_text(p.law.name), "critical-state", p.law.template is<granular::CriticalState>()},
      visit);
  of_critical_state(Parameter{"sph.stress_regularisation", dimension::none, at_least(0),
                              "how strongly shear draws the deviatoric stress to that of the neighbours; 1: by as much "
                              "as the shear of a step replaces of it; 0: not at all"},
                    p.sph.stress_regularisation);
  auto of_cohesion = only_if({"law.name", "is " + value_text(p.law.name), "critical-state with cohesion",
                              p.law.template is<granular::CriticalState>() && granular::bears_tension(p.law)},
                             visit);
  of_cohesion(Parameter{"sph.artificial_stress", dimension::none, between(0, 4),
                        "epsilon of springs between particles under tension, which would pair up: the tensile "
                        "instability; 0: none"},
              p.sph.artificial_stress);

  visit(Parameter{"walls.friction", {}, {}, "friction of walls and plate: Coulomb's, the printed rule, or none"},
        p.walls.friction);
  auto rough = only_if(unless("walls.friction", p.walls.friction, Friction::none), visit);
  rough(Parameter{"walls.material",
                  {},
                  {},
                  "what the walls are made of: their friction follows with grains.material, where walls.coefficient is "
                  "not given"},
        p.walls.material);
  rough(Parameter{"walls.coefficient", dimension::none, friction_coefficient(),
                  "coefficient of wall friction, the tangent of the angle of wall friction"},
        p.walls.coefficient);
  auto adhesive = only_if(where("walls.friction", p.walls.friction, Friction::coulomb), of_cohesion);
  adhesive(Parameter{"walls.adhesion", dimension::pressure, at_least(0),
                     "shear stress that walls bear besides, of grains that stick together, which they hold up to a "
                     "tension of this over walls.coefficient"},
           p.walls.adhesion);
  rough(
      Parameter{
          "walls.friction_from", {}, {}, "whether walls have friction from the start or from the opening of the gate"},
      p.walls.friction_from);

  visit(Parameter{"gravity.acceleration", dimension::acceleration, at_least(0), "acceleration of gravity, along -z"},
        p.gravity.acceleration);
  visit(Parameter{"gravity.tilt", dimension::angle, between(0, 4 * std::numbers::pi / 9),
                  "angle by which it leans towards +x, as in a box that stands on a slope; in a plain box alone"},
        p.gravity.tilt);

  visit(Parameter{"air.enabled", {}, {}, "whether there is air; without it no other key of the air may be given"},
        p.air.enabled);
  auto airy = only_if(where("air.enabled", p.air.enabled, true), visit);
  airy(Parameter{"air.cell", dimension::length, above(0),
                 "size of the cells of the air, adjusted to whole numbers along each side of the box; left out: three "
                 "quarters of bed.spacing, adjusted to the plate too"},
       p.air.cell);
  airy(Parameter{"air.cell_depth", dimension::length, above(0),
                 "size of the cells along y, if another: a box that is thin along y may have one cell there"},
       p.air.cell_depth);
  air::for_each_parameter(airy, p.air.gas);

  auto settling = only_if(where("gate.opens", p.gate.opens, GateOpens::when_settled), visit);
  settling(Parameter{"settle.speed", dimension::velocity, above(0),
                     "the bed has settled when 99 of 100 particles are slower than this; left out: 0.0008 times (g "
                     "D)^½, D the narrower side of the outlet, without one the height of the bed"},
           p.settle.speed);
  settling(Parameter{"settle.duration", dimension::time, at_least(0), "for this long; left out: 0.3 times (D/g)^½"},
           p.settle.duration);
  settling(Parameter{"settle.max_time", dimension::time, above(0),
                     "a bed that is still moving then is a failure; left out: 15 times (L/g)^½, L the larger of D and "
                     "the height of the bed, after the last inlet that fills the vessel has ended"},
           p.settle.max_time);
  settling(Parameter{"settle.loading_time", dimension::time, at_least(0),
                     "time over which gravity is raised to its full value while the bed settles, so that no pressure "
                     "wave compresses it beyond its weight; 0: at once; left out: the time in which a pressure wave "
                     "passes twenty times through the height of the bed, eighty times with settle.filling = "
                     "\"layers\", at most a quarter of settle.max_time"},
           p.settle.loading_time);
  settling(Parameter{"settle.filling",
                     {},
                     {},
                     "how gravity is raised: everywhere at once, or in layers from below, as a silo is filled, so that "
                     "what lies above a layer has no weight yet when the layer takes up its own"},
           p.settle.filling);
  auto gated = only_if(unless("gate.opens", p.gate.opens, GateOpens::from_the_start), visit);
  gated(Parameter{"settle.damping_time", dimension::time, above(0),
                  "time constant of an artificial damping of the velocities until the gate opens, but not while inlets "
                  "fill the vessel; left out: no damping"},
        p.settle.damping_time);
  gated(Parameter{"settle.viscosity_alpha", dimension::none, at_least(0),
                  "sph.viscosity_alpha until the gate opens; left out: the same, and 0.1 where that follows from the "
                  "outlet"},
        p.settle.viscosity_alpha);

  visit(Parameter{"analysis.averaging_time", dimension::time, above(0),
                  "averaging time of rates, wall loads and speeds; peaks are averages over half of it; left out: 0.3 "
                  "times (D/g)^½, D the narrower side of the outlet, without one the height of the bed"},
        p.analysis.averaging_time);
  visit(Parameter{"integration.method",
                  {},
                  {},
                  "leapfrog, or second-order Runge-Kutta, of twice the work in a step and shorter steps"},
        p.integration.method);
  visit(Parameter{"integration.step", dimension::time, above(0),
                  "fixed time step, instead of that of the Courant number"},
        p.integration.step);
  visit(Parameter{"integration.courant", dimension::none, above(0),
                  "time step times the sound speed over the smallest smoothing length; left out: 1.2 with the "
                  "leapfrog, 0.3 with Runge-Kutta"},
        p.integration.courant);
  visit(Parameter{"integration.skin", dimension::none, between(0, 2),
                  "largest skin of the neighbour lists, of particles that move half of it in 20 steps, in spacings; "
                  "left out: 0.4, with levels 2"},
        p.integration.skin);
  visit(Parameter{"integration.skin_at_rest", dimension::none, between(0, 1),
                  "share of that skin which particles at rest have: with a smaller one lists of a bed are shorter, and "
                  "rebuilt as soon as it moves"},
        p.integration.skin_at_rest);
  visit(
      Parameter{
          "integration.pair_precision",
          {},
          {},
          "precision of the sums over pairs; single: relative error 1e-6 of a sum, about twice as fast; the state "
          "stays double"},
      p.integration.pair_precision);
  visit(
      Parameter{
          "integration.instruction_set", {}, {}, "instruction set of the sums over neighbours; the bits depend on it"},
      p.integration.instruction_set);
}

/// Whether a particle in a free surface is as loose as the kernel, half empty there, says it is. Eq. 16 keeps what
/// separates a density from the kernel's sum, wherever the particle goes: one that began at a free surface with the
/// density of the bed would be buried at a packing of 0.51 and bear as much there as others at 0.6. A body that bears
/// tension would pull its own skin in; its surfaces stay surfaces.
bool is_loose_where_free(const Parameters& parameters);

/// sph.density_relaxation where it holds, else 0: what a shear strain of 1 takes back of the difference between the
/// kernel's sum and the density. Eq. 16 is the rate of the kernel's sum for a constant smoothing length and between
/// mirrors; what else there is adds up with the strain (docs/design/stabilisation.md). Where grains stick together a
/// density is drawn upwards only: a lack of neighbours is a free surface, which no crack has opened.
double density_relaxation(const Parameters& parameters);

/// Whether they are drawn by the shear that lasts (State::lasting_rate) and not by each step's. Particles beside a
/// round wall of a vessel jitter: a shear to and fro, by which a density loses nothing that would have to be taken
/// back, and beside walls the kernel's sum is some per cent off (docs/design/stabilisation.md).
bool draws_by_lasting_rate(const Parameters& parameters);

/// K, sph.stress_regularisation where the law has it, else 0.
double stress_regularisation(const Parameters& parameters);

/// Whether the grains stick together.
bool has_cohesion(const Parameters& parameters);

/// walls.adhesion where grains stick together and walls rub, else 0, Pa.
/// \param of_part of the vessel, which counts where it is given
double wall_adhesion(const Parameters& parameters, const std::optional<double>& of_part = {});

/// epsilon, sph.artificial_stress where grains stick together, else 0.
double artificial_stress(const Parameters& parameters);

/// Contradictions between keys that are each valid by themselves; empty if there are none.
std::vector<Problem> check(const Parameters& parameters);

}  // namespace talus::continuum

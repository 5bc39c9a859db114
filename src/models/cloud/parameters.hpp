// SPDX-License-Identifier: Apache-2.0
/// Parameters of the cloud model: grains that interact through a viscous fluid on an incline or in free space (Niiya,
/// Awazu & Nishimori 2020). SI, angles in radians; the initial values are the defaults.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/instruction_set.hpp"
#include "base/parameter.hpp"
#include "models/cloud/pair_sum.hpp"
#include "numerics/run_record.hpp"

namespace talus::cloud {

enum class Shape { circle, rectangle, triangle, wedge, ball, dome, file };
enum class RadiusDistribution { uniform, normal };
enum class Boundary { centres, whole };
/// How the sum over pairs is computed.
enum class Sum { automatic, direct, spectral };
enum class Method { chebyshev, dormand_prince, euler };

struct Parameters {
  std::int64_t seed = 1;
  struct Particles {
    Shape shape = Shape::circle;
    std::int64_t count = 2000;
    std::optional<double> size, length, width;  ///< m; those that the shape needs, ensured by check()
    std::string file;
    double radius = 0;
    double radius_spread = 0.05;
    RadiusDistribution radius_distribution = RadiusDistribution::uniform;
    Boundary boundary = Boundary::centres;
    double density = 0;
  } particles;
  struct Fluid {
    double density = 1.2;
    double viscosity = 1.82e-5;
    hydrodynamics::Mobility mobility = hydrodynamics::Mobility::rotne_prager_1969;
    Precision precision = Precision::double_precision;
    Sum sum = Sum::automatic;
    double sum_error = 1e-3;
  } fluid;
  struct Contact {
    bool enabled = true;
    double stiffness = 10;
  } contact;
  struct Slope {
    bool enabled = true;
    double angle = 0;
  } slope;
  struct Gravity {
    double acceleration = 9.81;
    std::optional<std::array<double, 3>> direction;
  } gravity;
  Motion motion = Motion::xy;
  struct Integration {
    Method method = Method::chebyshev;
    double max_step = 0.1;
    double tolerance = 0.02;
    double overlap_growth = 0.05;
    double max_overlap = 0.5;
    InstructionSet instruction_set = InstructionSet::automatic;
  } integration;
};

inline constexpr RenamedKey renamed_keys[] = {
    {"integration.largest_step", "integration.max_step"},
    {"integration.largest_overlap", "integration.max_overlap"},
};

/// Every key, once: parsing, ranges, defaults, schema, reference page and `talus check` follow from this list.
template <class Visit, class P>
void for_each_parameter(Visit&& visit, P& p) {
  visit(Parameter{"particles.shape",
                  {},
                  {},
                  "initial arrangement of the grains: circle, rectangle, triangle and wedge (a heap with a level "
                  "surface behind a gate perpendicular to the slope) in the plane of motion, ball and dome (half a "
                  "ball on the slope) in space, or a file of points",
                  true},
        p.particles.shape);
  auto packed = only_if(unless("particles.shape", p.particles.shape, Shape::file), visit);
  packed(Parameter{"seed", dimension::none, between(0, 9e15), "seed of the radii and positions"}, p.seed);
  packed(Parameter{"particles.count", dimension::none, between(1, 1e7), "number of grains"}, p.particles.count);
  visit(
      Parameter{"particles.size", dimension::length, above(0),
                "radius of the circle, ball or dome; height of the triangle, whose base on the slope is twice as long; "
                "depth of the gate's foot below the wedge's surface"},
      p.particles.size);
  visit(Parameter{"particles.length", dimension::length, above(0), "rectangle: extent along x"}, p.particles.length);
  visit(Parameter{"particles.width", dimension::length, above(0), "rectangle: extent across (y or z)"},
        p.particles.width);
  visit(Parameter{"particles.file",
                  {},
                  {},
                  "CSV file, relative to the case, with the columns x, y, z and radius (or r, diameter), each with its "
                  "unit as in x [mm]; without units m"},
        p.particles.file);
  visit(Parameter{"particles.radius", dimension::length, above(0), "mean radius a_p; the unit of length of the results",
                  true},
        p.particles.radius);
  packed(Parameter{"particles.radius_spread", dimension::none, between(0, 0.9),
                   "half the width of the radii's uniform "
                   "distribution, or the standard deviation of the normal one (cut at 3), over the mean radius"},
         p.particles.radius_spread);
  packed(Parameter{"particles.radius_distribution", {}, {}, "distribution of the radii"},
         p.particles.radius_distribution);
  packed(
      Parameter{"particles.boundary", {}, {}, "whether the grains' centres or the whole grains lie inside the shape"},
      p.particles.boundary);
  visit(Parameter{"particles.density", dimension::density, above(0), "true density of the grains", true},
        p.particles.density);

  visit(Parameter{"fluid.density", dimension::density, at_least(0), "density of the fluid"}, p.fluid.density);
  visit(Parameter{"fluid.viscosity", dimension::viscosity, between(1e-7, 1e9),
                  "dynamic viscosity of the fluid: gases have 1e-5 Pa s, pitch 1e8"},
        p.fluid.viscosity);
  visit(Parameter{"fluid.mobility",
                  {},
                  {},
                  "hydrodynamic interaction of the grains: the printed tensor, its symmetric form for unequal and "
                  "overlapping spheres, or none"},
        p.fluid.mobility);
  auto dragged = only_if(unless("fluid.mobility", p.fluid.mobility, hydrodynamics::Mobility::none), visit);
  dragged(
      Parameter{
          "fluid.precision", {}, {}, "arithmetic of the direct sum over pairs; positions and overlaps are double"},
      p.fluid.precision);
  dragged(Parameter{"fluid.sum",
                    {},
                    {},
                    "how the sum over pairs is computed: direct; spectral, by a grid and Fourier transforms at a cost "
                    "of N log N; or automatic, spectral for 5000 grains and more in a plane and 20,000 in space where "
                    "it is cheaper and reaches fluid.sum_error"},
          p.fluid.sum);
  auto split = only_if(unless("fluid.sum", p.fluid.sum, Sum::direct), dragged);
  split(Parameter{"fluid.sum_error", dimension::none, between(1e-15, 0.1),
                  "allowed error of the spectral sum: root mean square over that of the sums; steps of 1e-3, 1e-4 "
                  "and 1e-5"},
        p.fluid.sum_error);

  visit(Parameter{"contact.enabled", {}, {}, "whether grains that overlap repel each other and the slope"},
        p.contact.enabled);
  auto touching = only_if(where("contact.enabled", p.contact.enabled, true), visit);
  touching(Parameter{"contact.stiffness", dimension::stiffness, above(0), "spring constant k_n of grains and slope"},
           p.contact.stiffness);

  visit(Parameter{"slope.enabled", {}, {}, "whether the plane z = 0 supports the grains (a wall for contacts only)"},
        p.slope.enabled);
  visit(Parameter{"slope.angle", dimension::angle, between(0, 1.5707963267948966), "incline; x points down the slope"},
        p.slope.angle);

  visit(Parameter{"gravity.acceleration", dimension::acceleration, at_least(0), "acceleration of gravity"},
        p.gravity.acceleration);
  visit(Parameter{"gravity.direction",
                  {},
                  {},
                  "direction of gravity, of any length; left out: down the incline of "
                  "slope.angle, [sin, 0, -cos]"},
        p.gravity.direction);

  visit(Parameter{"motion", {}, {}, "the plane in which the grains move, or all space"}, p.motion);

  visit(Parameter{"integration.method",
                  {},
                  {},
                  "damped Runge-Kutta-Chebyshev of first order; Dormand and Prince's Runge-Kutta pair of fifth order, "
                  "for grains with few contacts (stiff contacts shorten its steps); or explicit Euler at its stability "
                  "limit (a reference for tests)"},
        p.integration.method);
  visit(Parameter{"integration.max_step", dimension::none, above(0), "largest time step, in a_p/v_s"},
        p.integration.max_step);
  auto adaptive = only_if(unless("integration.method", p.integration.method, Method::euler), visit);
  adaptive(Parameter{"integration.tolerance", dimension::none, above(0),
                     "allowed root mean square of the local error of a "
                     "step, in a_p"},
           p.integration.tolerance);
  visit(Parameter{"integration.overlap_growth", dimension::none, above(0),
                  "a step that makes the largest overlap grow "
                  "by more than this, in a_p, is repeated at half its length"},
        p.integration.overlap_growth);
  visit(Parameter{"integration.max_overlap", dimension::none, above(0),
                  "a run whose largest overlap passes this, in "
                  "a_p, is stopped"},
        p.integration.max_overlap);
  visit(
      Parameter{"integration.instruction_set", {}, {}, "instruction set of the sum over pairs; the bits depend on it"},
      p.integration.instruction_set);
}

/// Contradictions between keys that are each valid by themselves; empty if there are none.
std::vector<Problem> check(const Parameters& parameters);

/// Whether a case is within the assumptions of the model: the lines of the validity report that are known before the
/// run.
std::vector<RegimeLine> regime_of_case(const Parameters& parameters);

/// Quantities that follow from the parameters alone.
struct Scales {
  Vector3 gravity;  ///< unit vector
  double driving;   ///< share of gravity that drives the flow: sin(slope.angle) on a slope, else its part in the plane
  double mean_weight;      ///< N, less buoyancy, of a grain of the mean radius
  double stokes_speed;     ///< v_s, m/s, Eq. 5b
  double stokes_time;      ///< a_p/v_s, s
  double contact_ratio;    ///< gamma of Eq. 9 with an overlap of 0.01 a_p
  double volume_fraction;  ///< grains over the shape: area in a plane, volume in space; 0 for a file
};
Scales scales(const Parameters& parameters);

/// Of the stability polynomial: stiff modes decay by at least 10 % per step.
inline constexpr double stage_damping = 0.1;

/// Rate at which contacts that form within a step relax, 1/s: a floor for the estimate, since the power iteration
/// has only the contacts of the start. In units of k_n/(6 pi mu a_p): 1.5 with drag between the grains (the relative
/// mobility of touching grains is small), 6 without (a triangular lattice of springs).
double contact_rate(const Parameters& parameters);

/// The longest step with which a rate is stable, s: of as many stages as Chebyshev's may be, of Dormand and Prince's,
/// or of the one of explicit Euler. \param rate 1/s, > 0
double max_stable_step(const Parameters& parameters, double rate);

}  // namespace talus::cloud

namespace talus {
template <>
inline constexpr auto choices<cloud::Shape> = std::to_array<std::string_view>({"circle", "rectangle", "triangle",
                                                                               "wedge", "ball", "dome", "file"});
template <>
inline constexpr auto choices<cloud::RadiusDistribution> = std::to_array<std::string_view>({"uniform", "normal"});
template <>
inline constexpr auto choices<cloud::Boundary> = std::to_array<std::string_view>({"centres", "whole"});
template <>
inline constexpr auto choices<cloud::Sum> = std::to_array<std::string_view>({"automatic", "direct", "spectral"});
template <>
inline constexpr auto choices<cloud::Method> = std::to_array<std::string_view>({"chebyshev", "dormand-prince",
                                                                                "euler"});
}  // namespace talus

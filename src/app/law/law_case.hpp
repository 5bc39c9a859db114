// SPDX-License-Identifier: Apache-2.0
/// What `talus law` reads: the law of a case, and the path that a particle of its grains is led through.
#pragma once

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "base/parameter.hpp"
#include "io/case_file.hpp"
#include "models/continuum/setup/choices.hpp"
#include "numerics/run_record.hpp"
#include "physics/granular/collisional_stress.hpp"
#include "physics/granular/law.hpp"
#include "physics/granular/material_path.hpp"

namespace talus::app {

/// A case of a law alone, or that part of a whole case. Keys and defaults are as in the model `continuum`, but for
/// the table [path].
struct LawCase {
  granular::LawParameters law;
  granular::CollisionParameters collisions;
  struct Grains {
    std::optional<continuum::GrainMaterial> material;
    double density = 2500;
    double diameter = 200e-6;
    continuum::MaterialRange range;  ///< where the material's values hold; without a name where there is none
  } grains;
  struct Gravity {
    double acceleration = 9.81;
  } gravity;
  /// That talus shear-cell tests the grains on; without a coefficient none.
  struct Walls {
    std::optional<continuum::WallMaterial> material;
    std::optional<double> coefficient;
    double adhesion = 0;
  } walls;
  struct Path {
    std::optional<double> packing;
    double max_increment = 1e-6;
    std::int64_t points = 0;
  } path;
};

/// Every key, once.
template <class Visit, class P>
void for_each_parameter(Visit&& visit, P& p) requires std::same_as<std::remove_const_t<P>, LawCase> {
  granular::for_each_parameter(visit, p.law);
  granular::for_each_parameter(visit, p.collisions);
  visit(Parameter{"grains.material", {}, {}, "what the grains are (talus materials); the law's moduli stay its own"},
        p.grains.material);
  visit(Parameter{"grains.density", dimension::density, above(0), "true density of the grains, rho_p"},
        p.grains.density);
  visit(Parameter{"grains.diameter", dimension::length, above(0), "diameter of the grains, D_p"}, p.grains.diameter);
  visit(Parameter{"gravity.acceleration", dimension::acceleration, above(0), "g of Eqs 13 and 14"},
        p.gravity.acceleration);
  visit(Parameter{"walls.material", {}, {}, "what the wall of talus shear-cell is made of: its friction follows"},
        p.walls.material);
  visit(Parameter{"walls.coefficient", dimension::none, friction_coefficient(),
                  "coefficient of that wall's friction; left out: by walls.material, or no wall"},
        p.walls.coefficient);
  visit(Parameter{"walls.adhesion", dimension::pressure, at_least(0), "shear stress that the wall bears besides"},
        p.walls.adhesion);
  visit(Parameter{"path.packing", dimension::none, between(0.01, 0.74),
                  "packing at the start, free of stress; left out: that at which the law's grains touch"},
        p.path.packing);
  visit(Parameter{"path.max_increment", dimension::none, between(1e-9, 1e-3), "largest strain within a step"},
        p.path.max_increment);
  visit(Parameter{"path.points", dimension::none, between(0, 1e6),
                  "rows recorded for each line of the path; 0: as many as make 600 rows in all, at least 1"},
        p.path.points);
}

/// Of a case that names a model only what concerns the law is read and checked; one without is all the law's own.
/// \throws InputError with every problem, and for a file without a law: of another model, or empty
LawCase read_law_case(const CaseFile& file);

/// Reads a path: a line per stretch, with its duration and the components gradient_xx, gradient_xy, ... of the velocity
/// gradient, of which those left out are zero; a column stress_xx, stress_yy, stress_zz or stress_xz prescribes that
/// component of the stress, at the end of each stretch, in place of the gradient. \throws FileError, InputError with
/// every bad line
std::vector<granular::PathStretch> read_path(const std::filesystem::path& path);

/// Options of the case for a path of so many stretches.
granular::PathOptions path_options(const LawCase& parameters, std::size_t stretches);

/// A path that was followed.
struct FollowedPath {
  LawCase parameters;
  granular::AnyLaw law;
  std::vector<granular::PathStretch> stretches;
  granular::PathOptions options;
  std::vector<granular::PathPoint> points;  ///< as follow_path
};

/// Largest and last values of the path, for the screen.
std::vector<NamedValue> quantities_of(const FollowedPath& path);

/// A row per point: time, stretch, packing, pressure, shear stress (|tau_dev|/2^(1/2)), friction (their ratio), strain
/// and stress, the stress by collisions unless there are none, and what the law remembers. Strain since the start.
/// \throws FileError
void write_path_table(const FollowedPath& path, const std::filesystem::path& file);

/// A1 to A4 of a fitted law (the paper's Figure 1), the friction and the pressure that follow, against strain: as
/// printed and, where they are, as repaired. \throws FileError
void write_functions(const granular::Fits& fits, const std::filesystem::path& file);

}  // namespace talus::app

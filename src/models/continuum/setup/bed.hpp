// SPDX-License-Identifier: Apache-2.0
/// The bed at the start: [bed], and the seed of what is random in it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/parameter.hpp"
#include "base/vector.hpp"

namespace talus::continuum {

struct Parameters;
struct BedWalls;

/// The particles of bed.file. SI; columns that the file does not have are empty.
struct GivenBed {
  std::vector<Vector3> position, velocity;
  std::vector<double> density;      ///< bulk density, kg/m^3
  std::vector<int> lines;           ///< of a text file, by particle, from 1; empty: of another
  std::vector<std::string> unread;  ///< columns without a meaning here
  Vector3 low, high;                ///< corners of the box around the positions, m
};

/// Where a bed lies and how it moves. SI.
struct BedRegion {
  std::optional<double> mass;
  double height = 0;  ///< m; 0: no bed. With a mass that which holds it, with a file that of its particles (with_level)
  std::optional<double> bottom;
  std::optional<double> left, right, front, rear;
  std::optional<std::array<double, 3>> inside;
  std::optional<std::array<double, 3>> velocity;

  /// The walls of the vessel between which it lies. Not a key: Layout finds them (bed_walls.hpp).
  std::shared_ptr<const BedWalls> walls = nullptr;
};

struct BedParameters : BedRegion {
  double packing = 0.6;
  double spacing = 0;
  std::string file;
  double disorder = 0;

  /// What the file holds. Not a key: who reads the case fills it in.
  std::shared_ptr<const GivenBed> given = nullptr;
};

/// One of [[beds]].
struct TaggedBed : BedRegion {
  std::int64_t tag = 1;
};

/// The key of the nth of [[beds]], from 0.
std::string beds_key(std::size_t n, std::string_view name);

/// \param key of a name; \param optional whether there may be no bed there
template <class Visit, class Key, class Region>
void for_each_parameter_of_region(Visit&& visit, Key&& key, Region& bed, bool optional) {
  visit(
      Parameter{
          key("mass"),
          {0, 1, 0, 0},
          above(0),
          "mass of the bed, to the nearest particle, in place of its height: the bed fills its region from below"},
      bed.mass);
  auto filled = only_if({key("mass"), "is given", "left out", !bed.mass}, visit);
  constexpr std::string_view whole = "height of the bed at the start, where its mass is not given";
  constexpr std::string_view or_none =
      "height of the bed at the start, where neither its mass nor a file is given; left out with an [[inlet]] or "
      "[[beds]]: no bed, else required";
  filled(Parameter{key("height"), dimension::length, optional ? at_least(0) : above(0), optional ? or_none : whole,
                   !optional},
         bed.height);
  visit(Parameter{key("bottom"), dimension::length, at_least(0),
                  "bottom of the bed; left out: that of the vessel, the plate, the wedge's outlet, or the floor"},
        bed.bottom);
  visit(
      Parameter{
          key("left"), dimension::length, at_least(0),
          "start of the bed along x; left out: the left face, or the least x of the walls of a [[vessel]] between "
          "which it lies"},
      bed.left);
  visit(Parameter{key("right"), dimension::length, above(0),
                  "end of the bed along x; left out: the right face, or the largest x of such walls"},
        bed.right);
  visit(
      Parameter{
          key("front"), dimension::length, at_least(0),
          "start of the bed along y; left out: the front face, or the least y of the walls of a [[vessel]] between "
          "which it lies"},
      bed.front);
  visit(Parameter{key("rear"), dimension::length, above(0),
                  "end of the bed along y; left out: the rear face, or the largest y of such walls"},
        bed.rear);
  visit(Parameter{key("inside"),
                  dimension::length,
                  {},
                  "a place within the bed's region, x, y and z: the bed fills what is connected with it, no plate or "
                  "wall between; left out: the places above the level gates of a [[vessel]], else above its outlet, "
                  "else the middle of the bed's top"},
        bed.inside);
}

constexpr std::string_view text_of_bed_velocity = "initial velocity of the bed; left out: at rest";

/// \param optional whether there may be no such bed: grains come in through an inlet, or there are others
template <class Visit, class B, class Seed>
void for_each_parameter_of_bed(Visit&& visit, B& bed, Seed& seed, bool optional) {
  visit(Parameter{"bed.packing", dimension::none, between(1e-4, 0.74), "packing fraction at the start"}, bed.packing);
  visit(
      Parameter{"bed.spacing", dimension::length, above(0),
                "distance of the particles at the start; adjusted to whole numbers of particles along each side", true},
      bed.spacing);
  visit(Parameter{"bed.file",
                  {},
                  {},
                  "CSV or VTKHDF file of the particles at the start, in place of the other keys that say where the bed "
                  "lies: positions, and velocities and bulk densities if it has them; each has the mass of a cube of "
                  "bed.spacing at bed.packing; a path without / in front starts at the case's folder; left out: the "
                  "bed fills its region"},
        bed.file);
  auto laid = only_if({"bed.file", "is given", "left out", bed.file.empty()}, visit);
  for_each_parameter_of_region(
      laid, [](std::string_view name) { return "bed." + std::string(name); }, bed, optional);
  visit(Parameter{"bed.velocity", dimension::velocity, {}, text_of_bed_velocity}, bed.velocity);
  visit(Parameter{"bed.disorder", dimension::none, between(0, 0.1),
                  "how far the particles stand from their places at the start, at most, along each axis, in units of "
                  "bed.spacing; 0: on them. Runs that differ in the seed alone show what is chance: 1e-6 will do"},
        bed.disorder);
  auto random = only_if({"bed.disorder", "is 0", "above 0", bed.disorder > 0}, visit);
  random(Parameter{"seed", dimension::none, between(0, 9e15), "seed of the displacements by bed.disorder"}, seed);
}

template <class Visit, class B>
void for_each_parameter_of_beds(Visit&& visit, B& beds) {
  for (std::size_t n = 0; n < beds.size(); ++n) {
    const auto key = [n](std::string_view name) { return beds_key(n, name); };
    visit(
        Parameter{key("tag"), dimension::none, between(0, 1e9),
                  "number of its grains in the column `tag` of snapshots, in which those of [bed] have 0 and those of "
                  "inlets -1; left out: the number of the bed among [[beds]]"},
        beds[n].tag);
    for_each_parameter_of_region(visit, key, beds[n], false);
    visit(Parameter{key("velocity"), dimension::velocity, {}, text_of_bed_velocity}, beds[n].velocity);
  }
}

/// Particles that the case cannot begin with: outside the box, too near to each other, without a positive density, or
/// not finite; the first of them and their count. \pre bed.given
std::vector<Problem> check_given_bed(const Parameters& parameters);

}  // namespace talus::continuum

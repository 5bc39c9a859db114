// SPDX-License-Identifier: Apache-2.0
/// Parameters of every type that can be read, for the tests of reader, writer and schema. Not a model.
#pragma once

#include <array>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "base/parameter.hpp"

namespace talus::example {

enum class Shape { circle, rectangle, triangle };
enum class Scheme { euler, chebyshev };

struct Parameters {
  std::int64_t seed = 1;
  std::string title;
  struct Particles {
    Shape shape = Shape::circle;
    std::int64_t count = 2000;
    double radius = 0;
    double radius_spread = 0.05;
    double density = 2500;
    std::optional<double> size;
  } particles;
  struct Slope {
    bool enabled = true;
    double angle = std::numbers::pi / 4;
  } slope;
  struct Gravity {
    std::array<double, 3> direction = {0, 0, -1};
    std::optional<std::array<double, 3>> origin;
  } gravity;
  struct Numerics {
    Scheme scheme = Scheme::chebyshev;
    double porosity = 0.4;
    double temperature_slope = -3;
  } numerics;
};

struct Run {
  double end = 0;
  std::vector<double> snapshots = {0.001, 0.002};
  std::vector<double> weights;
};

template <class Visit, class P>
requires std::is_same_v<std::remove_const_t<P>, Parameters>
void for_each_parameter(Visit&& visit, P& p) {
  visit(Parameter{"seed", {}, between(0, 9e15), "seed of the radii"}, p.seed);
  visit(Parameter{"title", {}, {}, "a title | free text"}, p.title);
  visit(Parameter{"particles.shape", {}, {}, "shape at the start", true}, p.particles.shape);
  visit(Parameter{"particles.count", {}, between(1, 1e7), "number of particles"}, p.particles.count);
  visit(Parameter{"particles.radius", dimension::length, above(0), "mean radius", true}, p.particles.radius);
  visit(Parameter{"particles.radius_spread", {}, between(0, 0.9), "half width"}, p.particles.radius_spread);
  visit(Parameter{"particles.density", dimension::density, above(0), "true density"}, p.particles.density);
  visit(Parameter{"particles.size", dimension::length, above(0), "size of the shape"}, p.particles.size);
  visit(Parameter{"slope.enabled", {}, {}, "whether there is a slope"}, p.slope.enabled);
  visit(Parameter{"slope.angle", dimension::angle, between(0, std::numbers::pi / 2), "incline"}, p.slope.angle);
  visit(Parameter{"gravity.direction", {}, {}, "direction of gravity"}, p.gravity.direction);
  visit(Parameter{"gravity.origin", dimension::length, {}, "a place"}, p.gravity.origin);
  visit(Parameter{"numerics.scheme", {}, {}, "integrator"}, p.numerics.scheme);
  visit(Parameter{"numerics.porosity", {}, {.min = 0, .max = 1, .min_excluded = true, .max_excluded = true}, "p"},
        p.numerics.porosity);
  visit(Parameter{"numerics.temperature_slope", {}, {.max = 0, .max_excluded = true}, "s"},
        p.numerics.temperature_slope);
}

template <class Visit, class P>
requires std::is_same_v<std::remove_const_t<P>, Run>
void for_each_parameter(Visit&& visit, P& p) {
  visit(Parameter{"run.end", dimension::time, above(0), "simulated time", true}, p.end);
  visit(Parameter{"output.snapshots", dimension::time, at_least(0), "times of the snapshots"}, p.snapshots);
  visit(Parameter{"output.weights", {}, {}, "weights of the snapshots"}, p.weights);
}

inline constexpr const char* minimal_case = R"(
particles.shape = "circle"
particles.radius = "5 mm"
run.end = "1 s"
)";

}  // namespace talus::example

namespace talus {
template <>
inline constexpr auto choices<example::Shape> = std::to_array<std::string_view>({"circle", "rectangle", "triangle"});
template <>
inline constexpr auto choices<example::Scheme> = std::to_array<std::string_view>({"euler", "chebyshev"});
}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
/// What quantities are called and how they are written: names, SI units and examples of the dimensions that occur.
#include <fmt/format.h>

#include <array>

#include "base/unit.hpp"

namespace talus {

namespace {

/// Dimensions that have a name, and how they are written.
struct Naming {
  Dimension dimension;
  std::string_view name, unit, example_value, example_unit;
};
constexpr auto namings = std::to_array<Naming>({
    {dimension::none, "number", "", "0.5", ""},
    {dimension::length, "length", "m", "5", "mm"},
    {{2, 0, 0, 0}, "area", "m2", "4", "mm2"},
    {{3, 0, 0, 0}, "volume", "m3", "1", "cm3"},
    {{0, 1, 0, 0}, "mass", "kg", "2", "g"},
    {dimension::time, "time", "s", "5", "ms"},
    {{0, 0, -1, 0}, "rate", "1/s", "50", "1/s"},
    {dimension::angle, "angle", "deg", "45", "deg"},
    {{0, 0, -1, 1}, "angular velocity", "rad/s", "2", "rad/s"},
    {dimension::velocity, "velocity", "m/s", "2", "m/s"},
    {dimension::acceleration, "acceleration", "m/s2", "9.81", "m/s2"},
    {{1, 1, -2, 0}, "force", "N", "0.1", "N"},
    {{0, 1, -1, 0}, "mass flow rate", "kg/s", "0.2", "kg/s"},
    {dimension::density, "density", "kg/m3", "2500", "kg/m3"},
    {dimension::viscosity, "dynamic viscosity", "Pa s", "1.82e-5", "Pa s"},
    {{2, 0, -1, 0}, "kinematic viscosity", "m2/s", "1.5e-5", "m2/s"},
    {dimension::stiffness, "stiffness", "N/m", "10", "N/m"},
    {dimension::pressure, "pressure", "Pa", "101325", "Pa"},
});

const Naming* naming_of(Dimension dimension) {
  for (const Naming& naming : namings)
    if (naming.dimension == dimension) return &naming;
  return nullptr;
}

}  // namespace

std::string unit_name(Dimension dimension) {
  if (const Naming* naming = naming_of(dimension)) return std::string(naming->unit);
  std::string text;
  const auto add = [&](std::string_view unit, int power) {
    if (power == 0) return;
    if (!text.empty()) text += ' ';
    text += unit;
    if (power != 1) text += fmt::format("^{}", power);
  };
  add("m", dimension.length);
  add("kg", dimension.mass);
  add("s", dimension.time);
  add("rad", dimension.angle);
  return text;
}

std::string dimension_name(Dimension dimension) {
  if (const Naming* naming = naming_of(dimension)) return std::string(naming->name);
  return "quantity in " + unit_name(dimension);
}

std::string unit_example(Dimension dimension) {
  const Naming* naming = naming_of(dimension);
  if (!naming) return "1 " + unit_name(dimension);
  if (naming->example_unit.empty()) return std::string(naming->example_value);
  return fmt::format("{} {}", naming->example_value, naming->example_unit);
}

std::string example_unit(Dimension dimension) {
  const Naming* naming = naming_of(dimension);
  return naming ? std::string(naming->example_unit) : unit_name(dimension);
}

}  // namespace talus

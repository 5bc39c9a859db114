// SPDX-License-Identifier: Apache-2.0
/// A silo beside a conveyor, for the tests of beds; lengths in spacings.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "models/continuum/setup/bed_report.hpp"
#include "models/continuum/vessel_parts.hpp"

namespace talus::continuum {

inline VesselPart tube(std::string name, double x, double y, double radius, double bottom, double top) {
  VesselPart part = named(std::move(name), VesselShape::cylinder);
  part.centre = {x * spacing, y * spacing};
  part.radius = radius * spacing, part.bottom = bottom * spacing, part.top = top * spacing;
  return part;
}

inline VesselPart gate_at(double x, double y, double radius, double height) {
  VesselPart part = disc("gate", radius, height);
  part.centre = {x * spacing, y * spacing};
  part.gate = true;
  return part;
}

/// A silo, its gate shut, beside which a conveyor reaches far to one side: the middle of all walls is outside the silo.
inline Parameters beside_a_silo() {
  Parameters p = room(65, 20, 50);
  p.gate.opens = GateOpens::when_settled;
  p.vessel = {tube("silo", 10, 10, 6, 20, 45), gate_at(10, 10, 6, 20),
              plate("belt", {2, 3, 12}, {60, 0, 0}, {0, 14, 0})};
  p.bed.bottom = 20 * spacing;
  p.bed.height = 10 * spacing;
  return p;
}

inline std::size_t count_within(const std::vector<Vector3>& bed, double x, double y, double radius) {
  return static_cast<std::size_t>(std::count_if(bed.begin(), bed.end(), [&](const Vector3& at) {
    return std::hypot(at.x - x * spacing, at.y - y * spacing) < radius * spacing;
  }));
}

inline std::vector<std::string> warnings(const Parameters& p) {
  std::vector<std::string> quantities;
  for (const RegimeLine& line : regime_of_bed(Layout(p))) quantities.push_back(line.quantity);
  return quantities;
}

}  // namespace talus::continuum

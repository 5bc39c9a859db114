// SPDX-License-Identifier: Apache-2.0
#include "analysis/hopper_regions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/statistics.hpp"

namespace talus {

namespace {

constexpr double depth_in_spacings = 3;

}  // namespace

Vessel HopperShape::bin() const {
  return {0, plate ? plate->height : height, Vessel::Search::from_below};
}

Vessel HopperShape::hopper() const {
  return {plate.value().height, height, Vessel::Search::from_above};
}

HopperSurfaces hopper_surfaces(const Section& packing, const HopperShape& shape) {
  return {free_surface(packing, shape.bin()), shape.plate ? free_surface(packing, shape.hopper()) : FreeSurface{}};
}

std::vector<bool> deep_particles(std::span<const Vector3> position, const HopperSurfaces& surfaces,
                                 const HopperShape& shape) {
  const double least = depth_in_spacings * shape.spacing;
  std::vector<bool> deep;
  for (const Vector3& x : position) {
    const bool in_hopper = shape.plate && x.z >= shape.plate->height;
    const bool at_slit = shape.plate && x.x > shape.plate->slit_left && x.x < shape.plate->slit_right &&
                         std::abs(x.z - shape.plate->height) < least;
    deep.push_back(!at_slit && (in_hopper ? surfaces.hopper : surfaces.bin).height(x.x) - x.z > least);
  }
  return deep;
}

double mean_between(std::span<const Vector3> position, std::span<const double> values, double from, double to) {
  std::vector<double> chosen;
  for (std::size_t i = 0; i < position.size(); ++i)
    if (position[i].z > from && position[i].z < to) chosen.push_back(values[i]);
  return mean(chosen);
}

std::vector<bool> above_outlet(std::span<const Vector3> position, const HopperShape& shape) {
  const double height = shape.plate ? shape.plate->height : 0;
  std::vector<bool> above;
  for (const Vector3& x : position) above.push_back(x.z >= height);
  return above;
}

}  // namespace talus

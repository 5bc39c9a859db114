// SPDX-License-Identifier: Apache-2.0
#include "analysis/hopper_regions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/statistics.hpp"

namespace talus {

namespace {

constexpr double depth_in_spacings = 3;

double finite_median(const FreeSurface& surface, double from, double to) {
  std::vector<double> heights;
  for (std::size_t n = 0; n < surface.x.size(); ++n)
    if (surface.x[n] >= from && surface.x[n] <= to && std::isfinite(surface.z[n])) heights.push_back(surface.z[n]);
  return median(heights);
}

/// Distance to a level stretch, in the plane x, z.
double distance_to_stretch(const Vector3& x, double from, double to, double height) {
  return std::hypot(std::max({from - x.x, 0.0, x.x - to}), x.z - height);
}

/// From the nearer of the two side walls, m.
double distance_from_side(const Section& packing, const HopperShape& shape, std::size_t column) {
  return std::min(packing.x(column), shape.width - packing.x(column));
}

/// Mean packing of the two squares of `size` at the bottom of a vessel beside the side walls, over that of the cells of
/// the same layer for which compared(column, row) holds, both without the outermost h/2 at walls and bottom. nan if
/// either is empty.
template <class Compared>
double corner_packing_over(const Section& packing, const Vessel& vessel, const HopperShape& shape, double size,
                           Compared&& compared) {
  const double margin = 0.5 * shape.spacing;
  std::vector<double> corners, others;
  for (std::size_t row = 0; row < packing.rows; ++row) {
    const double above_bottom = packing.z(row) - vessel.bottom;
    if (above_bottom < margin || above_bottom > size) continue;
    for (std::size_t column = 0; column < packing.columns; ++column) {
      const double from_side = distance_from_side(packing, shape, column);
      if (from_side < margin) continue;
      if (from_side <= size) corners.push_back(packing.at(column, row));
      if (compared(column, row)) others.push_back(packing.at(column, row));
    }
  }
  return mean(corners) / mean(others);
}

}  // namespace

double HopperShape::cell() const {
  return width / std::max(1.0, std::round(width / (0.75 * spacing)));
}

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

std::vector<bool> outside_impact(std::span<const Vector3> position, const FreeSurface& bin, const HopperShape& shape,
                                 double distance) {
  const double from = shape.plate ? shape.plate->slit_left : 0, to = shape.plate ? shape.plate->slit_right : 0;
  double height = finite_median(bin, from, to);
  if (!std::isfinite(height)) height = finite_median(bin, 0, shape.width);
  if (!std::isfinite(height)) height = 0;
  std::vector<bool> outside;
  for (const Vector3& x : position) outside.push_back(distance_to_stretch(x, from, to, height) > distance);
  return outside;
}

double stream_width(std::span<const Vector3> position, double from, double to) {
  std::vector<double> x;
  for (const Vector3& p : position)
    if (p.z >= from && p.z < to) x.push_back(p.x);
  return quantile(x, 0.95) - quantile(x, 0.05);
}

double mean_between(std::span<const Vector3> position, std::span<const double> values, double from, double to) {
  std::vector<double> chosen;
  for (std::size_t i = 0; i < position.size(); ++i)
    if (position[i].z > from && position[i].z < to) chosen.push_back(values[i]);
  return mean(chosen);
}

std::vector<bool> outside_outlet(std::span<const Vector3> position, const HopperShape& shape) {
  std::vector<bool> outside;
  for (const Vector3& x : position)
    outside.push_back(!shape.plate || x.z > shape.plate->height || x.x < shape.plate->slit_left ||
                      x.x > shape.plate->slit_right);
  return outside;
}

std::vector<bool> above_outlet(std::span<const Vector3> position, const HopperShape& shape) {
  const double height = shape.plate ? shape.plate->height : 0;
  std::vector<bool> above;
  for (const Vector3& x : position) above.push_back(x.z >= height);
  return above;
}

double corner_packing_over_middle(const Section& packing, const Vessel& vessel, const HopperShape& shape, double size) {
  return corner_packing_over(packing, vessel, shape, size, [&](std::size_t column, std::size_t) {
    return distance_from_side(packing, shape, column) >= shape.width / 3;
  });
}

double corner_packing_ratio(const Section& packing, const FreeSurface& surface, const Vessel& vessel,
                            const HopperShape& shape, double size) {
  return corner_packing_over(packing, vessel, shape, size, [&](std::size_t column, std::size_t row) {
    return surface.z[column] - packing.z(row) > depth_in_spacings * shape.spacing;
  });
}

}  // namespace talus

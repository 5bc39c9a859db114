// SPDX-License-Identifier: Apache-2.0
/// The free surface of grains in a vessel: packing in the plane x, z as the mean over the depth y, the height Z(x) at
/// which it passes a level, the slopes of heaps and their angle of repose.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "analysis/particle_field.hpp"

namespace talus {

/// Values on the cells of a grid in x, z: row by row, x fastest.
struct Section {
  double x0 = 0, z0 = 0;         ///< lower left corner, m
  double width = 0, height = 0;  ///< of a cell, m
  std::size_t columns = 0, rows = 0;
  std::vector<double> value;

  double x(std::size_t column) const { return x0 + (static_cast<double>(column) + 0.5) * width; }
  double z(std::size_t row) const { return z0 + (static_cast<double>(row) + 0.5) * height; }
  double at(std::size_t column, std::size_t row) const { return value[row * columns + column]; }
};

/// Packing at the centres of cells that fill the domain's box, about `width` wide and `height` high: whole numbers of
/// them. Each particle is spread by its kernel, integrated along y: between mirror or periodic faces the exact mean
/// over the depth; beyond open front and rear faces it counts as if it lay between them. Images at the side walls, the
/// floor and plates count as in ParticleField. \param width, height > 0, m
Section packing_section(const Particles& particles, const Domain& domain, double width, double height);

/// Packing on the free surface: half of a loose bed's.
inline constexpr double surface_packing = 0.3;

/// A height at each x; nan where there is no surface.
struct FreeSurface {
  std::vector<double> x, z;  ///< m

  /// Height at x, linear between finite neighbours; nan beyond them.
  double height(double at) const;
};

/// Where a vessel is in a section, and from where its surface is looked for.
struct Vessel {
  double bottom = 0, top = 0;  ///< z, m
  /// From above: the highest position, in a vessel above which nothing falls. From below: the first one above the
  /// bottom, so that grains in the air do not count; a column of grains that reaches the top of the vessel, as a dense
  /// stream does, has none.
  enum class Search { from_above, from_below } search = Search::from_above;
};

/// One height a column of the section, linear between the centres of two rows.
FreeSurface free_surface(const Section& packing, const Vessel& vessel, double level = surface_packing);

/// The surface's slope as a whole: the angle whose tangent is the mean of the sizes of the slopes of two least-squares
/// lines, through the heights left and right of `middle`; rad. Of one half alone if the other has fewer than three
/// heights; nan if both have. \param tilt of what is level, rising along x, rad: slopes are against it
double surface_angle(const FreeSurface& surface, double middle, double tilt = 0);

/// A stretch of a surface that rises or falls all along.
struct HeapSlope {
  double from = 0, to = 0;  ///< x, m
  double slope = 0;         ///< tangent of the angle of the least-squares line through its middle 80 % in x

  double length() const { return to - from; }
  double angle() const;  ///< against the horizontal, rad, >= 0
};

/// The slopes longer than `min_length` along x. Where they begin and end is decided on the 5-point mean of the
/// heights (shorter near gaps and ends); the lines go through the heights themselves. \param min_length m
/// \param tilt of what is level, rising along x, rad: slopes rise and fall against it
std::vector<HeapSlope> heap_slopes(const FreeSurface& surface, double min_length, double tilt = 0);

/// Angles of repose, rad; nan where there is no slope.
struct ReposeAngle {
  double left = 0, right = 0;  ///< of the longest slope whose middle is left and right of the vessel's middle
  double mean = 0;             ///< of both, or of the one there is
  double steepest = 0;         ///< of all slopes
};
ReposeAngle repose_angle(std::span<const HeapSlope> slopes, double middle);

}  // namespace talus

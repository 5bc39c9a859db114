// SPDX-License-Identifier: Apache-2.0
/// The slopes of heaps and their angle of repose, from a free surface.
#pragma once

#include <span>
#include <vector>

#include "analysis/free_surface.hpp"

namespace talus {

/// A stretch of a surface that rises or falls all along.
struct HeapSlope {
  double from = 0, to = 0;  ///< x, m
  double slope = 0;         ///< dZ/dx of the least-squares line through its middle 80 % in x

  double length() const { return to - from; }
  double angle() const;  ///< against the horizontal, rad, >= 0
};

/// The slopes longer than `least_length` along x. Where they begin and end is decided on the 5-point mean of the
/// heights (shorter near gaps and ends); the lines go through the heights themselves. \param least_length m
std::vector<HeapSlope> heap_slopes(const FreeSurface& surface, double least_length);

/// Angles of repose, rad; nan where there is no slope.
struct ReposeAngle {
  double left = 0, right = 0;  ///< of the longest slope whose middle is left and right of the vessel's middle
  double mean = 0;             ///< of both, or of the one there is
  double steepest = 0;         ///< of all slopes
};
ReposeAngle repose_angle(std::span<const HeapSlope> slopes, double middle);

}  // namespace talus

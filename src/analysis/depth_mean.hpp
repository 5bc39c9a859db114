// SPDX-License-Identifier: Apache-2.0
/// Packing in the plane x, z as the mean over the depth y: what a camera in front of a flat vessel sees. Each particle
/// is spread by its kernel, integrated along y; between mirror or periodic faces that is the exact mean. What the
/// kernel spreads beyond open front and rear faces counts as if it lay between them.
#pragma once

#include <cstddef>
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
/// them. Images at the side walls, the floor and plates count as in ParticleField. \param width, height > 0, m
Section packing_section(const Particles& particles, const Domain& domain, double width, double height);

}  // namespace talus

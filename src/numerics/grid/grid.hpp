// SPDX-License-Identifier: Apache-2.0
/// A box of equal rectangular cells. Every field on it, of cells or of faces, is a flat array in the same order, x
/// fastest, with a margin of ghost cells, so that one index and three strides serve all stencils.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/vector.hpp"

namespace talus {

/// A scalar of every cell, or a component on every face of one axis: the face of a cell is its low one, and that of the
/// high boundary the low one of the first ghost.
using CellField = std::vector<double>;

/// One number on each face, by axis.
using FaceField = std::array<std::vector<double>, 3>;

struct Grid {
  static constexpr int margin = 2;  ///< ghost cells on every side

  std::array<int, 3> count{1, 1, 1};  ///< cells along x, y, z
  Vector3 low;                        ///< corner, m
  Vector3 spacing{1, 1, 1};           ///< of a cell, m

  constexpr std::size_t length(int axis) const {
    return static_cast<std::size_t>(count[static_cast<std::size_t>(axis)] + 2 * margin);
  }
  constexpr std::ptrdiff_t stride(int axis) const {
    return static_cast<std::ptrdiff_t>(axis == 0 ? 1 : axis == 1 ? length(0) : length(0) * length(1));
  }
  /// Length of a field.
  constexpr std::size_t size() const { return length(0) * length(1) * length(2); }
  /// Cells, without ghosts.
  constexpr std::size_t cells() const {
    return static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(count[2]);
  }
  /// \param i, j, k from -margin to count + margin - 1
  constexpr std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>(i + margin) +
           length(0) * (static_cast<std::size_t>(j + margin) + length(1) * static_cast<std::size_t>(k + margin));
  }
  /// Number of a row along x among all, ghosts included: positions of a field from row to row are length(0) apart.
  constexpr std::size_t row(int j, int k) const {
    return static_cast<std::size_t>(j + margin) + length(1) * static_cast<std::size_t>(k + margin);
  }
  /// From a row to the next along y or z.
  constexpr std::size_t row_stride(int axis) const { return axis == 0 ? 0 : axis == 1 ? 1 : length(1); }
  constexpr double volume() const { return spacing.x * spacing.y * spacing.z; }
  constexpr double face_area(int axis) const { return volume() / spacing[axis]; }

  constexpr Vector3 centre(int i, int j, int k) const {
    return {low.x + (i + 0.5) * spacing.x, low.y + (j + 0.5) * spacing.y, low.z + (k + 0.5) * spacing.z};
  }

  CellField cell_field() const { return CellField(size()); }
  FaceField face_field() const { return {CellField(size()), CellField(size()), CellField(size())}; }
};

}  // namespace talus

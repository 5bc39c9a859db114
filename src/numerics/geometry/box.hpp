// SPDX-License-Identifier: Apache-2.0
/// The rectangular domain and what each of its six faces is.
#pragma once

#include <array>
#include <string_view>

#include "base/parameter.hpp"
#include "base/vector.hpp"

namespace talus {

enum class FaceKind {
  wall,      ///< solid: mirror particles with the normal velocity reversed; friction; its load is counted
  symmetry,  ///< the same mirror without friction
  periodic,  ///< what leaves here comes in at the opposite face, which is periodic too
  printed,   ///< mirror particles with the velocity of their source, the "free" face of Yuu & Umekage 2011
  open       ///< nothing: particles pass, adjacent faces reach on without end
};

template <>
inline constexpr auto choices<FaceKind> = std::to_array<std::string_view>({"wall", "symmetry", "periodic",
                                                                           "free-as-printed", "open"});

/// Number of a face: side 0 is the low one of an axis, 1 the high one.
constexpr int face_number(int axis, int side) {
  return 2 * axis + side;
}

struct Box {
  Vector3 low, high;              ///< m
  std::array<FaceKind, 6> faces;  ///< by face_number

  constexpr FaceKind face(int axis, int side) const { return faces[static_cast<std::size_t>(face_number(axis, side))]; }
  constexpr bool is_periodic(int axis) const { return face(axis, 0) == FaceKind::periodic; }
  constexpr double bound(int axis, int side) const { return side == 0 ? low[axis] : high[axis]; }
  constexpr double extent(int axis) const { return high[axis] - low[axis]; }
  /// Its faces belong to it; no position that is not a number does.
  constexpr bool contains(const Vector3& x) const {
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis) inside = inside && x[axis] >= low[axis] && x[axis] <= high[axis];
    return inside;
  }
};

/// Whether the face makes mirror particles.
constexpr bool is_mirror(FaceKind kind) {
  return kind == FaceKind::wall || kind == FaceKind::symmetry || kind == FaceKind::printed;
}

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
/// The map from a particle to its image behind a boundary.
#pragma once

#include <array>
#include <cstdint>

#include "base/tensor.hpp"
#include "base/vector.hpp"

namespace talus {

/// The off-diagonal entries of a reflection in the x-z plane.
struct Turn {
  double xz = 0, zx = 0;
  constexpr bool operator==(const Turn&) const = default;
};

/// x' = sign x + turn x + offset, v' = vector_sign v + vector_turn v. Only walls at an angle have off-diagonal entries.
struct Image {
  Vector3 sign{1, 1, 1};
  Vector3 offset;
  Vector3 vector_sign{1, 1, 1};
  Turn turn, vector_turn;
  std::array<std::int8_t, 3> side{};  ///< the mirror face, per axis: -1 low, 1 high, 0 none (or periodic)
  std::array<std::int8_t, 3> copy{};  ///< number of the copy per axis, periodic ones too; 0: within the box
  /// Of an image in walls, by number in Domain::mirrors(): the mirrors that the line to it crosses, in order; -1: none.
  std::array<std::int8_t, 3> mirrors{-1, -1, -1};

  constexpr bool is_in_walls() const { return mirrors[0] >= 0; }
  constexpr bool is_identity() const { return !is_in_walls() && (copy[0] | copy[1] | copy[2]) == 0; }
  constexpr Vector3 position(const Vector3& x) const {
    return {sign.x * x.x + turn.xz * x.z + offset.x, sign.y * x.y + offset.y, sign.z * x.z + turn.zx * x.x + offset.z};
  }
  constexpr Vector3 vector(const Vector3& v) const {
    return {vector_sign.x * v.x + vector_turn.xz * v.z, vector_sign.y * v.y,
            vector_sign.z * v.z + vector_turn.zx * v.x};
  }
  /// A stress or strain of the source, as the image has it.
  constexpr SymmetricTensor3<> tensor(SymmetricTensor3<> t) const {
    if (vector_turn != Turn{})
      return transformed(
          t, Tensor3<>{vector_sign.x, 0, vector_turn.xz, 0, vector_sign.y, 0, vector_turn.zx, 0, vector_sign.z});
    t.xy *= vector_sign.x * vector_sign.y;
    t.yz *= vector_sign.y * vector_sign.z;
    t.zx *= vector_sign.z * vector_sign.x;
    return t;
  }
  /// The position whose image is at x.
  constexpr Vector3 source(const Vector3& x) const {
    const Vector3 d = x - offset;
    return {sign.x * d.x + turn.zx * d.z, sign.y * d.y, sign.z * d.z + turn.xz * d.x};
  }
};

}  // namespace talus

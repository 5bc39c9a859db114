// SPDX-License-Identifier: Apache-2.0
/// The map from a particle to its image behind a boundary.
#pragma once

#include <array>
#include <cstdint>

#include "base/tensor.hpp"
#include "base/vector.hpp"

namespace talus {

/// x' = map x + offset, v' = vector_map v. Both maps are orthogonal.
struct Image {
  Tensor3<> map = identity_tensor;
  Vector3 offset;
  Tensor3<> vector_map = identity_tensor;
  std::array<std::int8_t, 3> side{};  ///< the mirror face, per axis: -1 low, 1 high, 0 none (or periodic)
  std::array<std::int8_t, 3> copy{};  ///< number of the copy per axis, periodic ones too; 0: within the box
  /// Of an image in walls, by number in Domain::mirrors(): the mirrors that the line to it crosses, in order; -1: none.
  std::array<std::int8_t, 3> mirrors{-1, -1, -1};
  /// By how many angles of a sector it is turned about the axis; 0: it stands within the sector.
  std::int8_t turns = 0;

  constexpr bool is_in_walls() const { return mirrors[0] >= 0; }
  constexpr bool is_identity() const { return !is_in_walls() && (copy[0] | copy[1] | copy[2] | turns) == 0; }
  constexpr Vector3 position(const Vector3& x) const { return map * x + offset; }
  constexpr Vector3 vector(const Vector3& v) const { return vector_map * v; }
  /// A stress or strain of the source, as the image has it.
  constexpr SymmetricTensor3<> tensor(SymmetricTensor3<> t) const {
    const Tensor3<>& q = vector_map;
    if (q.xy != 0 || q.xz != 0 || q.yx != 0 || q.yz != 0 || q.zx != 0 || q.zy != 0) return transformed(t, q);
    t.xy *= q.xx * q.yy;
    t.yz *= q.yy * q.zz;
    t.zx *= q.zz * q.xx;
    return t;
  }
  /// The position whose image is at x.
  constexpr Vector3 source(const Vector3& x) const { return transpose(map) * (x - offset); }
};

}  // namespace talus

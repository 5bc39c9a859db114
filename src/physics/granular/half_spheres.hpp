// SPDX-License-Identifier: Apache-2.0
/// The gradient of displacements as the paper takes it: differences of means over two half spheres, for each axis.
///
///     d(x_i - X_i)/dX_j = (<x_i - X_i>_A - <x_i - X_i>_B) / (<X_j>_A - <X_j>_B)
///
/// A and B: the particles within 1.2 h_k around particle k before and behind it along axis j.
/// Source: Yuu & Umekage 2011, Appendix A, Figure A1. The printed formula ends before its denominator: completed.
/// Range: exact for a uniform gradient where the halves are each other's mirror image; where they are not, means along
/// the other axes differ too and come in as a false strain. On the cubic lattice 1.2 h_k holds the particle and its 6
/// neighbours, 6 in each half with those on the plane between: the printed "4~7".
#pragma once

#include "base/tensor.hpp"
#include "base/vector.hpp"

namespace talus::granular {

/// Radius of the sphere over h_k.
inline constexpr double half_sphere_radius = 1.2;

class HalfSpheres {
 public:
  /// Adds a particle within the sphere, particle k itself with an offset of zero. One on the plane between counts in
  /// both. \param offset x_l - x_k, m; \param displacement x_l - X_l, m, of the nearest image as x_l
  void add(const Vector3& offset, const Vector3& displacement) {
    const double along[3] = {offset.x, offset.y, offset.z};
    const double moved[3] = {displacement.x, displacement.y, displacement.z};
    for (int axis = 0; axis < 3; ++axis) {
      if (along[axis] >= 0) side_[axis][0].add(along[axis] - moved[axis], displacement);
      if (along[axis] <= 0) side_[axis][1].add(along[axis] - moved[axis], displacement);
    }
  }

  /// d(x_i - X_i)/dX_j, number. Choice: no displacement gradient along an axis without particles on both sides.
  Tensor3<> gradient() const {
    Vector3 column[3];
    for (int axis = 0; axis < 3; ++axis) {
      const Side &before = side_[axis][0], &behind = side_[axis][1];
      if (before.count == 0 || behind.count == 0) continue;
      const double one = 1.0 / before.count, other = 1.0 / behind.count;
      const double distance = one * before.position - other * behind.position;
      if (distance > 0) column[axis] = (1.0 / distance) * (one * before.displacement - other * behind.displacement);
    }
    return {column[0].x, column[1].x, column[2].x, column[0].y, column[1].y,
            column[2].y, column[0].z, column[1].z, column[2].z};
  }

 private:
  struct Side {
    int count = 0;
    double position = 0;  // sum of X_j less x_k,j
    Vector3 displacement;
    void add(double at, const Vector3& by) { ++count, position += at, displacement += by; }
  };
  Side side_[3][2];
};

}  // namespace talus::granular

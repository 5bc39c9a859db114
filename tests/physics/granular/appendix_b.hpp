// SPDX-License-Identifier: Apache-2.0
/// Appendix B of Yuu & Umekage 2011 read from the top, without the look-up of the laws; and rotations for their tests.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "base/tensor.hpp"
#include "physics/granular/fitted_functions.hpp"

namespace talus::granular {

inline double polynomial(const Piece& piece, double a) {
  return piece.c0 + a * (piece.c1 + a * (piece.c2 + a * piece.c3));
}
/// The first piece whose end lies above a.
inline double value(const FittedFunction& function, double a) {
  for (int k = 0; k < function.pieces; ++k)
    if (a < function.piece[k].end) return polynomial(function.piece[k], a);
  return polynomial(function.piece[function.pieces - 1], a);
}

inline Tensor3<> rotation_about_y(double angle) {
  return {std::cos(angle), 0, std::sin(angle), 0, 1, 0, -std::sin(angle), 0, std::cos(angle)};
}
inline Tensor3<> rotation_about_z(double angle) {
  return {std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle), 0, 0, 0, 1};
}
inline Tensor3<> turned(const Tensor3<>& a, const Tensor3<>& rotation) {
  return rotation * a * transpose(rotation);
}

inline void expect_near(const SymmetricTensor3<>& a, const SymmetricTensor3<>& b, double tolerance) {
  EXPECT_NEAR(a.xx, b.xx, tolerance);
  EXPECT_NEAR(a.yy, b.yy, tolerance);
  EXPECT_NEAR(a.zz, b.zz, tolerance);
  EXPECT_NEAR(a.xy, b.xy, tolerance);
  EXPECT_NEAR(a.yz, b.yz, tolerance);
  EXPECT_NEAR(a.zx, b.zx, tolerance);
}

/// Squashed along z, sides held; sheared along x in planes z = const; squeezed from all sides (rates, 1/s).
inline Tensor3<> squash(double rate) {
  return {.zz = -rate};
}
inline Tensor3<> shear(double rate) {
  return {.xz = rate};
}
inline Tensor3<> squeeze(double rate) {
  return {.xx = -rate / 3, .yy = -rate / 3, .zz = -rate / 3};
}

}  // namespace talus::granular

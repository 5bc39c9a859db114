// SPDX-License-Identifier: Apache-2.0
/// Second-order tensors in three dimensions, over any number type (double, float, SIMD vectors). Plain numbers, no
/// invariants; usable on host and device.
#pragma once

#include "base/simd.hpp"
#include "base/vector.hpp"

namespace talus {

/// A general tensor. Of a velocity gradient `xy` is du_x/dy.
template <class Number = double>
struct Tensor3 {
  Number xx = 0.0, xy = 0.0, xz = 0.0;
  Number yx = 0.0, yy = 0.0, yz = 0.0;
  Number zx = 0.0, zy = 0.0, zz = 0.0;

  constexpr bool operator==(const Tensor3&) const = default;
};

/// A symmetric tensor; the components in the order of VTK.
template <class Number = double>
struct SymmetricTensor3 {
  Number xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, yz = 0.0, zx = 0.0;

  constexpr bool operator==(const SymmetricTensor3&) const = default;
};

namespace detail {
template <class Number>
struct Same {
  using type = Number;  // a factor of a product follows the tensor's number type
};
}  // namespace detail

template <class Number>
constexpr Tensor3<Number> operator+(const Tensor3<Number>& a, const Tensor3<Number>& b) {
  return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yx + b.yx, a.yy + b.yy,
          a.yz + b.yz, a.zx + b.zx, a.zy + b.zy, a.zz + b.zz};
}
template <class Number>
constexpr Tensor3<Number> operator-(const Tensor3<Number>& a, const Tensor3<Number>& b) {
  return {a.xx - b.xx, a.xy - b.xy, a.xz - b.xz, a.yx - b.yx, a.yy - b.yy,
          a.yz - b.yz, a.zx - b.zx, a.zy - b.zy, a.zz - b.zz};
}
template <class Number>
constexpr Tensor3<Number> operator*(const typename detail::Same<Number>::type& s, const Tensor3<Number>& a) {
  return {s * a.xx, s * a.xy, s * a.xz, s * a.yx, s * a.yy, s * a.yz, s * a.zx, s * a.zy, s * a.zz};
}
template <class Number>
constexpr Tensor3<Number> operator*(const Tensor3<Number>& a, const Tensor3<Number>& b) {
  return {a.xx * b.xx + a.xy * b.yx + a.xz * b.zx, a.xx * b.xy + a.xy * b.yy + a.xz * b.zy,
          a.xx * b.xz + a.xy * b.yz + a.xz * b.zz, a.yx * b.xx + a.yy * b.yx + a.yz * b.zx,
          a.yx * b.xy + a.yy * b.yy + a.yz * b.zy, a.yx * b.xz + a.yy * b.yz + a.yz * b.zz,
          a.zx * b.xx + a.zy * b.yx + a.zz * b.zx, a.zx * b.xy + a.zy * b.yy + a.zz * b.zy,
          a.zx * b.xz + a.zy * b.yz + a.zz * b.zz};
}

constexpr Vector3 operator*(const Tensor3<>& a, const Vector3& v) {
  return {a.xx * v.x + a.xy * v.y + a.xz * v.z, a.yx * v.x + a.yy * v.y + a.yz * v.z,
          a.zx * v.x + a.zy * v.y + a.zz * v.z};
}

template <class Number>
constexpr Tensor3<Number> transpose(const Tensor3<Number>& a) {
  return {a.xx, a.yx, a.zx, a.xy, a.yy, a.zy, a.xz, a.yz, a.zz};
}
inline constexpr Tensor3<> identity_tensor{.xx = 1, .yy = 1, .zz = 1};
template <class Number>
constexpr Number trace(const Tensor3<Number>& a) {
  return a.xx + a.yy + a.zz;
}

template <class Number>
constexpr SymmetricTensor3<Number> operator+(const SymmetricTensor3<Number>& a, const SymmetricTensor3<Number>& b) {
  return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.yz + b.yz, a.zx + b.zx};
}
template <class Number>
constexpr SymmetricTensor3<Number> operator-(const SymmetricTensor3<Number>& a, const SymmetricTensor3<Number>& b) {
  return {a.xx - b.xx, a.yy - b.yy, a.zz - b.zz, a.xy - b.xy, a.yz - b.yz, a.zx - b.zx};
}
template <class Number>
constexpr SymmetricTensor3<Number> operator*(const typename detail::Same<Number>::type& s,
                                             const SymmetricTensor3<Number>& a) {
  return {s * a.xx, s * a.yy, s * a.zz, s * a.xy, s * a.yz, s * a.zx};
}

/// s I
template <class Number>
constexpr SymmetricTensor3<Number> isotropic(const Number& s) {
  return {s, s, s, 0.0, 0.0, 0.0};
}
template <class Number>
constexpr Number trace(const SymmetricTensor3<Number>& a) {
  return a.xx + a.yy + a.zz;
}
template <class Number>
constexpr SymmetricTensor3<Number> deviator(const SymmetricTensor3<Number>& a) {
  return a - isotropic<Number>((1.0 / 3.0) * trace(a));
}
/// a : b = a_ij b_ij
template <class Number>
constexpr Number double_dot(const SymmetricTensor3<Number>& a, const SymmetricTensor3<Number>& b) {
  return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + 2.0 * (a.xy * b.xy + a.yz * b.yz + a.zx * b.zx);
}
/// (a : a)^(1/2)
template <class Number>
Number norm(const SymmetricTensor3<Number>& a) {
  using std::sqrt;
  return sqrt(double_dot(a, a));
}

/// Component by component, `yes` where the condition holds.
template <class Condition, class Number>
constexpr SymmetricTensor3<Number> select_tensor(const Condition& condition, const SymmetricTensor3<Number>& yes,
                                                 const SymmetricTensor3<Number>& no) {
  return {select(condition, yes.xx, no.xx), select(condition, yes.yy, no.yy), select(condition, yes.zz, no.zz),
          select(condition, yes.xy, no.xy), select(condition, yes.yz, no.yz), select(condition, yes.zx, no.zx)};
}

/// (a + a^T)/2: of a velocity gradient the rate of deformation.
template <class Number>
constexpr SymmetricTensor3<Number> symmetric_part(const Tensor3<Number>& a) {
  return {a.xx, a.yy, a.zz, 0.5 * (a.xy + a.yx), 0.5 * (a.yz + a.zy), 0.5 * (a.zx + a.xz)};
}
/// (a - a^T)/2: of a velocity gradient the spin.
template <class Number>
constexpr Tensor3<Number> antisymmetric_part(const Tensor3<Number>& a) {
  return 0.5 * (a - transpose(a));
}
template <class Number>
constexpr Tensor3<Number> full(const SymmetricTensor3<Number>& a) {
  return {a.xx, a.xy, a.zx, a.xy, a.yy, a.yz, a.zx, a.yz, a.zz};
}
/// q a q^T: with a rotation q the tensor turned by it.
template <class Number>
constexpr SymmetricTensor3<Number> transformed(const SymmetricTensor3<Number>& a, const Tensor3<Number>& q) {
  return symmetric_part(q * full(a) * transpose(q));
}

template <class Number>
constexpr Number determinant(const Tensor3<Number>& a) {
  return a.xx * (a.yy * a.zz - a.yz * a.zy) - a.xy * (a.yx * a.zz - a.yz * a.zx) + a.xz * (a.yx * a.zy - a.yy * a.zx);
}
/// Not finite where the determinant is 0.
template <class Number>
constexpr Tensor3<Number> inverse(const Tensor3<Number>& a) {
  const Number s = 1.0 / determinant(a);
  return s * Tensor3<Number>{a.yy * a.zz - a.yz * a.zy, a.xz * a.zy - a.xy * a.zz, a.xy * a.yz - a.xz * a.yy,
                             a.yz * a.zx - a.yx * a.zz, a.xx * a.zz - a.xz * a.zx, a.xz * a.yx - a.xx * a.yz,
                             a.yx * a.zy - a.yy * a.zx, a.xy * a.zx - a.xx * a.zy, a.xx * a.yy - a.xy * a.yx};
}

}  // namespace talus

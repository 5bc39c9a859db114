// SPDX-License-Identifier: Apache-2.0
/// Vectors of three components. Plain numbers, no invariants; usable on host and device.
#pragma once

#include <cmath>

namespace talus {

struct Vector3 {
  double x = 0, y = 0, z = 0;

  constexpr Vector3& operator+=(const Vector3& b) {
    x += b.x, y += b.y, z += b.z;
    return *this;
  }
  constexpr Vector3& operator-=(const Vector3& b) {
    x -= b.x, y -= b.y, z -= b.z;
    return *this;
  }
  constexpr bool operator==(const Vector3&) const = default;
};

constexpr Vector3 operator+(Vector3 a, const Vector3& b) {
  return a += b;
}
constexpr Vector3 operator-(Vector3 a, const Vector3& b) {
  return a -= b;
}
constexpr Vector3 operator*(double s, const Vector3& a) {
  return {s * a.x, s * a.y, s * a.z};
}
constexpr double dot(const Vector3& a, const Vector3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(const Vector3& a) {
  return std::sqrt(dot(a, a));
}

}  // namespace talus

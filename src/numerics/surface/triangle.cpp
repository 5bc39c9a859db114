// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/triangle.hpp"

#include <cmath>
#include <tuple>

namespace talus {

namespace {

bool comes_before(const Vector3& a, const Vector3& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// Six times the volume of the tetrahedron of a line and an edge; exactly the opposite for the edge's other direction.
double volume(const Vector3& a, const Vector3& direction, const Vector3& p, const Vector3& q) {
  const auto ordered = [&](const Vector3& first, const Vector3& second) {
    return dot(direction, cross(first - a, second - a));
  };
  return comes_before(p, q) ? ordered(p, q) : -ordered(q, p);
}

}  // namespace

Vector3 Triangle::area() const {
  return 0.5 * cross(corner[1] - corner[0], corner[2] - corner[0]);
}

Vector3 Triangle::normal() const {
  const Vector3 n = area();
  return (1 / norm(n)) * n;
}

Vector3 nearest_place(const Triangle& triangle, const Vector3& x) {
  const auto& [a, b, c] = triangle.corner;
  const Vector3 ab = b - a, ac = c - a, ax = x - a;
  const double d1 = dot(ab, ax), d2 = dot(ac, ax);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vector3 bx = x - b;
  const double d3 = dot(ab, bx), d4 = dot(ac, bx);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + (d1 / (d1 - d3)) * ab;
  const Vector3 cx = x - c;
  const double d5 = dot(ab, cx), d6 = dot(ac, cx);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + (d2 / (d2 - d6)) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b);
  const double whole = 1 / (va + vb + vc);
  return a + (vb * whole) * ab + (vc * whole) * ac;
}

std::optional<double> crossing(const Triangle& triangle, const Vector3& a, const Vector3& b) {
  const auto& [p, q, r] = triangle.corner;
  const Vector3 n = cross(q - p, r - p);
  const double at_a = dot(n, a - p), at_b = dot(n, b - p);
  if ((at_a >= 0) == (at_b >= 0)) return std::nullopt;
  const Vector3 direction = b - a;
  const double u = volume(a, direction, p, q), v = volume(a, direction, q, r), w = volume(a, direction, r, p);
  // Beside a corner rounding may set each of its triangles apart from the line: they overlap by more than that.
  const double slack = 1e-13 * (std::abs(u) + std::abs(v) + std::abs(w));
  const bool within = (u >= -slack && v >= -slack && w >= -slack) || (u <= slack && v <= slack && w <= slack);
  if (!within) return std::nullopt;
  return at_a / (at_a - at_b);
}

}  // namespace talus

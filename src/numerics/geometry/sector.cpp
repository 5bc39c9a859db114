// SPDX-License-Identifier: Apache-2.0
#include "numerics/geometry/sector.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace talus {

namespace {

/// The turn by part/whole of a circle about z. Only the rest beyond whole quarters is rounded.
Tensor3<> turn_by(int part, int whole) {
  const int quarters = 4 * part / whole;
  const double rest = 0.5 * std::numbers::pi * (4 * part - quarters * whole) / whole;
  const double c = std::cos(rest), s = std::sin(rest);
  const double cosine[4] = {c, -s, -c, s}, sine[4] = {s, c, -s, -c};
  const int q = quarters % 4;
  return {.xx = cosine[q], .xy = -sine[q], .yx = sine[q], .yy = cosine[q], .zz = 1};
}

/// Positive where v is counterclockwise of u, within half a circle.
double across(double ux, double uy, const Vector3& v) {
  return ux * v.y - uy * v.x;
}

}  // namespace

Sector::Sector(const Vector3& axis, int copies) : axis_(axis) {
  if (copies < min_copies || copies > max_copies) throw std::invalid_argument("too few or too many copies");
  for (int k = 0; k < copies; ++k) turns_.push_back(turn_by(k, copies));
}

const Tensor3<>& Sector::turn(int angles) const {
  const int n = copies(), k = angles % n;
  return turns_[static_cast<std::size_t>(k < 0 ? k + n : k)];
}

int Sector::copy_at(const Vector3& x) const {
  const Vector3 d = x - axis_;
  if (d.x == 0 && d.y == 0) return 0;
  const int n = copies();
  const double circle = std::atan2(d.y, d.x) / (2 * std::numbers::pi);
  int k = static_cast<int>(std::floor(n * circle));
  k = ((k % n) + n) % n;
  // Round-off of the angle: the faces decide.
  if (across(turn(k).xx, turn(k).yx, d) < 0) return (k + n - 1) % n;
  if (across(turn(k + 1).xx, turn(k + 1).yx, d) >= 0) return (k + 1) % n;
  return k;
}

double Sector::distance(const Vector3& x) const {
  const Vector3 d = x - axis_;
  const double low = -across(1, 0, d), high = across(turn(1).xx, turn(1).yx, d);
  if (low <= 0 && high <= 0) return 0;
  // Beside which face, or beyond the axis.
  if (low > 0 && d.x >= 0) return low;
  if (high > 0 && turn(1).xx * d.x + turn(1).yx * d.y >= 0) return high;
  return std::hypot(d.x, d.y);
}

double Sector::radius(const Vector3& x) const {
  return std::hypot(x.x - axis_.x, x.y - axis_.y);
}

}  // namespace talus

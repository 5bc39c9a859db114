// SPDX-License-Identifier: Apache-2.0
#include "io/figure/figure.hpp"

#include "base/random.hpp"

namespace talus::figure {

namespace {

/// Offsets about a particle, in smoothing lengths.
std::vector<Vector3> scattered() {
  constexpr std::size_t count = 65536;
  constexpr double deviation = 2.0 / 3;
  Random random(1);
  std::vector<Vector3> offsets;
  while (offsets.size() < count) {
    Vector3 d;
    for (int axis = 0; axis < 3; ++axis) d[axis] = deviation * random.normal();
    if (dot(d, d) < 4) offsets.push_back(d);
  }
  return offsets;
}

/// Where those of a particle begin: spread evenly whatever the identities (Fibonacci hashing).
std::size_t start_of(std::int64_t identity) {
  constexpr std::uint64_t multiplier = 0x9e3779b97f4a7c15;
  return static_cast<std::size_t>((static_cast<std::uint64_t>(identity) * multiplier) >> 32U);
}

Vector3 turned_back(const Domain& domain, const Vector3& from, Vector3 to) {
  constexpr int max_bounces = 8;
  for (int n = 0; n < max_bounces; ++n) {
    const auto bounce = domain.bounce(from, to);
    if (!bounce) break;
    to = bounce->image.position(to);
  }
  return to;
}

}  // namespace

std::vector<Vector3> particle_dots(std::span<const Vector3> position, std::span<const double> smoothing_length,
                                   std::span<const std::int64_t> identity, const Domain& domain, int dots) {
  static const std::vector<Vector3> offsets = scattered();
  const auto count = static_cast<std::size_t>(dots);
  std::vector<Vector3> all;
  all.reserve(position.size() * count);
  for (std::size_t i = 0; i < position.size(); ++i) {
    const std::size_t start = start_of(identity[i]);
    for (std::size_t n = start; n < start + count; ++n) {
      const Vector3& offset = offsets[n % offsets.size()];
      all.push_back(turned_back(domain, position[i], position[i] + smoothing_length[i] * offset));
    }
  }
  return all;
}

}  // namespace talus::figure

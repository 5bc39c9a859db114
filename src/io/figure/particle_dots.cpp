// SPDX-License-Identifier: Apache-2.0
#include "io/figure/particle_dots.hpp"

#include "base/random.hpp"

namespace talus::figure {

namespace {

Vector3 scatter(Random& random, double h) {
  const double deviation = 2.0 / 3 * h;
  while (true) {
    Vector3 d;
    for (int axis = 0; axis < 3; ++axis) d[axis] = deviation * random.normal();
    if (dot(d, d) < 4 * h * h) return d;
  }
}

Vector3 turned_back(const Domain& domain, const Vector3& from, Vector3 to) {
  constexpr int most_bounces = 8;
  for (int n = 0; n < most_bounces; ++n) {
    const auto bounce = domain.bounce(from, to);
    if (!bounce) break;
    to = bounce->image.position(to);
  }
  return to;
}

}  // namespace

std::vector<Vector3> particle_dots(std::span<const Vector3> position, std::span<const double> smoothing_length,
                                   std::span<const std::int64_t> identity, const Domain& domain, int dots) {
  std::vector<Vector3> all;
  all.reserve(position.size() * static_cast<std::size_t>(dots));
  for (std::size_t i = 0; i < position.size(); ++i) {
    Random random(static_cast<std::uint64_t>(identity[i]));
    for (int n = 0; n < dots; ++n)
      all.push_back(turned_back(domain, position[i], position[i] + scatter(random, smoothing_length[i])));
  }
  return all;
}

}  // namespace talus::figure

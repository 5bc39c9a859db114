// SPDX-License-Identifier: Apache-2.0
#include "analysis/vortices.hpp"

#include <limits>

namespace talus {

namespace {

struct Mean {
  double sum = 0;
  std::size_t count = 0;

  void add(double value) {
    sum += value;
    ++count;
  }
  double value() const {
    return count > 0 ? sum / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
  }
};

}  // namespace

std::optional<PlaneGradient> velocity_gradient(std::span<const Vector3> position, std::span<const Vector3> velocity,
                                               const Links& links, std::size_t i) {
  const auto others = links.of(i);
  if (others.size() < 2) return std::nullopt;
  // Places and velocities relative to grain i, whose own are zero, and then to their mean.
  const double share = 1.0 / static_cast<double>(others.size() + 1);
  Vector3 place, speed;
  for (const std::uint32_t j : others) {
    place += share * (position[j] - position[i]);
    speed += share * (velocity[j] - velocity[i]);
  }
  double mxx = 0, mxy = 0, myy = 0;
  PlaneGradient c;  // moments of velocity and place
  auto add = [&](const Vector3& r, const Vector3& v) {
    mxx += r.x * r.x;
    mxy += r.x * r.y;
    myy += r.y * r.y;
    c.xx += v.x * r.x;
    c.xy += v.x * r.y;
    c.yx += v.y * r.x;
    c.yy += v.y * r.y;
  };
  add(-1 * place, -1 * speed);
  for (const std::uint32_t j : others) add(position[j] - position[i] - place, velocity[j] - velocity[i] - speed);

  const double determinant = mxx * myy - mxy * mxy;
  // On one line up to rounding: the smaller extent is below 1e-6 of the larger.
  if (!(determinant > 1e-12 * (mxx + myy) * (mxx + myy))) return std::nullopt;
  return PlaneGradient{(c.xx * myy - c.xy * mxy) / determinant, (c.xy * mxx - c.xx * mxy) / determinant,
                       (c.yx * myy - c.yy * mxy) / determinant, (c.yy * mxx - c.yx * mxy) / determinant};
}

HeadMotion head_motion(std::span<const Vector3> position, std::span<const Vector3> velocity, const Links& links,
                       const GrainSet& head, const HeadSize& size, double front_speed) {
  Mean left, right, rear, outward;
  const double middle = size.foremost - 0.5 * size.thickness;
  for (const std::uint32_t i : head) {
    const Vector3& x = position[i];
    if (const auto gradient = velocity_gradient(position, velocity, links, i)) {
      if (x.y > size.centre) left.add(gradient->curl());
      if (x.y < size.centre) right.add(gradient->curl());
    }
    if (x.x < middle && size.in_central_half(x)) rear.add(velocity[i].x - front_speed);
    if (x.x > middle) outward.add(x.y > size.centre ? velocity[i].y : x.y < size.centre ? -velocity[i].y : 0);
  }
  return {left.value(), right.value(), rear.value(), outward.value()};
}

}  // namespace talus

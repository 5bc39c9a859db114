// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/boundary/vessel_motion.hpp"

#include <cmath>

namespace talus::continuum {

namespace {

constexpr double in_plane = 1e-6;  // of a belt's speed

Vector3 vector_of(const std::array<double, 3>& a) {
  return {a[0], a[1], a[2]};
}

}  // namespace

bool is_moving(const VesselPart& v) {
  return v.spin != 0 || v.slide != 0 || v.belt;
}

Vector3 velocity_of_wall(const Parameters& p, std::size_t part, const Vector3& place) {
  const VesselPart& v = p.vessel[part];
  if (v.belt) return vector_of(*v.belt);
  if (!is_moving(v)) return {};
  const Vector3 axis = placed(v, {0, 0, 1});
  return v.spin * cross(axis, place - on_axis(p, v)) + v.slide * axis;
}

void check_motion(const VesselPart& v, std::size_t number, std::vector<Problem>& problems) {
  if (!v.belt) return;
  const Vector3 normal = cross(vector_of(v.first_edge), vector_of(v.second_edge)), belt = vector_of(*v.belt);
  if (std::abs(dot(normal, belt)) > in_plane * norm(normal) * norm(belt))
    problems.push_back({.key = vessel_key(number, "belt"),
                        .what = "would move the plate itself",
                        .allowed = "a velocity along the plate"});
}

}  // namespace talus::continuum

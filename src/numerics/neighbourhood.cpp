// SPDX-License-Identifier: Apache-2.0
#include "numerics/neighbourhood.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace talus {

void Neighbourhood::build(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> radius,
                          double skin) {
  const std::size_t count = position.size();
  const double largest = count == 0 ? 0.0 : *std::max_element(radius.begin(), radius.end());
  skin_ = skin;
  reach_ = 2 * largest + skin;
  if (!(reach_ <= domain_.largest_reach()))
    throw std::invalid_argument("a particle reaches farther than walls and faces are apart");
  reference_.assign(position.begin(), position.end());
  reference_radius_.assign(radius.begin(), radius.end());

  images_ = domain_.images(reach_);
  ghosts_.clear();
  for (std::uint32_t image = 0; image < images_.size(); ++image)
    for (std::uint32_t j = 0; j < count; ++j)
      if (domain_.is_near(images_[image], images_[image].position(position[j]), largest + radius[j] + skin))
        ghosts_.push_back({j, image});

  std::vector<Vector3> points(position.begin(), position.end());
  std::vector<double> radii(radius.begin(), radius.end());
  for (const Ghost& ghost : ghosts_) {
    points.push_back(image(ghost).position(position[ghost.source]));
    radii.push_back(radius[ghost.source]);
  }
  near_wall_.resize(count);
  for_each(team, count, [&](std::size_t i) { near_wall_[i] = domain_.is_near_wall(position[i], reach_ + skin); });
  // Images in walls are seen from near them only.
  const NeighbourList::Keep may_see = [&](std::size_t i, std::uint32_t j) {
    if (j < count) return true;
    const Image& mirrored = image(ghosts_[j - count]);
    return !mirrored.is_in_walls() || (near_wall_[i] && domain_.may_see(points[i], points[j], mirrored, skin));
  };
  list_.build(team, points, radii, skin, count, domain_.walls().empty() ? nullptr : may_see);

  first_ghost_.resize(count);
  for_each(team, count, [&](std::size_t i) {
    const auto neighbours = list_.of(i);
    const auto first = std::lower_bound(neighbours.begin(), neighbours.end(), count);
    first_ghost_[i] = static_cast<std::uint32_t>(first - neighbours.begin());
  });
}

bool Neighbourhood::holds(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> radius) const {
  if (skin_ < 0 || reference_.size() != position.size()) return false;
  return reduce(
      team, position.size(), true,
      [&](std::size_t i) {
        return norm(position[i] - reference_[i]) + (radius[i] - reference_radius_[i]) <= 0.5 * skin_;
      },
      [](bool a, bool b) { return a && b; });
}

}  // namespace talus

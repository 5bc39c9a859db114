// SPDX-License-Identifier: Apache-2.0
#include "numerics/neighbourhood.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace talus {

namespace {

constexpr std::size_t together = 16;     // points whose numbers follow each other
constexpr std::size_t max_slabs = 128;   // that are tried one by one
constexpr double thin = 0.02, wide = 2;  // slabs, of the reach

std::pair<Vector3, Vector3> box_around(std::span<const Vector3> points) {
  Vector3 low = points.front(), high = low;
  for (const Vector3& x : points)
    for (int axis = 0; axis < 3; ++axis)
      low[axis] = std::min(low[axis], x[axis]), high[axis] = std::max(high[axis], x[axis]);
  return {low, high};
}

}  // namespace

void Neighbourhood::build(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> radius,
                          std::span<const double> margin, const PartOfPoints& part) {
  const std::size_t count = position.size();
  max_radius_.resize(count);
  for (std::size_t i = 0; i < count; ++i) max_radius_[i] = radius[i] + margin[i];
  is_copy_.assign(part.is_copy.begin(), part.is_copy.end());
  max_margin_ = part.margin, reach_ = part.reach;
  if (count > 0) {
    max_margin_ = std::max(max_margin_, *std::max_element(margin.begin(), margin.end()));
    reach_ = std::max(reach_, 2 * *std::max_element(max_radius_.begin(), max_radius_.end()));
  }
  built_ = true;
  if (!(reach_ <= domain_.max_reach()))
    throw std::invalid_argument("a particle reaches farther than walls and faces are apart");
  reference_.assign(position.begin(), position.end());

  images_ = domain_.images(reach_);
  find_ghosts(team, position);

  reference_.resize(count + ghosts_.size());
  max_radius_.resize(count + ghosts_.size());
  for_each(team, ghosts_.size(), [&](std::size_t g) {
    reference_[count + g] = image(ghosts_[g]).position(position[ghosts_[g].source]);
    max_radius_[count + g] = max_radius_[ghosts_[g].source];
  });
  const std::span<const Vector3> points = reference_;
  sight_may_change_.assign(count, 0);
  // Images in walls are the last ones, and visible from near walls only. A step evaluates rates where the particles are
  // in its middle, a little farther away than the list allows for its ends.
  const auto first_in_walls = std::partition_point(ghosts_.begin(), ghosts_.end(),
                                                   [&](const Ghost& ghost) { return !image(ghost).is_in_walls(); });
  const std::size_t in_walls = count + static_cast<std::size_t>(first_in_walls - ghosts_.begin());
  find_distances(team, points);
  const auto visibility_of = [&](std::size_t i, std::uint32_t j) {
    static constexpr Image identity;
    const bool is_ghost = j >= count;
    const double other = margin[is_ghost ? ghosts_[j - count].source : j];
    return domain_.visibility(points[i], points[j], is_ghost ? image(ghosts_[j - count]) : identity,
                              2 * std::max(margin[i], other));
  };
  const NeighbourList::Keep keep_visible = [&](std::size_t i, std::span<std::uint32_t> near) {
    if (!vessel_.is_empty() && std::isfinite(distance_[i])) near = near.first(keep_unhidden(points, i, near));
    const auto seldom = std::lower_bound(near.begin(), near.end(), in_walls);
    const auto end = !domain_.is_near_wall(position[i], reach_ + 2 * max_margin_)
                         ? seldom
                         : std::remove_if(near.begin(), near.end(), [&](std::uint32_t j) {
                             const Domain::Visibility visibility = visibility_of(i, j);
                             if (visibility == Domain::Visibility::may_change) sight_may_change_[i] = 1;
                             return visibility == Domain::Visibility::never;
                           });
    return static_cast<std::size_t>(end - near.begin());
  };
  const bool all_seen = domain_.walls().empty() && vessel_.is_empty();
  list_.build(team, points, max_radius_, 0, count, all_seen ? nullptr : keep_visible, is_copy_);

  first_doubt_.assign(1, 0);
  for (std::size_t i = 0; i < count; ++i)
    first_doubt_.push_back(first_doubt_.back() + (sight_may_change_[i] ? list_.of(i).size() : 0));
  in_doubt_.resize(first_doubt_.back());
  for_each(team, count, [&](std::size_t i) {
    const auto neighbours = list_.of(i);
    for (std::size_t n = 0; n < first_doubt_[i + 1] - first_doubt_[i]; ++n)
      in_doubt_[first_doubt_[i] + n] = visibility_of(i, neighbours[n]) == Domain::Visibility::may_change;
  });

  first_ghost_.resize(count);
  for_each(team, count, [&](std::size_t i) {
    const auto neighbours = list_.of(i);
    const auto first = std::lower_bound(neighbours.begin(), neighbours.end(), count);
    first_ghost_[i] = static_cast<std::uint32_t>(first - neighbours.begin());
  });
}

/// Particles whose numbers follow each other are mostly near each other too: they share the slabs of the vessel that
/// reach into the box around all that they reach. Of too many, each looks for its own: a distance does not depend on
/// who shares with whom.
void Neighbourhood::find_distances(ThreadTeam& team, std::span<const Vector3> points) {
  distance_.clear();
  if (vessel_.is_empty()) return;
  distance_.assign(points.size(), infinity);
  const std::size_t count = points.size() - ghosts_.size();
  // A vessel with a sector turns into itself, but for what its corners may be off (check_symmetry of the model).
  constexpr double off = 4e-6;
  const double slack = off * norm(vessel_.high() - vessel_.low());
  const auto is_turned = [&](std::size_t n) {
    const Image& image = images_[ghosts_[n - count].image];
    return image.turns != 0 && image.copy[2] == 0;
  };
  slabs_.resize((points.size() + together - 1) / together);
  team.run(slabs_.size(), [&](std::size_t group) {
    const std::size_t begin = together * group, end = std::min(points.size(), begin + together);
    std::size_t first = begin;
    while (first < end && first >= count && is_turned(first)) ++first;
    if (first == end) return;
    const auto [low, high] = box_around(points.subspan(begin, end - begin));
    const double reach = (1 + 1e-9) * reach_;
    const Vector3 around{reach, reach, reach};
    const auto find = [&](const Vector3& from, const Vector3& to, std::vector<Slab>& slabs) {
      return vessel_.slabs_within(from - around, to + around, thin * reach_, wide * reach_, max_slabs, slabs);
    };
    Slabs& slabs = slabs_[group];
    slabs.all = find(low, high, slabs.of);
    std::size_t last = Surface::no_triangle;
    std::vector<Slab> own;
    for (std::size_t n = first; n < end; ++n) {
      double least = infinity;
      if (slabs.all || find(points[n], points[n], own)) {
        for (const Slab& slab : slabs.all ? slabs.of : own) least = std::min(least, slab.distance(points[n]));
      } else if (const auto foot = vessel_.nearest(points[n], reach_, last)) {
        least = foot->distance, last = foot->triangle;
      }
      if (least <= reach_) distance_[n] = least;
    }
  });
  for_each(team, ghosts_.size(), [&](std::size_t g) {
    if (is_turned(count + g)) distance_[count + g] = std::max(0.0, distance_[ghosts_[g].source] - slack);
  });
}

/// Moves those that the vessel does not hide from point i to the front, in their order. \returns how many they are
std::size_t Neighbourhood::keep_unhidden(std::span<const Vector3> points, std::size_t i,
                                         std::span<std::uint32_t> near) const {
  constexpr std::size_t most = 24;  // triangles that are tried one by one
  struct Around {
    std::vector<std::uint32_t> triangles;
    std::vector<Slab> half_spaces;
  };
  thread_local Around of_thread;
  Around& around = of_thread;  // its address is looked up once
  const Slabs& slabs = slabs_[i / together];
  const bool clear = slabs.all && find_half_spaces(points[i], reach_, slabs.of, around.half_spaces);
  bool sought = false, all = false;
  const auto is_hidden = [&](std::uint32_t j) {
    const Vector3 &x = points[j], d = x - points[i];
    if (const double free = distance_[i] + distance_[j]; free * free > dot(d, d)) return false;
    if (clear && std::all_of(around.half_spaces.begin(), around.half_spaces.end(),
                             [&](const Slab& slab) { return slab.height(x) > slab.slack; }))
      return false;
    if (!sought) all = vessel_.near(points[i], reach_, most, around.triangles);
    sought = true;
    return all ? vessel_.blocks(points[i], x, around.triangles) : vessel_.blocks(points[i], x);
  };
  return static_cast<std::size_t>(std::remove_if(near.begin(), near.end(), is_hidden) - near.begin());
}

void Neighbourhood::find_ghosts(ThreadTeam& team, std::span<const Vector3> position) {
  // Particles whose numbers follow each other are mostly near each other too: those of a sphere that is far from all
  // in which an image is visible need no test.
  struct Sphere {
    Vector3 centre;
    double radius = 0;
  };
  std::vector<Sphere> spheres((position.size() + together - 1) / together);
  const auto within = [&](std::size_t sphere, const auto& visit) {
    for (std::size_t j = together * sphere; j < std::min(position.size(), together * (sphere + 1)); ++j) visit(j);
  };
  for_each(team, spheres.size(), [&](std::size_t n) {
    const auto [low, high] =
        box_around(position.subspan(together * n, std::min(together, position.size() - together * n)));
    spheres[n] = {0.5 * (low + high), 0.5 * norm(high - low)};
  });
  std::vector<std::vector<Ghost>> found(images_.size());
  team.run(images_.size(), [&](std::size_t n) {
    const Image& image = images_[n];
    constexpr double rounding = 1 + 1e-6;
    for (std::size_t s = 0; s < spheres.size(); ++s)
      if (domain_.is_near(image, image.position(spheres[s].centre), rounding * (reach_ + spheres[s].radius)))
        within(s, [&](std::size_t j) {
          if (domain_.is_near(image, image.position(position[j]), 0.5 * reach_ + max_radius_[j]))
            found[n].push_back({static_cast<std::uint32_t>(j), static_cast<std::uint32_t>(n)});
        });
  });
  ghosts_.clear();
  for (const auto& of_image : found) ghosts_.insert(ghosts_.end(), of_image.begin(), of_image.end());
}

bool Neighbourhood::holds(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> radius) const {
  if (!built_ || particles() != position.size()) return false;
  return reduce(
      team, position.size(), true,
      [&](std::size_t i) { return is_copy(i) || norm(position[i] - reference_[i]) + radius[i] <= max_radius_[i]; },
      [](bool a, bool b) { return a && b; });
}

}  // namespace talus

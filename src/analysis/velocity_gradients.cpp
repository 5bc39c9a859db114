// SPDX-License-Identifier: Apache-2.0
/// Velocity gradients at many particles.
#include "analysis/particle_field.hpp"
#include "numerics/neighbourhood.hpp"

namespace talus {

namespace {

/// A particle or an image of one, as its neighbours see it.
struct Seen {
  Vector3 place, velocity;
  double smoothing_length, volume;
};

}  // namespace

std::vector<Tensor3<>> velocity_gradients(const Particles& particles, const Domain& domain,
                                          std::span<const std::uint32_t> taken, std::span<const Vector3> velocity) {
  ThreadTeam team(1);
  Neighbourhood neighbourhood(domain);
  neighbourhood.build(team, particles.position, particles.smoothing_length, 0.0);
  std::vector<Seen> all;
  all.reserve(particles.position.size() + neighbourhood.ghosts().size());
  for (std::size_t j = 0; j < particles.position.size(); ++j)
    all.push_back({particles.position[j], velocity[j], particles.smoothing_length[j], particles.volume[j]});
  for (const Ghost& ghost : neighbourhood.ghosts()) {
    Seen seen = all[ghost.source];
    const Image& image = neighbourhood.image(ghost);
    seen.place = image.position(seen.place), seen.velocity = image.vector(seen.velocity);
    all.push_back(seen);
  }
  static constexpr Image identity;
  const auto is_visible = [&](std::uint32_t i, std::uint32_t j) {
    const std::size_t count = particles.position.size();
    return domain.is_visible(all[i].place, all[j].place,
                             j < count ? identity : neighbourhood.image(neighbourhood.ghosts()[j - count]));
  };
  std::vector<Tensor3<>> gradients;
  gradients.reserve(taken.size());
  for (const std::uint32_t i : taken) {
    const Seen& own = all[i];
    const bool sees_all = !neighbourhood.sight_may_change(i);
    sph::GradientSums<> sums;
    for (const std::uint32_t j : neighbourhood.of(i)) {
      const Seen& other = all[j];
      const double h = 0.5 * (own.smoothing_length + other.smoothing_length);
      const Vector3 d = other.place - own.place;
      if (const double r = norm(d); r < sph::support * h && (sees_all || is_visible(i, j)))
        sums.add(other.volume, sph::cubic_spline_slope(r, h), d, other.velocity - own.velocity);
    }
    gradients.push_back(sph::velocity_gradient(sums));
  }
  return gradients;
}

}  // namespace talus

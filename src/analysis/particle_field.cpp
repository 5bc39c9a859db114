// SPDX-License-Identifier: Apache-2.0
#include "analysis/particle_field.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

#include "analysis/curve.hpp"
#include "numerics/neighbourhood.hpp"

namespace talus {

namespace {

double max_support(const Particles& particles) {
  double h = 0;
  for (const double length : particles.smoothing_length) {
    if (!(length > 0) || !std::isfinite(length)) throw std::invalid_argument("a smoothing length is not above 0");
    h = std::max(h, length);
  }
  return sph::support * (h > 0 ? h : 1);
}

/// \param any whether there are particles: without, the reach means nothing
std::vector<Image> identity_and_images(const Domain& domain, double reach, bool any) {
  std::vector<Image> images;
  if (any) images = domain.images(reach);
  images.insert(images.begin(), Image{});
  return images;
}

}  // namespace

Particles particles_of_density(std::span<const Vector3> position, std::span<const double> density, double mass,
                               double grain_density, std::optional<double> smoothing_length,
                               const MassRatios& mass_ratio) {
  Particles particles{.position = position, .smoothing_length = {}, .volume = {}, .solid_volume = mass / grain_density};
  for (std::size_t i = 0; i < density.size(); ++i) {
    particles.volume.push_back(mass_ratio[i] * mass / density[i]);
    particles.smoothing_length.push_back(
        smoothing_length.value_or(sph::smoothing_length(size_ratio(mass_ratio[i]) * mass, density[i])));
  }
  particles.mass_ratio.assign(mass_ratio.of.begin(), mass_ratio.of.end());
  return particles;
}

ParticleField::ParticleField(Particles particles, Domain domain)
    : particles_(std::move(particles)),
      domain_(std::move(domain)),
      reach_(max_support(particles_)),
      images_(identity_and_images(domain_, reach_, !particles_.position.empty())),
      grid_(particles_.position, reach_) {
  low_ = high_ = particles_.position.empty() ? Vector3{} : particles_.position[0];
  for (const Vector3& x : particles_.position)
    for (int axis = 0; axis < 3; ++axis) {
      low_[axis] = std::min(low_[axis], x[axis]);
      high_[axis] = std::max(high_[axis], x[axis]);
    }
}

template <class Visit>
void ParticleField::for_each_near(const Vector3& x, Visit&& visit) const {
  if (particles_.position.empty()) return;
  for (const Image& image : images_) {
    const Vector3 source = image.source(x);
    bool within = true;
    for (int axis = 0; axis < 3; ++axis)
      within = within && source[axis] > low_[axis] - reach_ && source[axis] < high_[axis] + reach_;
    if (!within) continue;
    grid_.for_each_candidate(source, [&](std::uint32_t j) {
      const Vector3 there = image.position(particles_.position[j]), d = there - x;
      if (dot(d, d) < reach_ * reach_ && domain_.is_visible(x, there, image)) visit(j, image, d);
    });
  }
}

double ParticleField::packing(const Vector3& x) const {
  const MassRatios ratios{particles_.mass_ratio};
  double sum = 0;
  for_each_near(x, [&](std::uint32_t j, const Image&, const Vector3& d) {
    sum += ratios[j] * sph::cubic_spline(norm(d), particles_.smoothing_length[j]);
  });
  return particles_.solid_volume * sum;
}

double ParticleField::value(const Vector3& x, std::span<const double> column) const {
  double sum = 0, weights = 0;
  for_each_near(x, [&](std::uint32_t j, const Image&, const Vector3& d) {
    const double weight = particles_.volume[j] * sph::cubic_spline(norm(d), particles_.smoothing_length[j]);
    sum += weight * column[j];
    weights += weight;
  });
  return weights > 0 ? sum / weights : no_value;
}

Vector3 ParticleField::value(const Vector3& x, std::span<const Vector3> column) const {
  Vector3 sum;
  double weights = 0;
  for_each_near(x, [&](std::uint32_t j, const Image& image, const Vector3& d) {
    const double weight = particles_.volume[j] * sph::cubic_spline(norm(d), particles_.smoothing_length[j]);
    sum += weight * image.vector(column[j]);
    weights += weight;
  });
  return weights > 0 ? (1 / weights) * sum : Vector3{no_value, no_value, no_value};
}

std::vector<std::size_t> particles_around(std::span<const Vector3> position, const Vector3& centre, double reach) {
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < position.size(); ++i)
    if (std::abs(position[i].x - centre.x) < reach && std::abs(position[i].z - centre.z) < reach) near.push_back(i);
  return near;
}

namespace {

/// A particle or an image of one, for its neighbours.
struct Source {
  Vector3 position, velocity;
  double smoothing_length, volume;
};

}  // namespace

std::vector<Tensor3<>> velocity_gradients(const Particles& particles, const Domain& domain,
                                          std::span<const std::uint32_t> taken, std::span<const Vector3> velocity) {
  ThreadTeam team(1);
  Neighbourhood neighbourhood(domain);
  neighbourhood.build(team, particles.position, particles.smoothing_length, 0.0);
  std::vector<Source> all;
  all.reserve(particles.position.size() + neighbourhood.ghosts().size());
  for (std::size_t j = 0; j < particles.position.size(); ++j)
    all.push_back({particles.position[j], velocity[j], particles.smoothing_length[j], particles.volume[j]});
  for (const Ghost& ghost : neighbourhood.ghosts()) {
    Source source = all[ghost.source];
    const Image& image = neighbourhood.image(ghost);
    source.position = image.position(source.position), source.velocity = image.vector(source.velocity);
    all.push_back(source);
  }
  static constexpr Image identity;
  const auto is_visible = [&](std::uint32_t i, std::uint32_t j) {
    const std::size_t count = particles.position.size();
    return domain.is_visible(all[i].position, all[j].position,
                             j < count ? identity : neighbourhood.image(neighbourhood.ghosts()[j - count]));
  };
  std::vector<Tensor3<>> gradients;
  gradients.reserve(taken.size());
  for (const std::uint32_t i : taken) {
    const Source& own = all[i];
    const bool all_visible = !neighbourhood.sight_may_change(i);
    sph::GradientSums<> sums;
    for (const std::uint32_t j : neighbourhood.of(i)) {
      const Source& other = all[j];
      const double h = 0.5 * (own.smoothing_length + other.smoothing_length);
      const Vector3 d = other.position - own.position;
      if (const double r = norm(d); r < sph::support * h && (all_visible || is_visible(i, j)))
        sums.add(other.volume, sph::cubic_spline_slope(r, h), d, other.velocity - own.velocity);
    }
    gradients.push_back(sph::velocity_gradient(sums));
  }
  return gradients;
}

namespace {

double displacement(const Vector3& from, const Vector3& to, const Domain& domain) {
  Vector3 d = to - from;
  for (const int axis : {0, 1, 2})
    if (domain.box().is_periodic(axis)) {
      const double extent = domain.box().extent(axis);
      d[axis] -= extent * std::round(d[axis] / extent);
    }
  double least = norm(d);
  if (const auto& sector = domain.sector())
    for (const int angles : {-1, 1}) least = std::min(least, norm(to - sector->turned(from, angles)));
  return least;
}

}  // namespace

std::vector<double> mean_speeds(const Snapshot& before, const Snapshot& now, const Domain& domain) {
  const double time = now.time - before.time;
  if (!(time > 0)) throw std::invalid_argument("the first snapshot must be the earlier one");
  std::unordered_map<std::int64_t, Vector3> position;
  const auto earlier = before.integers("identity"), identity = now.integers("identity");
  for (std::size_t i = 0; i < earlier.size(); ++i) position.emplace(earlier[i], before.positions()[i]);
  std::vector<double> speed;
  for (std::size_t i = 0; i < identity.size(); ++i) {
    const auto found = position.find(identity[i]);
    speed.push_back(found == position.end() ? no_value
                                            : displacement(found->second, now.positions()[i], domain) / time);
  }
  return speed;
}

}  // namespace talus

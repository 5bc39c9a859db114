// SPDX-License-Identifier: Apache-2.0
#include "analysis/particle_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace talus {

namespace {

double largest_support(const Particles& particles) {
  double h = 0;
  for (const double length : particles.smoothing_length) {
    if (!(length > 0) || !std::isfinite(length)) throw std::invalid_argument("a smoothing length is not above 0");
    h = std::max(h, length);
  }
  return sph::support * (h > 0 ? h : 1);
}

std::vector<Image> identity_and_images(const Domain& domain, double reach) {
  std::vector<Image> images = domain.images(reach);
  images.insert(images.begin(), Image{});
  return images;
}

}  // namespace

Particles particles_of_density(std::span<const Vector3> position, std::span<const double> density, double mass,
                               double grain_density, std::optional<double> smoothing_length) {
  Particles particles{.position = position, .smoothing_length = {}, .volume = {}, .solid_volume = mass / grain_density};
  for (const double rho : density) {
    particles.volume.push_back(mass / rho);
    particles.smoothing_length.push_back(smoothing_length.value_or(sph::smoothing_length(mass, rho)));
  }
  return particles;
}

Particles particles_of_spheres(std::span<const Vector3> position, double radius) {
  const double cube = 8 * radius * radius * radius;
  return {.position = position,
          .smoothing_length = std::vector<double>(position.size(), 2 * radius),
          .volume = std::vector<double>(position.size(), cube),
          .solid_volume = std::numbers::pi / 6 * cube};
}

ParticleField::ParticleField(Particles particles, Domain domain)
    : particles_(std::move(particles)),
      domain_(std::move(domain)),
      reach_(largest_support(particles_)),
      images_(identity_and_images(domain_, reach_)),
      grid_(particles_.position, reach_) {
  low_ = high_ = particles_.position.empty() ? Vector3{} : particles_.position[0];
  for (const Vector3& x : particles_.position)
    for (int axis = 0; axis < 3; ++axis) {
      low_[axis] = std::min(low_[axis], x[axis]);
      high_[axis] = std::max(high_[axis], x[axis]);
    }
}

template <class Visit>
void ParticleField::for_each_near(const Vector3& x, double reach, Visit&& visit) const {
  if (particles_.position.empty()) return;
  for (const Image& image : images_) {
    const Vector3 source = image.source(x);
    bool within = true;
    for (int axis = 0; axis < 3; ++axis)
      within = within && source[axis] > low_[axis] - reach && source[axis] < high_[axis] + reach;
    if (!within) continue;
    grid_.for_each_candidate(source, [&](std::uint32_t j) {
      const Vector3 place = image.position(particles_.position[j]), d = place - x;
      if (dot(d, d) < reach * reach && domain_.is_visible(x, place, image)) visit(j, image, d);
    });
  }
}

double ParticleField::packing(const Vector3& x) const {
  double sum = 0;
  for_each_near(x, reach_, [&](std::uint32_t j, const Image&, const Vector3& d) {
    sum += sph::cubic_spline(norm(d), particles_.smoothing_length[j]);
  });
  return particles_.solid_volume * sum;
}

double ParticleField::value(const Vector3& x, std::span<const double> column) const {
  double sum = 0, weights = 0;
  for_each_near(x, reach_, [&](std::uint32_t j, const Image&, const Vector3& d) {
    const double weight = particles_.volume[j] * sph::cubic_spline(norm(d), particles_.smoothing_length[j]);
    sum += weight * column[j];
    weights += weight;
  });
  return weights > 0 ? sum / weights : std::numeric_limits<double>::quiet_NaN();
}

Vector3 ParticleField::value(const Vector3& x, std::span<const Vector3> column) const {
  Vector3 sum;
  double weights = 0;
  for_each_near(x, reach_, [&](std::uint32_t j, const Image& image, const Vector3& d) {
    const double weight = particles_.volume[j] * sph::cubic_spline(norm(d), particles_.smoothing_length[j]);
    sum += weight * image.vector(column[j]);
    weights += weight;
  });
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return weights > 0 ? (1 / weights) * sum : Vector3{none, none, none};
}

Tensor3<> ParticleField::velocity_gradient(std::size_t particle, std::span<const Vector3> velocity) const {
  const Vector3& x = particles_.position[particle];
  sph::GradientSums<> sums;
  for_each_near(x, reach_, [&](std::uint32_t j, const Image& image, const Vector3& d) {
    const double h = 0.5 * (particles_.smoothing_length[particle] + particles_.smoothing_length[j]);
    const double r = norm(d);
    if (r < sph::support * h)
      sums.add(particles_.volume[j], sph::cubic_spline_slope(r, h), d, image.vector(velocity[j]) - velocity[particle]);
  });
  return sph::velocity_gradient(sums);
}

std::vector<std::size_t> particles_around(std::span<const Vector3> position, const Vector3& place, double reach) {
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < position.size(); ++i)
    if (std::abs(position[i].x - place.x) < reach && std::abs(position[i].z - place.z) < reach) near.push_back(i);
  return near;
}

Vector3 cell_centre(const Vector3& place, double cell) {
  // A place on a cell's face, but for rounding, belongs to the cell above it.
  const auto centre = [cell](double x) { return (std::floor(x / cell + 1e-9) + 0.5) * cell; };
  return {centre(place.x), centre(place.y), centre(place.z)};
}

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/sweep.hpp"

#include <cmath>

#include "models/continuum/material.hpp"
#include "numerics/sph/cubic_spline.hpp"
#include "numerics/sph/velocity_gradient.hpp"

namespace talus::continuum {

void Rates::resize(std::size_t count) {
  acceleration.resize(count);
  density_rate.resize(count);
  velocity_gradient.resize(count);
  kernel_density.resize(count);
  wall_push.resize(count);
}

Sweep::Sweep(const Parameters& p, double mass, double sound_speed)
    : mass_(mass),
      sound_speed_(sound_speed),
      fixed_smoothing_length_(p.sph.smoothing == Smoothing::fixed
                                  ? sph::smoothing_length(mass, p.bed.packing * p.grains.density)
                                  : 0.0),
      grain_density_(p.grains.density),
      skin_(p.integration.skin * p.bed.spacing),
      stress_form_(p.sph.stress_form),
      corrected_continuity_(p.sph.continuity == Continuity::corrected),
      viscosity_{p.sph.viscosity_alpha, p.sph.viscosity_beta},
      around_(domain_of(p)) {}

double Sweep::smoothing_length(double density) const {
  return fixed_smoothing_length_ > 0 ? fixed_smoothing_length_ : sph::smoothing_length(mass_, density);
}

void Sweep::find_neighbours(ThreadTeam& team, std::span<const Vector3> position,
                            std::span<const double> smoothing_length) {
  // Two lumps interact within the sum of their smoothing lengths: twice their mean.
  around_.build(team, position, smoothing_length, skin_);
  image_walls_.clear();
  for (const Image& image : around_.images()) {
    std::array<std::int8_t, 3> walls{-1, -1, -1};
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (image.side[axis] != 0) walls[axis] = static_cast<std::int8_t>(face_number(int(axis), image.side[axis] > 0));
    if (image.plate >= 0) {
      const Plate& plate = around_.domain().plates()[static_cast<std::size_t>(image.plate)];
      walls[static_cast<std::size_t>(plate.axis)] = static_cast<std::int8_t>(wall_of_plate(image.plate));
    }
    image_walls_.push_back(walls);
  }
}

void Sweep::pack(ThreadTeam& team, const LumpView& lumps) {
  const std::size_t count = lumps.position.size();
  const auto ghosts = around_.ghosts();
  records_.resize(count + ghosts.size());
  for_each(team, count, [&](std::size_t i) {
    const double density = lumps.density[i];
    records_[i] = {lumps.position[i],
                   lumps.velocity[i],
                   sph::specific_stress(stress_of(lumps.material, i), density, density / grain_density_, stress_form_),
                   smoothing_length(density),
                   density,
                   mass_ / density};
  });
  for_each(team, ghosts.size(), [&](std::size_t g) {
    const Image& image = around_.image(ghosts[g]);
    const Vector3& s = image.vector_sign;
    Record ghost = records_[ghosts[g].source];
    ghost.position = image.position(ghost.position);
    ghost.velocity = image.vector(ghost.velocity);
    ghost.specific_stress.xy *= s.x * s.y;
    ghost.specific_stress.yz *= s.y * s.z;
    ghost.specific_stress.zx *= s.z * s.x;
    records_[count + g] = ghost;
  });
}

/// The sums over the neighbours of one lump.
template <bool gradients, bool forces>
struct Sweep::Gather {
  const Sweep& sweep;
  const Record& self;
  sph::GradientSums gradient = {};
  double density_rate = 0;
  double kernel_density = 0;
  Vector3 acceleration = {};

  /// Adds a neighbour; \returns the acceleration that it causes
  Vector3 add(const Record& other) {
    const Vector3 d = other.position - self.position;
    const double h = 0.5 * (self.smoothing_length + other.smoothing_length);
    const double distance_squared = dot(d, d);
    if (distance_squared >= sph::support * sph::support * h * h) return {};
    const double distance = std::sqrt(distance_squared);
    const double slope = sph::cubic_spline_slope(distance, h);
    const Vector3 du = other.velocity - self.velocity;
    if constexpr (gradients) {
      gradient.add(other.volume, slope, d, du);
      density_rate += sph::density_rate(sweep.mass_, slope, d, du);
    }
    if constexpr (forces) {
      kernel_density += sweep.mass_ * sph::cubic_spline(distance, h);
      const double viscosity = sph::viscosity(sweep.viscosity_, dot(du, d), distance_squared, h, sweep.sound_speed_,
                                              0.5 * (self.density + other.density));
      const Vector3 push =
          sph::acceleration(sweep.mass_, slope, d, self.specific_stress + other.specific_stress, viscosity);
      acceleration += push;
      return push;
    }
    return {};
  }
};

template <bool gradients, bool forces>
void Sweep::sweep(ThreadTeam& team, Rates& rates) const {
  const std::size_t count = around_.particles();
  const auto ghosts = around_.ghosts();
  const Domain& domain = around_.domain();
  for_each(team, count, [&](std::size_t i) {
    Gather<gradients, forces> sums{.sweep = *this, .self = records_[i]};
    const auto neighbours = around_.of(i);
    const std::size_t first_ghost = around_.first_ghost_of(i);
    const bool near_plate = around_.is_near_plate(i);
    for (std::size_t n = 0; n < first_ghost; ++n) {
      const Record& other = records_[neighbours[n]];
      if (near_plate && !domain.sees(sums.self.position, other.position)) continue;
      sums.add(other);
    }
    std::array<double, most_walls> push{};
    for (std::size_t n = first_ghost; n < neighbours.size(); ++n) {
      const Record& other = records_[neighbours[n]];
      const std::uint32_t image = ghosts[neighbours[n] - count].image;
      if (near_plate && !domain.sees(sums.self.position, other.position, around_.images()[image].plate)) continue;
      const Vector3 a = sums.add(other);
      if constexpr (forces)
        for (int axis = 0; axis < 3; ++axis)
          if (const int wall = image_walls_[image][static_cast<std::size_t>(axis)]; wall >= 0)
            push[static_cast<std::size_t>(wall)] += a[axis];
    }
    if constexpr (gradients) {
      const Tensor3<> gradient = sph::velocity_gradient(sums.gradient);
      rates.velocity_gradient[i] = gradient;
      rates.density_rate[i] = corrected_continuity_ ? -sums.self.density * trace(gradient) : sums.density_rate;
    }
    if constexpr (forces) {
      rates.acceleration[i] = sums.acceleration;
      rates.kernel_density[i] = sums.kernel_density + mass_ * sph::cubic_spline(0.0, sums.self.smoothing_length);
      rates.wall_push[i] = push;
    }
  });
}

void Sweep::operator()(ThreadTeam& team, const LumpView& lumps, Wanted wanted, Rates& rates) {
  rates.resize(lumps.position.size());
  pack(team, lumps);
  switch (wanted) {
    case Wanted::all:
      return sweep<true, true>(team, rates);
    case Wanted::gradients:
      return sweep<true, false>(team, rates);
    case Wanted::forces:
      return sweep<false, true>(team, rates);
  }
}

}  // namespace talus::continuum

// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/sweep.hpp"

#include <algorithm>
#include <cmath>

#include "base/instruction_set.hpp"
#include "models/continuum/material.hpp"
#include "numerics/sph/cubic_spline.hpp"
#include "numerics/sph/velocity_gradient.hpp"

namespace talus::continuum {

namespace {

SumNeighbours choose(InstructionSet set, SweepTerms terms, Stabilisers stabilisers) {
  switch (set) {
#if defined(__x86_64__)
    case InstructionSet::avx512:
      return sum_neighbours_avx512(terms, stabilisers);
    case InstructionSet::avx2:
      return sum_neighbours_avx2(terms, stabilisers);
#endif
    default:
      return sum_neighbours_portable(terms, stabilisers);
  }
}

}  // namespace

void Rates::resize(std::size_t count) {
  acceleration.resize(count);
  density_rate.resize(count);
  velocity_gradient.resize(count);
  kernel_density.resize(count);
  wall_acceleration.resize(count);
}

Sweep::Sweep(const Parameters& p, const Domain& domain, double mass, double sound_speed, const Surface& vessel)
    : mass_(mass),
      smoothing_ratio_(p.sph.smoothing_ratio),
      fixed_smoothing_length_(p.sph.smoothing == Smoothing::fixed
                                  ? smoothing_ratio_ * sph::smoothing_length(mass, p.bed.packing * p.grains.density)
                                  : 0.0),
      grain_density_(p.grains.density),
      skin_(p.integration.skin * p.bed.spacing),
      stress_form_(p.sph.stress_form),
      corrected_continuity_(p.sph.continuity == Continuity::corrected),
      constants_{.mass = mass,
                 .sound_speed = sound_speed,
                 .viscosity_alpha = p.sph.viscosity_alpha,
                 .viscosity_beta = p.sph.viscosity_beta,
                 .density_diffusion = 2 * p.sph.density_diffusion * sound_speed,
                 .hourglass_damping = p.sph.hourglass_damping * sound_speed},
      local_sound_speed_(p.sph.viscosity_speed == ViscositySpeed::local),
      neighbourhood_(domain, vessel),
      vessel_(vessel, p.bed.spacing, resolve(p.integration.instruction_set)) {
  const InstructionSet set = resolve(p.integration.instruction_set);
  const bool stabilised = p.sph.density_diffusion > 0 || p.sph.hourglass_damping > 0 || local_sound_speed_;
  for (const SweepTerms terms : {SweepTerms::all, SweepTerms::gradients, SweepTerms::forces})
    sum_[static_cast<std::size_t>(terms)] = choose(set, terms, stabilised ? Stabilisers::acting : Stabilisers::none);
  if (stabilised) prepare_sum_ = choose(set, SweepTerms::gradients, Stabilisers::prepared);
}

double Sweep::smoothing_length(double density) const {
  return fixed_smoothing_length_ > 0 ? fixed_smoothing_length_
                                     : smoothing_ratio_ * sph::smoothing_length(mass_, density);
}

void Sweep::find_neighbours(ThreadTeam& team, std::span<const Vector3> position,
                            std::span<const double> smoothing_length) {
  // Two particles interact within the sum of their smoothing lengths: twice their mean.
  neighbourhood_.build(team, position, smoothing_length, skin_);
  vessel_.find(team, position, smoothing_length, skin_);
  loads_.clear();
  for (const Image& image : neighbourhood_.images()) loads_.push_back(neighbourhood_.domain().loads(image));
  find_groups();
}

/// Where each group of a particle's neighbours ends: particles first, then images by mirror, as the lists are sorted.
void Sweep::find_groups() {
  const auto ghosts = neighbourhood_.ghosts();
  const std::size_t count = neighbourhood_.particles();
  std::vector<std::size_t> end(neighbourhood_.images().size());  // of the ghosts of each image, which follow each other
  for (std::size_t g = 0; g < ghosts.size(); ++g) end[ghosts[g].image] = count + g + 1;
  groups_.clear();
  first_group_.assign(1, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const auto neighbours = neighbourhood_.of(i);
    groups_.push_back({static_cast<std::uint32_t>(neighbourhood_.first_ghost_of(i)), -1});
    std::size_t group_end = count;
    for (std::size_t n = neighbourhood_.first_ghost_of(i); n < neighbours.size(); ++n) {
      if (neighbours[n] >= group_end) {
        const std::uint32_t image = ghosts[neighbours[n] - count].image;
        groups_.push_back({0, static_cast<std::int32_t>(image)});
        group_end = end[image];
      }
      groups_.back().end = static_cast<std::uint32_t>(n + 1);
    }
    first_group_.push_back(static_cast<std::uint32_t>(groups_.size()));
  }
}

void Sweep::pack(ThreadTeam& team, const ParticleView& particles) {
  const std::size_t count = particles.position.size();
  const auto ghosts = neighbourhood_.ghosts();
  records_.resize(count + ghosts.size() + 1);
  for_each(team, count, [&](std::size_t i) {
    const double density = particles.density[i];
    const Vector3 &x = particles.position[i], &u = particles.velocity[i];
    const SymmetricTensor3<> s =
        sph::specific_stress(stress_of(particles.material, i), density, density / grain_density_, stress_form_);
    records_[i] = {{x.x, x.y, x.z},
                   {u.x, u.y, u.z},
                   particles.smoothing_length[i],
                   mass_ / density,
                   {s.xx, s.yy, s.zz, s.xy, s.yz, s.zx},
                   density,
                   0};
  });
  for_each(team, ghosts.size(), [&](std::size_t g) {
    const Image& image = neighbourhood_.image(ghosts[g]);
    ParticleRecord ghost = records_[ghosts[g].source];
    const Vector3 x = image.position({ghost.position[0], ghost.position[1], ghost.position[2]});
    const Vector3 u = image.vector({ghost.velocity[0], ghost.velocity[1], ghost.velocity[2]});
    for (int axis = 0; axis < 3; ++axis) ghost.position[axis] = x[axis], ghost.velocity[axis] = u[axis];
    const double* s = ghost.specific_stress;
    const SymmetricTensor3<> stress = image.tensor({s[0], s[1], s[2], s[3], s[4], s[5]});
    const double turned[6] = {stress.xx, stress.yy, stress.zz, stress.xy, stress.yz, stress.zx};
    std::copy(turned, turned + 6, ghost.specific_stress);
    records_[count + g] = ghost;
  });
  constexpr double far_away = 1e3;  // m
  records_.back() = {.position = {far_away, far_away, far_away},
                     .velocity = {},
                     .smoothing_length = records_.front().smoothing_length,
                     .volume = 0,
                     .specific_stress = {},
                     .density = records_.front().density,
                     .unused = 0};
}

/// The neighbours of a particle that it sees. Near a wall they are picked into `record` and `end`.
Neighbours Sweep::seen_from(std::size_t i, std::vector<std::uint32_t>& record, std::vector<std::uint32_t>& end) const {
  static constexpr Image identity;
  const auto neighbours = neighbourhood_.of(i);
  const std::uint32_t first = first_group_[i], last = first_group_[i + 1];
  const bool near_wall = neighbourhood_.is_near_wall(i);
  const auto place = [this](std::size_t r) {
    const double* x = records_[r].position;
    return Vector3{x[0], x[1], x[2]};
  };
  record.clear();
  end.clear();
  std::uint32_t n = 0;
  for (std::uint32_t g = first; g < last; ++g) {
    if (near_wall) {
      const Image& image =
          groups_[g].image < 0 ? identity : neighbourhood_.images()[static_cast<std::size_t>(groups_[g].image)];
      for (; n < groups_[g].end; ++n)
        if (neighbourhood_.domain().is_visible(place(i), place(neighbours[n]), image)) record.push_back(neighbours[n]);
      end.push_back(static_cast<std::uint32_t>(record.size()));
    } else {
      end.push_back(groups_[g].end);
    }
  }
  return {near_wall ? record.data() : neighbours.data(), end.data(), static_cast<int>(end.size()),
          static_cast<std::uint32_t>(records_.size() - 1)};
}

void Sweep::operator()(ThreadTeam& team, const ParticleView& particles, SweepTerms terms, Rates& rates) {
  const std::size_t count = particles.position.size();
  rates.resize(count);
  if (!vessel_.is_empty()) rates.vessel.resize(count);
  pack(team, particles);
  if (!vessel_.is_empty()) vessel_.meet(team, particles.position, particles.smoothing_length);
  if (prepare_sum_) prepare_stabilisers(team, particles);
  const SumNeighbours sum = sum_[static_cast<std::size_t>(terms)];
  for_each(team, count, [&](std::size_t i) {
    thread_local std::vector<std::uint32_t> record, end;
    thread_local std::vector<std::array<double, 3>> acceleration;
    const Neighbours neighbours = seen_from(i, record, end);
    acceleration.resize(static_cast<std::size_t>(neighbours.groups));
    PairSums sums;
    sum(records_.data(), static_cast<std::uint32_t>(i), neighbours, constants_, sums,
        reinterpret_cast<double(*)[3]>(acceleration.data()));
    if (terms != SweepTerms::forces) {
      const double *m = sums.moment, *v = sums.velocity;
      sph::GradientSums<> around{{m[0], m[1], m[2], m[3], m[4], m[5]},
                                 {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8]}};
      if (!vessel_.is_empty())
        sums.density_rate += particles.density[i] * add_walls(vessel_.of(i), particles.velocity[i], around);
      const Tensor3<> gradient = sph::velocity_gradient(around);
      rates.velocity_gradient[i] = gradient;
      rates.density_rate[i] = corrected_continuity_ ? -particles.density[i] * trace(gradient) : sums.density_rate;
    }
    if (terms == SweepTerms::gradients) return;
    Vector3 all;
    std::array<double, most_walls> by_wall{};
    for (std::size_t g = 0; g < acceleration.size(); ++g) {
      all += Vector3{acceleration[g][0], acceleration[g][1], acceleration[g][2]};
      const std::int32_t image = groups_[first_group_[i] + g].image;
      if (image < 0) continue;
      const Vector3 a{acceleration[g][0], acceleration[g][1], acceleration[g][2]};
      for (const Domain::Load& load : loads_[static_cast<std::size_t>(image)]) {
        if (load.wall < 0) break;
        by_wall[static_cast<std::size_t>(load.wall)] += dot(load.part, a);
      }
    }
    rates.acceleration[i] = all;
    rates.kernel_density[i] = sums.kernel_density + mass_ * sph::cubic_spline(0.0, records_[i].smoothing_length);
    rates.wall_acceleration[i] = by_wall;
    if (!vessel_.is_empty()) rates.kernel_density[i] += add_forces_of_vessel(particles, i, neighbours, rates);
  });
}

SeatAtWall Sweep::seat_at_wall(std::uint32_t record, std::uint32_t part) const {
  const std::size_t count = neighbourhood_.particles();
  const bool ghost = record >= count;
  const std::size_t source = ghost ? neighbourhood_.ghosts()[record - count].source : record;
  for (const NearWall& wall : vessel_.of(source).all()) {
    if (wall.part != part) continue;
    if (!ghost) return {wall.normal, wall.distance, wall.share};
    const Image& image = neighbourhood_.image(neighbourhood_.ghosts()[record - count]);
    return {image.position(wall.normal) - image.position({}), wall.distance, wall.share};
  }
  return {};
}

double Sweep::add_forces_of_vessel(const ParticleView& particles, std::size_t i, const Neighbours& neighbours,
                                   Rates& rates) const {
  const NearWalls& met = vessel_.of(i);
  rates.vessel[i] = {};
  if (met.count == 0) return 0;
  const bool silent = local_sound_speed_ && !(trace(stress_of(particles.material, i)) > 0);
  rates.vessel[i] =
      forces_of_walls(met, records_.data(), i, neighbours, constants_, silent ? 0 : constants_.sound_speed);
  for (const NearWall& wall : met.all())
    rates.acceleration[i] +=
        force_of_images(wall, records_.data(), i, neighbours, constants_.mass,
                        [this](std::uint32_t record, std::uint32_t part) { return seat_at_wall(record, part); });
  for (const WallForce& force : rates.vessel[i].all()) rates.acceleration[i] += force.acceleration;
  double beyond = 0;
  for (const NearWall& wall : met.all()) beyond += wall.sums.density;
  return particles.density[i] * beyond;
}

}  // namespace talus::continuum

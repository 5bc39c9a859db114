// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/sweep.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/compiled_for.hpp"
#include "models/continuum/material.hpp"
#include "numerics/sph/cubic_spline.hpp"
#include "numerics/sph/velocity_gradient.hpp"

namespace talus::continuum {

void Rates::resize(std::size_t count) {
  acceleration.resize(count);
  density_rate.resize(count);
  velocity_gradient.resize(count);
  kernel_density.resize(count);
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
    sum_[static_cast<std::size_t>(terms)] =
        TALUS_COMPILED_FOR(set, sum_neighbours)(terms, stabilised ? Stabilisers::acting : Stabilisers::none);
  velocity_gradients_ = TALUS_COMPILED_FOR(set, velocity_gradients);
  if (stabilised) prepare_sum_ = TALUS_COMPILED_FOR(set, sum_neighbours)(SweepTerms::gradients, Stabilisers::prepared);
}

double Sweep::smoothing_length(double density) const {
  return fixed_smoothing_length_ > 0 ? fixed_smoothing_length_
                                     : smoothing_ratio_ * sph::smoothing_length(mass_, density);
}

void Sweep::find_neighbours(ThreadTeam& team, std::span<const Vector3> position,
                            std::span<const double> smoothing_length) {
  // Two particles interact within the sum of their smoothing lengths: twice their mean.
  neighbourhood_.build(team, position, smoothing_length, skin_);
  vessel_.find(team, neighbourhood_, position, smoothing_length, skin_);
  loads_.clear();
  for (const Image& image : neighbourhood_.images()) {
    ImageLoads loads{};
    const auto found = neighbourhood_.domain().loads(image);
    for (std::size_t n = 0; n < found.size(); ++n)
      loads.load[n] = {found[n].wall, {found[n].part.x, found[n].part.y, found[n].part.z}};
    loads_.push_back(loads);
  }
  find_groups();
}

/// Where each group of a particle's neighbours ends: particles first, then images by mirror, as the lists are sorted.
void Sweep::find_groups() {
  const auto ghosts = neighbourhood_.ghosts();
  const std::size_t count = neighbourhood_.particles();
  std::vector<std::size_t> end(neighbourhood_.images().size());  // of the ghosts of each image, which follow each other
  for (std::size_t g = 0; g < ghosts.size(); ++g) end[ghosts[g].image] = count + g + 1;
  groups_.clear();
  longest_ = 1;
  first_group_.assign(1, 0);
  walls_.clear();
  first_wall_.assign(1, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const auto neighbours = neighbourhood_.of(i);
    longest_ = std::max(longest_, neighbours.size());
    groups_.push_back({static_cast<std::uint32_t>(neighbourhood_.first_ghost_of(i)), -1});
    std::uint32_t walls = 0;
    std::size_t group_end = count;
    for (std::size_t n = neighbourhood_.first_ghost_of(i); n < neighbours.size(); ++n) {
      if (neighbours[n] >= group_end) {
        const std::uint32_t image = ghosts[neighbours[n] - count].image;
        groups_.push_back({0, static_cast<std::int32_t>(image)});
        group_end = end[image];
        for (const ImageLoad& load : loads_[image].load)
          if (load.wall >= 0) walls |= 1u << load.wall;
      }
      groups_.back().end = static_cast<std::uint32_t>(n + 1);
    }
    first_group_.push_back(static_cast<std::uint32_t>(groups_.size()));
    walls_.push_back(walls);
    first_wall_.push_back(first_wall_.back() + static_cast<std::uint32_t>(std::popcount(walls)));
  }
}

/// Records of images are made from those of their sources. What only forces read is packed for them only.
void Sweep::pack(ThreadTeam& team, const ParticleView& particles, bool stresses) {
  const std::size_t count = particles.position.size();
  const auto ghosts = neighbourhood_.ghosts();
  motion_.resize(count + ghosts.size() + 1);
  stress_.resize(motion_.size());
  for_each(team, count, [&](std::size_t i) {
    const double density = particles.density[i];
    const Vector3 &x = particles.position[i], &u = particles.velocity[i];
    motion_[i] = {{x.x, x.y, x.z}, 0.5 * particles.smoothing_length[i], {u.x, u.y, u.z}, mass_ / density};
    if (!stresses) return;
    const SymmetricTensor3<> s =
        sph::specific_stress(stress_of(particles.material, i), density, density / grain_density_, stress_form_);
    stress_[i] = {{s.xx, s.yy, s.zz, s.xy, s.yz, s.zx}, 0.5 * density, 0};
  });
  for_each(team, ghosts.size(), [&](std::size_t g) {
    const Image& image = neighbourhood_.image(ghosts[g]);
    const MotionRecord& source = motion_[ghosts[g].source];
    const Vector3 x = image.position({source.position[0], source.position[1], source.position[2]});
    const Vector3 u = image.vector({source.velocity[0], source.velocity[1], source.velocity[2]});
    motion_[count + g] = {{x.x, x.y, x.z}, source.half_length, {u.x, u.y, u.z}, source.volume};
    if (!stresses) return;
    const double* s = stress_[ghosts[g].source].specific_stress;
    const SymmetricTensor3<> t = image.tensor({s[0], s[1], s[2], s[3], s[4], s[5]});
    stress_[count + g] = {{t.xx, t.yy, t.zz, t.xy, t.yz, t.zx}, stress_[ghosts[g].source].half_density, 0};
  });
  constexpr double far_away = 1e3;  // m
  motion_.back() = {{far_away, far_away, far_away}, motion_.front().half_length, {}, 0};
  stress_.back() = {{}, 0.5 * particles.density.front(), 0};
}

Records Sweep::records() const {
  return {motion_.data(), stress_.data(), stabilisers_.data(), loads_.data()};
}

/// The neighbours of a particle that it sees. Near a wall they are picked into `seen`.
Neighbours Sweep::seen_from(std::size_t i, Seen& seen) const {
  static constexpr Image identity;
  const auto neighbours = neighbourhood_.of(i);
  const NeighbourGroup* const group = groups_.data() + first_group_[i];
  const auto count = static_cast<int>(first_group_[i + 1] - first_group_[i]);
  seen.scratch.resize(3 * ((longest_ + Neighbours::padded_to - 1) / Neighbours::padded_to));
  Neighbours found{neighbours.data(),
                   group,
                   count,
                   walls_[i],
                   seen.scratch.front().number,
                   static_cast<std::uint32_t>(Neighbours::padded_to * seen.scratch.size())};
  if (!neighbourhood_.sight_may_change(i)) return found;
  const auto place = [this](std::size_t r) {
    const double* x = motion_[r].position;
    return Vector3{x[0], x[1], x[2]};
  };
  seen.record.clear();
  seen.group.clear();
  std::uint32_t n = 0;
  for (int g = 0; g < count; ++g) {
    const Image& image =
        group[g].image < 0 ? identity : neighbourhood_.images()[static_cast<std::size_t>(group[g].image)];
    for (; n < group[g].end; ++n)
      if (neighbourhood_.domain().is_visible(place(i), place(neighbours[n]), image))
        seen.record.push_back(neighbours[n]);
    seen.group.push_back({static_cast<std::uint32_t>(seen.record.size()), group[g].image});
  }
  while (seen.record.size() % Neighbours::padded_to != 0)
    seen.record.push_back(static_cast<std::uint32_t>(motion_.size() - 1));
  found.record = seen.record.data();
  found.group = seen.group.data();
  return found;
}

void Sweep::operator()(ThreadTeam& team, const ParticleView& particles, SweepTerms terms, Rates& rates) {
  const std::size_t count = particles.position.size();
  rates.resize(count);
  pack(team, particles, terms != SweepTerms::gradients || prepare_sum_);
  if (!vessel_.is_empty()) {
    rates.vessel.resize(vessel_.particles().size());
    rates.at_vessel.assign(vessel_.particles().begin(), vessel_.particles().end());
    // In half a step particles hardly move: the gradients take the walls as the forces met them.
    if (terms != SweepTerms::gradients || !vessel_.is_met())
      vessel_.meet(team, particles.position, particles.smoothing_length);
  }
  if (prepare_sum_) prepare_stabilisers(team, particles);
  if (terms != SweepTerms::gradients) {
    rates.by_walls.walls = walls_;
    rates.by_walls.first = first_wall_;
    rates.by_walls.value.resize(first_wall_.back());
  }
  const SumNeighbours sum = sum_[static_cast<std::size_t>(terms)];
  const Records all = records();
  constexpr std::size_t together = Neighbours::padded_to, blocks_at_once = 16;
  const auto compute = [&](std::size_t first) {
    thread_local Seen of_thread;
    Seen& seen = of_thread;
    PairSums sums[together];
    const std::size_t size = std::min(together, count - first);
    for (std::size_t n = 0; n < together; ++n) {
      if (n >= size) {
        sums[n] = {};
        continue;
      }
      const Neighbours neighbours = seen_from(first + n, seen);
      sum(all, static_cast<std::uint32_t>(first + n), neighbours, constants_, sums[n]);
      if (terms != SweepTerms::gradients && !vessel_.is_empty() && vessel_.place_of(first + n) >= 0)
        add_forces_of_vessel(particles, first + n, neighbours, sums[n], rates);
    }
    if (terms != SweepTerms::forces) {
      if (!vessel_.is_empty())
        for (std::size_t n = 0; n < size; ++n)
          if (vessel_.of(first + n).count > 0) add_walls_of_vessel(particles, first + n, sums[n]);
      alignas(64) double gradient[9][together];
      velocity_gradients_(sums, gradient);
      for (std::size_t c = 0; c < 9; ++c)
        std::copy_n(gradient[c], size, rates.velocity_gradient.component[c].data() + first);
      for (std::size_t n = 0; n < size; ++n)
        rates.density_rate[first + n] =
            corrected_continuity_ ? -particles.density[first + n] * (gradient[0][n] + gradient[4][n] + gradient[8][n])
                                  : sums[n].density_rate;
    }
    if (terms == SweepTerms::gradients) return;
    for (std::size_t n = 0; n < size; ++n) {
      const std::size_t i = first + n;
      rates.acceleration[i] = {sums[n].acceleration[0], sums[n].acceleration[1], sums[n].acceleration[2]};
      rates.kernel_density[i] = sums[n].kernel_density + mass_ * sph::cubic_spline(0.0, particles.smoothing_length[i]);
      std::copy_n(sums[n].wall_acceleration, first_wall_[i + 1] - first_wall_[i],
                  rates.by_walls.value.data() + first_wall_[i]);
    }
  };
  const std::size_t blocks = (count + together - 1) / together;
  team.run((blocks + blocks_at_once - 1) / blocks_at_once, [&](std::size_t task) {
    for (std::size_t b = task * blocks_at_once; b < std::min(blocks, (task + 1) * blocks_at_once); ++b)
      compute(b * together);
  });
}

void Sweep::add_walls_of_vessel(const ParticleView& particles, std::size_t i, PairSums& sums) const {
  double *m = sums.moment, *v = sums.velocity;
  sph::GradientSums<> around{{m[0], m[1], m[2], m[3], m[4], m[5]},
                             {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8]}};
  sums.density_rate += particles.density[i] * add_walls(vessel_.of(i), particles.velocity[i], around);
  const auto& [moment, velocity] = around;
  m[0] = moment.xx, m[1] = moment.yy, m[2] = moment.zz, m[3] = moment.xy, m[4] = moment.yz, m[5] = moment.zx;
  v[0] = velocity.xx, v[1] = velocity.xy, v[2] = velocity.xz;
  v[3] = velocity.yx, v[4] = velocity.yy, v[5] = velocity.yz;
  v[6] = velocity.zx, v[7] = velocity.zy, v[8] = velocity.zz;
}

void Sweep::add_forces_of_vessel(const ParticleView& particles, std::size_t i, const Neighbours& neighbours,
                                 PairSums& sums, Rates& rates) const {
  const NearWalls& met = vessel_.of(i);
  const bool silent = local_sound_speed_ && !(trace(stress_of(particles.material, i)) > 0);
  WallForces& forces = rates.vessel[static_cast<std::size_t>(vessel_.place_of(i))];
  forces.count = 0;
  if (met.count == 0) return;
  forces = forces_of_walls(vessel_, records(), i, neighbours, constants_, silent ? 0 : constants_.sound_speed);
  const std::span<const std::uint32_t> seen(neighbours.record, neighbours.group[neighbours.groups - 1].end);
  Vector3 acceleration;
  double beyond = 0;
  for (const NearWall& wall : met.all()) {
    acceleration += vessel_.force_of_images(wall, records(), i, neighbourhood_.sight_may_change(i) ? &seen : nullptr,
                                            constants_.mass);
    beyond += wall.sums.density;
  }
  for (const WallForce& force : forces.all()) acceleration += force.acceleration;
  for (int axis = 0; axis < 3; ++axis) sums.acceleration[axis] += acceleration[axis];
  sums.kernel_density += particles.density[i] * beyond;
}

}  // namespace talus::continuum

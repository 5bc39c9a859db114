// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/pairs/sweep.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/compiled_for.hpp"
#include "models/continuum/material.hpp"
#include "models/continuum/pairs/specific_stress.hpp"
#include "models/continuum/pairs/stress_regularisation.hpp"
#include "numerics/sph/cubic_spline.hpp"
#include "numerics/sph/smoothing_lengths.hpp"
#include "numerics/sph/velocity_gradient.hpp"

namespace talus::continuum {

void Rates::resize(std::size_t count) {
  acceleration.resize(count);
  density_rate.resize(count);
  velocity_gradient.resize(count);
  kernel_density.resize(count);
}

Sweep::Sweep(const Parameters& p, const Domain& domain, double mass, double sound_speed, const Surface& vessel,
             const SurfaceFields* fields)
    : mass_(mass),
      smoothing_ratio_(p.sph.smoothing_ratio),
      fixed_smoothing_length_(p.sph.smoothing == Smoothing::fixed
                                  ? smoothing_ratio_ * sph::smoothing_length(mass, p.bed.packing * p.grains.density)
                                  : 0.0),
      grain_density_(p.grains.density),
      skin_(p.integration.skin * p.bed.spacing),
      stress_form_(p.sph.stress_form),
      corrected_continuity_(p.sph.continuity == Continuity::corrected),
      asks_stress_around_(stress_regularisation(p) > 0),
      precision_(p.integration.pair_precision),
      constants_{.mass = mass,
                 .sound_speed = sound_speed,
                 .viscosity_alpha = p.sph.viscosity_alpha,
                 .viscosity_beta = p.sph.viscosity_beta,
                 .density_diffusion = 2 * p.sph.density_diffusion * sound_speed,
                 .hourglass_damping = p.sph.hourglass_damping * sound_speed},
      diffuses_(p.sph.density_diffusion > 0),
      damps_(p.sph.hourglass_damping > 0 || p.sph.viscosity_speed == ViscositySpeed::local),
      local_sound_speed_(p.sph.viscosity_speed == ViscositySpeed::local),
      neighbourhood_(domain, vessel),
      vessel_(vessel, p.bed.spacing, resolve(p.integration.instruction_set), fields, sector_of(p)) {
  const InstructionSet set = resolve(p.integration.instruction_set);
  const auto choose = [&](SweepTerms terms, StressGradient stress_gradient) {
    return TALUS_COMPILED_FOR(set, sum_neighbours)(
        terms, are_stabilised(terms) ? Stabilisers::acting : Stabilisers::none, precision_,
        asks_stress_around_ ? StressAround::asked : StressAround::unasked, stress_gradient);
  };
  for (const SweepTerms terms : {SweepTerms::all, SweepTerms::gradients, SweepTerms::forces}) {
    const auto n = static_cast<std::size_t>(terms);
    sum_[n] = choose(terms, StressGradient::unasked);
    sum_at_vessel_[n] = choose(terms, StressGradient::asked);
  }
  velocity_gradients_ = TALUS_COMPILED_FOR(set, velocity_gradients);
  if (diffuses_)
    density_gradients_ = TALUS_COMPILED_FOR(set, sum_neighbours)(
        SweepTerms::gradients, Stabilisers::prepared, precision_, StressAround::unasked, StressGradient::unasked);
}

bool Sweep::are_stabilised(SweepTerms terms) const {
  return (terms != SweepTerms::forces && diffuses_) || (terms != SweepTerms::gradients && damps_);
}

double Sweep::smoothing_length(double density) const {
  return fixed_smoothing_length_ > 0 ? fixed_smoothing_length_
                                     : smoothing_ratio_ * sph::smoothing_length(mass_, density);
}

void Sweep::find_smoothing_lengths(ThreadTeam& team, std::span<const double> density, std::span<double> length) const {
  if (fixed_smoothing_length_ > 0) {
    std::ranges::fill(length, fixed_smoothing_length_);
    return;
  }
  for_each_chunk(team, density.size(), [&](std::size_t first, std::size_t end) {
    sph::smoothing_lengths(end - first, mass_, smoothing_ratio_, density.data() + first, length.data() + first);
  });
}

void Sweep::find_neighbours(ThreadTeam& team, std::span<const Vector3> position,
                            std::span<const double> smoothing_length, std::span<const double> margin) {
  // Two particles interact within the sum of their smoothing lengths: twice their mean.
  neighbourhood_.build(team, position, smoothing_length, margin);
  quantum_ = quantum_for(neighbourhood_.reach());
  vessel_.find(team, neighbourhood_, position, smoothing_length, margin);
  loads_of_images_.clear();
  for (const Image& image : neighbourhood_.images()) loads_of_images_.push_back(neighbourhood_.domain().loads(image));
  find_groups();
}

/// Where each group of a particle's neighbours ends: particles first, then images by mirror, as the lists are sorted.
void Sweep::find_groups() {
  const auto ghosts = neighbourhood_.ghosts();
  const std::size_t count = neighbourhood_.particles();
  std::vector<std::size_t> end(neighbourhood_.images().size());  // of the ghosts of each image, which follow each other
  for (std::size_t g = 0; g < ghosts.size(); ++g) end[ghosts[g].image] = count + g + 1;
  std::vector<char> is_listed(ghosts.size(), 0);
  groups_.clear();
  longest_ = 1;
  first_group_.assign(1, 0);
  loads_.clear();
  first_load_.assign(1, 0);
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
        for (const Domain::Load& load : loads_of_images_[image])
          if (load.wall >= 0) walls |= 1u << load.wall;
      }
      groups_.back().end = static_cast<std::uint32_t>(n + 1);
      is_listed[neighbours[n] - count] = 1;
    }
    add_loads(std::span(groups_).subspan(first_group_.back()), walls, loads_);
    first_group_.push_back(static_cast<std::uint32_t>(groups_.size()));
    first_load_.push_back(static_cast<std::uint32_t>(loads_.size()));
    walls_.push_back(walls);
    first_wall_.push_back(first_wall_.back() + static_cast<std::uint32_t>(std::popcount(walls)));
  }
  // Ghosts within the reach of a few that reach far are near nobody. The walls of a vessel may ask for any.
  packed_ghosts_.clear();
  for (std::size_t g = 0; g < ghosts.size(); ++g)
    if (is_listed[g] || !vessel_.is_empty()) packed_ghosts_.push_back(static_cast<std::uint32_t>(g));
}

/// Which neighbours load which wall. \param walls a bit for each that the images of the groups load
void Sweep::add_loads(std::span<const NeighbourGroup> groups, std::uint32_t walls, std::vector<WallLoad>& loads) const {
  for (std::size_t g = 1; g < groups.size(); ++g)
    for (const Domain::Load& load : loads_of_images_[static_cast<std::size_t>(groups[g].image)]) {
      if (load.wall < 0) break;
      const auto slot = static_cast<std::uint8_t>(std::popcount(walls & ((1u << load.wall) - 1)));
      for (int axis = 0; axis < 3; ++axis)
        for (std::uint32_t n = groups[g - 1].end; load.part[axis] != 0 && n < groups[g].end;) {
          const std::uint32_t first = n / WallLoad::block * WallLoad::block;
          const std::uint32_t end = std::min(groups[g].end, first + WallLoad::block);
          loads.push_back({first, static_cast<std::uint8_t>(n - first), static_cast<std::uint8_t>(end - first),
                           static_cast<std::uint8_t>(axis), slot, load.part[axis]});
          n = end;
        }
    }
}

/// The neighbours of a particle that it sees. Near a wall they are picked into `seen`.
Neighbours Sweep::seen_from(std::span<const Vector3> position, std::size_t i, Seen& seen) const {
  const std::size_t lines = 3 * ((longest_ + Neighbours::padded_to - 1) / Neighbours::padded_to);
  if (seen.scratch.size() < lines) seen.scratch.resize(lines);
  Neighbours found{neighbourhood_.of(i).data(),
                   groups_.data() + first_group_[i],
                   static_cast<int>(first_group_[i + 1] - first_group_[i]),
                   loads_.data() + first_load_[i],
                   static_cast<int>(first_load_[i + 1] - first_load_[i]),
                   static_cast<int>(first_wall_[i + 1] - first_wall_[i]),
                   seen.scratch.front().number,
                   static_cast<std::uint32_t>(Neighbours::padded_to * lines)};
  if (neighbourhood_.sight_may_change(i)) pick_seen(position, i, seen, found);
  return found;
}

void Sweep::pick_seen(std::span<const Vector3> position, std::size_t i, Seen& seen, Neighbours& found) const {
  static constexpr Image identity;
  const std::uint32_t* const neighbours = found.record;
  const NeighbourGroup* const group = found.group;
  const std::span<const char> in_doubt = neighbourhood_.in_doubt(i);
  const auto place = [&](std::size_t record, const Image& image) {
    if (record < position.size()) return position[record];
    return image.position(position[neighbourhood_.ghosts()[record - position.size()].source]);
  };
  seen.record.clear();
  seen.group.clear();
  std::uint32_t n = 0;
  for (int g = 0; g < found.groups; ++g) {
    const Image& image =
        group[g].image < 0 ? identity : neighbourhood_.images()[static_cast<std::size_t>(group[g].image)];
    for (; n < group[g].end; ++n)
      if (!in_doubt[n] || neighbourhood_.domain().is_visible(position[i], place(neighbours[n], image), image))
        seen.record.push_back(neighbours[n]);
    seen.group.push_back({static_cast<std::uint32_t>(seen.record.size()), group[g].image});
  }
  while (seen.record.size() % Neighbours::padded_to != 0)
    seen.record.push_back(static_cast<std::uint32_t>(position.size() + neighbourhood_.ghosts().size()));
  found.record = seen.record.data();
  found.group = seen.group.data();
  seen.load.clear();
  add_loads(seen.group, walls_[i], seen.load);
  found.load = seen.load.data();
  found.loads = static_cast<int>(seen.load.size());
}

void Sweep::operator()(ThreadTeam& team, const ParticleView& particles, SweepTerms terms, Rates& rates) {
  const std::size_t count = particles.position.size();
  rates.resize(count);
  pack(team, particles, terms != SweepTerms::gradients || diffuses_);
  if (!vessel_.is_empty()) {
    rates.vessel.resize(vessel_.particles().size());
    rates.at_vessel.assign(vessel_.particles().begin(), vessel_.particles().end());
    // In half a step particles hardly move: the gradients take the walls as the forces met them.
    if (terms != SweepTerms::gradients || !vessel_.is_met())
      vessel_.meet(team, particles.position, particles.smoothing_length);
  }
  if (are_stabilised(terms)) {
    if (terms != SweepTerms::gradients) pack_damping(team, particles);
    if (terms != SweepTerms::forces) pack_diffusion(team, particles);
  }
  if (terms != SweepTerms::gradients) {
    if (asks_stress_around_)
      for (auto& component : rates.stress_around) component.resize(count);
    rates.by_walls.walls = walls_;
    rates.by_walls.first = first_wall_;
    rates.by_walls.value.resize(first_wall_.back());
  }
  const SumNeighbours sum = sum_[static_cast<std::size_t>(terms)];
  const SumNeighbours sum_at_vessel = sum_at_vessel_[static_cast<std::size_t>(terms)];
  const Records all = records();
  constexpr std::size_t together = PairSums::together, blocks_at_once = 16;
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
      const Neighbours neighbours = seen_from(particles.position, first + n, seen);
      const bool at_vessel = !vessel_.is_empty() && !vessel_.of(first + n).empty();
      (at_vessel ? sum_at_vessel : sum)(all, static_cast<std::uint32_t>(first + n), neighbours, constants_, sums[n]);
      if (terms != SweepTerms::gradients && !vessel_.is_empty() && vessel_.place_of(first + n) >= 0)
        add_forces_of_vessel(particles, first + n, neighbours, sums[n], rates);
    }
    if (terms != SweepTerms::forces) {
      if (!vessel_.is_empty())
        for (std::size_t n = 0; n < size; ++n)
          if (!vessel_.of(first + n).empty()) add_walls_of_vessel(particles, first + n, sums[n]);
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
      if (asks_stress_around_) set_tensor(rates.stress_around, i, stress_around(particles, i, sums[n]));
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

/// With that of the particle itself.
SymmetricTensor3<> Sweep::stress_around(const ParticleView& particles, std::size_t i, const PairSums& sums) const {
  const double own = sph::cubic_spline(0.0, particles.smoothing_length[i]);
  const double* s = sums.stress;
  return SymmetricTensor3<>{s[0], s[1], s[2], s[3], s[4], s[5]} +
         own * specific_stress(particles, i, stress_form_, grain_density_);
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
  const NearWalls met = vessel_.of(i);
  const bool silent = local_sound_speed_ && !(trace(stress_of(particles.material, i)) > 0);
  WallForces& forces = rates.vessel[static_cast<std::size_t>(vessel_.place_of(i))];
  find_forces_of_walls(vessel_, records(), i, sums.stress_gradient, constants_, silent ? 0 : constants_.sound_speed,
                       forces);
  if (met.empty()) return;
  const std::span<const std::uint32_t> seen(neighbours.record, neighbours.group[neighbours.groups - 1].end);
  Vector3 acceleration;
  double beyond = 0;
  for (const NearWall& wall : met) {
    acceleration += vessel_.force_of_images(wall, records(), i, neighbourhood_.sight_may_change(i) ? &seen : nullptr,
                                            constants_.mass);
    beyond += wall.sums.density;
  }
  for (const WallForce& force : forces.all()) acceleration += force.acceleration;
  for (int axis = 0; axis < 3; ++axis) sums.acceleration[axis] += acceleration[axis];
  sums.kernel_density += particles.density[i] * beyond;
  if (walls_[i] != 0) add_loads_at_vessel(i, neighbours, sums);
}

/// Where a wall of the vessel meets a boundary that mirrors, the images in the wall have images behind that boundary.
/// What these push along its normal it bears, as it bears that of any image behind it (WallAccelerations).
void Sweep::add_loads_at_vessel(std::size_t i, const Neighbours& neighbours, PairSums& sums) const {
  for (int g = 1; g < neighbours.groups; ++g) {
    const NeighbourGroup &before = neighbours.group[g - 1], &group = neighbours.group[g];
    const auto& loads = loads_of_images_[static_cast<std::size_t>(group.image)];
    if (group.end == before.end || loads[0].wall < 0) continue;
    const std::span<const std::uint32_t> behind(neighbours.record + before.end, group.end - before.end);
    Vector3 acceleration;
    for (const NearWall& wall : vessel_.of(i))
      acceleration += vessel_.force_of_images(wall, records(), i, &behind, constants_.mass);
    for (const Domain::Load& load : loads) {
      if (load.wall < 0) break;
      sums.wall_acceleration[std::popcount(walls_[i] & ((1u << load.wall) - 1))] += dot(load.part, acceleration);
    }
  }
}

}  // namespace talus::continuum

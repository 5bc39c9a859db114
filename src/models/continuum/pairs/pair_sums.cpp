// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/pairs/pair_sums.hpp"

#include <algorithm>
#include <cmath>

#include "base/instruction_set.hpp"
#include "models/continuum/material.hpp"
#include "models/continuum/pairs/rates.hpp"
#include "models/continuum/pairs/stress_regularisation.hpp"
#include "numerics/sph/cubic_spline.hpp"
#include "numerics/sph/velocity_gradient.hpp"

namespace talus::continuum {

void Rates::resize(std::size_t count) {
  acceleration.resize(count);
  density_rate.resize(count);
  velocity_gradient.resize(count);
  kernel_density.resize(count);
}

PairSums::PairSums(const Setup& setup, const Domain& domain, const Surface& vessel, const SurfaceFields* fields)
    : mass_(setup.lattice.mass),
      masses_(has_several_masses(setup.given) ? Masses::unequal : Masses::equal),
      smoothing_ratio_(setup.given.sph.smoothing_ratio),
      fixed_smoothing_length_(setup.given.sph.smoothing == Smoothing::fixed ? setup.smoothing_length : 0.0),
      grain_density_(setup.given.grains.density),
      skin_(setup.given.integration.skin * setup.given.bed.spacing),
      stress_form_(setup.given.sph.stress_form),
      asks_stress_around_(stress_regularisation(setup.given) > 0),
      precision_(setup.given.integration.pair_precision),
      constants_{.mass = masses_ == Masses::equal ? mass_ : 0,
                 .sound_speed = setup.sound_speed,
                 .viscosity_alpha = setup.given.sph.viscosity_alpha,
                 .artificial_stress = artificial_stress(setup.given),
                 .nearness = 1 / sph::cubic_spline_shape_of(1 / setup.given.sph.smoothing_ratio)},
      lists_(domain, vessel),
      vessel_(vessel, setup.given.bed.spacing, resolve(setup.given.integration.instruction_set), fields, setup.sector(),
              static_cast<int>(setup.given.levels.count)),
      walls_(vessel_, lists_, constants_),
      records_(
          {mass_, grain_density_, stress_form_, precision_, constants_.artificial_stress > 0, !vessel.is_empty()}) {
  const InstructionSet set = resolve(setup.given.integration.instruction_set);
  const auto choose = [&](PairTerms terms, StressGradient stress_gradient) {
    return TALUS_COMPILED_FOR(set, sum_neighbours)(
        terms, precision_, asks_stress_around_ ? StressAround::asked : StressAround::unasked, stress_gradient, masses_);
  };
  for (const PairTerms terms : {PairTerms::all, PairTerms::gradients, PairTerms::forces}) {
    const auto n = static_cast<std::size_t>(terms);
    sum_[n] = choose(terms, StressGradient::unasked);
    sum_at_vessel_[n] = choose(terms, StressGradient::asked);
  }
  velocity_gradients_ = TALUS_COMPILED_FOR(set, velocity_gradients);
}

double PairSums::smoothing_length(double density, double mass_ratio) const {
  return fixed_smoothing_length_ > 0
             ? fixed_smoothing_length_
             : smoothing_ratio_ * sph::smoothing_length(size_ratio(mass_ratio) * mass_, density);
}

void PairSums::find_smoothing_lengths(ThreadTeam& team, std::span<const double> density,
                                      std::span<const double> mass_ratio, std::span<double> length) const {
  if (fixed_smoothing_length_ > 0) {
    std::ranges::fill(length, fixed_smoothing_length_);
    return;
  }
  if (!mass_ratio.empty()) {
    for_each(team, density.size(), [&](std::size_t i) { length[i] = smoothing_length(density[i], mass_ratio[i]); });
    return;
  }
  for_each_chunk(team, density.size(), [&](std::size_t first, std::size_t end) {
    sph::smoothing_lengths(end - first, mass_, smoothing_ratio_, density.data() + first, length.data() + first);
  });
}

void PairSums::find_neighbours(ThreadTeam& team, std::span<const Vector3> position,
                               std::span<const double> smoothing_length, std::span<const double> margin,
                               std::span<const double> mass_ratio, const PartOfPoints& part) {
  lists_.build(team, position, smoothing_length, margin, part);
  vessel_.find(team, lists_.neighbourhood(), position, smoothing_length, margin, mass_ratio);
  records_.find_read_by_walls(lists_, vessel_.particles());
}

/// Records of particles and images, and the walls of the vessel as they are met.
void PairSums::pack(ThreadTeam& team, const ParticleView& particles, PairTerms terms) {
  const bool stresses = terms != PairTerms::gradients || masses_ == Masses::unequal;
  records_.pack(team, lists_, particles, stresses);
  // In half a step particles hardly move: the gradients take the walls as the forces met them.
  if (!vessel_.is_empty() && (terms != PairTerms::gradients || !vessel_.is_met()))
    vessel_.meet(team, particles.position, particles.smoothing_length);
}

void PairSums::make_room(PairTerms terms, std::size_t count, Rates& rates) const {
  rates.resize(count);
  if (!vessel_.is_empty()) {
    rates.vessel.resize(vessel_.particles().size());
    rates.at_vessel.assign(vessel_.particles().begin(), vessel_.particles().end());
  }
  if (terms == PairTerms::gradients) return;
  if (asks_stress_around_)
    for (auto& component : rates.stress_around) component.resize(count);
  rates.by_walls.walls = lists_.walls();
  rates.by_walls.first = lists_.first_wall();
  rates.by_walls.value.resize(lists_.first_wall().back());
}

void PairSums::operator()(ThreadTeam& team, const ParticleView& particles, PairTerms terms, Rates& rates) {
  const std::size_t count = particles.position.size();
  make_room(terms, count, rates);
  pack(team, particles, terms);
  const SumNeighbours sum = sum_[static_cast<std::size_t>(terms)];
  const SumNeighbours sum_at_vessel = sum_at_vessel_[static_cast<std::size_t>(terms)];
  const Records all = records_.view();
  constexpr std::size_t together = ParticleSums::together, blocks_at_once = 16;
  const auto compute = [&](std::size_t first) {
    thread_local PairLists::Visible of_thread;
    PairLists::Visible& visible = of_thread;
    ParticleSums sums[together];
    const std::size_t size = std::min(together, count - first);
    for (std::size_t n = 0; n < together; ++n) {
      if (n >= size || lists_.neighbourhood().is_copy(first + n)) {
        sums[n] = {};
        continue;
      }
      const Neighbours neighbours = lists_.visible_from(particles.position, first + n, visible);
      const bool at_vessel = !vessel_.is_empty() && !vessel_.of(first + n).empty();
      (at_vessel ? sum_at_vessel : sum)(all, static_cast<std::uint32_t>(first + n), neighbours, constants_, sums[n]);
      if (terms != PairTerms::gradients && !vessel_.is_empty() && vessel_.place_of(first + n) >= 0)
        walls_.add_forces(particles, first + n, all, neighbours, sums[n], rates);
    }
    if (terms != PairTerms::forces) {
      if (!vessel_.is_empty())
        for (std::size_t n = 0; n < size; ++n)
          if (!vessel_.of(first + n).empty()) walls_.add_gradients(particles, first + n, sums[n]);
      alignas(64) double gradient[9][together];
      velocity_gradients_(sums, gradient);
      for (std::size_t c = 0; c < 9; ++c)
        std::copy_n(gradient[c], size, rates.velocity_gradient.component[c].data() + first);
      for (std::size_t n = 0; n < size; ++n) rates.density_rate[first + n] = sums[n].density_rate;
    }
    if (terms == PairTerms::gradients) return;
    for (std::size_t n = 0; n < size; ++n) {
      const std::size_t i = first + n;
      rates.acceleration[i] = {sums[n].acceleration[0], sums[n].acceleration[1], sums[n].acceleration[2]};
      if (asks_stress_around_) set_tensor(rates.stress_around, i, stress_around(particles, i, sums[n]));
      rates.kernel_density[i] = sums[n].kernel_density +
                                particles.mass_ratio[i] * mass_ * sph::cubic_spline(0.0, particles.smoothing_length[i]);
      std::copy_n(sums[n].wall_acceleration, lists_.first_wall()[i + 1] - lists_.first_wall()[i],
                  rates.by_walls.value.data() + lists_.first_wall()[i]);
    }
  };
  const std::size_t blocks = (count + together - 1) / together;
  team.run((blocks + blocks_at_once - 1) / blocks_at_once, [&](std::size_t task) {
    for (std::size_t b = task * blocks_at_once; b < std::min(blocks, (task + 1) * blocks_at_once); ++b)
      compute(b * together);
  });
}

/// With that of the particle itself.
SymmetricTensor3<> PairSums::stress_around(const ParticleView& particles, std::size_t i,
                                           const ParticleSums& sums) const {
  const double own = sph::cubic_spline(0.0, particles.smoothing_length[i]);
  const double* s = sums.stress;
  return SymmetricTensor3<>{s[0], s[1], s[2], s[3], s[4], s[5]} +
         own * specific_stress(particles, i, stress_form_, grain_density_);
}

}  // namespace talus::continuum

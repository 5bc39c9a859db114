// SPDX-License-Identifier: Apache-2.0
/// Input of the stabilisers of the sums: the rates of deformation of the last step, and gradients of the density, which
/// are computed from the packed records in a separate sweep. Both depend only on the state.
#include <algorithm>

#include "models/continuum/material.hpp"
#include "models/continuum/pairs/sweep.hpp"
#include "numerics/sph/velocity_gradient.hpp"

namespace talus::continuum {

namespace {

/// Packing above which the density diffuses: grains that touch, and no free surface between them.
constexpr double least_packing = 0.5;

/// d x_j - x_i of the source, as the image has it.
Vector3 displaced(const Image& image, const Vector3& d) {
  return image.position(d) - image.position({});
}

DampingRecord record_of(const SymmetricTensor3<>& rate, double sound_speed, double loaded) {
  return {{rate.xx, rate.yy, rate.zz, rate.xy, rate.yz, rate.zx}, sound_speed, loaded};
}

/// The same in single precision, number by number.
template <class Single, class Record>
void round_to_single(ThreadTeam& team, const std::vector<Record>& records, std::vector<Single>& single) {
  static_assert(sizeof(Record) / sizeof(double) == sizeof(Single) / sizeof(float));
  single.resize(records.size());
  for_each(team, records.size(), [&](std::size_t r) {
    const double* const from = reinterpret_cast<const double*>(&records[r]);
    float* const to = reinterpret_cast<float*>(&single[r]);
    for (std::size_t n = 0; n < sizeof(Record) / sizeof(double); ++n) to[n] = static_cast<float>(from[n]);
  });
}

}  // namespace

void Sweep::pack_damping(ThreadTeam& team, const ParticleView& particles) {
  const std::size_t count = particles.position.size();
  const auto ghosts = neighbourhood_.ghosts();
  const bool rates = !particles.deformation_rate[0].empty();
  damping_.resize(count + ghosts.size() + 1);
  for_each(team, count, [&](std::size_t i) {
    const bool loaded = trace(stress_of(particles.material, i)) > 0;
    damping_[i] = record_of(rates ? tensor_at(particles.deformation_rate, i) : SymmetricTensor3<>{},
                            loaded || !local_sound_speed_ ? constants_.sound_speed : 0, loaded ? 1.0 : 0.0);
  });
  for_each(team, packed_ghosts_.size(), [&](std::size_t n) {
    const std::size_t g = packed_ghosts_[n];
    const DampingRecord& source = damping_[ghosts[g].source];
    const double* const r = source.deformation_rate;
    damping_[count + g] = record_of(neighbourhood_.image(ghosts[g]).tensor({r[0], r[1], r[2], r[3], r[4], r[5]}),
                                    source.sound_speed, source.loaded);
  });
  damping_.back() = {};
  if (precision_ == PairPrecision::in_single) round_to_single(team, damping_, single_damping_);
}

void Sweep::pack_diffusion(ThreadTeam& team, const ParticleView& particles) {
  const std::size_t count = particles.position.size();
  const auto ghosts = neighbourhood_.ghosts();
  diffusion_.assign(count + ghosts.size() + 1, {});
  if (diffuses_) {
    const Records all = records();
    for_each(team, count, [&](std::size_t i) {
      thread_local Seen seen;
      PairSums sums;
      density_gradients_(all, static_cast<std::uint32_t>(i), seen_from(particles.position, i, seen), constants_, sums);
      const double *m = sums.moment, *r = sums.density_gradient;
      // The density is corrected as a velocity is: as the x component of one.
      const Tensor3<> density = sph::velocity_gradient(
          {SymmetricTensor3<>{m[0], m[1], m[2], m[3], m[4], m[5]}, {.xx = r[0], .xy = r[1], .xz = r[2]}});
      diffusion_[i] = {
          {density.xx, density.xy, density.xz}, particles.density[i] > least_packing * grain_density_ ? 1.0 : 0.0, {}};
    });
    for_each(team, ghosts.size(), [&](std::size_t g) {
      DiffusionRecord ghost = diffusion_[ghosts[g].source];
      double* const slope = ghost.density_gradient;
      const Vector3 turned = displaced(neighbourhood_.image(ghosts[g]), {slope[0], slope[1], slope[2]});
      for (int axis = 0; axis < 3; ++axis) slope[axis] = turned[axis];
      diffusion_[count + g] = ghost;
    });
  }
  if (precision_ == PairPrecision::in_single) round_to_single(team, diffusion_, single_diffusion_);
}

}  // namespace talus::continuum

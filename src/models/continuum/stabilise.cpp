// SPDX-License-Identifier: Apache-2.0
/// Input of the stabilisers of the sums: gradients of density and velocity, computed from the packed records in a
/// separate sweep, so that they depend only on the state.
#include <algorithm>

#include "models/continuum/material.hpp"
#include "models/continuum/sweep.hpp"
#include "numerics/sph/velocity_gradient.hpp"

namespace talus::continuum {

namespace {

/// Packing above which the density diffuses: grains that touch, and no free surface between them.
constexpr double least_packing = 0.5;

/// d x_j - x_i of the source, as the image has it.
Vector3 displaced(const Image& image, const Vector3& d) {
  return image.position(d) - image.position({});
}

}  // namespace

void Sweep::prepare_stabilisers(ThreadTeam& team, const ParticleView& particles) {
  const std::size_t count = particles.position.size();
  const auto ghosts = neighbourhood_.ghosts();
  stabilisers_.assign(count + ghosts.size() + 1, {});
  const Records all = records();
  for_each(team, count, [&](std::size_t i) {
    thread_local Seen seen;
    PairSums sums;
    prepare_sum_(all, static_cast<std::uint32_t>(i), seen_from(particles.position, i, seen), constants_, sums);
    const double *m = sums.moment, *v = sums.velocity, *r = sums.density_gradient;
    const SymmetricTensor3<> moment{m[0], m[1], m[2], m[3], m[4], m[5]};
    const Tensor3<> l = sph::velocity_gradient({moment, {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8]}});
    // The density is corrected as a velocity is: as the x component of one.
    const Tensor3<> density = sph::velocity_gradient({moment, {.xx = r[0], .xy = r[1], .xz = r[2]}});
    const bool loaded = trace(stress_of(particles.material, i)) > 0;
    stabilisers_[i] = {{density.xx, density.xy, density.xz},
                       {l.xx, l.xy, l.xz, l.yx, l.yy, l.yz, l.zx, l.zy, l.zz},
                       loaded || !local_sound_speed_ ? constants_.sound_speed : 0,
                       loaded ? 1.0 : 0.0,
                       particles.density[i] > least_packing * grain_density_ ? 1.0 : 0.0,
                       0};
  });
  for_each(team, ghosts.size(), [&](std::size_t g) {
    const Image& image = neighbourhood_.image(ghosts[g]);
    StabiliserRecord ghost = stabilisers_[ghosts[g].source];
    double* const slope = ghost.density_gradient;
    const Vector3 turned = displaced(image, {slope[0], slope[1], slope[2]});
    for (int axis = 0; axis < 3; ++axis) slope[axis] = turned[axis];
    // L as the image has it maps the image's displacements to its velocities.
    double* const l = ghost.velocity_gradient;
    for (int row = 0; row < 3; ++row) {
      const Vector3 along = displaced(image, {l[3 * row], l[3 * row + 1], l[3 * row + 2]});
      for (int axis = 0; axis < 3; ++axis) l[3 * row + axis] = along[axis];
    }
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 across = image.vector({l[axis], l[3 + axis], l[6 + axis]});
      for (int row = 0; row < 3; ++row) l[3 * row + axis] = across[row];
    }
    stabilisers_[count + g] = ghost;
  });
  if (precision_ != PairPrecision::in_single) return;
  single_stabilisers_.resize(stabilisers_.size());
  for_each(team, stabilisers_.size(), [&](std::size_t r) {
    const StabiliserRecord& from = stabilisers_[r];
    SingleStabiliserRecord& to = single_stabilisers_[r];
    std::copy_n(from.density_gradient, 3, to.density_gradient);
    std::copy_n(from.velocity_gradient, 9, to.velocity_gradient);
    to.sound_speed = static_cast<float>(from.sound_speed);
    to.loaded = static_cast<float>(from.loaded), to.dense = static_cast<float>(from.dense);
  });
}

}  // namespace talus::continuum

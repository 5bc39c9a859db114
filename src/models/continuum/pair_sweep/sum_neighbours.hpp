// SPDX-License-Identifier: Apache-2.0
/// The sums over a particle's neighbours, a register of neighbours at a time: their records are loaded whole and turned
/// into columns. Included by one file for each instruction set; its contents live in that set's namespace.
#pragma once

#include "base/simd.hpp"
#include "base/tensor.hpp"
#include "models/continuum/pair_sweep/kernel.hpp"
#include "numerics/sph/cubic_spline.hpp"
#include "numerics/sph/velocity_gradient.hpp"
#include "physics/sph/artificial_viscosity.hpp"
#include "physics/sph/pair_terms.hpp"
#include "physics/sph/stabilisers.hpp"

namespace talus::continuum {
inline namespace TALUS_INSTRUCTION_SET {

using Number = SimdVector<double>;

struct SimdVector3 {
  Number x, y, z;
};

/// Accelerations by each neighbour, one component after the other, in the order of the list.
struct PairAccelerations {
  double* component[3];

  TALUS_INLINE PairAccelerations(const Neighbours& neighbours)
      : component{neighbours.scratch, neighbours.scratch + neighbours.scratch_size / 3,
                  neighbours.scratch + 2 * (neighbours.scratch_size / 3)} {}
  /// \param first place of the register's first lane in the list
  TALUS_INLINE void store(std::uint32_t first, const SimdVector3& a) const {
    a.x.store(component[0] + first), a.y.store(component[1] + first), a.z.store(component[2] + first);
  }
  /// The sum of a component of those of the places from `begin` up to `end`, lane by lane.
  TALUS_INLINE Number sum(int c, std::uint32_t begin, std::uint32_t end) const {
    constexpr std::uint32_t lanes = Number::lanes;
    const Number zero = 0.0;
    const Number low = static_cast<double>(begin) - 0.5, high = static_cast<double>(end) - 0.5;
    std::uint32_t first = begin / lanes * lanes;
    Number place = Number::ramp(0) + Number(static_cast<double>(first));
    Number all = select(place > low && high > place, Number::load(component[c] + first), zero);
    while ((first += lanes) < end) {
      place = place + Number(static_cast<double>(lanes));
      all = all + select(high > place, Number::load(component[c] + first), zero);
    }
    return all;
  }
};

/// Writes the acceleration, the sum of the kernel and the loads of the walls.
TALUS_INLINE void store_forces(const Neighbours& neighbours, const ImageLoads* loads, const PairAccelerations& pairs,
                               const SimdVector3& all, const Number& kernel_density, PairSums& sums) {
  const Number zero = 0.0;
  Number value[24];
  value[0] = all.x, value[1] = all.y, value[2] = all.z, value[3] = kernel_density;
  const int count = 4 + __builtin_popcount(neighbours.walls);
  TALUS_UNROLL for (int n = 4; n < 8; ++n) value[n] = zero;
  for (int n = 8; n < count; ++n) value[n] = zero;
  for (int g = 1; g < neighbours.groups; ++g) {
    const std::uint32_t begin = neighbours.group[g - 1].end, end = neighbours.group[g].end;
    if (begin == end) continue;
    for (const ImageLoad& load : loads[neighbours.group[g].image].load) {
      if (load.wall < 0) break;
      Number& wall = value[4 + __builtin_popcount(neighbours.walls & ((1u << load.wall) - 1))];
      for (int c = 0; c < 3; ++c)
        if (load.part[c] != 0) wall = multiply_add(Number(load.part[c]), pairs.sum(c, begin, end), wall);
    }
  }
  for (int n = 0; n < count; n += 8) {
    Number block[8];
    TALUS_UNROLL for (int k = 0; k < 8; ++k) block[k] = value[n + k];
    store_sums(block, sums.acceleration + n);
  }
}

/// What a sum needs of the places and the motion of a register of neighbours.
struct PairGeometry {
  SimdVector3 d, du;  ///< x_j - x_i, m; u_j - u_i, m/s
  Number volume;      ///< V_j, m^3
  Number h, square;   ///< mean smoothing length, m; distance squared, m^2
  Number q, inverse_h;
  Number slope;  ///< F_ij, 1/m^5

  TALUS_INLINE PairGeometry(const MotionRecord* motion, const MotionRecord& own, const std::uint32_t* neighbours) {
    Number other[8];
    load_columns([&](int lane) { return motion[neighbours[lane]].position; }, other);
    d = {other[0] - Number(own.position[0]), other[1] - Number(own.position[1]), other[2] - Number(own.position[2])};
    du = {other[4] - Number(own.velocity[0]), other[5] - Number(own.velocity[1]), other[6] - Number(own.velocity[2])};
    volume = other[7];
    h = Number(own.half_length) + other[3];
    square = multiply_add(d.x, d.x, multiply_add(d.y, d.y, d.z * d.z));
    inverse_h = 1.0 / h;
    const Number inverse_distance = reciprocal_sqrt(square + 1e-30);
    q = square * inverse_distance * inverse_h;
    slope = sph::cubic_spline_slope_of(q, h * inverse_distance, inverse_h);
  }
};

template <bool gradients, bool forces, Stabilisers stabilisers>
void sum_neighbours(const Records& records, std::uint32_t self, const Neighbours& neighbours,
                    const PairConstants& constants, PairSums& sums) {
  const MotionRecord own = records.motion[self];  // copies: what is stored below could change what is referred to
  const StressRecord loaded = records.stress[self];
  const sph::ArtificialViscosity viscous{constants.viscosity_alpha, constants.viscosity_beta};
  const Number zero = 0.0;
  sph::GradientSums<Number> gradient{{zero, zero, zero, zero, zero, zero},
                                     {zero, zero, zero, zero, zero, zero, zero, zero, zero}};
  Number density_rate = zero, kernel_density = zero;
  SimdVector3 density_gradient{zero, zero, zero};
  const std::uint32_t end = neighbours.group[neighbours.groups - 1].end;
  const PairAccelerations pairs(neighbours);
  SimdVector3 acceleration{zero, zero, zero};
  // The distances of the next register are found while those of this one are used: neither waits for the other.
  for (std::uint32_t first = 0; first < end; first += Number::lanes) {
    const std::uint32_t* const record = neighbours.record + first;
    const auto [d, du, volume, h, square, q, inverse_h, slope] = PairGeometry(records.motion, own, record);
    Number stress[8];
    if constexpr (forces || stabilisers != Stabilisers::none)
      load_columns([&](int lane) { return records.stress[record[lane]].specific_stress; }, stress);
    Number its[16];
    if constexpr (stabilisers == Stabilisers::acting)
      load_columns([&](int lane) { return records.stabilisers[record[lane]].density_gradient; }, its);
    if constexpr (gradients) {
      gradient.add(volume, slope, d, du);
      density_rate = density_rate + sph::density_rate(constants.mass, slope, d, du);
    }
    if constexpr (stabilisers == Stabilisers::prepared) {
      const Number weight = -2.0 * volume * slope * (stress[6] - Number(loaded.half_density));
      density_gradient = {density_gradient.x + weight * d.x, density_gradient.y + weight * d.y,
                          density_gradient.z + weight * d.z};
    }
    if constexpr (gradients && stabilisers == Stabilisers::acting) {
      const double* g = records.stabilisers[self].density_gradient;
      const SimdVector3 both{its[0] + Number(g[0]), its[1] + Number(g[1]), its[2] + Number(g[2])};
      density_rate = density_rate + records.stabilisers[self].dense * its[14] *
                                        sph::density_diffusion(constants.density_diffusion, h, volume, slope, d,
                                                               2.0 * (stress[6] - Number(loaded.half_density)), both);
    }
    if constexpr (forces) {
      const Number approach = multiply_add(du.x, d.x, multiply_add(du.y, d.y, du.z * d.z));
      kernel_density = multiply_add(Number(constants.mass), sph::cubic_spline_of(q, inverse_h), kernel_density);
      const Number mean_density = Number(loaded.half_density) + stress[6];
      Number viscosity;
      if constexpr (stabilisers == Stabilisers::acting) {
        const StabiliserRecord& mine = records.stabilisers[self];
        const double* l = mine.velocity_gradient;
        const Tensor3<Number> both{its[3] + Number(l[0]), its[4] + Number(l[1]),  its[5] + Number(l[2]),
                                   its[6] + Number(l[3]), its[7] + Number(l[4]),  its[8] + Number(l[5]),
                                   its[9] + Number(l[6]), its[10] + Number(l[7]), its[11] + Number(l[8])};
        viscosity =
            sph::viscosity(viscous, approach, square, h, 0.5 * (Number(mine.sound_speed) + its[12]), mean_density) +
            mine.loaded * its[13] *
                sph::hourglass_damping(constants.hourglass_damping, sph::unexplained_approach(approach, d, both),
                                       square, h, mean_density);
      } else {
        viscosity = sph::viscosity(viscous, approach, square, h, constants.sound_speed, mean_density);
      }
      const double* s = loaded.specific_stress;
      const SymmetricTensor3<Number> both{stress[0] + Number(s[0]), stress[1] + Number(s[1]), stress[2] + Number(s[2]),
                                          stress[3] + Number(s[3]), stress[4] + Number(s[4]), stress[5] + Number(s[5])};
      const SimdVector3 a = sph::acceleration(constants.mass, slope, d, both, viscosity);
      pairs.store(first, a);
      acceleration = {acceleration.x + a.x, acceleration.y + a.y, acceleration.z + a.z};
    }
  }
  if constexpr (forces) store_forces(neighbours, records.loads, pairs, acceleration, kernel_density, sums);
  if constexpr (gradients) {
    const SymmetricTensor3<Number>& m = gradient.moment;
    const Tensor3<Number>& v = gradient.velocity;
    const Number all[16] = {m.xx, m.yy, m.zz, m.xy, m.yz, m.zx, v.xx, v.xy,
                            v.xz, v.yx, v.yy, v.yz, v.zx, v.zy, v.zz, density_rate};
    store_sums(all, sums.moment);
  }
  if constexpr (stabilisers == Stabilisers::prepared) {
    const Number all[8] = {density_gradient.x, density_gradient.y, density_gradient.z, zero, zero, zero, zero, zero};
    store_sums(all, sums.density_gradient);
  }
}

TALUS_INLINE void velocity_gradients(const PairSums* sums, double (*gradient)[Neighbours::padded_to]) {
  for (std::uint32_t n = 0; n < Neighbours::padded_to; n += Number::lanes) {
    Number s[16];
    load_columns([&](int lane) { return sums[n + static_cast<std::uint32_t>(lane)].moment; }, s);
    const Tensor3<Number> l = sph::velocity_gradient<Number>(
        {{s[0], s[1], s[2], s[3], s[4], s[5]}, {s[6], s[7], s[8], s[9], s[10], s[11], s[12], s[13], s[14]}});
    const Number component[9] = {l.xx, l.xy, l.xz, l.yx, l.yy, l.yz, l.zx, l.zy, l.zz};
    TALUS_UNROLL for (int c = 0; c < 9; ++c) component[c].store(gradient[c] + n);
  }
}

template <Stabilisers stabilisers>
TALUS_INLINE SumNeighbours choose(SweepTerms terms) {
  return terms == SweepTerms::all         ? sum_neighbours<true, true, stabilisers>
         : terms == SweepTerms::gradients ? sum_neighbours<true, false, stabilisers>
                                          : sum_neighbours<false, true, stabilisers>;
}

TALUS_INLINE SumNeighbours choose(SweepTerms terms, Stabilisers stabilisers) {
  return stabilisers == Stabilisers::none     ? choose<Stabilisers::none>(terms)
         : stabilisers == Stabilisers::acting ? choose<Stabilisers::acting>(terms)
                                              : sum_neighbours<true, false, Stabilisers::prepared>;
}

}  // namespace TALUS_INSTRUCTION_SET
}  // namespace talus::continuum

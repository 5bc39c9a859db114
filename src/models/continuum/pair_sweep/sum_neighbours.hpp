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

TALUS_INLINE double total(const Number& x) {
  return sum_lanes(x, 0);
}

/// Sums a vector by group while registers of neighbours follow each other. A register may end one group and begin the
/// next: none is padded but the last.
class GroupedSum {
 public:
  /// \param total one per group, of three components
  GroupedSum(const Neighbours& neighbours, double (*total)[3]) : neighbours_(neighbours), total_(total) {}

  /// \param first place of the register's first lane in the list
  TALUS_INLINE void add(std::uint32_t first, SimdVector3 a) {
    while (group_ + 1 < neighbours_.groups && neighbours_.group_end[group_] < first + Number::lanes) {
      const Number zero = 0.0;
      const auto inside = Number::ramp(0) < Number(static_cast<double>(neighbours_.group_end[group_] - first));
      sum_ = {sum_.x + select(inside, a.x, zero), sum_.y + select(inside, a.y, zero),
              sum_.z + select(inside, a.z, zero)};
      a = {select(inside, zero, a.x), select(inside, zero, a.y), select(inside, zero, a.z)};
      end_group();
    }
    sum_ = {sum_.x + a.x, sum_.y + a.y, sum_.z + a.z};
  }
  void end() {
    while (group_ < neighbours_.groups) end_group();
  }

 private:
  TALUS_INLINE void end_group() {
    double(&of_group)[3] = total_[group_++];
    of_group[0] = total(sum_.x), of_group[1] = total(sum_.y), of_group[2] = total(sum_.z);
    sum_ = {0.0, 0.0, 0.0};
  }

  const Neighbours& neighbours_;
  double (*total_)[3];
  int group_ = 0;
  SimdVector3 sum_{0.0, 0.0, 0.0};
};

template <bool gradients, bool forces, Stabilisers stabilisers>
void sum_neighbours(const ParticleRecord* records, std::uint32_t self, const Neighbours& neighbours,
                    const PairConstants& constants, PairSums& sums, double (*acceleration)[3]) {
  const ParticleRecord& own = records[self];
  const sph::ArtificialViscosity viscous{constants.viscosity_alpha, constants.viscosity_beta};
  const Number zero = 0.0;
  sph::GradientSums<Number> gradient{{zero, zero, zero, zero, zero, zero},
                                     {zero, zero, zero, zero, zero, zero, zero, zero, zero}};
  Number density_rate = zero, kernel_density = zero;
  SimdVector3 density_gradient{zero, zero, zero};
  const std::uint32_t end = neighbours.group_end[neighbours.groups - 1];
  GroupedSum sum(neighbours, acceleration);
  for (std::uint32_t first = 0; first < end; first += Number::lanes) {
    Number other[16];
    load_columns(
        [&](int lane) {
          const std::uint32_t n = first + static_cast<std::uint32_t>(lane);
          return records[n < end ? neighbours.record[n] : neighbours.padding].position;
        },
        other);
    const SimdVector3 d{other[0] - Number(own.position[0]), other[1] - Number(own.position[1]),
                        other[2] - Number(own.position[2])};
    const SimdVector3 du{other[3] - Number(own.velocity[0]), other[4] - Number(own.velocity[1]),
                         other[5] - Number(own.velocity[2])};
    const Number h = 0.5 * (Number(own.smoothing_length) + other[6]);
    const Number square = d.x * d.x + d.y * d.y + d.z * d.z;
    const Number inverse_h = 1.0 / h;
    const Number inverse_distance = reciprocal_sqrt(square + 1e-30);
    const Number q = square * inverse_distance * inverse_h;
    const Number slope = sph::cubic_spline_slope_of(q, h * inverse_distance, inverse_h);
    if constexpr (gradients) {
      gradient.add(other[7], slope, d, du);
      density_rate = density_rate + sph::density_rate(constants.mass, slope, d, du);
    }
    if constexpr (stabilisers == Stabilisers::prepared) {
      const Number weight = -1.0 * other[7] * slope * (other[14] - Number(own.density));
      density_gradient = {density_gradient.x + weight * d.x, density_gradient.y + weight * d.y,
                          density_gradient.z + weight * d.z};
    }
    Number its[16];
    if constexpr (stabilisers == Stabilisers::acting)
      load_columns(
          [&](int lane) {
            const std::uint32_t n = first + static_cast<std::uint32_t>(lane);
            return constants.stabilisers[n < end ? neighbours.record[n] : neighbours.padding].density_gradient;
          },
          its);
    if constexpr (gradients && stabilisers == Stabilisers::acting) {
      const double* g = constants.stabilisers[self].density_gradient;
      const SimdVector3 both{its[0] + Number(g[0]), its[1] + Number(g[1]), its[2] + Number(g[2])};
      density_rate = density_rate + constants.stabilisers[self].dense * its[14] *
                                        sph::density_diffusion(constants.density_diffusion, h, other[7], slope, d,
                                                               other[14] - Number(own.density), both);
    }
    if constexpr (forces) {
      kernel_density = kernel_density + constants.mass * sph::cubic_spline_of(q, inverse_h);
      const Number approach = du.x * d.x + du.y * d.y + du.z * d.z;
      const Number mean_density = 0.5 * (Number(own.density) + other[14]);
      Number viscosity;
      if constexpr (stabilisers == Stabilisers::acting) {
        const StabiliserRecord& mine = constants.stabilisers[self];
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
      const double* s = own.specific_stress;
      const SymmetricTensor3<Number> stress{other[8] + Number(s[0]),  other[9] + Number(s[1]),
                                            other[10] + Number(s[2]), other[11] + Number(s[3]),
                                            other[12] + Number(s[4]), other[13] + Number(s[5])};
      sum.add(first, sph::acceleration(constants.mass, slope, d, stress, viscosity));
    }
  }
  if constexpr (forces) sum.end();
  if constexpr (gradients) {
    const SymmetricTensor3<Number>& m = gradient.moment;
    const Tensor3<Number>& v = gradient.velocity;
    const Number* moments[6] = {&m.xx, &m.yy, &m.zz, &m.xy, &m.yz, &m.zx};
    const Number* velocities[9] = {&v.xx, &v.xy, &v.xz, &v.yx, &v.yy, &v.yz, &v.zx, &v.zy, &v.zz};
    for (int c = 0; c < 6; ++c) sums.moment[c] = total(*moments[c]);
    for (int c = 0; c < 9; ++c) sums.velocity[c] = total(*velocities[c]);
    sums.density_rate = total(density_rate);
  }
  if constexpr (stabilisers == Stabilisers::prepared) {
    const Number* components[3] = {&density_gradient.x, &density_gradient.y, &density_gradient.z};
    for (int c = 0; c < 3; ++c) sums.density_gradient[c] = total(*components[c]);
  }
  if constexpr (forces) sums.kernel_density = total(kernel_density);
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

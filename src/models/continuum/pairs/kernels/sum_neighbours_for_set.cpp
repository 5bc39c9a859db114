// SPDX-License-Identifier: Apache-2.0
/// The sums over a particle's neighbours, a register of neighbours at a time: their records are loaded whole and turned
/// into columns. Compiled once for each instruction set.
#include "base/simd.hpp"
#include "base/simd_columns.hpp"
#include "base/tensor.hpp"
#include "models/continuum/pairs/kernels/kernel.hpp"
#include "numerics/sph/cubic_spline.hpp"
#include "numerics/sph/velocity_gradient.hpp"
#include "physics/sph/pair_terms.hpp"

namespace talus::continuum {
inline namespace TALUS_INSTRUCTION_SET {

template <class Real>
struct SimdVector3 {
  SimdVector<Real> x, y, z;
};

/// The records of one precision.
TALUS_INLINE const Records& records_of(const Records& records, double) {
  return records;
}
TALUS_INLINE const SingleRecords& records_of(const Records& records, float) {
  return records.single;
}

/// The same pointer, of which the compiler cannot tell where it points to: what is read through it in a loop stays an
/// operand in memory. Otherwise each number is spread over a register before the loop, and most of these are spilled.
template <class T>
TALUS_INLINE const T* opaque(const T* pointer) {
  asm volatile("" : "+r"(pointer));
  return pointer;
}

/// Accelerations by each neighbour, one component after the other, in the order of the list.
template <class Real>
struct PairAccelerations {
  using Number = SimdVector<Real>;
  Real* component[3];

  TALUS_INLINE explicit PairAccelerations(const Neighbours& neighbours) {
    for (std::uint32_t c = 0; c < 3; ++c)
      component[c] = reinterpret_cast<Real*>(neighbours.scratch) + c * (neighbours.scratch_size / 3);
  }
  /// \param first place of the register's first lane in the list
  TALUS_INLINE void store(std::uint32_t first, const SimdVector3<Real>& a) const {
    a.x.store(component[0] + first), a.y.store(component[1] + first), a.z.store(component[2] + first);
  }
  /// The sum over what loads a wall, lane by lane.
  TALUS_INLINE Number sum(const WallLoad& load) const {
    const Number begin = load.begin - 0.5, end = load.end - 0.5;
    Number all = 0.0;
    TALUS_UNROLL for (std::uint32_t n = 0; n < WallLoad::block; n += Number::lanes) {
      const Number values = Number::load(component[load.axis] + load.first + n), place = Number::ramp(n);
      all = all + select(place > begin && end > place, values, Number(0.0));
    }
    return Number(load.part) * all;
  }
};

/// Writes the acceleration, the sum of the kernel and the loads of the walls.
template <class Real>
TALUS_INLINE void store_forces(const Neighbours& neighbours, const PairAccelerations<Real>& pairs,
                               const SimdVector3<Real>& all, const SimdVector<Real>& kernel_density,
                               ParticleSums& sums) {
  using Number = SimdVector<Real>;
  const Number zero = 0.0;
  Number value[24];
  value[0] = all.x, value[1] = all.y, value[2] = all.z, value[3] = kernel_density;
  TALUS_UNROLL for (int n = 4; n < 8; ++n) value[n] = zero;
  const int count = 4 + neighbours.walls;
  for (int n = 8; n < count; ++n) value[n] = zero;
  for (int n = 0; n < neighbours.loads; ++n) {
    Number& wall = value[4 + neighbours.load[n].slot];
    wall = wall + pairs.sum(neighbours.load[n]);
  }
  for (int n = 0; n < count; n += 8) {
    Number block[8];
    TALUS_UNROLL for (int k = 0; k < 8; ++k) block[k] = value[n + k];
    store_sums(block, sums.acceleration + n);
  }
}

/// What a sum needs of the places and the motion of a register of neighbours.
template <class Real>
struct PairGeometry {
  using Number = SimdVector<Real>;
  SimdVector3<Real> d, du;  ///< x_j - x_i, m; u_j - u_i, m/s
  Number volume;            ///< V_j, m^3
  Number h, square;         ///< mean smoothing length, m; distance squared, m^2
  Number q, inverse_h;
  Number slope;  ///< F_ij, 1/m^5

  template <class AnyRecords, class Motion>
  TALUS_INLINE PairGeometry(const AnyRecords& records, const Motion& own, const std::uint32_t* neighbours) {
    Number other[8];
    load_columns([&](int lane) { return reinterpret_cast<const Real*>(records.motion + neighbours[lane]); }, other);
    d = difference(records, own, other);
    du = {other[4] - Number(own.velocity[0]), other[5] - Number(own.velocity[1]), other[6] - Number(own.velocity[2])};
    volume = other[7];
    h = Number(own.half_length) + other[3];
    square = multiply_add(d.x, d.x, multiply_add(d.y, d.y, d.z * d.z));
    inverse_h = 1.0 / h;
    const Number inverse_distance = reciprocal_sqrt(square + 1e-30);
    q = square * inverse_distance * inverse_h;
    slope = sph::cubic_spline_slope_of(q, h * inverse_distance, inverse_h);
  }

 private:
  TALUS_INLINE static SimdVector3<Real> difference(const Records&, const MotionRecord& own, const Number* other) {
    const double* x = own.position;
    return {other[0] - Number(x[0]), other[1] - Number(x[1]), other[2] - Number(x[2])};
  }
  TALUS_INLINE static SimdVector3<Real> difference(const SingleRecords& records, const SingleMotionRecord& own,
                                                   const Number* other) {
    const Number quantum = records.quantum;
    const auto along = [&](int axis) {
      Number quanta;
      quanta.row[0] = registers::differences_of_bits(other[axis].row[0], own.position[axis]);
      return quantum * quanta;
    };
    return {along(0), along(1), along(2)};
  }
};

/// Sums for the gradient of the specific stress; empty where nobody asks.
template <bool asked>
struct StressGradientSums {};
template <>
struct StressGradientSums<true> {
  using Number = SimdVector<double>;
  Number value[24];  ///< as StressSums

  TALUS_INLINE StressGradientSums() {
    // In two halves, which are unrolled: as one loop, an instruction that fills memory takes as long as a register of
    // neighbours.
    TALUS_UNROLL for (int n = 0; n < 12; ++n) value[n] = 0.0, value[12 + n] = 0.0;
  }
  TALUS_INLINE void add(const SimdVector3<double>& d, const Number& weight, const Number* stress, const double* own) {
    const Number w[3] = {weight * d.x, weight * d.y, weight * d.z};
    value[0] = multiply_add(w[0], d.x, value[0]), value[1] = multiply_add(w[1], d.y, value[1]);
    value[2] = multiply_add(w[2], d.z, value[2]), value[3] = multiply_add(w[0], d.y, value[3]);
    value[4] = multiply_add(w[1], d.z, value[4]), value[5] = multiply_add(w[2], d.x, value[5]);
    TALUS_UNROLL for (int c = 0; c < 6; ++c) {
      const Number change = stress[c] - Number(own[c]);
      TALUS_UNROLL for (int axis = 0; axis < 3; ++axis) value[6 + 3 * c + axis] =
          multiply_add(change, w[axis], value[6 + 3 * c + axis]);
    }
  }
};

/// m_j, kg.
template <Masses masses, class Number>
TALUS_INLINE auto mass_of(const PairConstants& constants, const Number& volume, const Number* stress) {
  if constexpr (masses == Masses::equal)
    return constants.mass;
  else
    return 2.0 * volume * stress[6];
}

template <class Real, bool gradients, bool forces, StressAround stress_around = StressAround::unasked,
          StressGradient stress_gradient = StressGradient::unasked, Masses masses = Masses::equal>
void sum_neighbours(const Records& all_records, std::uint32_t self, const Neighbours& neighbours,
                    const PairConstants& constants, ParticleSums& sums) {
  using Number = SimdVector<Real>;
  const auto records = records_of(all_records, Real{});
  const auto* motion = records.motion + self;
  const auto* stresses = records.stress + self;
  const Number zero = 0.0;
  sph::GradientSums<Number> gradient{{zero, zero, zero, zero, zero, zero},
                                     {zero, zero, zero, zero, zero, zero, zero, zero, zero}};
  Number density_rate = zero, kernel_density = zero;
  const std::uint32_t end = neighbours.group[neighbours.groups - 1].end;
  const PairAccelerations<Real> pairs(neighbours);
  SimdVector3<Real> acceleration{zero, zero, zero};
  Number around[8] = {zero, zero, zero, zero, zero, zero, zero, zero};
  constexpr bool slopes = stress_gradient == StressGradient::asked && sizeof(Real) == sizeof(double);
  [[maybe_unused]] StressGradientSums<slopes> stress_slopes;
  const auto geometry = [&](std::uint32_t first) __attribute__((always_inline)) {
    motion = opaque(motion);
    return PairGeometry<Real>(records, *motion, neighbours.record + first);
  };
  const auto add = [&](std::uint32_t first, const PairGeometry<Real>& pair) __attribute__((always_inline)) {
    const std::uint32_t* const record = neighbours.record + first;
    stresses = opaque(stresses);
    const auto& loaded = *stresses;
    const auto& [d, du, volume, h, square, q, inverse_h, slope] = pair;
    Number stress[8];
    if constexpr (forces || slopes || masses == Masses::unequal)
      load_columns([&](int lane) { return reinterpret_cast<const Real*>(records.stress + record[lane]); }, stress);
    const auto mass = mass_of<masses>(constants, volume, stress);
    if constexpr (gradients) {
      gradient.add(volume, slope, d, du);
      density_rate = density_rate + sph::density_rate(mass, slope, d, du);
    }
    if constexpr (forces) {
      const Number approach = multiply_add(du.x, d.x, multiply_add(du.y, d.y, du.z * d.z));
      const Number kernel = sph::cubic_spline_of(q, inverse_h);
      kernel_density = multiply_add(Number(mass), kernel, kernel_density);
      if constexpr (stress_around == StressAround::asked)
        TALUS_UNROLL for (int c = 0; c < 6; ++c) around[c] = multiply_add(kernel, stress[c], around[c]);
      const Number mean_density = Number(loaded.half_density) + stress[6];
      Number viscosity =
          sph::viscosity(constants.viscosity_alpha, approach, square, h, constants.sound_speed, mean_density);
      if (constants.artificial_stress > 0)
        viscosity = viscosity + sph::artificial_stress(constants.artificial_stress, Number(loaded.tension) + stress[7],
                                                       constants.nearness * sph::cubic_spline_shape_of(q));
      const Real* s = loaded.specific_stress;
      const SymmetricTensor3<Number> both{stress[0] + Number(s[0]), stress[1] + Number(s[1]), stress[2] + Number(s[2]),
                                          stress[3] + Number(s[3]), stress[4] + Number(s[4]), stress[5] + Number(s[5])};
      const SimdVector3<Real> a = sph::acceleration(mass, slope, d, both, viscosity);
      pairs.store(first, a);
      acceleration = {acceleration.x + a.x, acceleration.y + a.y, acceleration.z + a.z};
    }
    if constexpr (slopes) stress_slopes.add(d, -1.0 * volume * slope, stress, loaded.specific_stress);
  };
  if constexpr (gradients && !forces) {
    // The next register's geometry, a long chain of operations, has begun while this one's is summed.
    if (end > 0) {
      PairGeometry<Real> next = geometry(0);
      std::uint32_t first = 0;
      for (; first + Number::lanes < end; first += Number::lanes) {
        const PairGeometry<Real> now = next;
        next = geometry(first + Number::lanes);
        add(first, now);
      }
      add(first, next);
    }
  } else {
    for (std::uint32_t first = 0; first < end; first += Number::lanes) add(first, geometry(first));
  }
  if constexpr (forces && stress_around == StressAround::asked) store_sums(around, sums.stress);
  if constexpr (forces) store_forces(neighbours, pairs, acceleration, kernel_density, sums);
  if constexpr (slopes)
    store_sums(stress_slopes.value, sums.stress_gradient.moment);
  else if constexpr (stress_gradient == StressGradient::asked)
    sum_neighbours<double, false, false, StressAround::unasked, StressGradient::asked, masses>(
        all_records, self, neighbours, constants, sums);
  if constexpr (gradients) {
    const SymmetricTensor3<Number>& m = gradient.moment;
    const Tensor3<Number>& v = gradient.velocity;
    const Number all[16] = {m.xx, m.yy, m.zz, m.xy, m.yz, m.zx, v.xx, v.xy,
                            v.xz, v.yx, v.yy, v.yz, v.zx, v.zy, v.zz, density_rate};
    store_sums(all, sums.moment);
  }
}

template <class Real, Masses masses, StressAround stress_around, StressGradient stress_gradient>
TALUS_INLINE SumNeighbours choose(PairTerms terms) {
  constexpr StressAround unasked = StressAround::unasked;
  return terms == PairTerms::all         ? sum_neighbours<Real, true, true, stress_around, stress_gradient, masses>
         : terms == PairTerms::gradients ? sum_neighbours<Real, true, false, unasked, StressGradient::unasked, masses>
                                         : sum_neighbours<Real, false, true, stress_around, stress_gradient, masses>;
}

template <class Real, StressGradient stress_gradient>
TALUS_INLINE SumNeighbours choose(PairTerms terms, StressAround stress_around, Masses masses) {
  return masses == Masses::unequal ? choose<Real, Masses::unequal, StressAround::unasked, stress_gradient>(terms)
         : stress_around == StressAround::asked
             ? choose<Real, Masses::equal, StressAround::asked, stress_gradient>(terms)
             : choose<Real, Masses::equal, StressAround::unasked, stress_gradient>(terms);
}

template <class Real>
TALUS_INLINE SumNeighbours choose(PairTerms terms, StressAround stress_around, StressGradient stress_gradient,
                                  Masses masses) {
  return stress_gradient == StressGradient::asked ? choose<Real, StressGradient::asked>(terms, stress_around, masses)
                                                  : choose<Real, StressGradient::unasked>(terms, stress_around, masses);
}

}  // namespace TALUS_INSTRUCTION_SET

SumNeighbours TALUS_FOR_SET(sum_neighbours)(PairTerms terms, PairPrecision precision, StressAround stress_around,
                                            StressGradient stress_gradient, Masses masses) {
  return precision == PairPrecision::in_single ? choose<float>(terms, stress_around, stress_gradient, masses)
                                               : choose<double>(terms, stress_around, stress_gradient, masses);
}

void TALUS_FOR_SET(velocity_gradients)(const ParticleSums* sums, double (*gradient)[ParticleSums::together]) {
  using Number = SimdVector<double>;
  for (std::uint32_t n = 0; n < ParticleSums::together; n += Number::lanes) {
    Number s[16];
    load_columns([&](int lane) { return sums[n + static_cast<std::uint32_t>(lane)].moment; }, s);
    const Tensor3<Number> l = sph::velocity_gradient<Number>(
        {{s[0], s[1], s[2], s[3], s[4], s[5]}, {s[6], s[7], s[8], s[9], s[10], s[11], s[12], s[13], s[14]}});
    const Number component[9] = {l.xx, l.xy, l.xz, l.yx, l.yy, l.yz, l.zx, l.zy, l.zz};
    TALUS_UNROLL for (int c = 0; c < 9; ++c) component[c].store(gradient[c] + n);
  }
}

}  // namespace talus::continuum

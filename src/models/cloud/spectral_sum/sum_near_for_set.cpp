// SPDX-License-Identifier: Apache-2.0
/// The loop over near pairs: each target meets its neighbours a register at a time. Every target sums for itself, so
/// that no other thread's sums are touched. Compiled once for each instruction set.
#include "base/simd.hpp"
#include "models/cloud/spectral_sum/kernel.hpp"
#include "physics/hydrodynamics/mobility.hpp"

namespace talus::cloud {
inline namespace TALUS_INSTRUCTION_SET {

using hydrodynamics::Mobility;
using hydrodynamics::PairMobility;

template <int dimensions, class Number, class Vector>
TALUS_INLINE Number dot(const Number* u, const Vector* v) {
  Number sum = u[dimensions - 1] * v[dimensions - 1];
  TALUS_UNROLL for (int k = dimensions - 2; k >= 0; --k) sum = multiply_add(u[k], v[k], sum);
  return sum;
}

/// The spheres that a block's targets may be near, gathered: positions relative to the block's first cell. Left out is
/// what lies beyond the cut-off of the box around the targets.
template <class T, int dimensions>
struct Neighbours {
  using Column = SimdVector<T>;
  using Spheres = SortedSpheres<T, dimensions>;
  using Block = NearBlock<T, dimensions>;
  static constexpr std::size_t rows = near_rows(dimensions);
  T *position[dimensions], *force[dimensions], *size, *radius, *number;
  std::size_t count = 0;  ///< a multiple of the lanes of a register

  TALUS_INLINE Neighbours(const Spheres& spheres, const Block& block, T* space) {
    std::size_t capacity = near_padding;
    for (std::size_t row = 0; row < rows; ++row) capacity += block.end[row] - block.begin[row];
    capacity = (capacity + near_padding - 1) / near_padding * near_padding;
    for (int k = 0; k < dimensions; ++k)
      position[k] = space + k * capacity, force[k] = position[k] + dimensions * capacity;
    size = space + 2 * dimensions * capacity, radius = size + capacity, number = radius + capacity;

    Column low[dimensions], high[dimensions];
    for (int k = 0; k < dimensions; ++k) {
      T least = 100, most = -100;
      for (std::size_t n = block.first; n < block.last; ++n) {
        const T x = place_of(spheres, block, k, n);
        least = minimum(least, x), most = maximum(most, x);
      }
      low[k] = Column(least), high[k] = Column(most);
    }
    const Column lane = Column::ramp(0), first_cell(block.first_cell);
    std::size_t passed = 0;
    for (std::size_t row = 0; row < rows; ++row) {
      // From the targets' row to this one; 0 along the row.
      const std::size_t of_layer = row % 5, layer = row / 5;
      const Column offset[] = {0, 0.5 * (static_cast<double>(of_layer) - near_reach),
                               0.5 * (static_cast<double>(layer) - near_reach)};
      for (std::size_t n = block.begin[row]; n < block.end[row]; n += Column::lanes) {
        Column x[dimensions], beyond[dimensions];
        for (int k = 0; k < dimensions; ++k) {
          x[k] = Column::load_unaligned(spheres.position[k] + n);
          x[k] = k == 0 ? multiply_add(Column(0.5), Column::load_unaligned(spheres.cell + n) - first_cell, x[k])
                        : x[k] + offset[k];
          beyond[k] = maximum(maximum(low[k] - x[k], x[k] - high[k]), Column(0));
        }
        const std::size_t left_over = block.end[row] - n;
        // A little more than the cut-off: what rounding of the positions could bring within it stays.
        const auto near =
            Column(1.0001) > dot<dimensions>(beyond, beyond) && Column(static_cast<double>(left_over)) > lane;
        for (int k = 0; k < dimensions; ++k) {
          store_packed(x[k], near, position[k] + count);
          store_packed(Column::load_unaligned(spheres.force[k] + n), near, force[k] + count);
        }
        store_packed(Column::load_unaligned(spheres.size + n), near, size + count);
        store_packed(Column::load_unaligned(spheres.radius + n), near, radius + count);
        store_packed(lane + static_cast<double>(passed + n - block.begin[row]), near, number + count);
        count += static_cast<std::size_t>(__builtin_popcount(lane_bits(near)));
      }
      passed += block.end[row] - block.begin[row];
    }
    const std::size_t padded = (count + Column::lanes - 1) / Column::lanes * Column::lanes;
    for (std::size_t n = count; n < padded; ++n) {  // beyond every cut-off
      for (int k = 0; k < dimensions; ++k) position[k][n] = 100, force[k][n] = 0;
      size[n] = radius[n] = number[n] = 0;
    }
    count = padded;
  }

  TALUS_INLINE static T place_of(const Spheres& spheres, const Block& block, int k, std::size_t n) {
    return k == 0 ? spheres.position[0][n] + T(0.5) * (spheres.cell[n] - block.first_cell) : spheres.position[k][n];
  }
};

template <int degree, class Number, class Column>
TALUS_INLINE Number polynomial_at(const Number& v, const Column* coefficient) {
  Number sum = multiply_add(v, coefficient[degree], coefficient[degree - 1]);
  TALUS_UNROLL for (int n = degree - 2; n >= 0; --n) sum = multiply_add(sum, v, coefficient[n]);
  return sum;
}

/// The whole tensor. Few spheres overlap: what they need is computed only where a register holds such a pair.
template <Mobility mobility, class Number, class Size, class Column>
TALUS_INLINE PairMobility<Number> whole(const Number& square, const Size& size, const Number& radius_i,
                                        const Column& radius_j) {
  const Number inverse = reciprocal_sqrt(square);
  const PairMobility<Number> far = hydrodynamics::oseen_with_size(inverse, size);
  if constexpr (mobility == Mobility::zuk_2014) {
    const auto apart = hydrodynamics::are_apart(square, radius_i, radius_j);
    if (!all(apart)) [[unlikely]] {
      const PairMobility<Number> near = hydrodynamics::zuk_2014_overlapping(square, inverse, radius_i, radius_j);
      return {select(apart, far.isotropic, near.isotropic), select(apart, far.radial, near.radial)};
    }
  }
  return far;
}

/// Targets that meet a register of neighbours at once; what a last one meets beyond the targets is not kept.
inline constexpr int targets_at_once = 2;

/// As SumNear says.
template <Mobility mobility, class T, int dimensions, int degree>
void sum_near(const SortedSpheres<T, dimensions>& spheres, const NearBlock<T, dimensions>& block, const T* polynomial,
              T* space, T* const* velocity) {
  using Column = SimdVector<T>;
  using Number = SimdVector<T, targets_at_once>;
  const Neighbours<T, dimensions> near(spheres, block, space);
  constexpr int terms = degree + 1;
  Column c[4 * terms];
  for (int n = 0; n < 4 * terms; ++n) c[n] = Column(static_cast<double>(polynomial[n]));

  constexpr std::size_t middle = near_rows(dimensions) / 2;
  std::size_t self = block.first - block.begin[middle];
  for (std::size_t row = 0; row < middle; ++row) self += block.end[row] - block.begin[row];
  for (std::size_t target = block.first; target < block.last; target += targets_at_once, self += targets_at_once) {
    Number position[dimensions], sum[dimensions];
    T place[targets_at_once];
    for (int k = 0; k < dimensions; ++k) {
      for (std::size_t r = 0; r < targets_at_once; ++r)
        place[r] = near.place_of(spheres, block, k, target + r < block.last ? target + r : target);
      position[k] = Number::broadcast(place), sum[k] = Number(0);
    }
    const Number size_i = Number::broadcast(spheres.size + target);
    const Number radius_i = Number::broadcast(spheres.radius + target), number = Number::ramp_of_rows(self);
    for (std::size_t n = 0; n < near.count; n += Column::lanes) {
      Number d[dimensions];
      TALUS_UNROLL for (int k = 0; k < dimensions; ++k) d[k] = Column::load(near.position[k] + n) - position[k];
      const Number square = dot<dimensions>(d, d);
      const Column size_j = Column::load(near.size + n), radius_j = Column::load(near.radius + n);
      const auto size = [&] {
        if constexpr (mobility == Mobility::zuk_2014)
          return size_i + size_j;
        else
          return size_j;
      }();
      const PairMobility<Number> all_of_it = whole<mobility>(square, size, radius_i, radius_j);

      const Number v = multiply_add(square, Column(2), Column(-1));
      const Number smooth_isotropic =
          multiply_add(size, polynomial_at<degree>(v, c + 2 * terms), polynomial_at<degree>(v, c));
      const Number smooth_radial =
          multiply_add(size, polynomial_at<degree>(v, c + 3 * terms), polynomial_at<degree>(v, c + terms));
      // A sphere does not drag itself, but the smooth part, which knows no spheres, does.
      const Column other = Column::load(near.number + n);
      const auto counts = other > number || number > other;
      const auto within = Column(1) > square;
      const Number isotropic =
          select(within, select(counts, all_of_it.isotropic, Column(0)) - smooth_isotropic, Column(0));
      const Number radial = select(within, select(counts, all_of_it.radial, Column(0)) - smooth_radial, Column(0));

      Column force[dimensions];
      TALUS_UNROLL for (int k = 0; k < dimensions; ++k) force[k] = Column::load(near.force[k] + n);
      const Number along = radial * dot<dimensions>(d, force);
      TALUS_UNROLL for (int k = 0; k < dimensions; ++k) {
        sum[k] = multiply_add(along, d[k], multiply_add(isotropic, force[k], sum[k]));
      }
    }
    for (int r = 0; r < targets_at_once && target + static_cast<std::size_t>(r) < block.last; ++r)
      for (int k = 0; k < dimensions; ++k) velocity[k][target + static_cast<std::size_t>(r)] = sum_lanes(sum[k], r);
  }
}

template <class T, int dimensions, Mobility mobility>
TALUS_INLINE SumNear<T, dimensions> choose_near(int degree) {
  if constexpr (sizeof(T) == sizeof(double))
    return sum_near<mobility, T, dimensions, 12>;
  else
    return degree == 7 ? sum_near<mobility, T, dimensions, 7> : sum_near<mobility, T, dimensions, 9>;
}

template <class T, int dimensions>
TALUS_INLINE SumNear<T, dimensions> choose_near(Mobility mobility, int degree) {
  return mobility == Mobility::zuk_2014 ? choose_near<T, dimensions, Mobility::zuk_2014>(degree)
                                        : choose_near<T, dimensions, Mobility::rotne_prager_1969>(degree);
}

}  // namespace TALUS_INSTRUCTION_SET

template <>
SumNear<float, 2> TALUS_FOR_SET(sum_near)(Mobility mobility, int degree) {
  return choose_near<float, 2>(mobility, degree);
}

template <>
SumNear<float, 3> TALUS_FOR_SET(sum_near)(Mobility mobility, int degree) {
  return choose_near<float, 3>(mobility, degree);
}

template <>
SumNear<double, 2> TALUS_FOR_SET(sum_near)(Mobility mobility, int degree) {
  return choose_near<double, 2>(mobility, degree);
}

template <>
SumNear<double, 3> TALUS_FOR_SET(sum_near)(Mobility mobility, int degree) {
  return choose_near<double, 3>(mobility, degree);
}

}  // namespace talus::cloud

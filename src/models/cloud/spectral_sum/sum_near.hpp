// SPDX-License-Identifier: Apache-2.0
/// The loop over near pairs: each target meets its neighbours a register at a time. Every target sums for itself, so
/// that no other thread's sums are touched. Included by one file for each instruction set; its contents live in that
/// set's namespace.
#pragma once

#include "base/simd.hpp"
#include "models/cloud/spectral_sum/kernel.hpp"
#include "physics/hydrodynamics/rotne_prager.hpp"
#include "physics/hydrodynamics/zuk.hpp"

namespace talus::cloud {
inline namespace TALUS_INSTRUCTION_SET {

using hydrodynamics::Mobility;
using hydrodynamics::PairMobility;

/// The spheres that a block's targets may be near, gathered: places relative to the block's first cell. Left out is
/// what lies beyond the cut-off of the rectangle around the targets.
template <class T>
struct Neighbours {
  using Column = SimdVector<T>;
  T *x, *y, *force_x, *force_y, *size, *radius, *number;
  std::size_t count = 0;  ///< a multiple of the lanes of a register

  TALUS_INLINE Neighbours(const SortedSpheres<T>& spheres, const NearBlock<T>& block, T* space) {
    std::size_t capacity = near_padding;
    for (int row = 0; row < near_rows; ++row) capacity += block.end[row] - block.begin[row];
    capacity = (capacity + near_padding - 1) / near_padding * near_padding;
    T** const columns[] = {&x, &y, &force_x, &force_y, &size, &radius, &number};
    for (std::size_t k = 0; k < near_columns; ++k) *columns[k] = space + k * capacity;

    T left = 100, right = -100, low = 100, high = -100;
    for (std::size_t n = block.first; n < block.last; ++n) {
      const T x_n = x_of(spheres, block, n), y_n = spheres.position[1][n];
      left = minimum(left, x_n), right = maximum(right, x_n), low = minimum(low, y_n), high = maximum(high, y_n);
    }
    const Column to_left(left), to_right(right), to_low(low), to_high(high), first_cell(block.first_cell);
    const Column lane = Column::ramp(0);
    std::size_t seen = 0;
    for (int row = 0; row < near_rows; ++row) {
      const Column above(0.5 * (row - near_rows / 2));
      for (std::size_t n = block.begin[row]; n < block.end[row]; n += Column::lanes) {
        const Column x_n = multiply_add(Column(0.5), Column::load_unaligned(spheres.cell + n) - first_cell,
                                        Column::load_unaligned(spheres.position[0] + n));
        const Column y_n = Column::load_unaligned(spheres.position[1] + n) + above;
        const Column beside = maximum(maximum(to_left - x_n, x_n - to_right), Column(0));
        const Column over = maximum(maximum(to_low - y_n, y_n - to_high), Column(0));
        const std::size_t left_over = block.end[row] - n;
        // A little more than the cut-off: what rounding of the places could bring within it stays.
        const auto near =
            Column(1.0001) > multiply_add(beside, beside, over * over) && Column(static_cast<double>(left_over)) > lane;
        store_packed(x_n, near, x + count);
        store_packed(y_n, near, y + count);
        store_packed(Column::load_unaligned(spheres.force[0] + n), near, force_x + count);
        store_packed(Column::load_unaligned(spheres.force[1] + n), near, force_y + count);
        store_packed(Column::load_unaligned(spheres.size + n), near, size + count);
        store_packed(Column::load_unaligned(spheres.radius + n), near, radius + count);
        store_packed(lane + static_cast<double>(seen + n - block.begin[row]), near, number + count);
        count += static_cast<std::size_t>(__builtin_popcount(lane_bits(near)));
      }
      seen += block.end[row] - block.begin[row];
    }
    const std::size_t padded = (count + Column::lanes - 1) / Column::lanes * Column::lanes;
    for (std::size_t n = count; n < padded; ++n) {  // beyond every cut-off
      x[n] = y[n] = 100;
      force_x[n] = force_y[n] = size[n] = radius[n] = number[n] = 0;
    }
    count = padded;
  }

  TALUS_INLINE static T x_of(const SortedSpheres<T>& spheres, const NearBlock<T>& block, std::size_t n) {
    return spheres.position[0][n] + T(0.5) * (spheres.cell[n] - block.first_cell);
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
template <Mobility mobility, class T, int degree>
void sum_near(const SortedSpheres<T>& spheres, const NearBlock<T>& block, const T* polynomial, T* space,
              T* const* velocity) {
  using Column = SimdVector<T>;
  using Number = SimdVector<T, targets_at_once>;
  const Neighbours<T> near(spheres, block, space);
  constexpr int terms = degree + 1;
  Column c[4 * terms];
  for (int n = 0; n < 4 * terms; ++n) c[n] = Column(static_cast<double>(polynomial[n]));

  std::size_t self = block.first - block.begin[near_rows / 2];
  for (int row = 0; row < near_rows / 2; ++row) self += block.end[row] - block.begin[row];
  for (std::size_t target = block.first; target < block.last; target += targets_at_once, self += targets_at_once) {
    T along_row[targets_at_once];
    for (std::size_t r = 0; r < targets_at_once; ++r)
      along_row[r] = near.x_of(spheres, block, target + r < block.last ? target + r : target);
    const Number x = Number::broadcast(along_row), y = Number::broadcast(spheres.position[1] + target);
    const Number size_i = Number::broadcast(spheres.size + target);
    const Number radius_i = Number::broadcast(spheres.radius + target), number = Number::ramp_of_rows(self);
    Number velocity_x(0), velocity_y(0);
    for (std::size_t n = 0; n < near.count; n += Column::lanes) {
      const Number dx = Column::load(near.x + n) - x, dy = Column::load(near.y + n) - y;
      const Number square = multiply_add(dx, dx, dy * dy);
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

      const Column force_x = Column::load(near.force_x + n), force_y = Column::load(near.force_y + n);
      const Number along = radial * multiply_add(dx, force_x, dy * force_y);
      velocity_x = multiply_add(along, dx, multiply_add(isotropic, force_x, velocity_x));
      velocity_y = multiply_add(along, dy, multiply_add(isotropic, force_y, velocity_y));
    }
    for (int r = 0; r < targets_at_once && target + static_cast<std::size_t>(r) < block.last; ++r) {
      velocity[0][target + static_cast<std::size_t>(r)] = sum_lanes(velocity_x, r);
      velocity[1][target + static_cast<std::size_t>(r)] = sum_lanes(velocity_y, r);
    }
  }
}

template <class T, Mobility mobility>
TALUS_INLINE SumNear<T> choose_near(int degree) {
  return degree == 7 ? sum_near<mobility, T, 7> : degree == 9 ? sum_near<mobility, T, 9> : sum_near<mobility, T, 12>;
}

template <class T>
TALUS_INLINE SumNear<T> choose_near(Mobility mobility, int degree) {
  return mobility == Mobility::zuk_2014 ? choose_near<T, Mobility::zuk_2014>(degree)
                                        : choose_near<T, Mobility::rotne_prager_1969>(degree);
}

}  // namespace TALUS_INSTRUCTION_SET
}  // namespace talus::cloud

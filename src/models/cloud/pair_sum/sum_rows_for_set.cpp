// SPDX-License-Identifier: Apache-2.0
/// The loop over pairs: tiles of the upper triangle, a few rows against a register of columns at a time. The geometry
/// of a pair is computed once for both of its spheres; the rows' velocities stay in registers, the columns' are added
/// up in memory. Compiled once for each instruction set.
///
/// On Zen 5 with AVX-512 the loop keeps 0.81 to 0.87 of the multiplication slots busy (benchmarks/benchmark_pair_sum).
#include "base/simd.hpp"
#include "models/cloud/pair_sum/kernel.hpp"
#include "physics/hydrodynamics/mobility.hpp"

namespace talus::cloud {
inline namespace TALUS_INSTRUCTION_SET {

using hydrodynamics::Mobility;
using hydrodynamics::PairMobility;

/// Rows that meet a register of columns at once: as many independent chains of operations as the registers can hold,
/// to hide the latency of each.
inline constexpr int block_rows = registers::bytes == 64 ? 4 : 2;

/// Columns of a tile: 4 KiB of each number, so that a tile stays in the first-level cache.
template <class T>
inline constexpr std::size_t tile_columns = 4096 / sizeof(T);

/// One side of a tile, in the precision of the arithmetic.
template <Mobility mobility, class T, int dimensions, std::size_t length>
struct alignas(64) Side {
  T position[dimensions][length];
  T force[dimensions][length];
  T radius[length];
  T size[length];
  T velocity[dimensions][length];

  TALUS_INLINE void fill(const PackedSpheres& spheres, std::size_t begin, std::size_t end, const double* centre) {
    const std::size_t count = end - begin;
    for (int k = 0; k < dimensions; ++k) {
      for (std::size_t n = 0; n < count; ++n)
        position[k][n] = static_cast<T>(spheres.position[k][begin + n] - centre[k]);
      for (std::size_t n = 0; n < count; ++n) force[k][n] = static_cast<T>(spheres.force[k][begin + n]);
      for (std::size_t n = 0; n < count; ++n) velocity[k][n] = 0;
    }
    for (std::size_t n = 0; n < count; ++n) size[n] = static_cast<T>(spheres.size[begin + n]);
    if constexpr (mobility == Mobility::zuk_2014)
      for (std::size_t n = 0; n < count; ++n) radius[n] = static_cast<T>(spheres.radius[begin + n]);
  }
};

/// A block of rows: each number broadcast to all lanes. `velocity` is the sum so far, lane by lane.
template <Mobility mobility, class T, int dimensions>
struct Rows {
  using Number = SimdVector<T, block_rows>;
  Number position[dimensions], force[dimensions], radius, size, velocity[dimensions];

  template <std::size_t length>
  TALUS_INLINE Rows(const Side<mobility, T, dimensions, length>& rows, std::size_t first) {
    TALUS_UNROLL for (int k = 0; k < dimensions; ++k) {
      position[k] = Number::broadcast(rows.position[k] + first);
      force[k] = Number::broadcast(rows.force[k] + first);
      velocity[k] = 0;
    }
    if constexpr (mobility == Mobility::zuk_2014) radius = Number::broadcast(rows.radius + first);
    size = Number::broadcast(rows.size + first);
  }
};

/// The symmetric law. Few spheres overlap: what they need is computed only where a block holds such a pair.
template <class Number, class Column>
TALUS_INLINE PairMobility<Number> zuk_2014(const Number& square, const Number& inverse, const Number& radius_i,
                                           const Number& size_i, const Column& radius_j, const Column& size_j) {
  const PairMobility<Number> far = hydrodynamics::zuk_2014_apart(inverse, size_i, size_j);
  const auto apart = hydrodynamics::are_apart(square, radius_i, radius_j);
  if (all(apart)) [[likely]]
    return far;
  const PairMobility<Number> near = hydrodynamics::zuk_2014_overlapping(square, inverse, radius_i, radius_j);
  return {select(apart, far.isotropic, near.isotropic), select(apart, far.radial, near.radial)};
}

template <int dimensions, class Number, class Vector>
TALUS_INLINE Number project(const Number* d, const Vector* force) {
  Number sum = d[0] * force[0];
  TALUS_UNROLL for (int k = 1; k < dimensions; ++k) sum = multiply_add(d[k], force[k], sum);
  return sum;
}

/// The interactions of a block of rows with the register of columns that begins at `column`.
/// \param first only with `on_diagonal`, where pairs i < j alone count: the index of the first row among the columns
template <bool on_diagonal, Mobility mobility, class T, int dimensions, std::size_t length>
TALUS_INLINE void add_pairs(Rows<mobility, T, dimensions>& i, Side<mobility, T, dimensions, length>& columns,
                            std::size_t column, [[maybe_unused]] std::size_t first = 0) {
  using Column = SimdVector<T>;
  using Number = SimdVector<T, block_rows>;
  Number d[dimensions];
  TALUS_UNROLL for (int k = 0; k < dimensions; ++k) d[k] = Column::load(columns.position[k] + column) - i.position[k];
  const Number square = project<dimensions>(d, d);
  const Number inverse = reciprocal_sqrt(square);

  // Of i under the force on j, and of j under the force on i.
  PairMobility<Number> of_i, of_j;
  const Column size_j = Column::load(columns.size + column);
  if constexpr (mobility == Mobility::zuk_2014) {
    const Column radius_j = Column::load(columns.radius + column);
    of_j = of_i = zuk_2014(square, inverse, i.radius, i.size, radius_j, size_j);
  } else {
    of_i = hydrodynamics::rotne_prager_1969(inverse, size_j);
    of_j = hydrodynamics::rotne_prager_1969(inverse, i.size);
  }
  if constexpr (on_diagonal) {
    const auto counts = Column::ramp(column) > Number::ramp_of_rows(first);
    of_i = {select(counts, of_i.isotropic, Column(0)), select(counts, of_i.radial, Column(0))};
    of_j = {select(counts, of_j.isotropic, Column(0)), select(counts, of_j.radial, Column(0))};
  }

  Column force_j[dimensions];
  TALUS_UNROLL for (int k = 0; k < dimensions; ++k) force_j[k] = Column::load(columns.force[k] + column);
  const Number along_i = of_i.radial * project<dimensions>(d, force_j);
  TALUS_UNROLL for (int k = 0; k < dimensions; ++k) {
    i.velocity[k] = multiply_add(of_i.isotropic, force_j[k], i.velocity[k]);
    i.velocity[k] = multiply_add(along_i, d[k], i.velocity[k]);
  }
  const Number along_j = of_j.radial * project<dimensions>(d, i.force);
  TALUS_UNROLL for (int k = 0; k < dimensions; ++k) {
    Column velocity_j = Column::load(columns.velocity[k] + column);
    velocity_j = multiply_add_rows(of_j.isotropic, i.force[k], velocity_j);
    velocity_j = multiply_add_rows(along_j, d[k], velocity_j);
    velocity_j.store(columns.velocity[k] + column);
  }
}

/// As SumRows says. Single precision takes positions relative to a sphere in the middle of the tile's rows, so that
/// what is near keeps its digits, and adds no more than a tile up.
template <Mobility mobility, class T, int dimensions>
void sum_rows(const PackedSpheres& spheres, std::size_t row_begin, std::size_t row_end, double* const* velocity) {
  constexpr std::size_t width = tile_columns<T>, lanes = SimdVector<T>::lanes;
  Side<mobility, T, dimensions, tile_rows> rows;
  Side<mobility, T, dimensions, width> columns;
  if (row_end > spheres.padded) row_end = spheres.padded;

  for (std::size_t top = row_begin; top < row_end; top += tile_rows) {
    const std::size_t bottom = top + tile_rows < row_end ? top + tile_rows : row_end;
    const std::size_t middle = (top + (bottom < spheres.count ? bottom : spheres.count)) / 2;
    double centre[dimensions] = {};
    if constexpr (sizeof(T) < sizeof(double))
      for (int k = 0; k < dimensions; ++k) centre[k] = spheres.position[k][middle];
    rows.fill(spheres, top, bottom, centre);
    double row_velocity[dimensions][tile_rows] = {};

    for (std::size_t left = top; left < spheres.padded; left += width) {
      const std::size_t right = left + width < spheres.padded ? left + width : spheres.padded;
      columns.fill(spheres, left, right, centre);

      for (std::size_t row = 0; row < bottom - top; row += block_rows) {
        Rows<mobility, T, dimensions> block(rows, row);
        std::size_t column = 0;
        if (left == top)
          for (column = row / lanes * lanes; column < row + block_rows; column += lanes)
            add_pairs<true>(block, columns, column, row);
        for (; column < right - left; column += lanes) add_pairs<false>(block, columns, column);
        for (int k = 0; k < dimensions; ++k)
          for (int r = 0; r < block_rows; ++r) row_velocity[k][row + r] += sum_lanes(block.velocity[k], r);
      }

      for (int k = 0; k < dimensions; ++k) {
        double* const sum = velocity[k] + (left - row_begin);
        if (top == row_begin)
          for (std::size_t n = 0; n < right - left; ++n) sum[n] = columns.velocity[k][n];
        else
          for (std::size_t n = 0; n < right - left; ++n) sum[n] += columns.velocity[k][n];
      }
    }
    for (int k = 0; k < dimensions; ++k)
      for (std::size_t n = 0; n < bottom - top; ++n) velocity[k][top - row_begin + n] += row_velocity[k][n];
  }
}

template <Mobility mobility>
TALUS_INLINE SumRows choose(std::size_t dimensions, bool single_precision) {
  if (single_precision) return dimensions == 2 ? sum_rows<mobility, float, 2> : sum_rows<mobility, float, 3>;
  return dimensions == 2 ? sum_rows<mobility, double, 2> : sum_rows<mobility, double, 3>;
}

}  // namespace TALUS_INSTRUCTION_SET

SumRows TALUS_FOR_SET(sum_rows)(Mobility mobility, std::size_t dimensions, bool single_precision) {
  return mobility == Mobility::zuk_2014 ? choose<Mobility::zuk_2014>(dimensions, single_precision)
                                        : choose<Mobility::rotne_prager_1969>(dimensions, single_precision);
}

}  // namespace talus::cloud

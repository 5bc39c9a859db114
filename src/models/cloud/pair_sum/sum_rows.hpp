// SPDX-License-Identifier: Apache-2.0
/// The loop over pairs: tiles of the upper triangle, a few rows against a register of columns at a time. The geometry
/// of a pair is computed once for both of its spheres; the rows' velocities stay in registers, the columns' are added
/// up in memory. Included by one file for each instruction set; its contents live in that set's namespace.
#pragma once

#include "base/lanes.hpp"
#include "models/cloud/pair_sum/kernel.hpp"
#include "physics/hydrodynamics/rotne_prager.hpp"
#include "physics/hydrodynamics/zuk.hpp"

namespace talus::cloud {
inline namespace TALUS_INSTRUCTION_SET {

using hydrodynamics::Mobility;
using hydrodynamics::PairMobility;

/// Rows that meet a register of columns at once: enough independent chains to hide the latency of the arithmetic.
inline constexpr int block_rows = 4;

/// Columns of a tile: 2 KiB of each number, so that a tile stays in the first-level cache.
template <class T>
inline constexpr std::size_t tile_columns = 2048 / sizeof(T);

/// One side of a tile, in the precision of the arithmetic; positions relative to the centre of the tile's rows, so that
/// what is near keeps its digits.
template <Mobility mobility, class T, int dimensions, std::size_t length>
struct alignas(64) Side {
  T position[dimensions][length];
  T force[dimensions][length];
  T radius[length];
  T size[length];  // the law's share of the sphere's size
  T velocity[dimensions][length];

  TALUS_INLINE void fill(const PackedSpheres& spheres, std::size_t begin, std::size_t end, const double* centre) {
    for (int k = 0; k < dimensions; ++k)
      for (std::size_t n = 0; n < end - begin; ++n) {
        position[k][n] = static_cast<T>(spheres.position[k][begin + n] - centre[k]);
        force[k][n] = static_cast<T>(spheres.force[k][begin + n]);
        velocity[k][n] = 0;
      }
    for (std::size_t n = 0; n < end - begin; ++n) {
      const double a = spheres.radius[begin + n];
      radius[n] = static_cast<T>(a);
      size[n] = static_cast<T>(mobility == Mobility::zuk_2014 ? hydrodynamics::shared_size(a)
                                                              : hydrodynamics::source_size(a));
    }
  }
};

/// A block of rows: each number spread over the lanes. `velocity` is the sum so far, lane by lane.
template <class T, int dimensions>
struct Rows {
  using Number = Lanes<T, block_rows>;
  Number position[dimensions], force[dimensions], radius, size, velocity[dimensions];

  template <class Side>
  TALUS_INLINE Rows(const Side& rows, std::size_t first) {
    for (int k = 0; k < dimensions; ++k) {
      position[k] = Number::spread(rows.position[k] + first);
      force[k] = Number::spread(rows.force[k] + first);
      velocity[k] = 0;
    }
    radius = Number::spread(rows.radius + first);
    size = Number::spread(rows.size + first);
  }
};

/// Mobilities of i under the forces on j, and of j under the forces on i.
template <class Number>
struct BothWays {
  PairMobility<Number> of_i, of_j;
};

template <class Number, class Column>
TALUS_INLINE BothWays<Number> printed_tensor(const Number& inverse, const Number& size_i, const Column& size_j) {
  return {hydrodynamics::rotne_prager_1969(inverse, size_j), hydrodynamics::rotne_prager_1969(inverse, size_i)};
}

/// Few pairs overlap: what they need is computed only where a block has one.
template <class Number, class Column>
TALUS_INLINE BothWays<Number> symmetric_tensor(const Number& square, const Number& inverse, const Number& radius_i,
                                               const Number& size_i, const Column& radius_j, const Column& size_j) {
  PairMobility<Number> mobility = hydrodynamics::zuk_2014_apart(inverse, size_i, size_j);
  const Number reach = radius_i + radius_j;
  const auto apart = square > reach * reach;
  if (!all(apart)) [[unlikely]] {
    const auto inner = hydrodynamics::zuk_2014_overlapping(square, inverse, radius_i, radius_j);
    mobility = {select(apart, mobility.isotropic, inner.isotropic), select(apart, mobility.radial, inner.radial)};
  }
  return {mobility, mobility};
}

/// The interactions of a block of rows with the register of columns that begins at `column`.
/// \param first only with `on_diagonal`, where pairs with i < j alone count: index of the first row among the columns
template <Mobility mobility, bool on_diagonal, class T, int dimensions, class Columns>
TALUS_INLINE void add_pairs(Rows<T, dimensions>& i, Columns& columns, std::size_t column, std::size_t first = 0) {
  using Number = Lanes<T, block_rows>;
  using Column = Lanes<T>;
  Number d[dimensions];
  for (int k = 0; k < dimensions; ++k) d[k] = Column::load(columns.position[k] + column) - i.position[k];
  Number square = d[0] * d[0];
  for (int k = 1; k < dimensions; ++k) square = multiply_add(d[k], d[k], square);
  const Number inverse = reciprocal_sqrt(square);

  const Column size_j = Column::load(columns.size + column);
  BothWays<Number> m;
  if constexpr (mobility == Mobility::zuk_2014)
    m = symmetric_tensor(square, inverse, i.radius, i.size, Column::load(columns.radius + column), size_j);
  else
    m = printed_tensor(inverse, i.size, size_j);
  if constexpr (on_diagonal) {
    const auto counts = Column::ramp(column) > Number::ramp_of_rows(first);
    m.of_i = {select(counts, m.of_i.isotropic, Column(0)), select(counts, m.of_i.radial, Column(0))};
    m.of_j = {select(counts, m.of_j.isotropic, Column(0)), select(counts, m.of_j.radial, Column(0))};
  }

  Column force_j[dimensions];
  for (int k = 0; k < dimensions; ++k) force_j[k] = Column::load(columns.force[k] + column);
  Number along_i = d[0] * force_j[0], along_j = d[0] * i.force[0];
  for (int k = 1; k < dimensions; ++k) {
    along_i = multiply_add(d[k], force_j[k], along_i);
    along_j = multiply_add(d[k], i.force[k], along_j);
  }
  along_i = along_i * m.of_i.radial;
  along_j = along_j * m.of_j.radial;
  for (int k = 0; k < dimensions; ++k) {
    i.velocity[k] = multiply_add(m.of_i.isotropic, force_j[k], i.velocity[k]);
    i.velocity[k] = multiply_add(along_i, d[k], i.velocity[k]);
    Column velocity_j = Column::load(columns.velocity[k] + column);
    velocity_j = multiply_add_rows(m.of_j.isotropic, i.force[k], velocity_j);
    velocity_j = multiply_add_rows(along_j, d[k], velocity_j);
    velocity_j.store(columns.velocity[k] + column);
  }
}

/// As SumRows says.
template <Mobility mobility, class T, int dimensions>
void sum_rows(const PackedSpheres& spheres, std::size_t row_begin, std::size_t row_end, double* const* velocity) {
  constexpr std::size_t width = tile_columns<T>, lanes = Lanes<T>::lanes;
  Side<mobility, T, dimensions, tile_rows> rows;
  Side<mobility, T, dimensions, width> columns;
  if (row_end > spheres.padded) row_end = spheres.padded;

  for (std::size_t top = row_begin; top < row_end; top += tile_rows) {
    const std::size_t bottom = top + tile_rows < row_end ? top + tile_rows : row_end;
    const std::size_t middle = (top + (bottom < spheres.count ? bottom : spheres.count)) / 2;
    double centre[dimensions];
    for (int k = 0; k < dimensions; ++k) centre[k] = spheres.position[k][middle];
    rows.fill(spheres, top, bottom, centre);

    for (std::size_t left = top; left < spheres.padded; left += width) {
      const std::size_t right = left + width < spheres.padded ? left + width : spheres.padded;
      columns.fill(spheres, left, right, centre);

      for (std::size_t row = 0; row < bottom - top; row += block_rows) {
        Rows<T, dimensions> block(rows, row);
        std::size_t column = 0;
        if (left == top)
          for (column = row / lanes * lanes; column < row + block_rows; column += lanes)
            add_pairs<mobility, true>(block, columns, column, row);
        for (; column < right - left; column += lanes) add_pairs<mobility, false>(block, columns, column);
        for (int k = 0; k < dimensions; ++k)
          for (int r = 0; r < block_rows; ++r)
            velocity[k][top - row_begin + row + r] += sum_lanes(block.velocity[k], r);
      }

      for (int k = 0; k < dimensions; ++k)
        for (std::size_t n = 0; n < right - left; ++n) velocity[k][left - row_begin + n] += columns.velocity[k][n];
    }
  }
}

template <Mobility mobility>
SumRows choose(int dimensions, bool single_precision) {
  if (single_precision) return dimensions == 2 ? sum_rows<mobility, float, 2> : sum_rows<mobility, float, 3>;
  return dimensions == 2 ? sum_rows<mobility, double, 2> : sum_rows<mobility, double, 3>;
}

TALUS_INLINE SumRows choose(Mobility mobility, int dimensions, bool single_precision) {
  return mobility == Mobility::zuk_2014 ? choose<Mobility::zuk_2014>(dimensions, single_precision)
                                        : choose<Mobility::rotne_prager_1969>(dimensions, single_precision);
}

}  // namespace TALUS_INSTRUCTION_SET
}  // namespace talus::cloud

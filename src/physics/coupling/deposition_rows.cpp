// SPDX-License-Identifier: Apache-2.0
#include "physics/coupling/deposition_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/clones.hpp"
#include "base/registers.hpp"
#include "numerics/sph/cubic_spline.hpp"

namespace talus::coupling {

namespace {

// The numbers of a row that are computed together.
using Doubles [[gnu::vector_size(row_lanes * sizeof(double))]] = double;
using Floats [[gnu::vector_size(row_lanes * sizeof(float))]] = float;

template <class Vector, class Number>
TALUS_INLINE void load(const Number* from, Vector& x) {
  std::memcpy(&x, from, sizeof(Vector));
}

template <class Vector, class Number>
TALUS_INLINE void store(const Vector& x, Number* to) {
  std::memcpy(to, &x, sizeof(Vector));
}

/// Squares of distances over the smoothing length become the kernel times a constant, sph::cubic_spline_shape. By
/// reference: clang passes no vector by value where its registers may be lacking.
TALUS_INLINE void weigh(Floats& q) {
  for (std::size_t l = 0; l < row_lanes; ++l) q[l] = std::sqrt(q[l]);
  const Floats zero{}, one = zero + 1, two = zero + 2;
  const Floats outer = two > q ? two - q : zero, inner = one > q ? one - q : zero;
  q = outer * outer * outer - 4 * (inner * inner * inner);
}

template <class Row>
TALUS_INLINE double total_of(const Row& s) {
  return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
}

}  // namespace

TALUS_CLONES void weigh_rows(const Reach& given, std::size_t rows_y, float* __restrict sum, RowFate* __restrict fate) {
  const Reach r = given;
  for (std::size_t k = 0; k < r.many_z; ++k)
    for (std::size_t j = 0; j < r.many_y; ++j) {
      const float across = r.square_y[j] + r.square_z[k];
      if (!(across < static_cast<float>(sph::support * sph::support))) continue;
      const std::size_t number = r.row_y[j] + rows_y * r.row_z[k];
      fate[number] = RowFate::kept;
      float* row = sum + r.columns * number;
      for (std::size_t i = 0; i < r.many_x; i += row_lanes) {
        Floats weight, had;
        load(r.square_x + i, weight);
        weight += across;
        weigh(weight);
        if (r.column_x) {
          for (std::size_t l = 0; l < row_lanes && i + l < r.many_x; ++l) row[r.column_x[i + l]] += weight[l];
        } else {
          load(row + i, had);
          store(had + weight, row + i);
        }
      }
    }
}

TALUS_CLONES float weight_at(float square) {
  Floats weight = Floats{} + square;
  weigh(weight);
  return weight[0];
}

TALUS_CLONES double keep_rows(std::size_t rows, std::size_t columns, const RowFate* fate, const float* sum,
                              float* __restrict kept) {
  Doubles total{};
  for (std::size_t r = 0; r < rows; ++r) {
    if (fate[r] == RowFate::empty) continue;
    for (std::size_t i = 0; i < columns; i += row_lanes) {
      Floats weight;
      load(sum + r * columns + i, weight);
      total += __builtin_convertvector(weight, Doubles);
      if (fate[r] == RowFate::lost) continue;
      store(weight, kept);
      kept += row_lanes;
    }
  }
  return total_of(total);
}

TALUS_CLONES void find_max(std::size_t count, const double* number, double* __restrict largest) {
  for (std::size_t begin = 0; begin < count; begin += row_lanes) {
    double most = 0;
    for (std::size_t i = begin; i < std::min(begin + row_lanes, count); ++i) most = number[i] > most ? number[i] : most;
    largest[begin / row_lanes] = most;
  }
}

TALUS_CLONES void add_rows(std::size_t rows, std::size_t columns, const std::uint32_t* first, const float* weight,
                           double amount, double other_amount, double rounding, double other_rounding,
                           double* __restrict field, double* __restrict other) {
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t i = first[r]; i < first[r] + columns; i += row_lanes, weight += row_lanes) {
      Floats kept;
      Doubles one, two;
      load(weight, kept), load(field + i, one), load(other + i, two);
      const Doubles share = __builtin_convertvector(kept, Doubles);
      one += (amount * share + rounding) - rounding, two += (other_amount * share + other_rounding) - other_rounding;
      store(one, field + i), store(two, other + i);
    }
}

TALUS_CLONES void add_rows(std::size_t rows, std::size_t columns, const std::uint32_t* first, const float* weight,
                           const double* amount, double rounding, double other_rounding,
                           const std::array<double*, 4>& field) {
  double* __restrict a = field[0], * __restrict b = field[1], * __restrict c = field[2], * __restrict d = field[3];
  const double of_a = amount[0], of_b = amount[1], of_c = amount[2], of_d = amount[3];
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t i = first[r]; i < first[r] + columns; i += row_lanes, weight += row_lanes) {
      Floats kept;
      Doubles x, y, z, w;
      load(weight, kept), load(a + i, x), load(b + i, y), load(c + i, z), load(d + i, w);
      const Doubles share = __builtin_convertvector(kept, Doubles);
      x += (of_a * share + rounding) - rounding, y += (of_b * share + other_rounding) - other_rounding;
      z += (of_c * share + other_rounding) - other_rounding, w += (of_d * share + other_rounding) - other_rounding;
      store(x, a + i), store(y, b + i), store(z, c + i), store(w, d + i);
    }
}

TALUS_CLONES Vector3 sum_rows(std::size_t rows, std::size_t columns, const std::uint32_t* first, const float* weight,
                              const double* x, const double* y, const double* z) {
  Doubles sum_x{}, sum_y{}, sum_z{};
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t i = first[r]; i < first[r] + columns; i += row_lanes, weight += row_lanes) {
      Floats kept;
      Doubles u, v, w;
      load(weight, kept), load(x + i, u), load(y + i, v), load(z + i, w);
      const Doubles share = __builtin_convertvector(kept, Doubles);
      sum_x += share * u, sum_y += share * v, sum_z += share * w;
    }
  return {total_of(sum_x), total_of(sum_y), total_of(sum_z)};
}

}  // namespace talus::coupling

// SPDX-License-Identifier: Apache-2.0
#include "numerics/grid/run_loops.hpp"

#include <cstring>

#include "base/clones.hpp"

namespace talus::run_loops {

namespace {

/// Calls body(index, lane) along a run, lanes in turn.
template <int lanes, class Body>
TALUS_INLINE void for_each_interleaved(int length, Body&& body) {
  int m = 0;
  for (; m + lanes <= length; m += lanes)
    for (int l = 0; l < lanes; ++l) body(m + l, l);
  for (int l = 0; m < length; ++m, ++l) body(m, l);
}

// Eight numbers that are computed together; the compiler finds no vectors in a sum of floats by itself.
using Floats [[gnu::vector_size(8 * sizeof(float))]] = float;

template <class Number>
TALUS_INLINE double total(const Number& lane) {
  return static_cast<double>(((lane[0] + lane[4]) + (lane[2] + lane[6])) + ((lane[1] + lane[5]) + (lane[3] + lane[7])));
}

}  // namespace

TALUS_CLONES bool take(int length, const double* row, double* __restrict run) {
  std::size_t changes = 0;
  for (int m = 0; m < length; ++m) {
    const double now = row[2 * m];
    changes += static_cast<std::size_t>((now > 0) != (run[m] > 0));
    run[m] = now;
  }
  return changes > 0;
}

TALUS_CLONES void take(int length, const float* row, float* __restrict run) {
  for (int m = 0; m < length; ++m) run[m] = row[2 * m];
}

TALUS_CLONES void add_strided(int length, const double* row, double* __restrict run) {
  for (int m = 0; m < length; ++m) run[m] += row[2 * m];
}

TALUS_CLONES void put(int length, const double* run, double* __restrict row) {
  for (int m = 0; m < length; ++m) row[2 * m] = run[m];
}

TALUS_CLONES void put(int length, const float* run, float* __restrict row) {
  for (int m = 0; m < length; ++m) row[2 * m] = run[m];
}

TALUS_CLONES void add(int length, const float* from, float* __restrict to) {
  for (int m = 0; m < length; ++m) to[m] += from[m];
}

TALUS_CLONES void add(std::size_t length, double factor, const float* from, double* __restrict to) {
  for (std::size_t m = 0; m < length; ++m) to[m] += factor * static_cast<double>(from[m]);
}

TALUS_CLONES void scale(std::size_t length, double factor, const double* from, float* __restrict to) {
  for (std::size_t m = 0; m < length; ++m) to[m] = static_cast<float>(factor * from[m]);
}

TALUS_CLONES void invert(std::size_t length, const float* from, float* __restrict to) {
  for (std::size_t m = 0; m < length; ++m) {
    const float is_positive = from[m] > 0 ? 1.0f : 0.0f;
    to[m] = is_positive / (from[m] + (1 - is_positive));
  }
}

TALUS_CLONES double find_diagonal(int length, const Runs<double>& around, const double* outside,
                                  double* __restrict diagonal) {
  const Runs<double> runs = around;
  double lane[8] = {};
  for_each_interleaved<8>(length, [&](int m, int l) {
    const double sum = runs.conductance(m) + outside[m];
    diagonal[m] = sum;
    lane[l] = sum > lane[l] ? sum : lane[l];
  });
  double most = 0;
  for (const double x : lane) most = x > most ? x : most;
  return most;
}

TALUS_CLONES void find_diagonal(int length, const Runs<float>& around, const float* outside,
                                float* __restrict diagonal) {
  const Runs<float> runs = around;
  for (int m = 0; m < length; ++m) diagonal[m] = runs.conductance(m) + outside[m];
}

TALUS_CLONES double find_residual(int length, const Runs<double>& around, const double* diagonal, const double* value,
                                  const double* source, double* __restrict residual) {
  const Runs<double> runs = around;
  double lane[8] = {};
  for_each_interleaved<8>(length, [&](int m, int l) {
    const double left = source[m] - (diagonal[m] * value[m] - runs.inflow(m));
    residual[m] = left;
    lane[l] += left * left;
  });
  return total(lane);
}

TALUS_CLONES double apply(int length, const Runs<float>& around, const float* diagonal, const float* x,
                          float* __restrict applied) {
  const Runs<float> runs = around;
  float lane[8] = {};
  for_each_interleaved<8>(length, [&](int m, int l) {
    const float out = diagonal[m] * x[m] - runs.inflow(m);
    applied[m] = out;
    lane[l] += out * x[m];
  });
  return total(lane);
}

TALUS_CLONES void relax_from_zero(int length, const float* source, const float* inverse, float* __restrict x) {
  for (int m = 0; m < length; ++m) x[m] = inverse[m] * source[m];
}

TALUS_CLONES void relax(int length, const Runs<float>& around, const float* source, const float* inverse,
                        float* __restrict x) {
  const Runs<float> runs = around;
  for (int m = 0; m < length; ++m) x[m] = inverse[m] * (source[m] + runs.inflow(m));
}

TALUS_CLONES void add_inflow(int length, const Runs<float>& around, float* __restrict to) {
  const Runs<float> runs = around;
  for (int m = 0; m < length; ++m) to[m] += runs.inflow(m);
}

TALUS_CLONES double product(int length, const float* a, const float* b) {
  Floats sum{};
  int m = 0;
  for (; m + 8 <= length; m += 8) {
    Floats x, y;
    std::memcpy(&x, a + m, sizeof x), std::memcpy(&y, b + m, sizeof y);
    sum += x * y;
  }
  for (int l = 0; m < length; ++m, ++l) sum[l] += a[m] * b[m];
  return total(sum);
}

TALUS_CLONES double square(int length, const double* a) {
  double lane[8] = {};
  for_each_interleaved<8>(length, [&](int m, int l) { lane[l] += a[m] * a[m]; });
  return total(lane);
}

TALUS_CLONES void update_direction(std::size_t length, float beta, const float* correction,
                                   float* __restrict direction) {
  for (std::size_t m = 0; m < length; ++m) direction[m] = correction[m] + beta * direction[m];
}

TALUS_CLONES double advance(int length, float step, const float* direction, const float* applied, float* __restrict x,
                            float* __restrict residual) {
  for (int m = 0; m < length; ++m) {
    x[m] += step * direction[m];
    residual[m] -= step * applied[m];
  }
  return product(length, residual, residual);
}

}  // namespace talus::run_loops

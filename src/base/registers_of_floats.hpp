// SPDX-License-Identifier: Apache-2.0
/// Tables and sums of floats in vector registers, as registers.hpp has them of doubles. Quads of four floats are what
/// the instructions move between the halves of a register. Included by simd.hpp only.
#pragma once

#include "base/registers.hpp"

namespace talus {
inline namespace TALUS_INSTRUCTION_SET {
namespace registers {

typedef float FloatRegister __attribute__((vector_size(bytes)));
typedef float FloatHalf __attribute__((vector_size(bytes / 2)));
typedef float FloatQuad __attribute__((vector_size(16)));
inline constexpr int floats = bytes / sizeof(float);

/// Of each quad of four registers the columns: lane k of a quad of x[c] becomes lane c of that of x[k].
TALUS_INLINE void transpose_quads(FloatRegister (&x)[4]) {
#if defined(__AVX512F__)
#define TALUS_QUADS(a, b, c, d) \
  a, b, c, d, a + 4, b + 4, c + 4, d + 4, a + 8, b + 8, c + 8, d + 8, a + 12, b + 12, c + 12, d + 12
#elif defined(__AVX2__)
#define TALUS_QUADS(a, b, c, d) a, b, c, d, a + 4, b + 4, c + 4, d + 4
#else
#define TALUS_QUADS(a, b, c, d) a, b, c, d
#endif
  constexpr int n = floats;
  const FloatRegister a = __builtin_shufflevector(x[0], x[1], TALUS_QUADS(0, n, 1, n + 1));
  const FloatRegister b = __builtin_shufflevector(x[0], x[1], TALUS_QUADS(2, n + 2, 3, n + 3));
  const FloatRegister c = __builtin_shufflevector(x[2], x[3], TALUS_QUADS(0, n, 1, n + 1));
  const FloatRegister d = __builtin_shufflevector(x[2], x[3], TALUS_QUADS(2, n + 2, 3, n + 3));
  x[0] = __builtin_shufflevector(a, c, TALUS_QUADS(0, 1, n, n + 1));
  x[1] = __builtin_shufflevector(a, c, TALUS_QUADS(2, 3, n + 2, n + 3));
  x[2] = __builtin_shufflevector(b, d, TALUS_QUADS(0, 1, n, n + 1));
  x[3] = __builtin_shufflevector(b, d, TALUS_QUADS(2, 3, n + 2, n + 3));
}

template <class Vector>
TALUS_INLINE Vector load_as(const float* values) {
  Vector x;
  __builtin_memcpy(&x, values, sizeof(x));
  return x;
}

/// As load_transposed of doubles, eight columns at a time: those of `row[k] + first`.
TALUS_INLINE void load_transposed(const float* const (&row)[floats], std::size_t first, FloatRegister (&block)[8]) {
  FloatRegister low[4], high[4];  // the first four columns and the others
#if defined(__AVX512F__)
  TALUS_UNROLL for (int k = 0; k < 4; ++k) {
    const auto two = [&](int r) {
      return _mm512_castpd_ps(
          _mm512_maskz_insertf64x4(0xff, _mm512_castps_pd(_mm512_castps256_ps512(load_as<FloatHalf>(row[r] + first))),
                                   _mm256_castps_pd(load_as<FloatHalf>(row[r + 4] + first)), 1));
    };
    const FloatRegister a = two(k), b = two(k + 8);
    low[k] = __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11, 16, 17, 18, 19, 24, 25, 26, 27);
    high[k] = __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15, 20, 21, 22, 23, 28, 29, 30, 31);
  }
#elif defined(__AVX2__)
  TALUS_UNROLL for (int k = 0; k < 4; ++k) {
    const auto two = [&](std::size_t c) {
      return _mm256_insertf128_ps(_mm256_castps128_ps256(load_as<FloatQuad>(row[k] + c)),
                                  load_as<FloatQuad>(row[k + 4] + c), 1);
    };
    low[k] = two(first), high[k] = two(first + 4);
  }
#else
  TALUS_UNROLL for (int k = 0; k < 4; ++k) {
    low[k] = load_as<FloatQuad>(row[k] + first), high[k] = load_as<FloatQuad>(row[k] + first + 4);
  }
#endif
  transpose_quads(low), transpose_quads(high);
  TALUS_UNROLL for (int k = 0; k < 4; ++k) {
    block[k] = low[k], block[4 + k] = high[k];
  }
}

/// As sums of doubles.
TALUS_INLINE FloatRegister sums(const FloatRegister (&x)[floats]) {
  constexpr int n = floats;
  FloatRegister quads[4];  // a quad for each of the columns m, 4 + m, ...
  TALUS_UNROLL for (int m = 0; m < 4; ++m) {
#if defined(__AVX512F__)
    const auto two = [](FloatRegister a, FloatRegister b) {
      return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7, 16, 17, 18, 19, 20, 21, 22, 23) +
             __builtin_shufflevector(a, b, 8, 9, 10, 11, 12, 13, 14, 15, 24, 25, 26, 27, 28, 29, 30, 31);
    };
    const FloatRegister a = two(x[m], x[4 + m]), b = two(x[8 + m], x[12 + m]);
    quads[m] = __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11, 16, 17, 18, 19, 24, 25, 26, 27) +
               __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15, 20, 21, 22, 23, 28, 29, 30, 31);
#elif defined(__AVX2__)
    quads[m] = __builtin_shufflevector(x[m], x[4 + m], 0, 1, 2, 3, 8, 9, 10, 11) +
               __builtin_shufflevector(x[m], x[4 + m], 4, 5, 6, 7, 12, 13, 14, 15);
#else
    quads[m] = x[m];
#endif
  }
  const auto two = [](FloatRegister a, FloatRegister b) {
    return __builtin_shufflevector(a, b, TALUS_QUADS(0, floats, 1, floats + 1)) +
           __builtin_shufflevector(a, b, TALUS_QUADS(2, floats + 2, 3, floats + 3));
  };
  const FloatRegister a = two(quads[0], quads[1]), b = two(quads[2], quads[3]);
  return __builtin_shufflevector(a, b, TALUS_QUADS(0, 1, n, n + 1)) +
         __builtin_shufflevector(a, b, TALUS_QUADS(2, 3, n + 2, n + 3));
#undef TALUS_QUADS
}

/// The same of four registers, in narrower ones.
TALUS_INLINE FloatQuad sums_of_four(const FloatRegister (&x)[4]) {
  FloatQuad quad[4];
  TALUS_UNROLL for (int m = 0; m < 4; ++m) {
    FloatQuad part[floats / 4];
    __builtin_memcpy(part, &x[m], sizeof(x[m]));
    if constexpr (floats == 16)
      quad[m] = (part[0] + part[2]) + (part[1] + part[3]);
    else if constexpr (floats == 8)
      quad[m] = part[0] + part[1];
    else
      quad[m] = part[0];
  }
  const auto two = [](FloatQuad a, FloatQuad b) {
    return __builtin_shufflevector(a, b, 0, 4, 1, 5) + __builtin_shufflevector(a, b, 2, 6, 3, 7);
  };
  const FloatQuad a = two(quad[0], quad[1]), b = two(quad[2], quad[3]);
  return __builtin_shufflevector(a, b, 0, 1, 4, 5) + __builtin_shufflevector(a, b, 2, 3, 6, 7);
}

/// a - b of whole numbers modulo 2^32, those of a in the bits of a register: from -2^31 on, as floats.
TALUS_INLINE FloatRegister differences_of_bits(FloatRegister a, std::uint32_t b) {
  typedef std::uint32_t Bits __attribute__((vector_size(bytes)));
  typedef std::int32_t Whole __attribute__((vector_size(bytes)));
  return __builtin_convertvector((Whole)((Bits)a - b), FloatRegister);
}

// __builtin_convertvector of gcc 12 goes by way of memory, two lanes at a time.
#if defined(__AVX512F__)
TALUS_INLINE __m512d as_doubles(FloatHalf x) {
  return _mm512_maskz_cvtps_pd(0xff, x);
}
TALUS_INLINE __m256d as_doubles(FloatQuad x) {
  return _mm256_cvtps_pd(x);
}
TALUS_INLINE FloatHalf lower_half(FloatRegister x) {
  return __builtin_shufflevector(x, x, 0, 1, 2, 3, 4, 5, 6, 7);
}
TALUS_INLINE FloatHalf upper_half(FloatRegister x) {
  return __builtin_shufflevector(x, x, 8, 9, 10, 11, 12, 13, 14, 15);
}
#elif defined(__AVX2__)
TALUS_INLINE __m256d as_doubles(FloatHalf x) {
  return _mm256_cvtps_pd(x);
}
TALUS_INLINE FloatHalf lower_half(FloatRegister x) {
  return __builtin_shufflevector(x, x, 0, 1, 2, 3);
}
TALUS_INLINE FloatHalf upper_half(FloatRegister x) {
  return __builtin_shufflevector(x, x, 4, 5, 6, 7);
}
#else
typedef double DoublePair __attribute__((vector_size(16)));
TALUS_INLINE DoublePair as_doubles(FloatHalf x) {
  return __builtin_convertvector(x, DoublePair);
}
TALUS_INLINE FloatHalf lower_half(FloatRegister x) {
  return __builtin_shufflevector(x, x, 0, 1);
}
TALUS_INLINE FloatHalf upper_half(FloatRegister x) {
  return __builtin_shufflevector(x, x, 2, 3);
}
#endif

/// Writes floats as doubles.
template <class Floats>
TALUS_INLINE void store_as_doubles(Floats x, double* values) {
  if constexpr (std::is_same_v<Floats, FloatRegister>) {
    store_as_doubles(lower_half(x), values);
    store_as_doubles(upper_half(x), values + floats / 2);
  } else {
    const auto wide = as_doubles(x);
    __builtin_memcpy(values, &wide, sizeof(wide));
  }
}

}  // namespace registers
}  // namespace TALUS_INSTRUCTION_SET
}  // namespace talus

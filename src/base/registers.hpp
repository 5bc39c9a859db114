// SPDX-License-Identifier: Apache-2.0
/// Vector registers of the instruction set that the including file is compiled for: the compiler's vector types, and
/// the operations that these lack. Included by simd.hpp only.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#if defined(__AVX2__)
#include <immintrin.h>
#endif

#if defined(__AVX512F__)
#define TALUS_INSTRUCTION_SET avx512
#elif defined(__AVX2__)
#define TALUS_INSTRUCTION_SET avx2
#else
#define TALUS_INSTRUCTION_SET portable
#endif
#define TALUS_INLINE [[gnu::always_inline]] inline
// Short loops over rows or dimensions have to vanish before the compiler gives registers to what they run over. Under
// the sanitizers, which check every access, they stay: unrolled they take minutes to compile.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TALUS_UNROLL
#else
#define TALUS_UNROLL _Pragma("GCC unroll 16")
#endif

namespace talus {
inline namespace TALUS_INSTRUCTION_SET {
namespace registers {

#if defined(__AVX512F__)
inline constexpr int bytes = 64;
#elif defined(__AVX2__)
inline constexpr int bytes = 32;
#else
inline constexpr int bytes = 16;
#endif

template <class T>
struct Of {
  typedef T Register __attribute__((vector_size(bytes)));
#if defined(__AVX512F__)
  using Mask = std::conditional_t<sizeof(T) == 8, __mmask8, __mmask16>;
#else
  using Mask = decltype(Register{} > Register{});
#endif
};

/// Sum of the lanes: the upper half onto the lower half, and so on.
template <class Register>
TALUS_INLINE auto sum(Register x) {
  constexpr int lanes = sizeof(x) / sizeof(x[0]);
  if constexpr (lanes == 2)
    return x[0] + x[1];
  else if constexpr (lanes == 4)
    return sum(__builtin_shufflevector(x, x, 0, 1) + __builtin_shufflevector(x, x, 2, 3));
  else if constexpr (lanes == 8)
    return sum(__builtin_shufflevector(x, x, 0, 1, 2, 3) + __builtin_shufflevector(x, x, 4, 5, 6, 7));
  else
    return sum(__builtin_shufflevector(x, x, 0, 1, 2, 3, 4, 5, 6, 7) +
               __builtin_shufflevector(x, x, 8, 9, 10, 11, 12, 13, 14, 15));
}

typedef double HalfRegister __attribute__((vector_size(bytes / 2)));
TALUS_INLINE auto join(HalfRegister low, HalfRegister high) {
#if defined(__AVX512F__)
  return _mm512_maskz_insertf64x4(0xff, _mm512_castpd256_pd512(low), high, 1);
#elif defined(__AVX2__)
  return _mm256_insertf128_pd(_mm256_castpd128_pd256(low), high, 1);
#else
  return __builtin_shufflevector(low, high, 0, 1);
#endif
}

/// Columns of a table whose rows are elsewhere in memory: lane k of block[c] is row[k][c], for as many columns as a
/// register has lanes. The upper halves of registers come with the load, which spares a third of the shuffles.
template <class Register>
TALUS_INLINE void load_transposed(const double* const (&row)[sizeof(Register) / 8], std::size_t first,
                                  Register (&block)[sizeof(Register) / 8]) {
  constexpr int lanes = sizeof(Register) / 8;
  if constexpr (lanes == 2) {
    const Register a = *reinterpret_cast<const Register*>(row[0] + first);
    const Register b = *reinterpret_cast<const Register*>(row[1] + first);
    block[0] = __builtin_shufflevector(a, b, 0, 2);
    block[1] = __builtin_shufflevector(a, b, 1, 3);
  } else {
    constexpr int half = lanes / 2;
    TALUS_UNROLL for (int c = 0; c < lanes; c += half) {
      Register t[half];
      TALUS_UNROLL for (int k = 0; k < half; ++k) {
        t[k] = join(*reinterpret_cast<const HalfRegister*>(row[k] + first + c),
                    *reinterpret_cast<const HalfRegister*>(row[k + half] + first + c));
      }
      if constexpr (lanes == 4) {
        block[c] = __builtin_shufflevector(t[0], t[1], 0, 4, 2, 6);
        block[c + 1] = __builtin_shufflevector(t[0], t[1], 1, 5, 3, 7);
      } else {
        const Register even = __builtin_shufflevector(t[0], t[1], 0, 8, 2, 10, 4, 12, 6, 14);
        const Register odd = __builtin_shufflevector(t[0], t[1], 1, 9, 3, 11, 5, 13, 7, 15);
        const Register next_even = __builtin_shufflevector(t[2], t[3], 0, 8, 2, 10, 4, 12, 6, 14);
        const Register next_odd = __builtin_shufflevector(t[2], t[3], 1, 9, 3, 11, 5, 13, 7, 15);
        block[c] = __builtin_shufflevector(even, next_even, 0, 1, 8, 9, 4, 5, 12, 13);
        block[c + 1] = __builtin_shufflevector(odd, next_odd, 0, 1, 8, 9, 4, 5, 12, 13);
        block[c + 2] = __builtin_shufflevector(even, next_even, 2, 3, 10, 11, 6, 7, 14, 15);
        block[c + 3] = __builtin_shufflevector(odd, next_odd, 2, 3, 10, 11, 6, 7, 14, 15);
      }
    }
  }
}

/// The sum of the lanes of each of x, in one register: lane k that of x[k]. In a fixed order.
template <class Register>
TALUS_INLINE Register sums(const Register (&x)[sizeof(Register) / 8]) {
  constexpr int lanes = sizeof(Register) / 8;
  if constexpr (lanes == 2) {
    return __builtin_shufflevector(x[0], x[1], 0, 2) + __builtin_shufflevector(x[0], x[1], 1, 3);
  } else if constexpr (lanes == 4) {
    Register t[2];
    TALUS_UNROLL for (int k = 0; k < 2; ++k) {
      t[k] = __builtin_shufflevector(x[2 * k], x[2 * k + 1], 0, 4, 2, 6) +
             __builtin_shufflevector(x[2 * k], x[2 * k + 1], 1, 5, 3, 7);
    }
    return __builtin_shufflevector(t[0], t[1], 0, 1, 4, 5) + __builtin_shufflevector(t[0], t[1], 2, 3, 6, 7);
  } else {
    Register t[4], u[2];
    TALUS_UNROLL for (int k = 0; k < 4; ++k) {
      t[k] = __builtin_shufflevector(x[2 * k], x[2 * k + 1], 0, 8, 2, 10, 4, 12, 6, 14) +
             __builtin_shufflevector(x[2 * k], x[2 * k + 1], 1, 9, 3, 11, 5, 13, 7, 15);
    }
    TALUS_UNROLL for (int k = 0; k < 2; ++k) {
      u[k] = __builtin_shufflevector(t[2 * k], t[2 * k + 1], 0, 1, 8, 9, 4, 5, 12, 13) +
             __builtin_shufflevector(t[2 * k], t[2 * k + 1], 2, 3, 10, 11, 6, 7, 14, 15);
    }
    return __builtin_shufflevector(u[0], u[1], 0, 1, 2, 3, 8, 9, 10, 11) +
           __builtin_shufflevector(u[0], u[1], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

// The same of floats. Quads of four of them are what the instructions move between the halves of a register.
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
    return __builtin_shufflevector(a, b, TALUS_QUADS(0, n, 1, n + 1)) +
           __builtin_shufflevector(a, b, TALUS_QUADS(2, n + 2, 3, n + 3));
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

/// Writes floats as doubles.
template <class Floats>
TALUS_INLINE void store_as_doubles(Floats x, double* values) {
  constexpr int count = sizeof(x) / sizeof(float), lanes = count < bytes / 8 ? count : bytes / 8;
  typedef float Part __attribute__((vector_size(lanes * 4)));
  typedef double Doubles __attribute__((vector_size(lanes * 8)));
  Part part[count / lanes];
  __builtin_memcpy(part, &x, sizeof(x));
  TALUS_UNROLL for (int k = 0; k < count / lanes; ++k) {
    const Doubles wide = __builtin_convertvector(part[k], Doubles);
    __builtin_memcpy(values + k * lanes, &wide, sizeof(wide));
  }
}

// The few operations that the vector arithmetic of the compiler lacks: a b + c and c - a b, rounded once where the
// instruction set can; an estimate of the reciprocal square root, good to `estimate_bits` bits; the square root,
// rounded correctly; a > b; a choice lane by lane; whether a mask holds in every lane, and its lanes as bits; those of
// eight numbers whose bit is set, one after the other (the places behind them, up to eight in all, may be overwritten),
// and how many they are; the same of the lanes of a register (as many places as it has lanes may be overwritten).
#if defined(__AVX512F__)
inline constexpr int estimate_bits = 14;
TALUS_INLINE __m512d fused(__m512d a, __m512d b, __m512d c) {
  return _mm512_fmadd_pd(a, b, c);
}
TALUS_INLINE __m512 fused(__m512 a, __m512 b, __m512 c) {
  return _mm512_fmadd_ps(a, b, c);
}
TALUS_INLINE __m512d negative_fused(__m512d a, __m512d b, __m512d c) {
  return _mm512_fnmadd_pd(a, b, c);
}
TALUS_INLINE __m512 negative_fused(__m512 a, __m512 b, __m512 c) {
  return _mm512_fnmadd_ps(a, b, c);
}
TALUS_INLINE __m512d estimate_reciprocal_sqrt(__m512d x) {
  return _mm512_maskz_rsqrt14_pd(0xff, x);
}
TALUS_INLINE __m512 estimate_reciprocal_sqrt(__m512 x) {
  return _mm512_maskz_rsqrt14_ps(0xffff, x);
}
TALUS_INLINE __m512d square_root(__m512d x) {
  return _mm512_maskz_sqrt_pd(0xff, x);
}
TALUS_INLINE __mmask8 greater(__m512d a, __m512d b) {
  return _mm512_cmp_pd_mask(a, b, _CMP_GT_OQ);
}
TALUS_INLINE __mmask16 greater(__m512 a, __m512 b) {
  return _mm512_cmp_ps_mask(a, b, _CMP_GT_OQ);
}
TALUS_INLINE __m512d blend(__mmask8 m, __m512d yes, __m512d no) {
  return _mm512_mask_blend_pd(m, no, yes);
}
TALUS_INLINE __m512 blend(__mmask16 m, __m512 yes, __m512 no) {
  return _mm512_mask_blend_ps(m, no, yes);
}
TALUS_INLINE bool all(__mmask8 mask) {
  return mask == 0xff;
}
TALUS_INLINE bool all(__mmask16 mask) {
  return mask == 0xffff;
}
TALUS_INLINE unsigned bits(__mmask8 mask) {
  return mask;
}
TALUS_INLINE unsigned bits(__mmask16 mask) {
  return mask;
}
TALUS_INLINE std::size_t pack(const std::uint32_t* numbers, unsigned bits, std::uint32_t* packed) {
  const __m256i eight = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(numbers));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(packed),
                      _mm256_maskz_compress_epi32(static_cast<__mmask8>(bits), eight));
  return static_cast<std::size_t>(__builtin_popcount(bits));
}
TALUS_INLINE void pack(__m512d x, __mmask8 mask, double* packed) {
  _mm512_storeu_pd(packed, _mm512_maskz_compress_pd(mask, x));
}
TALUS_INLINE void pack(__m512 x, __mmask16 mask, float* packed) {
  _mm512_storeu_ps(packed, _mm512_maskz_compress_ps(mask, x));
}
#elif defined(__AVX2__)
inline constexpr int estimate_bits = 11;
TALUS_INLINE __m256d fused(__m256d a, __m256d b, __m256d c) {
  return _mm256_fmadd_pd(a, b, c);
}
TALUS_INLINE __m256 fused(__m256 a, __m256 b, __m256 c) {
  return _mm256_fmadd_ps(a, b, c);
}
TALUS_INLINE __m256d negative_fused(__m256d a, __m256d b, __m256d c) {
  return _mm256_fnmadd_pd(a, b, c);
}
TALUS_INLINE __m256 negative_fused(__m256 a, __m256 b, __m256 c) {
  return _mm256_fnmadd_ps(a, b, c);
}
// Doubles by way of floats: the argument must lie in their range, which numbers in units of a grain's radius do.
TALUS_INLINE __m256d estimate_reciprocal_sqrt(__m256d x) {
  return _mm256_cvtps_pd(_mm_rsqrt_ps(_mm256_cvtpd_ps(x)));
}
TALUS_INLINE __m256 estimate_reciprocal_sqrt(__m256 x) {
  return _mm256_rsqrt_ps(x);
}
TALUS_INLINE __m256d square_root(__m256d x) {
  return _mm256_sqrt_pd(x);
}
template <class Register>
TALUS_INLINE auto greater(Register a, Register b) {
  return a > b;
}
template <class Mask, class Register>
TALUS_INLINE Register blend(Mask m, Register yes, Register no) {
  return m ? yes : no;
}
template <class Mask>
TALUS_INLINE bool all(Mask mask) {
  return _mm256_movemask_epi8((__m256i)mask) == -1;
}
template <class Mask>
TALUS_INLINE unsigned bits(Mask mask) requires(sizeof(mask[0]) == 8) {
  return static_cast<unsigned>(_mm256_movemask_pd((__m256d)mask));
}
template <class Mask>
TALUS_INLINE unsigned bits(Mask mask) requires(sizeof(mask[0]) == 4) {
  return static_cast<unsigned>(_mm256_movemask_ps((__m256)mask));
}
#else
inline constexpr int estimate_bits = 53;  // not an estimate
template <class Register>
TALUS_INLINE Register fused(Register a, Register b, Register c) {
  return a * b + c;
}
template <class Register>
TALUS_INLINE Register negative_fused(Register a, Register b, Register c) {
  return c - a * b;
}
template <class Register>
TALUS_INLINE Register estimate_reciprocal_sqrt(Register x) {
  for (unsigned k = 0; k < sizeof(Register) / sizeof(x[0]); ++k) x[k] = std::sqrt(x[k]);
  return 1 / x;
}
template <class Register>
TALUS_INLINE Register square_root(Register x) {
  for (unsigned k = 0; k < sizeof(Register) / sizeof(x[0]); ++k) x[k] = std::sqrt(x[k]);
  return x;
}
template <class Register>
TALUS_INLINE auto greater(Register a, Register b) {
  return a > b;
}
template <class Mask, class Register>
TALUS_INLINE Register blend(Mask m, Register yes, Register no) {
  return m ? yes : no;
}
template <class Mask>
TALUS_INLINE bool all(Mask mask) {
  bool set = true;
  for (unsigned k = 0; k < sizeof(Mask) / sizeof(mask[0]); ++k) set = set && mask[k] != 0;
  return set;
}
template <class Mask>
TALUS_INLINE unsigned bits(Mask mask) {
  unsigned set = 0;
  for (unsigned k = 0; k < sizeof(Mask) / sizeof(mask[0]); ++k) set |= (mask[k] != 0 ? 1u : 0u) << k;
  return set;
}
#endif
#if !defined(__AVX512F__)
TALUS_INLINE std::size_t pack(const std::uint32_t* numbers, unsigned bits, std::uint32_t* packed) {
  std::size_t count = 0;
  for (; bits != 0; bits &= bits - 1) packed[count++] = numbers[__builtin_ctz(bits)];
  return count;
}
template <class Register, class Mask, class T>
TALUS_INLINE void pack(Register x, Mask mask, T* packed) {
  for (unsigned set = bits(mask); set != 0; set &= set - 1) *packed++ = x[__builtin_ctz(set)];
}
#endif

}  // namespace registers
}  // namespace TALUS_INSTRUCTION_SET
}  // namespace talus

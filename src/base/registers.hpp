// SPDX-License-Identifier: Apache-2.0
/// Vector registers of the instruction set that the including file is compiled for: the compiler's vector types, and
/// the operations that these lack; registers_of_floats.hpp has more. Included by simd.hpp only.
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
/// The function of this name for the instruction set (TALUS_COMPILED_FOR in instruction_set.hpp).
#define TALUS_FOR_SET(name) TALUS_JOINED(name, TALUS_INSTRUCTION_SET)
#define TALUS_JOINED(name, set) TALUS_JOINED_TOKENS(name, set)
#define TALUS_JOINED_TOKENS(name, set) name##_##set
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

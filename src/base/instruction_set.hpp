// SPDX-License-Identifier: Apache-2.0
/// The instruction sets for which the innermost loops are compiled, and the choice among them at run time. The same
/// case is bitwise reproducible with the same set, and nearly the same numbers with another.
#pragma once

#include <array>
#include <string_view>

#include "base/parameter.hpp"

/// Of name_avx512, name_avx2 and name_portable, functions of one type (with the template arguments that follow), the
/// one for a set that resolve() has returned. Only the last exists on processors other than x86-64. A macro, since
/// their names are all that differs.
#if defined(__x86_64__)
#define TALUS_COMPILED_FOR(set, name, ...)                              \
  ((set) == ::talus::InstructionSet::avx512 ? name##_avx512 __VA_ARGS__ \
   : (set) == ::talus::InstructionSet::avx2 ? name##_avx2 __VA_ARGS__   \
                                            : name##_portable __VA_ARGS__)
#else
#define TALUS_COMPILED_FOR(set, name, ...) (static_cast<void>(set), name##_portable __VA_ARGS__)
#endif

namespace talus {

enum class InstructionSet {
  automatic,  ///< the best one that the running processor has
  avx512,     ///< x86-64 with AVX-512 F, DQ, VL and BW: 8 doubles or 16 floats at a time
  avx2,       ///< x86-64 with AVX2 and FMA: 4 doubles or 8 floats at a time
  portable    ///< nothing beyond the compiler's baseline; multiplications and additions are not fused
};

template <>
inline constexpr auto choices<InstructionSet> = std::to_array<std::string_view>({"automatic", "avx512", "avx2",
                                                                                 "portable"});

/// Whether the running processor (and operating system) can execute it.
bool is_available(InstructionSet set);

/// The set that is used for a choice: the choice itself, or the best available set for `automatic`.
/// \throws InputError if the processor does not have it
InstructionSet resolve(InstructionSet wanted);

}  // namespace talus

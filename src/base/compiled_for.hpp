// SPDX-License-Identifier: Apache-2.0
/// The choice of a function by the instruction set that it was compiled for.
#pragma once

#include "base/instruction_set.hpp"

/// Of name_avx512, name_avx2 and name_portable, functions of one type, the one for a set that resolve() has returned.
/// Only the last exists on processors other than x86-64. A macro, since their names are all that differs.
#if defined(__x86_64__)
#define TALUS_COMPILED_FOR(set, name)                       \
  ((set) == ::talus::InstructionSet::avx512 ? name##_avx512 \
   : (set) == ::talus::InstructionSet::avx2 ? name##_avx2   \
                                            : name##_portable)
#else
#define TALUS_COMPILED_FOR(set, name) (static_cast<void>(set), name##_portable)
#endif

// SPDX-License-Identifier: Apache-2.0
#include "base/instruction_set.hpp"

#include <fmt/format.h>

#include "base/error.hpp"

namespace talus {

bool is_available(InstructionSet set) {
  switch (set) {
#if defined(__x86_64__)
    case InstructionSet::avx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("fma");
    case InstructionSet::avx2:
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
    case InstructionSet::avx512:
    case InstructionSet::avx2:
      return false;
#endif
    case InstructionSet::automatic:
    case InstructionSet::portable:
      return true;
  }
  return false;
}

InstructionSet resolve(InstructionSet wanted) {
  if (wanted == InstructionSet::automatic)
    return is_available(InstructionSet::avx512) ? InstructionSet::avx512
           : is_available(InstructionSet::avx2) ? InstructionSet::avx2
                                                : InstructionSet::portable;
  if (is_available(wanted)) return wanted;
  std::string allowed;
  for (std::size_t i = 0; i < choices<InstructionSet>.size(); ++i)
    if (is_available(static_cast<InstructionSet>(i)))
      allowed += (allowed.empty() ? "" : ", ") + std::string(choices<InstructionSet>[i]);
  throw InputError({{.where = "instruction set",
                     .key = {},
                     .what = fmt::format("this processor has no {}", choice_name(wanted)),
                     .allowed = allowed}});
}

}  // namespace talus

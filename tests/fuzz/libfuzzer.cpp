// SPDX-License-Identifier: Apache-2.0
/// What libFuzzer calls: one program a target, TALUS_FUZZ_TARGET.
#include <cstddef>
#include <cstdint>

#include "fuzz/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  talus::fuzz::TALUS_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
  return 0;
}

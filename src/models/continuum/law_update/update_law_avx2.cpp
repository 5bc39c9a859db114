// SPDX-License-Identifier: Apache-2.0
/// The law in vectors, compiled for one instruction set.
#include "models/continuum/law_update/update_law.hpp"

namespace talus::continuum {

void update_law_avx2(const granular::CriticalStateCoefficients& law, const LawColumns& columns, std::size_t first,
                     std::size_t end) {
  update_law(law, columns, first, end);
}

}  // namespace talus::continuum

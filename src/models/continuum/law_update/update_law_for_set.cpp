// SPDX-License-Identifier: Apache-2.0
/// A law applied to a register of particles at a time. Compiled once for each instruction set.
#include "models/continuum/law_update/kernel.hpp"

namespace talus::continuum {
inline namespace TALUS_INSTRUCTION_SET {

using Number = SimdVector<double>;

TALUS_INLINE Number load(const double* values) {
  Number x;
  __builtin_memcpy(x.row, values, sizeof(x));
  return x;
}
TALUS_INLINE void store(const Number& x, double* values) {
  __builtin_memcpy(values, x.row, sizeof(x));
}

}  // namespace TALUS_INSTRUCTION_SET

void TALUS_FOR_SET(update_law)(const granular::CriticalStateCoefficients& law, const LawColumns& c, std::size_t first,
                               std::size_t end) {
  const bool has_cohesion = law.parameters.has_cohesion();
  for (std::size_t i = first; i < end; i += Number::lanes) {
    const auto stress = [&](int k) { return load(c.stress[k] + i); };
    const auto l = [&](int k) { return load(c.velocity_gradient[k] + i); };
    granular::CriticalStatePoint<Number> old{{stress(0), stress(1), stress(2), stress(3), stress(4), stress(5)},
                                             load(c.expansion + i),
                                             load(c.contacts + i),
                                             0.0};
    if (has_cohesion) old.strengthening = load(c.strengthening + i);
    const granular::CriticalStatePoint<Number> point =
        granular::updated(law, old, Tensor3<Number>{l(0), l(1), l(2), l(3), l(4), l(5), l(6), l(7), l(8)},
                          load(c.density + i), c.time_step);
    const Number next[6] = {point.stress.xx, point.stress.yy, point.stress.zz,
                            point.stress.xy, point.stress.yz, point.stress.zx};
    for (int k = 0; k < 6; ++k) store(next[k], c.next_stress[k] + i);
    if (c.next_expansion == nullptr) continue;
    store(point.expansion, c.next_expansion + i);
    store(point.contacts, c.next_contacts + i);
    if (has_cohesion) store(point.strengthening, c.next_strengthening + i);
  }
}

}  // namespace talus::continuum

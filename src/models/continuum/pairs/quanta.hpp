// SPDX-License-Identifier: Apache-2.0
/// Places as whole numbers of a quantum, modulo 2^32: what two that are near each other differ by is exact, and as good
/// as a float wherever they are (docs/design/lists-and-precision.md).
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "base/vector.hpp"

namespace talus::continuum {

/// Whole quanta to the nearest, modulo 2^32.
inline std::uint32_t whole_quanta(double quanta) {
  return static_cast<std::uint32_t>(static_cast<std::int64_t>(quanta + std::copysign(0.5, quanta)));
}

/// \param per_quantum 1/m
inline std::array<std::uint32_t, 3> in_quanta(const Vector3& x, double per_quantum) {
  return {whole_quanta(per_quantum * x.x), whole_quanta(per_quantum * x.y), whole_quanta(per_quantum * x.z)};
}

/// The quantum of walls, m: a power of two, a float's epsilon of a spacing. The numbers wrap around at 128 spacings,
/// far beyond the reach of a particle.
inline double quantum_of_walls(double spacing) {
  return std::exp2(std::ceil(std::log2(spacing)) - 24);
}

}  // namespace talus::continuum

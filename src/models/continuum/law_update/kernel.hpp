// SPDX-License-Identifier: Apache-2.0
/// What the law in vectors, compiled once for each instruction set, is handed: columns. No operation is fused, so that
/// all sets give the bits of the law applied to one particle after the other.
#pragma once

#include <cstddef>

#include "physics/granular/critical_state_point.hpp"

namespace talus::continuum {

/// Columns of all particles, as of Material::update. A law may read and write the same ones.
struct LawColumns {
  const double* stress[6];
  const double *expansion, *contacts;  ///< CriticalState::History
  const double* strengthening;         ///< the same; read where the law has cohesion
  const double* velocity_gradient[9];
  const double* density;
  double time_step;
  double* next_stress[6];
  double *next_expansion, *next_contacts;  ///< null: not written
  double* next_strengthening;              ///< written with the former where the law has cohesion
};

/// Particles updated together: their number is a multiple of it.
inline constexpr std::size_t law_block = 8;

using UpdateCriticalState = void(const granular::CriticalStateCoefficients& law, const LawColumns& columns,
                                 std::size_t first, std::size_t end);
UpdateCriticalState update_law_portable, update_law_avx2, update_law_avx512;

}  // namespace talus::continuum

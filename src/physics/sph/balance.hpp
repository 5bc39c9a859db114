// SPDX-License-Identifier: Apache-2.0
/// What a particle brings to the momentum balance of its neighbours, Yuu & Umekage 2011, Eq. 17.
#pragma once

#include <array>
#include <string_view>

#include "base/parameter.hpp"
#include "base/tensor.hpp"

namespace talus::sph {

/// The factor before the stress in Eq. 17.
enum class StressForm {
  balanced,  ///< du/dt = -div(tau)/rho_b: the floor carries the bed's weight
  printed    ///< du/dt = -(1-Phi) div(tau)/rho_b: it would carry 1/(1-Phi) times the weight
};

/// What a particle brings to the momentum balance: stress over density squared, times the packing fraction in the
/// printed form (inside the divergence, so that pairs stay balanced). \returns m^5/(kg s^2)
constexpr SymmetricTensor3<> specific_stress(const SymmetricTensor3<>& stress, double density, double packing,
                                             StressForm form) {
  return (form == StressForm::printed ? packing : 1.0) / (density * density) * stress;
}

}  // namespace talus::sph

namespace talus {
template <>
inline constexpr auto choices<sph::StressForm> = std::to_array<std::string_view>({"balanced", "printed"});
}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
/// What a case of the continuum can choose, and the words for it.
#pragma once

#include <array>
#include <string_view>

#include "base/parameter.hpp"
#include "models/continuum/pairs/kernels/kernel.hpp"

namespace talus::continuum {

enum class GateOpens { when_settled, at_time, from_the_start };
enum class Smoothing { local, fixed };
enum class Continuity { printed, corrected };
enum class ViscositySpeed { largest, local };
enum class Friction { coulomb, printed, none };
enum class FrictionFrom { gate, start };
enum class Method { runge_kutta, leapfrog };

/// Two thirds of what the leapfrog bears, and what the midpoint rule does
/// (docs/design/time-steps.md).
constexpr double default_courant(Method method) {
  return method == Method::leapfrog ? 1.2 : 0.3;
}

}  // namespace talus::continuum

namespace talus {
template <>
inline constexpr auto choices<continuum::GateOpens> = std::to_array<std::string_view>({"when-settled", "at-time",
                                                                                       "from-the-start"});
template <>
inline constexpr auto choices<continuum::Smoothing> = std::to_array<std::string_view>({"local", "fixed"});
template <>
inline constexpr auto choices<continuum::Continuity> = std::to_array<std::string_view>({"printed", "corrected"});
template <>
inline constexpr auto choices<continuum::ViscositySpeed> = std::to_array<std::string_view>({"largest", "local"});
template <>
inline constexpr auto choices<continuum::Friction> = std::to_array<std::string_view>({"coulomb", "printed", "none"});
template <>
inline constexpr auto choices<continuum::FrictionFrom> = std::to_array<std::string_view>({"gate", "start"});
template <>
inline constexpr auto choices<continuum::PairPrecision> = std::to_array<std::string_view>({"double", "single"});
template <>
inline constexpr auto choices<continuum::Method> = std::to_array<std::string_view>({"runge-kutta", "leapfrog"});
}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
/// Units at the edge of the program: "200 um", "2500 kg/m3", "45 deg". Inside, every number is SI (angles in radians).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace talus {

/// Exponents of metre, kilogram, second and radian.
struct Dimension {
  int length = 0, mass = 0, time = 0, angle = 0;
  constexpr bool operator==(const Dimension&) const = default;
};

namespace dimension {
inline constexpr Dimension none{};
inline constexpr Dimension length{1, 0, 0, 0};
inline constexpr Dimension time{0, 0, 1, 0};
inline constexpr Dimension angle{0, 0, 0, 1};
inline constexpr Dimension velocity{1, 0, -1, 0};
inline constexpr Dimension acceleration{1, 0, -2, 0};
inline constexpr Dimension density{-3, 1, 0, 0};
inline constexpr Dimension viscosity{-1, 1, -1, 0};  ///< dynamic, Pa s
inline constexpr Dimension stiffness{0, 1, -2, 0};   ///< N/m
inline constexpr Dimension pressure{-1, 1, -2, 0};
}  // namespace dimension

/// A quantity as it was written, converted to SI.
struct Quantity {
  double value = 0;  ///< SI
  Dimension dimension;
};

/// Reads a number and its unit: "200 um", "1.82e-5 Pa s", "9.81 m/s2", "45 deg", "0.5". Prefixes n, u, m, c, k, M, G;
/// products by blank or '*', quotients by '/', powers by digits ("m2", "s^-1").
/// \returns nothing if the text is no quantity; `why` then says what is wrong
std::optional<Quantity> parse_quantity(std::string_view text, std::string* why = nullptr);

/// The unit in which Talus writes a quantity of this dimension: "m", "kg/m3", "Pa s", "deg" for angles, "" for numbers.
std::string_view unit_name(Dimension dimension);

/// A few valid writings, for messages: "\"5 mm\"".
std::string_view unit_example(Dimension dimension);

}  // namespace talus

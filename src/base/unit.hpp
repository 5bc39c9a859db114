// SPDX-License-Identifier: Apache-2.0
/// Units at the edge of the program: "200 um", "2500 kg/m3", "45 deg". Inside, every number is SI (angles in radians).
#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <string_view>

namespace talus {

// Units in which code writes down numbers.
inline constexpr double millimetre = 1e-3;                ///< m
inline constexpr double degree = std::numbers::pi / 180;  ///< rad

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
  double value = 0;  ///< SI; the double nearest to what was written
  Dimension dimension;
};

/// Reads a number and its unit: "200 um", "1.82e-5 Pa s", "9.81 m/s2", "45 deg", "0.5". Units m, g, s, rad, N, Pa, J,
/// W, Hz, bar and L (litre), with the prefixes p, n, u (or µ), m, c, k, M, G; deg (or °), rev, rpm, min, h, d, t, kt,
/// hPa, cP, P (poise), dm, cc, in, ft, lb, lbf, psi and psf without. Products by blank, '*' or '·', quotients by '/'
/// (of the next unit only), parentheses, powers by digits ("m2", "m^2", "m²", "s^-1"). \returns nothing if the text is
/// no quantity; `why` then says what is wrong
std::optional<Quantity> parse_quantity(std::string_view text, std::string* why = nullptr);

/// The unit in which Talus writes a quantity of this dimension: "m", "kg/m3", "Pa s", "deg" for angles, "" for numbers.
std::string unit_name(Dimension dimension);

/// What a quantity of this dimension is called: "length", "dynamic viscosity", "number"; where Talus has no word,
/// "quantity in m^2 kg".
std::string dimension_name(Dimension dimension);

/// A common writing, for messages, without quotes: "5 mm", "45 deg", "0.5".
std::string unit_example(Dimension dimension);

/// The unit of that example: "mm", "deg", "".
std::string example_unit(Dimension dimension);

/// The shortest text that parse_quantity reads back bitwise identical: "0.0002 m", "45 deg", "0.05".
/// \param value finite, SI
/// \param unit any unit of the value's dimension that parse_quantity knows, such as unit_name(dimension); "" for a
/// number
std::string format_quantity(double value, std::string_view unit);

}  // namespace talus

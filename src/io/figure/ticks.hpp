// SPDX-License-Identifier: Apache-2.0
/// Where the numbers of an axis stand, and how they are written.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace talus::figure {

struct Ticks {
  std::vector<double> major;        ///< increasing, within the axis
  std::vector<std::string> labels;  ///< one for each major tick; labels times `factor` is the value
  std::string factor;               ///< "×10^{-6}" for very small or large numbers, or empty
};

/// The smallest of 1, 2 or 5 times a power of ten that divides `range` into at most `most` steps.
/// \throws std::invalid_argument unless range is positive and finite and most >= 1
double nice_step(double range, int most);

/// The largest of 1, 2 or 5 times a power of ten that is not above `most`, for bars and arrows that show a scale.
/// \throws std::invalid_argument unless most is positive and finite
double nice_length(double most);

/// Multiples of the nice step in [low, high]; with `most` below 3 there may be none. \throws std::invalid_argument
/// unless low < high, both finite
Ticks linear_ticks(double low, double high, int most);

/// With the minus sign of typography.
std::string with_minus(std::string_view number);

}  // namespace talus::figure

// SPDX-License-Identifier: Apache-2.0
#include "io/figure/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace talus::figure {

namespace {

void check(double low, double high, int most) {
  if (!(low < high) || !std::isfinite(high - low) || most < 1) {
    throw std::invalid_argument(fmt::format("no ticks from {} to {}, at most {}", low, high, most));
  }
}

int decade(double value) {
  return static_cast<int>(std::floor(std::log10(value) + 1e-12));
}

/// digit times 10 to the n; the nearest double to that as long as the power is exact.
double scaled(double digit, int n) {
  return n >= 0 ? digit * std::pow(10.0, n) : digit / std::pow(10.0, -n);
}

}  // namespace

std::string with_minus(std::string_view number) {
  return number.starts_with('-') ? "−" + std::string(number.substr(1)) : std::string(number);
}

double nice_step(double range, int most) {
  check(0, range, most);
  const int exponent = decade(range / most);
  for (const double digit : {1.0, 2.0, 5.0}) {
    // The tolerance keeps a range of 0.3 at 3 steps from needing 0.30000000000000004 / 0.1 = 4 of them.
    const double step = scaled(digit, exponent);
    if (range <= step * most * (1 + 1e-9)) return step;
  }
  return scaled(1, exponent + 1);
}

double nice_length(double most) {
  check(0, most, 1);
  const int exponent = decade(most);
  for (const double digit : {5.0, 2.0}) {
    if (scaled(digit, exponent) <= most * (1 + 1e-9)) return scaled(digit, exponent);
  }
  return scaled(1, exponent);
}

Ticks linear_ticks(double low, double high, int most) {
  check(low, high, most);
  const double step = nice_step(high - low, most);
  const double slack = 1e-9 * (high - low) / step;
  const double first = std::ceil(low / step - slack), last = std::floor(high / step + slack);
  Ticks ticks;
  for (double k = first; k <= last; k += 1) ticks.major.push_back(std::clamp(k * step, low, high));

  const double largest = std::max(std::abs(first), std::abs(last)) * step;
  const int exponent = largest > 0 ? decade(largest) : 0;
  const int factor = exponent >= 5 || exponent <= -3 ? exponent : 0;
  if (factor != 0) ticks.factor = fmt::format("×10^{{{}}}", factor);
  const int decimals = std::max(0, factor - decade(step));
  for (double k = first; k <= last; k += 1) {
    // k == 0 may be a negative zero
    ticks.labels.push_back(with_minus(fmt::format("{:.{}f}", k == 0 ? 0.0 : k * step / scaled(1, factor), decimals)));
  }
  return ticks;
}

}  // namespace talus::figure

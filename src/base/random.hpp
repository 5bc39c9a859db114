// SPDX-License-Identifier: Apache-2.0
/// Random numbers, bitwise identical on every machine: the engine is std::mt19937_64, whose sequence the standard
/// fixes; the distributions of the standard library are not fixed, so the few that are needed are defined here.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace talus {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [0, 1), 53 bits.
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }

  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Normal with mean 0 and standard deviation 1 (Box & Muller 1958; the second value is not kept, so that the state is
  /// the engine's alone).
  double normal() {
    const double u = 1.0 - uniform();  // in (0, 1]
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
/// Detects a run whose steps have become so short that it would never end.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "io/checkpoint.hpp"

namespace talus::run {

class StepGuard {
 public:
  static constexpr double most_fall = 100;        ///< longest step of the phase over one that is too short
  static constexpr std::uint64_t patience = 100;  ///< steps in a row: an impact may ask for some

  /// To be called for every step, of length `step`, s. \param begun whether the run's time origin had come when it
  /// began; steps before and after it are compared with their own
  /// \returns what is wrong, nothing if the run may continue
  std::optional<std::string> take(double step, bool begun);

  void save(CheckpointWriter& checkpoint) const;
  /// A checkpoint of a version without a guard leaves it as it is.
  void resume(const CheckpointReader& checkpoint);

 private:
  double longest_ = 0;       ///< of the phase, s
  std::uint64_t short_ = 0;  ///< steps in a row that were too short
  std::uint64_t begun_ = 0;
};

}  // namespace talus::run

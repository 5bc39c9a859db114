// SPDX-License-Identifier: Apache-2.0
#include "run/step_guard.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace talus::run {

std::optional<std::string> StepGuard::take(double step, bool begun) {
  if (begun != (begun_ != 0)) {
    longest_ = 0;
    short_ = 0;
    begun_ = begun;
  }
  longest_ = std::max(longest_, step);
  short_ = most_fall * step < longest_ ? short_ + 1 : 0;
  if (short_ < patience) return std::nullopt;
  return fmt::format("the time step has fallen from {:.3g} s to {:.3g} s, {} steps in a row: the run would not end",
                     longest_, step, short_);
}

void StepGuard::save(CheckpointWriter& checkpoint) const {
  checkpoint.put("run/longest_step", longest_, "s");
  checkpoint.put("run/short_steps", short_);
  checkpoint.put("run/origin_has_come", begun_);
}

void StepGuard::resume(const CheckpointReader& checkpoint) {
  if (!checkpoint.has("run/longest_step")) return;
  checkpoint.get("run/longest_step", longest_);
  checkpoint.get("run/short_steps", short_);
  checkpoint.get("run/origin_has_come", begun_);
}

}  // namespace talus::run

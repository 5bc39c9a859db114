// SPDX-License-Identifier: Apache-2.0
/// The ways in which a run can be interrupted: SIGINT, SIGTERM, SIGUSR1, a file `stop` in its folder, the wall-time
/// limit. All end alike: a checkpoint is written and the exit status is 130.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

namespace talus::run {

/// Makes SIGINT, SIGTERM and SIGUSR1, which mpirun hands on, request a stop; a second one kills the process. Call once.
void catch_signals();

/// True after one of them.
bool signal_has_come();

class Interrupt {
 public:
  /// \param stop_file looked for ten times a second; \param walltime from now, none: no limit
  Interrupt(std::filesystem::path stop_file, std::optional<std::chrono::duration<double>> walltime);

  /// Why the run should stop now; nothing if it may continue. Cheap enough for every step.
  std::optional<std::string> reason();

 private:
  using Clock = std::chrono::steady_clock;
  std::filesystem::path stop_file_;
  std::optional<Clock::time_point> deadline_;
  Clock::time_point next_look_;
};

}  // namespace talus::run

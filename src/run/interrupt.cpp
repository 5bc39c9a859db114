// SPDX-License-Identifier: Apache-2.0
#include "run/interrupt.hpp"

#include <csignal>
#include <system_error>
#include <utility>

namespace talus::run {

namespace {

volatile std::sig_atomic_t caught = 0;

void remember(int signal) {
  caught = signal;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_signals() {
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
  std::signal(SIGUSR1, remember);
}

bool signal_has_come() {
  return caught != 0;
}

Interrupt::Interrupt(std::filesystem::path stop_file, std::optional<std::chrono::duration<double>> walltime)
    : stop_file_(std::move(stop_file)), next_look_(Clock::now()) {
  if (walltime) deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(*walltime);
}

std::optional<std::string> Interrupt::reason() {
  if (caught == SIGINT) return "SIGINT";
  if (caught == SIGUSR1) return "SIGUSR1";
  if (caught != 0) return "SIGTERM";
  const Clock::time_point now = Clock::now();
  if (deadline_ && now >= *deadline_) return "the wall-time limit";
  if (now >= next_look_) {
    next_look_ = now + std::chrono::milliseconds(100);
    std::error_code ignored;
    if (std::filesystem::exists(stop_file_, ignored)) return "the file " + stop_file_.string();
  }
  return std::nullopt;
}

}  // namespace talus::run

// SPDX-License-Identifier: Apache-2.0
#include "run/waiting.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "run/progress.hpp"

namespace talus::run {

Waiting::Waiting(std::string phase, std::FILE* stream, double first)
    : phase_(std::move(phase)), stream_(stream), thread_([this, first] { watch(first); }) {}

Waiting::~Waiting() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  over_.notify_all();
  thread_.join();
}

void Waiting::watch(double first) {
  using Seconds = std::chrono::duration<double>;
  constexpr Seconds between_live_lines{1}, between_lines{60};
  const bool terminal = isatty(fileno(stream_)) != 0;
  const auto began = std::chrono::steady_clock::now();
  bool shown = false;
  Seconds next{first};
  std::unique_lock lock(mutex_);
  while (!over_.wait_until(lock, began + std::chrono::duration_cast<std::chrono::nanoseconds>(next),
                           [this] { return is_over_; })) {
    const std::string line = fmt::format("{} ... {}", phase_, format_seconds(next.count()));
    std::fprintf(stream_, terminal ? "\r\033[K%s" : "%s\n", line.c_str());
    std::fflush(stream_);
    shown = true;
    next += terminal ? between_live_lines : std::min(next, between_lines);
  }
  if (shown && terminal) {
    std::fprintf(stream_, "\r\033[K");
    std::fflush(stream_);
  }
}

}  // namespace talus::run

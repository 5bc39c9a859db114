// SPDX-License-Identifier: Apache-2.0
#include "run/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>

namespace talus::run {

std::string format_seconds(double seconds) {
  if (!std::isfinite(seconds)) return "?";
  if (seconds > 3.15e10) return "more than a thousand years";
  const auto s = static_cast<std::int64_t>(std::llround(seconds));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {} s", s / 60, s % 60);
  return fmt::format("{} h {} min", s / 3600, s / 60 % 60);
}

Progress::Progress(std::FILE* stream, double start, double end)
    : stream_(stream),
      terminal_(isatty(fileno(stream)) != 0),
      start_(start),
      end_(end),
      began_(Clock::now()),
      next_(began_ + (terminal_ ? std::chrono::milliseconds(200) : std::chrono::milliseconds(5000))) {}

Progress::~Progress() {
  finish();
}

void Progress::show(double now, const std::string& text) {
  const Clock::time_point clock = Clock::now();
  next_ = clock + (terminal_ ? std::chrono::milliseconds(200) : std::chrono::milliseconds(10000));
  const double done = (now - start_) / (end_ - start_);
  const double elapsed = std::chrono::duration<double>(clock - began_).count();
  const std::string line =
      fmt::format("{}  {:3.0f} %  ETA {}", text, 100 * done, format_seconds(elapsed * (1 - done) / done));
  std::fprintf(stream_, terminal_ ? "\r\033[K%s" : "%s\n", line.c_str());
  std::fflush(stream_);
  shown_ = true;
}

void Progress::finish() {
  if (shown_ && terminal_) std::fprintf(stream_, "\r\033[K");
  std::fflush(stream_);
  shown_ = false;
}

}  // namespace talus::run

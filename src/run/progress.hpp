// SPDX-License-Identifier: Apache-2.0
/// The line that lives: how far a run is, how fast, and when it will end. Rewritten in place on a terminal; elsewhere a
/// plain line now and then.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>

namespace talus::run {

class Progress {
 public:
  /// \param stream where lines go, usually stderr; \param start, end of the quantity that grows (simulated time,
  /// members)
  Progress(std::FILE* stream, double start, double end);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Shows the line if the last one is old enough. \param text what stands before the share done and the ETA
  template <class Text>
  void update(double now, Text&& text) {
    if (is_due()) show(now, text());
  }

  /// Ends the living line, so that other text can follow.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  bool is_due() const { return Clock::now() >= next_; }
  void show(double now, const std::string& text);

  std::FILE* stream_;
  bool terminal_;
  bool shown_ = false;
  double start_, end_;
  Clock::time_point began_, next_;
};

/// 75 -> "1 min 15 s".
std::string format_seconds(double seconds);

}  // namespace talus::run

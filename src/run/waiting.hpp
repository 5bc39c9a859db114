// SPDX-License-Identifier: Apache-2.0
/// Says what a run does while it does not step: a phase that lasts longer than two seconds is named on stderr, on a
/// terminal with its seconds in a line that is rewritten, elsewhere after 2, 4, 8, ... seconds, and each minute.
#pragma once

#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <string>
#include <thread>

namespace talus::run {

/// Lives as long as the phase. Its thread only looks at the clock and prints: no number of a run depends on it.
class Waiting {
 public:
  /// \param phase such as "drawing pictures" \param stream usually stderr \param first when it is first named, s
  explicit Waiting(std::string phase, std::FILE* stream = stderr, double first = 2);
  ~Waiting();
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;

 private:
  void watch(double first);

  std::string phase_;
  std::FILE* stream_;
  std::mutex mutex_;
  std::condition_variable over_;
  bool is_over_ = false;
  std::thread thread_;
};

}  // namespace talus::run

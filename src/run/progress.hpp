// SPDX-License-Identifier: Apache-2.0
/// Progress of a run and the time left. On a terminal one line, rewritten in place and cut to its width; elsewhere, and
/// in a log, one line per tenth of the run.
///
/// The forecast distinguishes phases (settling, then flow): the speed of each is measured over its latest quarter,
/// since the cost of a step changes during a run.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

namespace talus::run {

// Says what a run does while it does not step: a phase that lasts longer than two seconds is named on stderr, on a
// terminal with its seconds in a line that is rewritten, elsewhere after 2, 4, 8, ... seconds, and each minute.

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

class Progress {
 public:
  using Log = std::function<void(const std::string& line)>;

  /// \param stream where lines go, usually stderr; \param log receives the line of each tenth
  explicit Progress(std::FILE* stream, Log log = {});
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// A part of the way, in the quantity that grows: simulated time, members.
  struct Phase {
    double start = 0, end = 1;
    std::string name = {};  ///< of a phase that may end before `end`: it then lasts "at most" so long
    double after = 0;       ///< what comes after this phase, in the same quantity
    double recent = 0.25;   ///< share of the phase's time, the latest, over which its speed is measured
  };
  void begin(const Phase& phase);

  /// Shows the line if one is due. \param text the text before the fraction done and the time left
  template <class Text>
  void update(double now, Text&& text) {
    const Clock::time_point clock = Clock::now();
    take_sample(clock, now);
    if (is_due(clock, now)) show(clock, now, text());
  }

  /// Ends the progress line, so that other text can follow.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  struct Sample {
    Clock::time_point clock;
    double now;
  };
  void take_sample(Clock::time_point clock, double now);
  bool is_due(Clock::time_point clock, double now) const;
  bool is_line_due(Clock::time_point clock, double now) const;
  void show(Clock::time_point clock, double now, const std::string& text);
  double share_done(double now) const;
  std::string time_left(Clock::time_point clock, double now) const;

  std::FILE* stream_;
  Log log_;
  bool terminal_;
  bool shown_ = false;
  Phase phase_;
  std::deque<Sample> samples_;  ///< the first is where the phase's recent part began
  Clock::time_point began_, next_live_, last_line_;
  int tenths_ = 0;  ///< of the phase, reported as lines
  bool told_ = false;
};

/// 75 -> "1 min 15 s", 2.6e7 -> "10 months".
std::string format_seconds(double seconds);

/// The first `width` characters (code points) of a text in UTF-8.
std::string cut(std::string_view text, std::size_t width);

}  // namespace talus::run

// SPDX-License-Identifier: Apache-2.0
/// Whether a loop is worth sharing among threads. It is not where others want the processors (a thread is taken off one
/// in the middle of a task, and the loop waits for it), where what one processor writes is slow to reach another, and
/// where loops are short. None of that can be known beforehand, so both ways are timed, now and then for a moment, and
/// the faster one is kept in between. Which thread does what changes no bit, so this may follow the clock.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace talus {

class Sharing {
 public:
  using Clock = std::chrono::steady_clock;

  /// Whether the next loop is to be shared. \param now the time at its start
  bool decide(Clock::time_point now);

  /// Takes note of a loop that has ended. \param loop what distinguishes it from others, not null \param tasks how many
  /// it had
  void note(const void* loop, std::size_t tasks, Clock::duration taken);

  /// How long a trial of the way that is not kept takes at least, and how long the other is kept: between two bounds,
  /// and so long that trials take at most one part in `share` of the time.
  static constexpr Clock::duration trial = std::chrono::milliseconds(20);
  static constexpr Clock::duration min_rest = std::chrono::milliseconds(200), max_rest = std::chrono::seconds(4);
  static constexpr int share = 50;

 private:
  enum Way : std::uint8_t { shared, alone };
  struct Loop {
    const void* name = nullptr;
    std::array<double, 2> tasks{}, seconds{};  // by way
  };

  Way other(Way way) const { return way == shared ? alone : shared; }
  /// Time of the loops that were timed both ways, shared over alone; 1 if there are none.
  double ratio() const;
  void forget(Way way);

  // Loops stand where their names fall, or next to it; those that find no room are not timed.
  std::array<Loop, 128> loops_{};
  Way kept_ = shared, now_ = shared;
  bool on_trial_ = true;  // at first the kept way is timed for a moment as well
  Clock::time_point begin_{}, until_{};
  Clock::duration rest_ = min_rest;
};

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
#include "base/sharing.hpp"

#include <algorithm>

namespace talus {

namespace {

// The way is changed for a gain of more than this, so that noise alone does not change it.
constexpr double gain = 0.03;

}  // namespace

bool Sharing::decide(Clock::time_point now) {
  if (begin_ == Clock::time_point{}) begin_ = now, until_ = now + trial;
  if (now < until_) return now_ == shared;
  if (on_trial_ && now_ != kept_) {
    const double kept_over_other = kept_ == shared ? ratio() : 1 / ratio();
    if (kept_over_other > 1 + gain)
      kept_ = now_, rest_ = min_rest;
    else
      rest_ = std::min(2 * rest_, max_rest);
    until_ = now + std::max(rest_, share * (now - begin_));
    now_ = kept_, on_trial_ = false;
    forget(kept_);  // what the next trial is compared with is timed from now on
  } else {
    now_ = other(kept_), on_trial_ = true;
    forget(now_);
    until_ = now + trial;
  }
  begin_ = now;
  return now_ == shared;
}

void Sharing::note(const void* loop, std::size_t tasks, Clock::duration taken) {
  const std::size_t first = reinterpret_cast<std::uintptr_t>(loop) / 16 % loops_.size();
  for (std::size_t k = 0; k < 4; ++k) {
    Loop& entry = loops_[(first + k) % loops_.size()];
    if (!entry.name) entry.name = loop;
    if (entry.name != loop) continue;
    entry.tasks[now_] += static_cast<double>(tasks);
    entry.seconds[now_] += std::chrono::duration<double>(taken).count();
    return;
  }
}

double Sharing::ratio() const {
  double time_shared = 0, time_alone = 0;
  for (const Loop& loop : loops_) {
    if (!(loop.tasks[shared] > 0 && loop.tasks[alone] > 0)) continue;
    // Each way as many tasks as were timed alone and shared together.
    const double tasks = loop.tasks[shared] + loop.tasks[alone];
    time_shared += tasks * loop.seconds[shared] / loop.tasks[shared];
    time_alone += tasks * loop.seconds[alone] / loop.tasks[alone];
  }
  return time_alone > 0 ? time_shared / time_alone : 1;
}

void Sharing::forget(Way way) {
  for (Loop& loop : loops_) loop.tasks[way] = loop.seconds[way] = 0;
}

}  // namespace talus

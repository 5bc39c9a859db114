// SPDX-License-Identifier: Apache-2.0
#include "base/sharing.hpp"

#include <gtest/gtest.h>

namespace talus {
namespace {

using namespace std::chrono_literals;
using Clock = Sharing::Clock;

/// A clock of its own, and two kinds of loops that take so long a task, shared and alone.
struct Machine {
  Sharing sharing;
  Clock::time_point now{1s};
  Clock::duration in_shared{}, in_all{};

  void loop(const void* name, std::size_t tasks, Clock::duration a_task_shared, Clock::duration a_task_alone) {
    const bool shared = sharing.decide(now);
    const Clock::duration taken = static_cast<int>(tasks) * (shared ? a_task_shared : a_task_alone);
    now += taken;
    sharing.note(name, tasks, taken);
    in_all += taken;
    if (shared) in_shared += taken;
  }
  /// The share of the time in shared loops.
  double run(Clock::duration length, double cost_of_sharing) {
    in_shared = in_all = {};
    static constexpr int names[2] = {};
    for (const Clock::time_point end = now + length; now < end;) {
      // Loops of unlike lengths: what is compared is the same loop both ways.
      loop(&names[0], 7, std::chrono::nanoseconds(static_cast<int>(1e4 * cost_of_sharing)), 10us);
      loop(&names[1], 100, std::chrono::nanoseconds(static_cast<int>(1e3 * cost_of_sharing)), 1us);
    }
    return std::chrono::duration<double>(in_shared) / std::chrono::duration<double>(in_all);
  }
};

TEST(Sharing, IsKeptWhereItPays) {
  Machine machine;
  EXPECT_GT(machine.run(20s, 0.55), 0.97);
}

TEST(Sharing, IsGivenUpWhereItDoesNot) {
  Machine machine;
  machine.run(1s, 2.0);
  EXPECT_LT(machine.run(20s, 2.0), 0.03);
  EXPECT_GT(machine.in_shared.count(), 0) << "it is tried again";
}

TEST(Sharing, FollowsTheMachine) {
  Machine machine;
  machine.run(10s, 0.55);
  machine.run(5s, 3.0);  // others have come
  EXPECT_LT(machine.run(10s, 3.0), 0.05);
  machine.run(5s, 0.55);  // and gone
  EXPECT_GT(machine.run(10s, 0.55), 0.95);
}

TEST(Sharing, OfLongLoopsIsTriedRarely) {
  Machine machine;
  static constexpr int name = 0;
  for (int k = 0; k < 500; ++k) machine.loop(&name, 1, 600ms, 1s);
  EXPECT_LT((machine.in_all - machine.in_shared) / machine.in_all, 0.05);
  EXPECT_GT(machine.in_shared / 600ms, 400);
}

}  // namespace
}  // namespace talus

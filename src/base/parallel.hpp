// SPDX-License-Identifier: Apache-2.0
/// The parallel loop: the only code that deals with threads. Each index writes only its own data, so the result does
/// not depend on the number of threads; a reduction sums chunks of fixed size in a fixed order, for the same reason.
/// Why not OpenMP or oneTBB: docs/design/build.md.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

namespace talus {

/// A team of threads that waits passively between loops. One loop runs at a time; a loop is not started inside a loop.
/// A loop ends when its tasks are done; it waits only for the threads that have taken part in it. A thread that the
/// system has not let run by then finds the loop closed and sits it out.
class ThreadTeam {
 public:
  /// \param threads at least 1; the calling thread is one of them
  explicit ThreadTeam(int threads = 1);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  int size() const;

  /// Calls body(task) once for each task in [0, tasks), in any order, on any thread; returns when all are done and the
  /// threads that took part have left the loop.
  /// An exception leaves the loop after all tasks have ended; of several, the exception of the lowest task.
  template <class Body>
  void run(std::size_t tasks, Body&& body) {
    run_tasks(
        tasks, [](void* context, std::size_t task) { (*static_cast<std::remove_reference_t<Body>*>(context))(task); },
        const_cast<void*>(static_cast<const void*>(std::addressof(body))));
  }

 private:
  using Call = void (*)(void* context, std::size_t task);
  void run_tasks(std::size_t tasks, Call call, void* context);

  struct Shared;
  std::unique_ptr<Shared> shared_;
};

/// Elements handed to a thread at once. Part of the definition of `reduce`: changing it changes sums bitwise.
inline constexpr std::size_t chunk_size = 256;

/// Calls body(first, end) for chunks that together are [0, count). It writes only what belongs to [first, end).
template <class Body>
void for_each_chunk(ThreadTeam& team, std::size_t count, Body&& body) {
  const std::size_t chunks = (count + chunk_size - 1) / chunk_size;
  team.run(chunks, [&](std::size_t chunk) {
    const std::size_t end = (chunk + 1) * chunk_size < count ? (chunk + 1) * chunk_size : count;
    body(chunk * chunk_size, end);
  });
}

/// Calls body(i) once for each i in [0, count). body(i) writes only what belongs to i.
template <class Body>
void for_each(ThreadTeam& team, std::size_t count, Body&& body) {
  for_each_chunk(team, count, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) body(i);
  });
}

/// Reduces all i to one T: add(i, T&) within chunks of `chunk_size` in order, then the chunks combined in order.
/// \param combine (T, T) -> T, e.g. sum
template <class T, class Add, class Combine>
T accumulate(ThreadTeam& team, std::size_t count, T initial, Add&& add, Combine&& combine) {
  const std::size_t chunks = (count + chunk_size - 1) / chunk_size;
  struct Slot {  // so that flags are not packed into bits that threads would share
    T value;
  };
  std::vector<Slot> partial(chunks, Slot{initial});
  for_each_chunk(team, count, [&](std::size_t first, std::size_t end) {
    T gathered = initial;
    for (std::size_t i = first; i < end; ++i) add(i, gathered);
    partial[first / chunk_size].value = gathered;
  });
  T total = initial;
  for (const Slot& part : partial) total = combine(total, part.value);
  return total;
}

/// Combines value(i) over all i: within chunks of `chunk_size` in order, then the chunks in order.
/// \param combine (T, T) -> T, e.g. sum or maximum
template <class T, class Value, class Combine>
T reduce(ThreadTeam& team, std::size_t count, T initial, Value&& value, Combine&& combine) {
  return accumulate(
      team, count, initial, [&](std::size_t i, T& sum) { sum = combine(sum, value(i)); }, combine);
}

}  // namespace talus

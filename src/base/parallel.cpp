// SPDX-License-Identifier: Apache-2.0
#include "base/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "base/sharing.hpp"

namespace talus {

namespace {

// A thread that runs out of tasks looks this many times before it sleeps: about 20 microseconds, longer than the gaps
// between the loops of a step, and little on a machine whose cores are shared.
constexpr int looks_before_sleep = 1000;

void relax() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

}  // namespace

struct ThreadTeam::Shared {
  // A thread's share of the tasks, which others take from when they have done their own. The shares of successive loops
  // over the same elements are the same, so that a thread finds in its caches what it wrote there.
  struct alignas(64) Share {
    std::atomic<std::size_t> next{0};
    std::size_t end = 0;
  };
  Sharing sharing;
  std::vector<Share> shares;
  std::atomic<unsigned> generation{0};  // of loops that threads were woken for
  // Twice the threads that have taken part in the loop and not yet left it, plus 1 while more may enter: for these the
  // loop waits, and for no others.
  std::atomic<int> inside{0};
  std::atomic<bool> stop{false};
  Call call = nullptr;
  void* context = nullptr;
  std::mutex error_mutex;
  std::size_t error_task = 0;
  std::exception_ptr error;
  std::vector<std::thread> threads;

  explicit Shared(int size) : shares(static_cast<std::size_t>(size)) {}

  void work(std::size_t own) {
    for (std::size_t k = 0; k < shares.size(); ++k) {
      Share& share = shares[(own + k) % shares.size()];
      if (share.next.load(std::memory_order_relaxed) >= share.end) continue;
      for (std::size_t task; (task = share.next.fetch_add(1, std::memory_order_relaxed)) < share.end;) {
        try {
          call(context, task);
        } catch (...) {
          const std::lock_guard lock(error_mutex);
          if (!error || task < error_task) error = std::current_exception(), error_task = task;
        }
      }
    }
  }

  // Whether the loop is still open; from then on it waits for this thread.
  bool enter() {
    for (int now = inside.load(std::memory_order_relaxed); now & open;)
      if (inside.compare_exchange_weak(now, now + one, std::memory_order_acquire, std::memory_order_relaxed))
        return true;
    return false;
  }

  void leave() {
    if (inside.fetch_sub(one, std::memory_order_acq_rel) == one) inside.notify_one();
  }

  // No tasks are left to take. Only threads that have entered can still be at work on one; a thread that has not finds
  // the loop closed and is not waited for: on a busy machine it may not run for long.
  void close() {
    inside.fetch_and(~open, std::memory_order_acq_rel);
    for (int look = 0; look < looks_before_sleep && inside.load(std::memory_order_acquire) > 0; ++look) relax();
    for (int now; (now = inside.load(std::memory_order_acquire)) > 0;) inside.wait(now, std::memory_order_acquire);
  }

  void serve(std::size_t own) {
    unsigned seen = 0;
    while (true) {
      for (int look = 0; look < looks_before_sleep && generation.load(std::memory_order_acquire) == seen; ++look)
        relax();
      generation.wait(seen, std::memory_order_acquire);
      seen = generation.load(std::memory_order_acquire);
      if (stop.load(std::memory_order_relaxed)) return;
      if (!enter()) continue;
      work(own);
      leave();
    }
  }

  static constexpr int open = 1, one = 2;  // of `inside`
};

ThreadTeam::ThreadTeam(int threads) : shared_(std::make_unique<Shared>(std::max(threads, 1))) {
  for (std::size_t own = 1; own < shared_->shares.size(); ++own)
    shared_->threads.emplace_back([shared = shared_.get(), own] { shared->serve(own); });
}

ThreadTeam::~ThreadTeam() {
  shared_->stop.store(true, std::memory_order_relaxed);
  shared_->generation.fetch_add(1, std::memory_order_release);
  shared_->generation.notify_all();
  for (std::thread& thread : shared_->threads) thread.join();
}

int ThreadTeam::size() const {
  return static_cast<int>(shared_->threads.size()) + 1;
}

void ThreadTeam::run_tasks(std::size_t tasks, Call call, void* context) {
  Shared& shared = *shared_;
  shared.call = call;
  shared.context = context;
  const std::size_t size = shared.shares.size();
  for (std::size_t k = 0; k < size; ++k) {
    shared.shares[k].next.store(tasks * k / size, std::memory_order_relaxed);
    shared.shares[k].end = tasks * (k + 1) / size;
  }
  shared.error = nullptr;
  if (tasks > 1 && !shared.threads.empty()) {
    const Sharing::Clock::time_point begin = Sharing::Clock::now();
    if (shared.sharing.decide(begin)) {
      shared.inside.store(Shared::open, std::memory_order_release);
      shared.generation.fetch_add(1, std::memory_order_release);
      shared.generation.notify_all();
    }
    shared.work(0);
    shared.close();
    shared.sharing.note(reinterpret_cast<const void*>(call), tasks, Sharing::Clock::now() - begin);
  } else {
    shared.work(0);
  }
  if (shared.error) std::rethrow_exception(shared.error);
}

}  // namespace talus

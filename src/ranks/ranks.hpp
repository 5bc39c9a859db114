// SPDX-License-Identifier: Apache-2.0
/// The processes that run a case together: the only code that deals with them, as base/parallel.hpp does with threads.
/// What a call does that all of them must make, and make in the same order, is marked "together".
///
/// A program has one of two kinds: a process by itself (`one_process`), or those of an MPI program (petsc/petsc.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "base/error.hpp"
#include "base/exact_sum.hpp"
#include "base/vector.hpp"

namespace talus {

/// What processes tell each other in one message: of each entry the least, the largest or the sum over all of them.
/// None of these depends on an order. Each has as many entries on every process; no entry of `least` or `largest` is a
/// NaN.
struct Votes {
  std::vector<double> least, largest;
  std::vector<std::uint64_t> sum;  ///< modulo 2^64
};

/// A way in which processes send items to each other, made once and used any number of times.
class Plan {
 public:
  virtual ~Plan() = default;
  std::size_t sent() const { return sent_; }          ///< items, those to itself among them
  std::size_t received() const { return received_; }  ///< items

  /// Together. \param items those to process 0 first, then those to 1, ...; each of so many words of 8 bytes
  /// \param received those from process 0 first, in the order in which it has them, then those from 1, ...
  virtual void exchange(const void* items, std::size_t words, void* received) = 0;

  /// The same with a value for each item.
  template <class T>
  std::vector<T> exchange(const std::vector<T>& items) {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % 8 == 0);
    std::vector<T> got(received_);
    exchange(items.data(), sizeof(T) / 8, got.data());
    return got;
  }

 protected:
  Plan(std::size_t sent, std::size_t received) : sent_(sent), received_(received) {}

 private:
  std::size_t sent_, received_;
};

/// Space, cut into a part for each process. Every place belongs to one part.
class Partition {
 public:
  virtual ~Partition() = default;
  /// Cuts it so that each part holds about the same weight. Together. \param points of this process, finite, m
  /// \param weight of each, > 0
  virtual void cut(std::span<const Vector3> points, std::span<const double> weight) = 0;
  /// Whose part a place is in. \pre cut
  virtual int rank_of(const Vector3& x) const = 0;
  /// Writes the processes whose parts meet the box between two corners, m. \pre cut
  virtual void ranks_of(const Vector3& low, const Vector3& high, std::vector<int>& ranks) const = 0;
};

class Ranks {
 public:
  virtual ~Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }  ///< of this process, from 0
  int size() const { return size_; }  ///< how many there are
  bool is_first() const { return rank_ == 0; }
  bool is_alone() const { return size_ == 1; }

  /// Together: the votes of all.
  virtual void join(Votes& votes) const = 0;
  /// Together: sums over all processes, place by place. \pre the terms of a sum are multiples of one power of two, and
  /// their sums less than 2^53 times that: then they are integers, exact and of no order; or all but one are zero
  virtual void add_up(std::span<double> sums) const = 0;
  /// Together: the bytes of all processes, in their order. For what is small.
  virtual std::string gather(const std::string& own) const = 0;
  /// Together: the same at the first one alone; nothing elsewhere.
  virtual std::string gather_at_first(const std::string& own) const = 0;
  /// Together: the first one's bytes, of the same number everywhere.
  virtual void from_first(std::span<std::byte> bytes) const = 0;
  /// Together. \param counts how many items go to each process
  virtual std::unique_ptr<Plan> plan(std::span<const std::size_t> counts) const = 0;
  virtual std::unique_ptr<Partition> partition() const = 0;
  /// How many of the processes share this machine.
  virtual int on_this_machine() const = 0;
  /// Ends all processes at once, with this exit status: for what only one of them has met.
  [[noreturn]] virtual void abort(int status) const = 0;

  /// Together: the values of all processes, in their order.
  template <class T>
  std::vector<T> gather_values(const std::vector<T>& own) const {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::string all = gather({reinterpret_cast<const char*>(own.data()), own.size() * sizeof(T)});
    std::vector<T> values(all.size() / sizeof(T));
    std::copy(all.begin(), all.end(), reinterpret_cast<char*>(values.data()));
    return values;
  }
  /// Together: gives the value of the first one. \returns it
  template <class T>
  T value_from_first(T value) const {
    static_assert(std::is_trivially_copyable_v<T>);
    from_first(std::as_writable_bytes(std::span(&value, 1)));
    return value;
  }

 protected:
  Ranks(int rank, int size) : rank_(rank), size_(size) {}

 private:
  int rank_, size_;
};

/// This process by itself.
const Ranks& one_process();

/// Elements by the process that they go to.
struct ByRank {
  std::vector<std::vector<std::uint32_t>> of;

  explicit ByRank(const Ranks& ranks) : of(static_cast<std::size_t>(ranks.size())) {}
  void add(int rank, std::size_t element) {
    of[static_cast<std::size_t>(rank)].push_back(static_cast<std::uint32_t>(element));
  }
  std::vector<std::size_t> counts() const {
    std::vector<std::size_t> counts;
    for (const auto& elements : of) counts.push_back(elements.size());
    return counts;
  }
  std::vector<std::uint32_t> all() const {
    std::vector<std::uint32_t> elements;
    for (const auto& some : of) elements.insert(elements.end(), some.begin(), some.end());
    return elements;
  }
};

// Single votes. All are calls together.

bool all_of(const Ranks& ranks, bool vote);
double largest_of(const Ranks& ranks, double vote);
std::uint64_t sum_of(const Ranks& ranks, std::uint64_t vote);
/// What one process reports; the others have an empty report.
NumericalError::Report report_of_one(const Ranks& ranks, NumericalError::Report own);
/// Does what may fail at some processes; then all throw what the first of those has met.
void together(const Ranks& ranks, const std::function<void()>& act);
/// Exact, as sums in fixed point are.
void sum_up(const Ranks& ranks, FixedSums& sums);
void sum_up(const Ranks& ranks, std::span<FixedVector> sums);
/// The same in one message with other votes.
void join(const Ranks& ranks, Votes& votes, std::span<FixedVector> sums);

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
/// The tasks of a direct sum, divided among processes. What they have computed of a row goes to the process that adds
/// it up, in the order of the tasks as one process does, and the velocities of its rows go to all: bitwise identical.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "base/vector.hpp"
#include "ranks/ranks.hpp"

namespace talus::cloud {

/// What a task has computed for the rows from `begin` on, `padding` of them side by side.
struct TaskSums {
  const double* sums;        ///< of the first component
  std::size_t begin;         ///< row
  std::size_t of_component;  ///< from a component to the next
  std::size_t of_rows;       ///< from `padding` rows to the next
};

class SharedTasks {
 public:
  /// Together. \param begin first row of each task, rising \param padded rows, a multiple of `padding`
  /// \param ranks more than one; outlive it
  SharedTasks(const Ranks& ranks, std::vector<std::size_t> begin, std::size_t padded, std::size_t dimensions);

  /// Whether this process computes a task. Processes take them in turn: each has long rows and short ones.
  bool has(std::size_t task) const { return rank_of(task) == ranks_.rank(); }
  /// Rows that this process adds up.
  std::size_t first_row() const { return first_row(ranks_.rank()); }
  std::size_t end_row() const { return first_row(ranks_.rank() + 1); }

  /// Together. \param own sums of the tasks of this process, rising \returns those of all tasks, of the rows that this
  /// process adds up; valid until the next call
  std::vector<TaskSums> collect(ThreadTeam& team, std::span<const TaskSums> own);

  /// Together. \param own velocities of the rows of this process \returns those of all rows
  std::vector<Vector3> share(const std::vector<Vector3>& own) const;

  /// Processor time of messages until now, s.
  double seconds() const { return seconds_; }

 private:
  int rank_of(std::size_t task) const { return static_cast<int>(task % static_cast<std::size_t>(ranks_.size())); }
  std::size_t first_row(int rank) const;
  std::size_t groups(std::size_t task, int rank) const;

  const Ranks& ranks_;
  std::vector<std::size_t> begin_;
  std::size_t padded_, dimensions_;
  std::unique_ptr<Plan> plan_;  // of items: all components of `padding` rows
  std::vector<double> going_, coming_;
  mutable double seconds_ = 0;
};

}  // namespace talus::cloud

// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/pair_sum/shared_tasks.hpp"

#include <algorithm>
#include <utility>

#include "base/system.hpp"
#include "models/cloud/pair_sum/kernel.hpp"

namespace talus::cloud {

SharedTasks::SharedTasks(const Ranks& ranks, std::vector<std::size_t> begin, std::size_t padded, std::size_t dimensions)
    : ranks_(ranks), begin_(std::move(begin)), padded_(padded), dimensions_(dimensions) {
  std::vector<std::size_t> counts(static_cast<std::size_t>(ranks.size()), 0);
  for (int r = 0; r < ranks.size(); ++r)
    for (std::size_t t = 0; t < begin_.size(); ++t)
      if (has(t)) counts[static_cast<std::size_t>(r)] += groups(t, r);
  plan_ = ranks.plan(counts);
  going_.resize(plan_->sent() * dimensions_ * padding);
  coming_.resize(plan_->received() * dimensions_ * padding);
}

std::size_t SharedTasks::first_row(int rank) const {
  return padded_ / padding * static_cast<std::size_t>(rank) / static_cast<std::size_t>(ranks_.size()) * padding;
}

/// How many times `padding` rows of a task a process adds up.
std::size_t SharedTasks::groups(std::size_t task, int rank) const {
  const std::size_t first = std::max(begin_[task], first_row(rank)), end = first_row(rank + 1);
  return first < end ? (end - first) / padding : 0;
}

std::vector<TaskSums> SharedTasks::collect(ThreadTeam& team, std::span<const TaskSums> own) {
  const std::size_t item = dimensions_ * padding;
  struct Move {
    const TaskSums* from;
    std::size_t row, groups, to;
  };
  std::vector<Move> moves;
  std::size_t next = 0;
  for (int r = 0; r < ranks_.size(); ++r) {
    const TaskSums* from = own.data();
    for (std::size_t t = 0; t < begin_.size(); ++t) {
      if (!has(t)) continue;
      moves.push_back({from++, std::max(begin_[t], first_row(r)), groups(t, r), next});
      next += moves.back().groups * item;
    }
  }
  team.run(moves.size(), [&](std::size_t n) {
    const auto& [from, row, count, to] = moves[n];
    for (std::size_t g = 0; g < count; ++g)
      for (std::size_t k = 0; k < dimensions_; ++k)
        std::copy_n(from->sums + k * from->of_component + ((row - from->begin) / padding + g) * from->of_rows, padding,
                    going_.data() + to + g * item + k * padding);
  });
  {
    const Stopwatch watch(seconds_);
    plan_->exchange(going_.data(), item, coming_.data());
  }
  // What comes is in the order of the processes, and of each in that of its tasks.
  std::vector<TaskSums> all(begin_.size());
  next = 0;
  for (int r = 0; r < ranks_.size(); ++r)
    for (std::size_t t = 0; t < begin_.size(); ++t)
      if (rank_of(t) == r) {
        all[t] = {coming_.data() + next, std::max(begin_[t], first_row()), padding, item};
        next += groups(t, ranks_.rank()) * item;
      }
  return all;
}

std::vector<Vector3> SharedTasks::share(const std::vector<Vector3>& own) const {
  const Stopwatch watch(seconds_);
  return ranks_.gather_values(own);
}

}  // namespace talus::cloud

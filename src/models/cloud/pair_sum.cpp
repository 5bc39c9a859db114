// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/pair_sum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "base/error.hpp"
#include "base/instruction_set.hpp"
#include "models/cloud/pair_sum/kernel.hpp"
#include "physics/hydrodynamics/mobility.hpp"

namespace talus::cloud {

namespace {

using hydrodynamics::Mobility;

// Accumulators are as many as tasks, and tasks follow from the number of spheres alone: so do the sums, bitwise.
constexpr std::size_t task_limit = 64;
constexpr std::size_t gather_block = 32 * padding;

SumRows choose(InstructionSet set, const PairSum::Options& options, std::size_t dimensions) {
  const bool single = options.precision == Precision::single_precision;
  return TALUS_COMPILED_FOR(set, sum_rows)(options.mobility, dimensions, single);
}

std::array<double Vector3::*, 3> axes(Motion motion) {
  if (motion == Motion::xz) return {&Vector3::x, &Vector3::z, &Vector3::y};
  return {&Vector3::x, &Vector3::y, &Vector3::z};
}

}  // namespace

PairSum::PairSum(const Options& options, std::span<const double> radius, std::span<const std::uint32_t> order,
                 const Ranks& ranks)
    : options_(options),
      instruction_set_(resolve(options.instruction_set)),
      dimensions_(options.motion == Motion::xyz ? 3 : 2),
      axis_(axes(options.motion)),
      radius_(radius.begin(), radius.end()),
      padded_((radius.size() + padding - 1) / padding * padding) {
  if (options.mobility != Mobility::none && !radius_.empty()) {
    sum_rows_ = choose(instruction_set_, options, dimensions_);
    length_ = std::exp2(std::floor(std::log2(*std::max_element(radius_.begin(), radius_.end()))));
    packed_.assign(padded_ * (2 * dimensions_ + 2), 0.0);
    divide_into_tasks(ranks);
  }
  reorder(order);
}

std::size_t PairSum::max_tasks(std::size_t spheres) {
  return std::min(((spheres + task_rows - 1) / task_rows + 1) / 2, task_limit);
}

// Tasks of about the same number of pairs: the first rows have the most columns.
void PairSum::divide_into_tasks(const Ranks& ranks) {
  const std::size_t steps = (size() + task_rows - 1) / task_rows;
  const std::size_t tasks = max_tasks(size());
  std::size_t begin = 0;
  for (std::size_t t = 1; t <= tasks; ++t) {
    const double rest = std::sqrt(static_cast<double>(tasks - t) / static_cast<double>(tasks));
    const std::size_t end = steps - static_cast<std::size_t>(std::lround(rest * static_cast<double>(steps)));
    if (end * task_rows <= begin) continue;
    tasks_.push_back({begin, end * task_rows, 0, true});
    begin = end * task_rows;
  }
  if (!ranks.is_alone()) {
    std::vector<std::size_t> first;
    for (const Task& task : tasks_) first.push_back(task.begin);
    shared_ = std::make_unique<SharedTasks>(ranks, std::move(first), padded_, dimensions_);
    for (std::size_t t = 0; t < tasks_.size(); ++t) tasks_[t].is_here = shared_->has(t);
  }
  std::size_t offset = 0;
  for (Task& task : tasks_) {
    task.offset = offset;
    if (task.is_here) offset += (padded_ - task.begin) * dimensions_;
  }
  sums_.resize(offset);
}

void PairSum::reorder(std::span<const std::uint32_t> order) {
  std::vector<std::uint32_t> straight(size());
  std::iota(straight.begin(), straight.end(), 0u);
  if (order.empty()) {
    order_ = straight;
  } else {
    std::vector<std::uint32_t> sorted(order.begin(), order.end());
    std::sort(sorted.begin(), sorted.end());
    require(sorted == straight, "the order is no permutation of the spheres");
    order_.assign(order.begin(), order.end());
  }
  if (!sum_rows_) return;
  double *const radius_column = column(2 * dimensions_), *const size_column = column(2 * dimensions_ + 1);
  for (std::size_t n = 0; n < size(); ++n) {
    const double a = radius_[order_[n]] / length_;
    radius_column[n] = a;
    size_column[n] =
        options_.mobility == Mobility::zuk_2014 ? hydrodynamics::shared_size(a) : hydrodynamics::source_size(a);
  }
}

void PairSum::pack(ThreadTeam& team, std::span<const Vector3> position, std::span<const Vector3> force) {
  const double per_length = 1 / length_;
  const double speed_per_force = 1 / (8 * std::numbers::pi * options_.viscosity * length_);
  for_each(team, size(), [&](std::size_t n) {
    for (std::size_t k = 0; k < dimensions_; ++k) {
      column(k)[n] = position[order_[n]].*axis_[k] * per_length;
      column(dimensions_ + k)[n] = force[order_[n]].*axis_[k] * speed_per_force;
    }
  });
  // The padding lies beyond all spheres along the first axis, farther off and apart than two radii (each below 2).
  double* const x = column(0);
  const double beyond = *std::max_element(x, x + size()) + 8;
  for (std::size_t n = size(); n < padded_; ++n) {
    x[n] = beyond + 8 * static_cast<double>(n - size());
    for (std::size_t k = 1; k < dimensions_; ++k) column(k)[n] = column(k)[0];
  }
}

/// What the tasks of this process have computed.
std::vector<TaskSums> PairSum::computed() const {
  std::vector<TaskSums> here;
  for (const Task& task : tasks_)
    if (task.is_here) here.push_back({sums_.data() + task.offset, task.begin, padded_ - task.begin, padding});
  return here;
}

/// Sums over the tasks, in their order, for rows that are spheres. \param take (row, sum of each component)
template <class Take>
void PairSum::add_tasks(ThreadTeam& team, std::span<const TaskSums> tasks, std::size_t first, std::size_t end,
                        Take&& take) const {
  // Of component k for the `padding` rows from `begin`.
  auto add = [&](std::size_t k, std::size_t begin, double* result) {
    double sum[padding] = {};
    for (const TaskSums& task : tasks) {
      if (task.begin > begin) break;
      const double* const part = task.sums + k * task.of_component + (begin - task.begin) / padding * task.of_rows;
      for (std::size_t n = 0; n < padding; ++n) sum[n] += part[n];
    }
    std::copy(sum, sum + padding, result);
  };
  team.run((end - first + gather_block - 1) / gather_block, [&](std::size_t block) {
    const std::size_t last = std::min(first + (block + 1) * gather_block, end);
    for (std::size_t begin = first + block * gather_block; begin < last; begin += padding) {
      double sum[3][padding] = {};
      for (std::size_t k = 0; k < dimensions_; ++k) add(k, begin, sum[k]);
      for (std::size_t n = 0; n < padding && begin + n < size(); ++n)
        take(begin + n, Vector3{sum[0][n], sum[1][n], sum[2][n]});
    }
  });
}

void PairSum::velocities(ThreadTeam& team, std::span<const Vector3> position, std::span<const Vector3> force,
                         std::span<Vector3> velocity) {
  require(position.size() == size() && force.size() == size() && velocity.size() == size(),
          "positions, forces and velocities have not one entry a sphere");
  if (!sum_rows_) {
    std::fill(velocity.begin(), velocity.end(), Vector3{});
    return;
  }
  pack(team, position, force);
  PackedSpheres spheres{
      .count = size(), .padded = padded_, .radius = column(2 * dimensions_), .size = column(2 * dimensions_ + 1)};
  for (std::size_t k = 0; k < dimensions_; ++k)
    spheres.position[k] = column(k), spheres.force[k] = column(dimensions_ + k);
  team.run(tasks_.size(), [&](std::size_t t) {
    const Task& task = tasks_[t];
    if (!task.is_here) return;
    double* sums[3] = {};
    for (std::size_t k = 0; k < dimensions_; ++k) sums[k] = sums_.data() + task.offset + k * (padded_ - task.begin);
    sum_rows_(spheres, task.begin, task.end, sums);
  });
  const auto put = [&](std::size_t row, const Vector3& sum) {
    for (std::size_t k = 0; k < 3; ++k) velocity[order_[row]].*axis_[k] = sum[static_cast<int>(k)];
  };
  if (!shared_) return add_tasks(team, computed(), 0, padded_, put);
  const std::size_t first = shared_->first_row(), end = shared_->end_row();
  std::vector<Vector3> own(std::min(end, size()) - std::min(first, size()));
  add_tasks(team, shared_->collect(team, computed()), first, end,
            [&](std::size_t row, const Vector3& sum) { own[row - first] = sum; });
  const std::vector<Vector3> all = shared_->share(own);
  for_each(team, size(), [&](std::size_t row) { put(row, all[row]); });
}

}  // namespace talus::cloud

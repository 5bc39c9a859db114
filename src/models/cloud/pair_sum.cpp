// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/pair_sum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace talus::cloud {

namespace {

using hydrodynamics::Mobility;

// Accumulators are as many as tasks, and tasks follow from the number of spheres alone: so do the bits of the sums.
constexpr std::size_t most_tasks = 64;
constexpr std::size_t gather_block = 512;

SumRows choose(InstructionSet set, const PairSum::Options& options, int dimensions) {
  const bool single = options.precision == Precision::single_precision;
  switch (set) {
#if defined(__x86_64__)
    case InstructionSet::avx512:
      return sum_rows_avx512(options.mobility, dimensions, single);
    case InstructionSet::avx2:
      return sum_rows_avx2(options.mobility, dimensions, single);
#endif
    default:
      return sum_rows_portable(options.mobility, dimensions, single);
  }
}

std::array<double Vector3::*, 3> axes(Motion motion) {
  if (motion == Motion::xz) return {&Vector3::x, &Vector3::z, &Vector3::y};
  return {&Vector3::x, &Vector3::y, &Vector3::z};
}

double power_of_two_below(double x) {
  return x > 0 ? std::exp2(std::floor(std::log2(x))) : 1.0;
}

void require(bool condition, const char* what) {
  if (!condition) throw std::invalid_argument(what);
}

}  // namespace

PairSum::PairSum(const Options& options, std::span<const double> radius, std::span<const std::uint32_t> order)
    : options_(options),
      instruction_set_(resolve(options.instruction_set)),
      dimensions_(options.motion == Motion::xyz ? 3 : 2),
      axis_(axes(options.motion)),
      radius_(radius.begin(), radius.end()) {
  if (options.mobility == Mobility::none || radius_.empty()) return;
  sum_rows_ = choose(instruction_set_, options, dimensions_);
  length_ = power_of_two_below(*std::max_element(radius_.begin(), radius_.end()));
  speed_per_force_ = 1.0 / (8.0 * std::numbers::pi * options.viscosity * length_);

  const std::size_t count = radius_.size();
  const std::size_t padded = (count + padding - 1) / padding * padding;
  packed_.assign(padded * (2 * static_cast<std::size_t>(dimensions_) + 1), 0.0);
  spheres_.count = count;
  spheres_.padded = padded;
  double* column = packed_.data();
  for (int k = 0; k < dimensions_; ++k, column += padded) spheres_.position[k] = column;
  for (int k = 0; k < dimensions_; ++k, column += padded) spheres_.force[k] = column;
  spheres_.radius = column;

  // Tasks of about the same number of pairs: the first rows have the most columns.
  const std::size_t steps = (count + task_rows - 1) / task_rows;
  const std::size_t tasks = std::min((steps + 1) / 2, most_tasks);
  std::size_t begin = 0, offset = 0;
  for (std::size_t t = 1; t <= tasks; ++t) {
    const double share = 1 - std::sqrt(1 - static_cast<double>(t) / static_cast<double>(tasks));
    const std::size_t end =
        t == tasks ? steps : static_cast<std::size_t>(std::lround(share * static_cast<double>(steps)));
    if (end * task_rows <= begin) continue;
    tasks_.push_back({begin, end * task_rows, offset});
    offset += (padded - begin) * static_cast<std::size_t>(dimensions_);
    begin = end * task_rows;
  }
  sums_.resize(offset);
  reorder(order);
}

void PairSum::reorder(std::span<const std::uint32_t> order) {
  require(order.empty() || order.size() == radius_.size(), "the order has not one entry a sphere");
  order_.resize(radius_.size());
  if (order.empty())
    std::iota(order_.begin(), order_.end(), 0u);
  else
    order_.assign(order.begin(), order.end());
  if (!sum_rows_) return;
  double* radius = packed_.data() + 2 * static_cast<std::size_t>(dimensions_) * spheres_.padded;
  for (std::size_t n = 0; n < order_.size(); ++n) radius[n] = radius_[order_[n]] / length_;
}

void PairSum::pack(ThreadTeam& team, std::span<const Vector3> position, std::span<const Vector3> force) {
  const std::size_t padded = spheres_.padded, count = spheres_.count;
  double* const x = packed_.data();
  double* const f = x + static_cast<std::size_t>(dimensions_) * padded;
  const double per_length = 1 / length_;
  for_each(team, count, [&](std::size_t n) {
    const Vector3& position_n = position[order_[n]];
    const Vector3& force_n = force[order_[n]];
    for (std::size_t k = 0; k < static_cast<std::size_t>(dimensions_); ++k) {
      x[k * padded + n] = position_n.*axis_[k] * per_length;
      f[k * padded + n] = force_n.*axis_[k] * speed_per_force_;
    }
  });
  // Beside the last sphere along the first axis by more than any two radii.
  const double beyond = *std::max_element(x, x + count) + 8;
  for (std::size_t n = count; n < padded; ++n) {
    x[n] = beyond + 8 * static_cast<double>(n - count);
    for (std::size_t k = 1; k < static_cast<std::size_t>(dimensions_); ++k) x[k * padded + n] = x[k * padded];
  }
}

void PairSum::gather(ThreadTeam& team, std::span<Vector3> velocity) const {
  const std::size_t count = spheres_.count, padded = spheres_.padded;
  constexpr std::size_t width = padding;
  // Sums of column k over the tasks, for the spheres of one width from `begin`.
  auto add_tasks = [&](std::size_t k, std::size_t begin, double* result) {
    double sum[width] = {};
    for (const Task& task : tasks_) {
      if (task.begin > begin) break;
      const double* part = sums_.data() + task.offset + k * (padded - task.begin) + (begin - task.begin);
      for (std::size_t n = 0; n < width; ++n) sum[n] += part[n];
    }
    for (std::size_t n = 0; n < width; ++n) result[n] = sum[n];
  };
  team.run((padded + gather_block - 1) / gather_block, [&](std::size_t block) {
    const std::size_t end = std::min((block + 1) * gather_block, padded);
    for (std::size_t begin = block * gather_block; begin < end; begin += width) {
      double sum[3][width] = {};
      for (int k = 0; k < dimensions_; ++k) add_tasks(k, begin, sum[k]);
      for (std::size_t n = 0; n < width && begin + n < count; ++n) {
        Vector3& v = velocity[order_[begin + n]];
        for (std::size_t k = 0; k < 3; ++k) v.*axis_[k] = sum[k][n];
      }
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
  team.run(tasks_.size(), [&](std::size_t t) {
    const Task& task = tasks_[t];
    const std::size_t length = spheres_.padded - task.begin;
    double* columns[3] = {};
    for (std::size_t k = 0; k < static_cast<std::size_t>(dimensions_); ++k) {
      columns[k] = sums_.data() + task.offset + k * length;
    }
    sum_rows_(spheres_, task.begin, task.end, columns);
  });
  gather(team, velocity);
}

}  // namespace talus::cloud

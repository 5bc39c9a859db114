// SPDX-License-Identifier: Apache-2.0
/// Which grains are near each other: the graph of all pairs of centres closer than a distance, and its connected sets.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vector.hpp"

namespace talus {

/// Indices of some grains of all.
using GrainSet = std::vector<std::uint32_t>;

class Links {
 public:
  /// \param position centres, finite, m; not kept
  /// \param reach grains i and j are linked if |r_i - r_j| < reach and i is not j; > 0, m
  /// \throws std::invalid_argument as CellGrid
  Links(std::span<const Vector3> position, double reach);

  std::size_t size() const { return first_.size() - 1; }

  /// The grains linked to i, by index.
  std::span<const std::uint32_t> of(std::size_t i) const {
    return std::span(others_).subspan(first_[i], first_[i + 1] - first_[i]);
  }

  /// The connected sets of those grains that take part, each by index, in the order of their first grains.
  /// \param takes_part one entry per grain
  std::vector<GrainSet> connected_sets(const std::vector<bool>& takes_part) const;

 private:
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> others_;
};

/// The set with the most grains; of equal ones the one whose foremost grain is farther down (x). Empty if there is
/// none.
GrainSet max_set(std::vector<GrainSet> sets, std::span<const Vector3> position);

/// True if a has more grains than b, or as many and its foremost grain is farther down. Neither is empty.
bool is_larger(const GrainSet& a, const GrainSet& b, std::span<const Vector3> position);

}  // namespace talus

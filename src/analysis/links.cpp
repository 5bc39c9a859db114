// SPDX-License-Identifier: Apache-2.0
#include "analysis/links.hpp"

#include <algorithm>

#include "numerics/cell_grid.hpp"

namespace talus {

namespace {

double foremost(const GrainSet& set, std::span<const Vector3> position) {
  double x = position[set.front()].x;
  for (const std::uint32_t i : set) x = std::max(x, position[i].x);
  return x;
}

}  // namespace

Links::Links(std::span<const Vector3> position, double reach) : first_(1, 0) {
  const CellGrid grid(position, reach);
  for (std::size_t i = 0; i < position.size(); ++i) {
    grid.for_each_candidate(position[i], [&](std::uint32_t j) {
      const Vector3 d = position[i] - position[j];
      if (j != i && dot(d, d) < reach * reach) others_.push_back(j);
    });
    std::sort(others_.begin() + static_cast<std::ptrdiff_t>(first_.back()), others_.end());
    first_.push_back(others_.size());
  }
}

std::vector<GrainSet> Links::connected_sets(const std::vector<bool>& takes_part) const {
  std::vector<GrainSet> sets;
  std::vector<bool> open = takes_part;
  for (std::uint32_t start = 0; start < size(); ++start) {
    if (!open[start]) continue;
    GrainSet set = {start};
    open[start] = false;
    for (std::size_t n = 0; n < set.size(); ++n)
      for (const std::uint32_t j : of(set[n]))
        if (open[j]) {
          open[j] = false;
          set.push_back(j);
        }
    std::sort(set.begin(), set.end());
    sets.push_back(std::move(set));
  }
  return sets;
}

bool is_larger(const GrainSet& a, const GrainSet& b, std::span<const Vector3> position) {
  return a.size() != b.size() ? a.size() > b.size() : foremost(a, position) > foremost(b, position);
}

GrainSet max_set(std::vector<GrainSet> sets, std::span<const Vector3> position) {
  const auto largest = std::min_element(
      sets.begin(), sets.end(), [&](const GrainSet& a, const GrainSet& b) { return is_larger(a, b, position); });
  return largest == sets.end() ? GrainSet{} : std::move(*largest);
}

}  // namespace talus

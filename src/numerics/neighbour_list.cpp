// SPDX-License-Identifier: Apache-2.0
#include "numerics/neighbour_list.hpp"

#include <algorithm>

#include "numerics/cell_grid.hpp"

namespace talus {

void NeighbourList::build(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> radius,
                          double skin) {
  const std::size_t count = position.size();
  reference_.assign(position.begin(), position.end());
  skin_ = skin;
  neighbours_.clear();
  first_.assign(count + 1, 0);
  if (count == 0) return;

  const double largest = *std::max_element(radius.begin(), radius.end());
  const CellGrid grid(position, 2 * largest + skin);
  auto for_each_neighbour = [&](std::size_t i, auto&& visit) {
    grid.for_each_candidate(position[i], [&](std::uint32_t j) {
      const Vector3 d = position[i] - position[j];
      const double reach = radius[i] + radius[j] + skin;
      if (j != i && dot(d, d) <= reach * reach) visit(j);
    });
  };

  for_each(team, count, [&](std::size_t i) { for_each_neighbour(i, [&](std::uint32_t) { ++first_[i + 1]; }); });
  for (std::size_t i = 0; i < count; ++i) first_[i + 1] += first_[i];
  neighbours_.resize(first_[count]);
  for_each(team, count, [&](std::size_t i) {
    std::size_t n = first_[i];
    for_each_neighbour(i, [&](std::uint32_t j) { neighbours_[n++] = j; });
    std::sort(neighbours_.begin() + static_cast<std::ptrdiff_t>(first_[i]),
              neighbours_.begin() + static_cast<std::ptrdiff_t>(first_[i + 1]));
  });
}

bool NeighbourList::holds(ThreadTeam& team, std::span<const Vector3> position) const {
  if (skin_ < 0 || reference_.size() != position.size() || position.empty()) return false;
  // Distances between points do not change when all move together: only what exceeds the mean motion counts.
  const Vector3 mean = (1.0 / static_cast<double>(position.size())) *
                       reduce(
                           team, position.size(), Vector3{}, [&](std::size_t i) { return position[i] - reference_[i]; },
                           [](const Vector3& a, const Vector3& b) { return a + b; });
  const double limit = 0.25 * skin_ * skin_;
  return reduce(
      team, position.size(), true,
      [&](std::size_t i) {
        const Vector3 d = position[i] - reference_[i] - mean;
        return dot(d, d) <= limit;
      },
      [](bool a, bool b) { return a && b; });
}

}  // namespace talus

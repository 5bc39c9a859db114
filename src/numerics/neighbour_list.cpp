// SPDX-License-Identifier: Apache-2.0
#include "numerics/neighbour_list.hpp"

#include <algorithm>

#include "numerics/cell_grid.hpp"

namespace talus {

void NeighbourList::build(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> radius,
                          double skin, std::size_t count, const Keep& keep) {
  reference_.assign(position.begin(), position.end());
  skin_ = skin;
  neighbours_.clear();
  first_.assign(count + 1, 0);
  if (count == 0) return;

  const double largest = *std::max_element(radius.begin(), radius.end());
  const CellGrid grid(position, 2 * largest + skin);
  const std::size_t chunks = (count + chunk_size - 1) / chunk_size;
  std::vector<std::vector<std::uint32_t>> found(chunks);
  team.run(chunks, [&](std::size_t chunk) {
    std::vector<std::uint32_t>& list = found[chunk];
    for (std::size_t i = chunk * chunk_size; i < std::min(count, (chunk + 1) * chunk_size); ++i) {
      const auto begin = static_cast<std::ptrdiff_t>(list.size());
      grid.for_each_candidate(position[i], [&](std::uint32_t j) {
        const Vector3 d = position[i] - position[j];
        const double reach = radius[i] + radius[j] + skin;
        if (dot(d, d) <= reach * reach && j != i && (!keep || keep(i, j))) list.push_back(j);
      });
      std::sort(list.begin() + begin, list.end());
      first_[i + 1] = list.size() - static_cast<std::size_t>(begin);
    }
  });
  for (std::size_t i = 0; i < count; ++i) first_[i + 1] += first_[i];
  neighbours_.reserve(first_[count]);
  for (const auto& list : found) neighbours_.insert(neighbours_.end(), list.begin(), list.end());
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

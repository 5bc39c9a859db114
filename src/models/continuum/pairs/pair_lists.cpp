// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/pairs/pair_lists.hpp"

#include <algorithm>
#include <bit>

namespace talus::continuum {

void PairLists::build(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> smoothing_length,
                      std::span<const double> margin, const PartOfPoints& part) {
  // Two particles interact within the sum of their smoothing lengths: twice their mean.
  neighbourhood_.build(team, position, smoothing_length, margin, part);
  loads_of_images_.clear();
  for (const Image& image : neighbourhood_.images()) loads_of_images_.push_back(neighbourhood_.domain().loads(image));
  find_groups();
}

/// Where each group of a particle's neighbours ends: particles first, then images by mirror, as the lists are sorted.
void PairLists::find_groups() {
  const auto ghosts = neighbourhood_.ghosts();
  const std::size_t count = neighbourhood_.particles();
  std::vector<std::size_t> end(neighbourhood_.images().size());  // of the ghosts of each image, which follow each other
  for (std::size_t g = 0; g < ghosts.size(); ++g) end[ghosts[g].image] = count + g + 1;
  std::vector<char> is_listed(ghosts.size(), 0);
  groups_.clear();
  max_neighbours_ = 1;
  first_group_.assign(1, 0);
  loads_.clear();
  first_load_.assign(1, 0);
  walls_.clear();
  first_wall_.assign(1, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const auto neighbours = neighbourhood_.of(i);
    max_neighbours_ = std::max(max_neighbours_, neighbours.size());
    groups_.push_back({static_cast<std::uint32_t>(neighbourhood_.first_ghost_of(i)), -1});
    std::uint32_t walls = 0;
    std::size_t group_end = count;
    for (std::size_t n = neighbourhood_.first_ghost_of(i); n < neighbours.size(); ++n) {
      if (neighbours[n] >= group_end) {
        const std::uint32_t image = ghosts[neighbours[n] - count].image;
        groups_.push_back({0, static_cast<std::int32_t>(image)});
        group_end = end[image];
        for (const Domain::Load& load : loads_of_images_[image])
          if (load.wall >= 0) walls |= 1u << load.wall;
      }
      groups_.back().end = static_cast<std::uint32_t>(n + 1);
      is_listed[neighbours[n] - count] = 1;
    }
    add_loads(std::span(groups_).subspan(first_group_.back()), walls, loads_);
    first_group_.push_back(static_cast<std::uint32_t>(groups_.size()));
    first_load_.push_back(static_cast<std::uint32_t>(loads_.size()));
    walls_.push_back(walls);
    first_wall_.push_back(first_wall_.back() + static_cast<std::uint32_t>(std::popcount(walls)));
  }
  // Ghosts within the reach of a few that reach far are near nobody.
  packed_ghosts_.clear();
  for (std::size_t g = 0; g < ghosts.size(); ++g)
    if (is_listed[g]) packed_ghosts_.push_back(static_cast<std::uint32_t>(g));
}

/// Which neighbours load which wall. \param walls a bit for each that the images of the groups load
void PairLists::add_loads(std::span<const NeighbourGroup> groups, std::uint32_t walls,
                          std::vector<WallLoad>& loads) const {
  for (std::size_t g = 1; g < groups.size(); ++g)
    for (const Domain::Load& load : loads_of_images_[static_cast<std::size_t>(groups[g].image)]) {
      if (load.wall < 0) break;
      const auto slot = static_cast<std::uint8_t>(std::popcount(walls & ((1u << load.wall) - 1)));
      for (int axis = 0; axis < 3; ++axis)
        for (std::uint32_t n = groups[g - 1].end; load.part[axis] != 0 && n < groups[g].end;) {
          const std::uint32_t first = n / WallLoad::block * WallLoad::block;
          const std::uint32_t end = std::min(groups[g].end, first + WallLoad::block);
          loads.push_back({first, static_cast<std::uint8_t>(n - first), static_cast<std::uint8_t>(end - first),
                           static_cast<std::uint8_t>(axis), slot, load.part[axis]});
          n = end;
        }
    }
}

Neighbours PairLists::visible_from(std::span<const Vector3> position, std::size_t i, Visible& memory) const {
  const std::size_t lines = 3 * ((max_neighbours_ + Neighbours::padded_to - 1) / Neighbours::padded_to);
  if (memory.scratch.size() < lines) memory.scratch.resize(lines);
  Neighbours found{neighbourhood_.of(i).data(),
                   groups_.data() + first_group_[i],
                   static_cast<int>(first_group_[i + 1] - first_group_[i]),
                   loads_.data() + first_load_[i],
                   static_cast<int>(first_load_[i + 1] - first_load_[i]),
                   static_cast<int>(first_wall_[i + 1] - first_wall_[i]),
                   memory.scratch.front().number,
                   static_cast<std::uint32_t>(Neighbours::padded_to * lines)};
  if (neighbourhood_.sight_may_change(i)) pick_visible(position, i, memory, found);
  return found;
}

void PairLists::pick_visible(std::span<const Vector3> position, std::size_t i, Visible& memory,
                             Neighbours& found) const {
  static constexpr Image identity;
  const std::uint32_t* const neighbours = found.record;
  const NeighbourGroup* const group = found.group;
  const std::span<const char> in_doubt = neighbourhood_.in_doubt(i);
  const auto place = [&](std::size_t record, const Image& image) {
    if (record < position.size()) return position[record];
    return image.position(position[neighbourhood_.ghosts()[record - position.size()].source]);
  };
  memory.record.clear();
  memory.group.clear();
  std::uint32_t n = 0;
  for (int g = 0; g < found.groups; ++g) {
    const Image& image =
        group[g].image < 0 ? identity : neighbourhood_.images()[static_cast<std::size_t>(group[g].image)];
    for (; n < group[g].end; ++n)
      if (!in_doubt[n] || neighbourhood_.domain().is_visible(position[i], place(neighbours[n], image), image))
        memory.record.push_back(neighbours[n]);
    memory.group.push_back({static_cast<std::uint32_t>(memory.record.size()), group[g].image});
  }
  while (memory.record.size() % Neighbours::padded_to != 0)
    memory.record.push_back(static_cast<std::uint32_t>(position.size() + neighbourhood_.ghosts().size()));
  found.record = memory.record.data();
  found.group = memory.group.data();
  memory.load.clear();
  add_loads(memory.group, walls_[i], memory.load);
  found.load = memory.load.data();
  found.loads = static_cast<int>(memory.load.size());
}

}  // namespace talus::continuum

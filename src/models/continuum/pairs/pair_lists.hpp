// SPDX-License-Identifier: Apache-2.0
/// Verlet lists of the pair sums: the neighbours of each particle, its images behind boundaries among them, in groups
/// by image; which walls these images load; and which neighbours are visible at present.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "models/continuum/pairs/kernels/kernel.hpp"
#include "numerics/geometry/domain.hpp"
#include "numerics/neighbourhood.hpp"
#include "numerics/surface/surface.hpp"

namespace talus::continuum {

class PairLists {
 public:
  /// \param domain, vessel outlive the lists
  PairLists(const Domain& domain, const Surface& vessel) : neighbourhood_(domain, vessel) {}

  /// \param margin by which a particle may move and grow while the lists hold, m
  void build(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> smoothing_length,
             std::span<const double> margin, const PartOfPoints& part = {});

  const Neighbourhood& neighbourhood() const { return neighbourhood_; }

  /// Memory of `visible_from`, one for each thread.
  struct Visible {
    struct alignas(64) Line {
      std::byte number[Neighbours::padded_to * sizeof(double)];
    };
    std::vector<Line> scratch;
    std::vector<std::uint32_t> record;
    std::vector<NeighbourGroup> group;
    std::vector<WallLoad> load;
  };
  /// The visible neighbours of a particle. Near a wall, where that can change while the lists hold, they are picked
  /// into `memory`.
  Neighbours visible_from(std::span<const Vector3> position, std::size_t i, Visible& memory) const;

  /// Of each particle the walls that its images load, a bit each, and where their values begin (WallAccelerations).
  const std::vector<std::uint32_t>& walls() const { return walls_; }
  const std::vector<std::uint32_t>& first_wall() const { return first_wall_; }
  /// What an image loads.
  const std::array<Domain::Load, 3>& loads_of(std::int32_t image) const {
    return loads_of_images_[static_cast<std::size_t>(image)];
  }
  /// The images that need records: those in a list.
  std::span<const std::uint32_t> packed_ghosts() const { return packed_ghosts_; }

 private:
  void find_groups();
  void add_loads(std::span<const NeighbourGroup> groups, std::uint32_t walls, std::vector<WallLoad>& loads) const;
  void pick_visible(std::span<const Vector3> position, std::size_t i, Visible& memory, Neighbours& found) const;

  Neighbourhood neighbourhood_;
  std::vector<std::array<Domain::Load, 3>> loads_of_images_;
  std::vector<std::uint32_t> packed_ghosts_;
  std::vector<NeighbourGroup> groups_;      // of every particle's neighbours, one particle after the other
  std::size_t max_neighbours_ = 1;          // list of neighbours
  std::vector<std::uint32_t> first_group_;  // of a particle; one more than particles
  std::vector<WallLoad> loads_;             // of every particle's neighbours
  std::vector<std::uint32_t> first_load_;   // of a particle; one more than particles
  std::vector<std::uint32_t> walls_, first_wall_;
};

}  // namespace talus::continuum

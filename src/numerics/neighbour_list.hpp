// SPDX-License-Identifier: Apache-2.0
/// Verlet list of the pairs that may touch: all j with |x_i - x_j| <= a_i + a_j + skin at the reference positions.
/// The list holds as long as no particle has moved farther than half the skin against the mean of all. Each particle's
/// neighbours are sorted by their number, so a sum over them does not depend on when the list was built.
#pragma once

#include <cstdint>
#include <functional>
#include <numeric>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "base/vector.hpp"

namespace talus {

class NeighbourList {
 public:
  /// Builds a full list (each pair appears twice).
  /// \param position, radius in m, one entry per particle; \param skin >= 0, in m
  void build(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> radius, double skin) {
    build(team, position, radius, skin, position.size(), nullptr);
    skin_ = skin;
    reference_.assign(position.begin(), position.end());
  }

  /// The same, with neighbours among all for the first `listed` particles only: those behind them are ghosts. Notes no
  /// reference positions: such a list never holds by itself.
  /// \param keep moves those of the particles near i that i may ever interact with to the front, in their order, and
  /// returns how many they are; none: all stay
  using Keep = std::function<std::size_t(std::size_t i, std::span<std::uint32_t> near)>;
  /// \param without_list of each of the first, whether it is left with an empty list; empty: none is
  void build(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> radius, double skin,
             std::size_t listed, const Keep& keep, std::span<const char> without_list = {});

  /// True if every particle, less the mean displacement of all, is within half the skin of where the list was built,
  /// so that no touching pair is missing.
  /// False for a position that is not finite.
  bool holds(ThreadTeam& team, std::span<const Vector3> position) const;

  std::span<const std::uint32_t> of(std::size_t i) const { return {neighbours_.data() + first_[i], length_[i]}; }

  std::size_t pairs() const { return std::accumulate(length_.begin(), length_.end(), std::size_t{0}); }

  /// Behind each list the number of all points stands until a multiple of `padded_to` is reached, so that whole
  /// registers can be read.
  static constexpr std::size_t padded_to = 16;

  /// Lists are found cell by cell, and then lie by number, as sums go through them. Only those of an eighth of the
  /// points, and of so many at least, are found at once, and take memory twice.
  static constexpr std::size_t found_at_once = std::size_t{1} << 14;

 private:
  double skin_ = -1;
  std::vector<Vector3> reference_;
  std::vector<std::uint32_t> neighbours_;
  std::vector<std::size_t> first_;  // a multiple of `padded_to`
  std::vector<std::uint32_t> length_;
  std::vector<std::vector<std::uint32_t>> found_;  // by cells, while lists are built; kept for its memory
};

}  // namespace talus

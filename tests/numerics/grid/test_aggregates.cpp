// SPDX-License-Identifier: Apache-2.0
#include "numerics/grid/aggregates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

namespace talus {
namespace {

/// A board whose cells are open to each other unless a wall stands between their centres.
struct Walled {
  Checkerboard board;
  std::array<std::vector<float>, 3> low;

  /// \param side of a cell: those of one side are open to each other
  template <class Side>
  Walled(std::array<int, 3> count, Side&& side) : board(count, {false, false, false}) {
    for (auto& faces : low) faces.assign(board.size(), 0);
    for (int k = 0; k < count[2]; ++k)
      for (int j = 0; j < count[1]; ++j)
        for (int i = 0; i < count[0]; ++i) {
          const int own = side(i, j, k);
          if (i > 0 && side(i - 1, j, k) == own) low[0][board.at(i, j, k)] = 1;
          if (j > 0 && side(i, j - 1, k) == own) low[1][board.at(i, j, k)] = 1;
          if (k > 0 && side(i, j, k - 1) == own) low[2][board.at(i, j, k)] = 1;
        }
  }

  std::array<const float*, 3> faces() const { return {low[0].data(), low[1].data(), low[2].data()}; }
};

Checkerboard half(const std::array<int, 3>& count) {
  return Checkerboard({(count[0] + 1) / 2, (count[1] + 1) / 2, (count[2] + 1) / 2}, {false, false, false});
}

Aggregates aggregates(const Walled& fine) {
  return find_aggregates(fine.board, fine.faces(), half(fine.board.count()), {2, 2, 2});
}

TEST(Aggregates, AreEmptyWhereNoWallPartsJoinedCells) {
  const auto anywhere = [](int, int, int) { return 0; };
  EXPECT_TRUE(aggregates({{6, 6, 6}, anywhere}).empty());
  EXPECT_TRUE(aggregates({{6, 6, 6}, [](int, int, int k) { return k < 4 ? 0 : 1; }}).empty());
}

TEST(Aggregates, OfAWallBetweenJoinedCellsHaveThreeLayersAndOne) {
  // The wall stands below the fourth layer, so that it parts the second pair.
  const Walled fine({4, 4, 8}, [](int, int, int k) { return k < 3 ? 0 : 1; });
  const Checkerboard coarse = half({4, 4, 8});
  const Aggregates found = aggregates(fine);
  std::map<std::uint32_t, std::size_t> cells, faces;
  for (std::size_t list = 0; list < found.cells.place.size(); ++list)
    cells[found.cells.place[list]] = found.cells.begin[list + 1] - found.cells.begin[list];
  for (std::size_t list = 0; list < found.faces[2].place.size(); ++list)
    faces[found.faces[2].place[list]] = found.faces[2].begin[list + 1] - found.faces[2].begin[list];
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      EXPECT_EQ(cells.at(static_cast<std::uint32_t>(coarse.at(i, j, 1))), 4u);   // the layer below the wall
      EXPECT_EQ(cells.at(static_cast<std::uint32_t>(coarse.at(i, j, 2))), 12u);  // the three above it
      EXPECT_EQ(faces.at(static_cast<std::uint32_t>(coarse.at(i, j, 2))), 0u);   // no face leads through the wall
    }
  // Red ones of the 16 cells in the fourth layer.
  EXPECT_EQ(found.moved.size(), 8u);
  for (const auto& m : found.moved) EXPECT_NE(m.coarse, m.coarse_beside);
}

TEST(Aggregates, NeverJoinBothSidesOfAConeNorLeadThroughIt) {
  const auto side = [](int i, int j, int k) { return std::hypot(i - 11.5, j - 11.5) < 3 + 0.6 * k ? 1 : 0; };
  const std::array count{24, 24, 24};
  const Walled fine(count, side);
  const Checkerboard coarse_board = half(count);
  const Aggregates found = aggregates(fine);
  ASSERT_FALSE(found.empty());
  // Sides of the coarse cells: of those with lists by their parts, of the others by any of their cells.
  std::map<std::uint32_t, int> side_of_place;
  for (int k = 0; k < 24; ++k)
    for (int j = 0; j < 24; ++j)
      for (int i = 0; i < 24; ++i) side_of_place[static_cast<std::uint32_t>(fine.board.at(i, j, k))] = side(i, j, k);
  std::map<std::uint32_t, int> side_of_coarse;
  std::size_t parts = 0;
  for (std::size_t list = 0; list < found.cells.place.size(); ++list)
    for (auto n = found.cells.begin[list]; n < found.cells.begin[list + 1]; ++n) {
      const auto& c = found.cells.parts[n];
      const int own = side_of_place.at(static_cast<std::uint32_t>(fine.board.run(c.colour, c.row) + c.m));
      EXPECT_EQ(side_of_coarse.emplace(found.cells.place[list], own).first->second, own);
      ++parts;
    }
  EXPECT_GT(parts, 500u);
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t list = 0; list < found.faces[a].place.size(); ++list) {
      std::array<std::uint32_t, 3> at = found.faces[a].at[list];
      --at[a];
      const auto below = static_cast<std::uint32_t>(
          coarse_board.at(static_cast<int>(at[0]), static_cast<int>(at[1]), static_cast<int>(at[2])));
      const auto here = side_of_coarse.find(found.faces[a].place[list]), there = side_of_coarse.find(below);
      if (here != side_of_coarse.end() && there != side_of_coarse.end() && here->second != there->second) {
        EXPECT_EQ(found.faces[a].begin[list], found.faces[a].begin[list + 1]) << "axis " << a;
      }
    }
}

}  // namespace
}  // namespace talus

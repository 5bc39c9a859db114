// SPDX-License-Identifier: Apache-2.0
#include "numerics/grid/aggregates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
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
  for (std::size_t list = 0; list < found.cells.index.size(); ++list)
    cells[found.cells.index[list]] = found.cells.begin[list + 1] - found.cells.begin[list];
  for (std::size_t list = 0; list < found.faces[2].index.size(); ++list)
    faces[found.faces[2].index[list]] = found.faces[2].begin[list + 1] - found.faces[2].begin[list];
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      EXPECT_EQ(cells.at(static_cast<std::uint32_t>(coarse.at(i, j, 1))), 4u);   // the layer below the wall
      EXPECT_EQ(cells.at(static_cast<std::uint32_t>(coarse.at(i, j, 2))), 12u);  // the three above it
      EXPECT_EQ(faces.at(static_cast<std::uint32_t>(coarse.at(i, j, 2))), 0u);   // no face leads through the wall
    }
  // Red ones of the 16 cells in the fourth layer.
  EXPECT_EQ(found.moved.size(), 8u);
  for (const auto& m : found.moved) EXPECT_NE(m.coarse, m.coarse_neighbour);
}

TEST(Aggregates, NeverJoinBothSidesOfAConeNorLeadThroughIt) {
  const auto side = [](int i, int j, int k) { return std::hypot(i - 11.5, j - 11.5) < 3 + 0.6 * k ? 1 : 0; };
  const std::array count{24, 24, 24};
  const Walled fine(count, side);
  const Checkerboard coarse = half(count);
  const Aggregates found = aggregates(fine);
  ASSERT_FALSE(found.empty());
  // Sides of the coarse cells: of those with lists by their parts, of the others by the pairs that they join.
  std::map<std::size_t, int> side_of_place, side_of_coarse;
  const auto for_each_cell = [](int n, auto&& body) {
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) body(i, j, k);
  };
  for_each_cell(24, [&](int i, int j, int k) { side_of_place[fine.board.at(i, j, k)] = side(i, j, k); });
  const std::set<std::size_t> listed(found.cells.index.begin(), found.cells.index.end());
  std::size_t parts = 0;
  for (std::size_t list = 0; list < found.cells.index.size(); ++list)
    for (auto n = found.cells.begin[list]; n < found.cells.begin[list + 1]; ++n, ++parts) {
      const auto& c = found.cells.parts[n];
      const int own = side_of_place.at(fine.board.run(c.colour, c.row) + c.m);
      EXPECT_EQ(side_of_coarse.emplace(found.cells.index[list], own).first->second, own);
    }
  EXPECT_GT(parts, 500u);
  for_each_cell(24, [&](int i, int j, int k) {
    const std::size_t c = coarse.at(i / 2, j / 2, k / 2);
    if (!listed.contains(c)) {
      EXPECT_EQ(side_of_coarse.emplace(c, side(i, j, k)).first->second, side(i, j, k));
    }
  });
  // Of faces with lists, by their parts; of the others, of the faces between the pairs.
  std::size_t faces_through = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    std::map<std::size_t, std::size_t> faces;
    for (std::size_t list = 0; list < found.faces[a].index.size(); ++list)
      faces[found.faces[a].index[list]] = found.faces[a].begin[list + 1] - found.faces[a].begin[list];
    for_each_cell(12, [&](int i, int j, int k) {
      const std::array at{i, j, k};
      if (at[a] == 0) return;
      std::array below = at;
      --below[a];
      const std::size_t c = coarse.at(i, j, k), n = coarse.at(below[0], below[1], below[2]);
      if (side_of_coarse.at(c) == side_of_coarse.at(n)) return;
      ++faces_through;
      if (faces.contains(c)) {
        EXPECT_EQ(faces.at(c), 0u);
        return;
      }
      for (int m = 0; m < 4; ++m) {
        std::array first{2 * i, 2 * j, 2 * k};
        first[(a + 1) % 3] += m & 1, first[(a + 2) % 3] += m >> 1;
        EXPECT_EQ(fine.low[a][fine.board.at(first[0], first[1], first[2])], 0) << "axis " << a;
      }
    });
  }
  EXPECT_GT(faces_through, 200u);
}

}  // namespace
}  // namespace talus

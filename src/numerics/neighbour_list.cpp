// SPDX-License-Identifier: Apache-2.0
#include "numerics/neighbour_list.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/exact_sum.hpp"
#include "base/instruction_set.hpp"
#include "numerics/cell_grid.hpp"
#include "numerics/near_points/kernel.hpp"

namespace talus {

namespace {

/// Numbers that go in in any order and come out in theirs: a bit for each, and one for each word of bits in use.
class NumberSet {
 public:
  /// \param bound above all numbers
  void allow(std::size_t bound) {
    words_.resize(bound / 64 + 1);
    used_.resize(words_.size() / 64 + 1);
  }
  void insert(std::span<const std::uint32_t> numbers) {
    std::uint64_t *const words = words_.data(), *const used = used_.data();  // looked up once
    for (const std::uint32_t n : numbers) {
      words[n / 64] |= std::uint64_t{1} << (n % 64);
      used[n / 4096] |= std::uint64_t{1} << (n / 64 % 64);
    }
  }
  /// Writes the numbers and leaves the set empty. \returns the slot behind the last one
  std::uint32_t* drain(std::uint32_t* numbers) {
    for (std::size_t u = 0; u < used_.size(); ++u)
      for (std::uint64_t words = std::exchange(used_[u], 0); words != 0; words &= words - 1) {
        const std::size_t w = 64 * u + static_cast<std::size_t>(std::countr_zero(words));
        for (std::uint64_t bits = std::exchange(words_[w], 0); bits != 0; bits &= bits - 1)
          *numbers++ = static_cast<std::uint32_t>(64 * w + static_cast<std::size_t>(std::countr_zero(bits)));
      }
    return numbers;
  }

 private:
  std::vector<std::uint64_t> words_, used_;
};

/// Points in cells that are as wide as most points reach. A few that reach farther do not make all cells wider: they
/// are looked for in more cells, and each cell knows the largest radius in it.
struct Cells {
  double farthest;  ///< that a pair may be apart, m
  double edge;      ///< m
  CellGrid grid;
  std::int64_t range;                      ///< how many cells a pair is apart at most
  std::vector<double> largest;             ///< radius of the points of each cell, m
  std::vector<std::uint32_t> block;        ///< that have points in a cell, rising, one cell after the other
  std::vector<std::uint32_t> first_block;  ///< of a cell, in these; one more at the end

  Cells(std::span<const Vector3> position, std::span<const double> radius, double skin)
      : farthest(2 * *std::max_element(radius.begin(), radius.end()) + skin),
        edge(std::min(farthest, std::max(farthest / 4, 2.24 * mean(radius) + skin))),
        grid(position, edge),
        range(static_cast<std::int64_t>(std::ceil(farthest / edge))),
        largest(grid.cells(), 0.0) {
    block.reserve(position.size());
    for (std::size_t c = 0; c < largest.size(); ++c) {
      first_block.push_back(static_cast<std::uint32_t>(block.size()));
      for (const std::uint32_t n : grid.points_of(c)) {
        largest[c] = std::max(largest[c], radius[n]);
        const auto of_point = static_cast<std::uint32_t>(n / PointBlock::size);
        if (block.size() == first_block.back() || block.back() != of_point) block.push_back(of_point);
      }
    }
    first_block.push_back(static_cast<std::uint32_t>(block.size()));
  }
  std::span<const std::uint32_t> blocks_of(std::size_t cell) const {
    return std::span(block).subspan(first_block[cell], first_block[cell + 1] - first_block[cell]);
  }

 private:
  static double mean(std::span<const double> radius) {
    return std::accumulate(radius.begin(), radius.end(), 0.0) / static_cast<double>(radius.size());
  }
};

/// Around the points of a block.
struct BlockBox {
  Vector3 low, high;  ///< m
  double radius;      ///< the largest of the points, m
};

/// All points by number, and a box around each block of them.
struct Blocks {
  std::vector<PointBlock> points;
  std::vector<BlockBox> boxes;
};
Blocks blocks_of(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> radius) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Blocks blocks;
  blocks.points.resize((position.size() + PointBlock::size - 1) / PointBlock::size);
  blocks.boxes.resize(blocks.points.size());
  for_each(team, blocks.points.size(), [&](std::size_t b) {
    PointBlock& block = blocks.points[b];
    BlockBox box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}, 0};
    for (std::size_t k = 0; k < PointBlock::size; ++k) {
      const std::size_t n = b * PointBlock::size + k;
      block.number[k] = static_cast<std::uint32_t>(n);
      if (n >= position.size()) {
        block.x[k] = infinity, block.y[k] = block.z[k] = block.radius[k] = 0;
        continue;
      }
      const Vector3& x = position[n];
      block.x[k] = x.x, block.y[k] = x.y, block.z[k] = x.z;
      block.radius[k] = radius[n];
      box.low = {std::min(box.low.x, x.x), std::min(box.low.y, x.y), std::min(box.low.z, x.z)};
      box.high = {std::max(box.high.x, x.x), std::max(box.high.y, x.y), std::max(box.high.z, x.z)};
      box.radius = std::max(box.radius, radius[n]);
    }
    blocks.boxes[b] = box;
  });
  return blocks;
}

/// The boxes of the blocks that have points around a cell, by the numbers of the blocks.
class Surroundings {
 public:
  void gather(const Cells& cells, std::span<const BlockBox> boxes, double skin, std::size_t cell) {
    blocks_.allow(boxes.size());
    std::size_t most = 0;
    cells.grid.for_each_cell_near(cell, cells.range, [&](std::size_t near, double square) {
      const double reach = cells.largest[cell] + cells.largest[near] + skin;
      constexpr double rounding = 1 - 1e-9;
      if (rounding * square > reach * reach) return;
      const auto blocks = cells.blocks_of(near);
      blocks_.insert(blocks), most += blocks.size();
    });
    if (sorted_.size() < most) sorted_.resize(most);
    count_ = static_cast<std::size_t>(blocks_.drain(sorted_.data()) - sorted_.data());
    if (boxes_.size() < registers()) boxes_.resize(registers());
    for (std::size_t n = 0; n < registers() * BlockBoxes::size; ++n) {
      BlockBoxes& to = boxes_[n / BlockBoxes::size];
      const std::size_t k = n % BlockBoxes::size;
      const BlockBox& box = n < count_ ? boxes[sorted_[n]] : nowhere;
      to.low[0][k] = box.low.x, to.low[1][k] = box.low.y, to.low[2][k] = box.low.z;
      to.high[0][k] = box.high.x, to.high[1][k] = box.high.y, to.high[2][k] = box.high.z;
      to.radius[k] = box.radius;
      to.block[k] = n < count_ ? sorted_[n] : 0;
    }
  }

  /// How many numbers find_near needs room for.
  std::size_t most() const { return PointBlock::size * BlockBoxes::size * registers(); }

  /// Writes those near a point, sorted. \param near has room for most() \returns how many they are
  std::size_t find_near(PickNear* pick, const PointBlock* blocks, std::size_t point, double skin,
                        std::uint32_t* near) const {
    return pick(blocks, boxes_.data(), registers(), point, skin, near);
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr BlockBox nowhere{{infinity, infinity, infinity}, {infinity, infinity, infinity}, 0};

  std::size_t registers() const { return (count_ + BlockBoxes::size - 1) / BlockBoxes::size; }

  NumberSet blocks_;
  std::vector<std::uint32_t> sorted_;
  std::size_t count_ = 0;  // of the blocks
  std::vector<BlockBoxes> boxes_;
};

}  // namespace

void NeighbourList::build(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> radius,
                          double skin, std::size_t count, const Keep& keep, std::span<const char> without_list) {
  skin_ = -1;
  first_.assign(count + 1, 0);
  length_.assign(count, 0);
  if (count == 0) return;

  const Cells cells(position, radius, skin);
  const Blocks blocks = blocks_of(team, position, radius);
  const CellGrid& grid = cells.grid;
  constexpr std::size_t cells_at_once = 32;
  const std::size_t chunks = (grid.cells() + cells_at_once - 1) / cells_at_once;
  static PickNear* const pick_near = TALUS_COMPILED_FOR(resolve(InstructionSet::automatic), pick_near);
  found_.resize(std::max(chunks, found_.size()));
  std::vector<std::uint32_t> slot(chunks);  // of what a chunk has found, in these
  const std::size_t at_once = std::max(found_at_once, count / 8);
  for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
    end = std::min(count, begin + at_once);
    const auto for_each_listed = [&](std::size_t chunk, const auto& visit) {  // those of one cell at a time
      for (std::size_t c = chunk * cells_at_once; c < std::min(grid.cells(), (chunk + 1) * cells_at_once); ++c) {
        const auto points = grid.points_of(c);
        const auto first = std::lower_bound(points.begin(), points.end(), begin);
        const auto last = std::lower_bound(first, points.end(), end);
        if (first != last) visit(c, std::span(first, last));
      }
    };
    std::atomic<std::uint32_t> slots{0};
    team.run(chunks, [&](std::size_t chunk) {
      thread_local Surroundings of_thread;
      Surroundings& around = of_thread;  // its address is looked up once
      std::vector<std::uint32_t>* list = nullptr;
      std::size_t filled = 0;
      for_each_listed(chunk, [&](std::size_t cell, std::span<const std::uint32_t> listed) {
        if (list == nullptr) list = &found_[slot[chunk] = slots++];
        around.gather(cells, blocks.boxes, skin, cell);
        for (const std::uint32_t i : listed) {
          if (!without_list.empty() && without_list[i]) continue;
          if (list->size() < filled + around.most()) list->resize((filled + around.most()) * 5 / 4);
          std::uint32_t* const near = list->data() + filled;
          std::size_t length = around.find_near(pick_near, blocks.points.data(), i, skin, near);
          if (keep) length = keep(i, {near, length});
          length_[i] = static_cast<std::uint32_t>(length);
          filled += length;
        }
      });
    });
    for (std::size_t i = begin; i < end; ++i)
      first_[i + 1] = first_[i] + (length_[i] + padded_to - 1) / padded_to * padded_to;
    // Room for all, by the length of those that are known: a vector that grows by itself takes its memory twice.
    if (neighbours_.capacity() < first_[end]) neighbours_.reserve(first_[end] / end * count / 10 * 11);
    neighbours_.resize(std::max(neighbours_.size(), first_[end]));
    team.run(chunks, [&](std::size_t chunk) {
      const std::uint32_t* list = found_[slot[chunk]].data();
      for_each_listed(chunk, [&](std::size_t, std::span<const std::uint32_t> listed) {
        for (const std::uint32_t i : listed) {
          std::uint32_t* const behind = std::copy_n(list, length_[i], neighbours_.data() + first_[i]);
          std::fill(behind, neighbours_.data() + first_[i + 1], static_cast<std::uint32_t>(position.size()));
          list += length_[i];
        }
      });
    });
  }
}

bool NeighbourList::holds(ThreadTeam& team, std::span<const Vector3> position) const {
  if (skin_ < 0 || reference_.size() != position.size() || position.empty()) return false;
  // Distances between points do not change when all move together: only what exceeds the mean motion counts.
  Vector3 mean;
  for (int axis = 0; axis < 3; ++axis)
    mean[axis] =
        exact_sum(team, position.size(), [&](std::size_t i) { return position[i][axis] - reference_[i][axis]; }) /
        static_cast<double>(position.size());
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

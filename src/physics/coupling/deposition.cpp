// SPDX-License-Identifier: Apache-2.0
#include "physics/coupling/deposition.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "numerics/sph/cubic_spline.hpp"

namespace talus::coupling {

namespace {

/// The cell within the box that a cell beyond its ends stands for; -1: none.
int fold(int place, int count, FaceKind low, FaceKind high) {
  if (low == FaceKind::periodic) return ((place % count) + count) % count;
  while (place < 0 || place >= count) {
    if (!is_mirror(place < 0 ? low : high)) return -1;
    place = place < 0 ? -1 - place : 2 * count - 1 - place;
  }
  return place;
}

}  // namespace

Deposition::Deposition(const Grid& grid, const Domain& domain) : grid_(grid), domain_(domain) {
  const auto close = [](double a, double b, double width) { return std::abs(a - b) < 1e-6 * width; };
  for (int axis = 0; axis < 3; ++axis) {
    const double width = grid.spacing[axis];
    const double high = grid.low[axis] + width * grid.count[static_cast<std::size_t>(axis)];
    if (!close(grid.low[axis], domain.box().low[axis], width) || !close(high, domain.box().high[axis], width))
      throw std::invalid_argument("Deposition: the grid must fill the box");
  }
  for (const Plate& plate : domain.plates()) {
    const double width = grid.spacing[plate.axis], place = (plate.position - grid.low[plate.axis]) / width;
    layer_.push_back(static_cast<int>(std::lround(place)));
    if (std::abs(place - layer_.back()) > 1e-6)
      throw std::invalid_argument("Deposition: a plate must lie on faces of the cells");
  }
}

void Deposition::weigh(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> smoothing_length) {
  count_ = position.size();
  blocks_.resize((count_ + block_size - 1) / block_size);
  team.run(blocks_.size(), [&](std::size_t b) {
    Block& block = blocks_[b];
    block.end.clear(), block.cell.clear(), block.weight.clear();
    for (std::size_t i = b * block_size; i < std::min((b + 1) * block_size, count_); ++i)
      weigh(position[i], smoothing_length[i], block);
  });
}

void Deposition::weigh(const Vector3& x, double h, Block& block) const {
  const Box& box = domain_.box();
  // At least the nearest cell's centre is within reach.
  const double reach = std::max(sph::support * h, 0.5001 * norm(grid_.spacing));
  const double width = reach / sph::support;
  std::array<int, 3> from, to;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double place = (x[axis] - grid_.low[axis]) / grid_.spacing[axis] - 0.5;
    from[a] = static_cast<int>(std::ceil(place - reach / grid_.spacing[axis]));
    to[a] = static_cast<int>(std::floor(place + reach / grid_.spacing[axis]));
  }
  const bool beside_plate = domain_.is_near_plate(x, reach);
  const std::size_t begin = block.cell.size();
  double sum = 0;
  for (int k = from[2]; k <= to[2]; ++k)
    for (int j = from[1]; j <= to[1]; ++j)
      for (int i = from[0]; i <= to[0]; ++i) {
        const Vector3 centre = grid_.centre(i, j, k);
        const double distance = norm(centre - x);
        if (distance >= reach) continue;
        std::array<int, 3> place{i, j, k};
        // Hidden behind the solid part of a plate: to its mirror image on this side.
        if (beside_plate && !domain_.sees(x, centre))
          for (std::size_t p = 0; p < layer_.size(); ++p) {
            const Plate& plate = domain_.plates()[p];
            auto& layer = place[static_cast<std::size_t>(plate.axis)];
            if (plate.side_of(x) != plate.side_of(centre)) layer = 2 * layer_[p] - 1 - layer;
          }
        bool is_within = true;
        for (int axis = 0; axis < 3; ++axis) {
          const auto a = static_cast<std::size_t>(axis);
          place[a] = fold(place[a], grid_.count[a], box.face(axis, 0), box.face(axis, 1));
          is_within = is_within && place[a] >= 0;
        }
        if (!is_within) continue;
        const double weight = sph::cubic_spline(distance, width);
        sum += weight;
        block.cell.push_back(static_cast<std::uint32_t>(grid_.index(place[0], place[1], place[2])));
        block.weight.push_back(weight);
      }
  for (std::size_t n = begin; n < block.weight.size(); ++n) block.weight[n] /= sum;
  block.end.push_back(block.cell.size());
}

/// Calls body(lump, begin, end) with the range of each lump's cells.
template <class Body>
void Deposition::for_each_lump(const Block& block, std::size_t first, Body&& body) const {
  std::size_t begin = 0;
  for (std::size_t n = 0; n < block.end.size(); begin = block.end[n++]) body(first + n, begin, block.end[n]);
}

void Deposition::gather(ThreadTeam& team, double solid_volume, std::span<const Vector3> velocity, CellField& fraction,
                        FaceField& flux) const {
  // Cells are shared by lumps of several blocks, so the four sums are the tasks; each adds the lumps in order.
  const double share = solid_volume / grid_.volume();
  team.run(4, [&](std::size_t task) {
    CellField& sum = task == 3 ? fraction : flux[task];
    std::fill(sum.begin(), sum.end(), 0.0);
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const Block& block = blocks_[b];
      for_each_lump(block, b * block_size, [&](std::size_t i, std::size_t begin, std::size_t end) {
        const double amount = task == 3 ? share : share * velocity[i][static_cast<int>(task)];
        for (std::size_t n = begin; n < end; ++n) sum[block.cell[n]] += amount * block.weight[n];
      });
    }
  });
}

void Deposition::hand_out(ThreadTeam& team, double solid_volume, const FaceField& per_solid_volume,
                          std::span<Vector3> received) const {
  team.run(blocks_.size(), [&](std::size_t b) {
    const Block& block = blocks_[b];
    for_each_lump(block, b * block_size, [&](std::size_t i, std::size_t begin, std::size_t end) {
      Vector3 sum;
      for (std::size_t n = begin; n < end; ++n) {
        const std::size_t c = block.cell[n];
        sum += block.weight[n] * Vector3{per_solid_volume[0][c], per_solid_volume[1][c], per_solid_volume[2][c]};
      }
      received[i] = solid_volume * sum;
    });
  });
}

}  // namespace talus::coupling

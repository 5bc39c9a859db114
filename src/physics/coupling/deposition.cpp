// SPDX-License-Identifier: Apache-2.0
#include "physics/coupling/deposition.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "base/clones.hpp"
#include "numerics/sph/cubic_spline.hpp"

namespace talus::coupling {

namespace {

/// The cell within the box that a cell beyond its ends stands for.
int fold(int place, int count, bool is_periodic) {
  if (is_periodic) return ((place % count) + count) % count;
  while (place < 0 || place >= count) place = place < 0 ? -1 - place : 2 * count - 1 - place;
  return place;
}

/// The kernel where the square of the distance is square[i] + beside. \param per_width over the smoothing length
TALUS_CLONES void weigh_row(std::size_t count, const double* square, double beside, double per_width,
                            double* __restrict weight) {
  for (std::size_t i = 0; i < count; ++i)
    weight[i] = sph::cubic_spline_of(std::sqrt(beside + square[i]) * per_width, per_width);
}

}  // namespace

/// The cells within reach of a particle, and their weights.
struct Deposition::Scratch {
  struct Along {
    int from = 0;                   // the first one along an axis
    std::vector<double> square;     // of the distance of each one's centre, m^2; then far ones, to a whole vector
    std::vector<std::size_t> slot;  // in `cell`, of the one within the box that it stands for
    std::vector<int> cell;          // each once; `left` for all beyond an open face

    static constexpr int left = -1;

    void find(const Grid& grid, const Box& box, int axis, double x, double reach);
    /// The slot of the cell whose centre is at x, if it is one of these.
    std::optional<std::size_t> slot_at(const Grid& grid, int axis, double x) const;
  };
  struct Slots {
    std::size_t x, z;
  };
  using Seen = std::optional<Slots>;
  std::array<Along, 3> along;
  std::vector<double> weight;  // of a row along x
  std::vector<double> sum;     // by slots along x, y, z
  std::vector<Seen> seen;      // by cells along x and z: whose share each one's is
};

void Deposition::Scratch::Along::find(const Grid& grid, const Box& box, int axis, double x, double reach) {
  const double width = grid.spacing[axis], place = (x - grid.low[axis]) / width - 0.5;
  const int to = static_cast<int>(std::floor(place + reach / width));
  from = static_cast<int>(std::ceil(place - reach / width));
  const int count = grid.count[static_cast<std::size_t>(axis)];
  const bool is_periodic = box.face(axis, 0) == FaceKind::periodic;
  const auto has_left = [&](int n) {
    return (n < 0 && box.face(axis, 0) == FaceKind::open) || (n >= count && box.face(axis, 1) == FaceKind::open);
  };
  square.clear(), slot.clear(), cell.clear();
  for (int n = from; n <= to; ++n) {
    square.push_back((n - place) * (n - place) * width * width);
    const int within = has_left(n) ? left : fold(n, count, is_periodic);
    const auto found = std::find(cell.begin(), cell.end(), within);
    slot.push_back(static_cast<std::size_t>(found - cell.begin()));
    if (found == cell.end()) cell.push_back(within);
  }
  square.resize((square.size() + 7) / 8 * 8, 4 * reach * reach);
}

std::optional<std::size_t> Deposition::Scratch::Along::slot_at(const Grid& grid, int axis, double x) const {
  const double place = (x - grid.low[axis]) / grid.spacing[axis] - 0.5, nearest = std::round(place);
  if (std::abs(place - nearest) > 1e-6) return std::nullopt;
  const bool within = nearest >= 0 && nearest < grid.count[static_cast<std::size_t>(axis)];
  const auto found = std::find(cell.begin(), cell.end(), within ? static_cast<int>(nearest) : left);
  if (found == cell.end()) return std::nullopt;
  return static_cast<std::size_t>(found - cell.begin());
}

Deposition::Deposition(const Grid& grid, const Domain& domain) : grid_(grid), domain_(domain) {
  const auto nearly_equal = [](double a, double b, double width) { return std::abs(a - b) < 1e-6 * width; };
  for (int axis = 0; axis < 3; ++axis) {
    const double width = grid.spacing[axis];
    const double high = grid.low[axis] + width * grid.count[static_cast<std::size_t>(axis)];
    if (!nearly_equal(grid.low[axis], domain.box().low[axis], width) ||
        !nearly_equal(high, domain.box().high[axis], width))
      throw std::invalid_argument("Deposition: the grid must fill the box");
  }
}

void Deposition::find_weights(ThreadTeam& team, std::span<const Vector3> position,
                              std::span<const double> smoothing_length) {
  count_ = position.size();
  blocks_.resize((count_ + block_size - 1) / block_size);
  team.run(blocks_.size(), [&](std::size_t b) {
    Block& block = blocks_[b];
    Scratch scratch;
    block.end.clear();
    for (std::size_t i = b * block_size; i < std::min((b + 1) * block_size, count_); ++i)
      find_weights(position[i], smoothing_length[i], scratch, block);
  });
}

void Deposition::find_weights(const Vector3& x, double h, Scratch& scratch, Block& block) const {
  // At least the nearest cell's centre is within reach.
  const double reach = std::max(sph::support * h, 0.5001 * norm(grid_.spacing));
  const double per_width = sph::support / reach;
  for (int axis = 0; axis < 3; ++axis)
    scratch.along[static_cast<std::size_t>(axis)].find(grid_, domain_.box(), axis, x[axis], reach);
  const Scratch::Along &along_x = scratch.along[0], &along_y = scratch.along[1], &along_z = scratch.along[2];
  const std::size_t columns = along_x.cell.size(), rows = along_y.cell.size();
  scratch.sum.assign(columns * rows * along_z.cell.size(), 0);
  scratch.weight.resize(along_x.square.size());
  double *sum = scratch.sum.data(), *weight = scratch.weight.data();
  const auto add_weights = [&](bool beside_wall) {
    if (beside_wall) find_seen(x, scratch);
    for (std::size_t k = 0; k < along_z.slot.size(); ++k)
      for (std::size_t j = 0; j < along_y.slot.size(); ++j) {
        const double beside = along_y.square[j] + along_z.square[k];
        if (beside >= reach * reach) continue;
        weigh_row(along_x.square.size(), along_x.square.data(), beside, per_width, weight);
        if (beside_wall) {
          const Scratch::Seen* seen = scratch.seen.data() + k * along_x.slot.size();
          for (std::size_t i = 0; i < along_x.slot.size(); ++i)
            if (seen[i]) sum[seen[i]->x + columns * (along_y.slot[j] + rows * seen[i]->z)] += weight[i];
        } else {
          double* row = sum + columns * (along_y.slot[j] + rows * along_z.slot[k]);
          for (std::size_t i = 0; i < along_x.slot.size(); ++i) row[along_x.slot[i]] += weight[i];
        }
      }
  };
  const bool beside_wall = domain_.is_near_wall(x, reach);
  add_weights(beside_wall);
  // In a corner too narrow for a cell's centre a particle sees none: then it has all.
  if (beside_wall && std::none_of(scratch.sum.begin(), scratch.sum.end(), [](double w) { return w > 0; }))
    add_weights(false);

  const std::size_t begin = block.end.empty() ? 0 : block.end.back(), most = begin + scratch.sum.size();
  if (block.cell.size() < most) block.cell.resize(2 * most), block.weight.resize(2 * most);
  std::uint32_t* cell = block.cell.data();
  double *kept = block.weight.data(), total = 0;
  std::size_t end = begin;
  for (std::size_t k = 0; k < along_z.cell.size(); ++k)
    for (std::size_t j = 0; j < along_y.cell.size(); ++j) {
      const double* row = sum + columns * (j + rows * k);
      const bool row_has_left = along_y.cell[j] == Scratch::Along::left || along_z.cell[k] == Scratch::Along::left;
      const auto first = static_cast<std::uint32_t>(grid_.index(0, along_y.cell[j], along_z.cell[k]));
      for (std::size_t i = 0; i < along_x.cell.size(); ++i) {
        cell[end] = first + static_cast<std::uint32_t>(along_x.cell[i]);
        kept[end] = row[i], total += row[i];
        end += row[i] > 0 && !row_has_left && along_x.cell[i] != Scratch::Along::left;
      }
    }
  for (std::size_t n = begin; n < end; ++n) kept[n] /= total;
  block.end.push_back(end);
}

/// For each cell within reach, that which has its share: where the line to its centre ends, turned at walls and faces.
/// Behind a wall that lies on faces of the cells this is the cell's mirror image; where it is no cell's centre, nothing
/// has it.
void Deposition::find_seen(const Vector3& x, Scratch& scratch) const {
  const auto& [along_x, along_y, along_z] = scratch.along;
  scratch.seen.assign(along_x.slot.size() * along_z.slot.size(), {});
  for (std::size_t k = 0; k < along_z.slot.size(); ++k)
    for (std::size_t i = 0; i < along_x.slot.size(); ++i) {
      Vector3 centre = grid_.centre(along_x.from + static_cast<int>(i), 0, along_z.from + static_cast<int>(k));
      centre.y = x.y;
      const std::optional<Vector3> end = domain_.end_of_line(x, centre);
      if (!end) continue;
      const auto column = along_x.slot_at(grid_, 0, end->x), row = along_z.slot_at(grid_, 2, end->z);
      if (column && row) scratch.seen[i + k * along_x.slot.size()] = Scratch::Slots{*column, *row};
    }
}

/// Calls body(particle, begin, end) with the range of each particle's cells.
template <class Body>
void Deposition::for_each_particle(const Block& block, std::size_t first, Body&& body) const {
  std::size_t begin = 0;
  for (std::size_t n = 0; n < block.end.size(); begin = block.end[n++]) body(first + n, begin, block.end[n]);
}

void Deposition::deposit(ThreadTeam& team, double solid_volume, std::span<const Vector3> velocity, CellField& fraction,
                         FaceField& flux) const {
  // Cells are shared by particles of several blocks, so the four sums are the tasks; each adds the particles in order.
  const double share = solid_volume / grid_.volume();
  team.run(4, [&](std::size_t task) {
    CellField& sum = task == 3 ? fraction : flux[task];
    std::fill(sum.begin(), sum.end(), 0.0);
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const Block& block = blocks_[b];
      for_each_particle(block, b * block_size, [&](std::size_t i, std::size_t begin, std::size_t end) {
        const double amount = task == 3 ? share : share * velocity[i][static_cast<int>(task)];
        for (std::size_t n = begin; n < end; ++n) sum[block.cell[n]] += amount * block.weight[n];
      });
    }
  });
}

void Deposition::distribute(ThreadTeam& team, double solid_volume, const FaceField& per_solid_volume,
                            std::span<Vector3> received) const {
  team.run(blocks_.size(), [&](std::size_t b) {
    const Block& block = blocks_[b];
    for_each_particle(block, b * block_size, [&](std::size_t i, std::size_t begin, std::size_t end) {
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

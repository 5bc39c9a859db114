// SPDX-License-Identifier: Apache-2.0
#include "physics/coupling/deposition.hpp"

#include <algorithm>
#include <cmath>
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

/// The cells within reach of a particle, and what they weigh.
struct Deposition::Scratch {
  struct Along {
    int from = 0;                   // the first one along an axis
    std::vector<double> square;     // of the distance of each one's centre, m^2; then far ones, to a whole vector
    std::vector<std::size_t> slot;  // in `cell`, of the one within the box that it stands for
    std::vector<int> cell;          // each once; `left` for all beyond an open face

    static constexpr int left = -1;

    void find(const Grid& grid, const Box& box, int axis, double x, double reach);
  };
  std::array<Along, 3> along;
  std::vector<double> weight;  // of a row along x
  std::vector<double> sum;     // by slots along x, y, z
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
    Scratch scratch;
    block.end.clear();
    for (std::size_t i = b * block_size; i < std::min((b + 1) * block_size, count_); ++i)
      weigh(position[i], smoothing_length[i], scratch, block);
  });
}

void Deposition::weigh(const Vector3& x, double h, Scratch& scratch, Block& block) const {
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
  const auto slot = [&](std::size_t i, std::size_t j, std::size_t k) {
    return along_x.slot[i] + columns * (along_y.slot[j] + rows * along_z.slot[k]);
  };
  const bool beside_plate = domain_.is_near_plate(x, reach);
  const auto spread = [&](bool beside_panel) {
    for (std::size_t k = 0; k < along_z.slot.size(); ++k)
      for (std::size_t j = 0; j < along_y.slot.size(); ++j) {
        const double beside = along_y.square[j] + along_z.square[k];
        if (beside >= reach * reach) continue;
        weigh_row(along_x.square.size(), along_x.square.data(), beside, per_width, weight);
        if (beside_panel) {
          for (std::size_t i = 0; i < along_x.slot.size(); ++i)
            if (!is_behind_panel(x, scratch, {i, j, k})) sum[slot(i, j, k)] += weight[i];
        } else if (beside_plate) {
          for (std::size_t i = 0; i < along_x.slot.size(); ++i)
            if (const auto seen = in_front_of_plates(x, scratch, {i, j, k}))
              sum[slot((*seen)[0], (*seen)[1], (*seen)[2])] += weight[i];
        } else {
          double* row = sum + slot(0, j, k) - along_x.slot[0];
          for (std::size_t i = 0; i < along_x.slot.size(); ++i) row[along_x.slot[i]] += weight[i];
        }
      }
  };
  const bool beside_panel = domain_.is_near_panel(x, reach);
  spread(beside_panel);
  // In a corner too narrow for a cell's centre a particle sees none: then it has all.
  if (beside_panel && std::none_of(scratch.sum.begin(), scratch.sum.end(), [](double w) { return w > 0; }))
    spread(false);

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

/// Of a cell within reach, by its numbers along the axes: itself, or its mirror image on this side of the plates behind
/// whose solid part it is hidden.
std::optional<std::array<std::size_t, 3>> Deposition::in_front_of_plates(const Vector3& x, const Scratch& scratch,
                                                                         std::array<std::size_t, 3> cell) const {
  std::array<int, 3> place;
  for (std::size_t a = 0; a < 3; ++a) place[a] = scratch.along[a].from + static_cast<int>(cell[a]);
  const Vector3 centre = grid_.centre(place[0], place[1], place[2]);
  if (domain_.sees(x, centre)) return cell;
  for (std::size_t p = 0; p < layer_.size(); ++p) {
    const Plate& plate = domain_.plates()[p];
    const auto a = static_cast<std::size_t>(plate.axis);
    if (plate.side_of(x) == plate.side_of(centre)) continue;
    place[a] = 2 * layer_[p] - 1 - place[a];
    cell[a] = static_cast<std::size_t>(place[a] - scratch.along[a].from);
    if (cell[a] >= scratch.along[a].slot.size()) return {};  // out of reach, by rounding
  }
  return cell;
}

/// Whether a panel stands between a particle and a cell within reach, or the one within the box that stands for it.
bool Deposition::is_behind_panel(const Vector3& x, const Scratch& scratch, std::array<std::size_t, 3> cell) const {
  std::array<int, 3> place, within;
  for (std::size_t a = 0; a < 3; ++a) {
    const Scratch::Along& along = scratch.along[a];
    place[a] = along.from + static_cast<int>(cell[a]), within[a] = along.cell[along.slot[cell[a]]];
    if (within[a] == Scratch::Along::left) within[a] = place[a];
  }
  const Vector3 centre = grid_.centre(within[0], within[1], within[2]);
  const Vector3 moved = centre - grid_.centre(place[0], place[1], place[2]);
  Vector3 from = x;  // the copy beside the cell, through periodic faces
  for (int axis = 0; axis < 3; ++axis)
    if (domain_.box().face(axis, 0) == FaceKind::periodic) from[axis] += moved[axis];
  return domain_.blocks(from, centre);
}

/// Calls body(particle, begin, end) with the range of each particle's cells.
template <class Body>
void Deposition::for_each_particle(const Block& block, std::size_t first, Body&& body) const {
  std::size_t begin = 0;
  for (std::size_t n = 0; n < block.end.size(); begin = block.end[n++]) body(first + n, begin, block.end[n]);
}

void Deposition::gather(ThreadTeam& team, double solid_volume, std::span<const Vector3> velocity, CellField& fraction,
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

void Deposition::hand_out(ThreadTeam& team, double solid_volume, const FaceField& per_solid_volume,
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

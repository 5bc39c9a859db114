// SPDX-License-Identifier: Apache-2.0
#include "physics/coupling/deposition.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "numerics/sph/cubic_spline.hpp"
#include "physics/coupling/cells_along.hpp"
#include "physics/coupling/deposition_rows.hpp"

namespace talus::coupling {

/// The cells within reach of a particle, and their weights.
struct Deposition::Scratch {
  struct Slots {
    std::size_t x, z;
  };
  using Seen = std::optional<Slots>;
  std::array<CellsAlong, 3> along;
  std::vector<float> sum;     // by slots along x, y, z
  std::vector<RowFate> fate;  // by slots along y, z
  std::vector<Seen> seen;     // by cells along x and z: whose share each one's is
  std::vector<float> all;     // what `sum` was before cells behind the surface were left out
  std::vector<Slab> slabs, half_spaces;
  std::array<std::vector<double>, 3> centre;  // of the cells along each axis, m
  std::vector<std::uint32_t> near;
};

Deposition::Deposition(const Grid& grid, const Domain& domain, const Surface& surface)
    : grid_(grid), domain_(domain), surface_(surface) {
  const auto is_mirror = [&](int axis, int side) {
    const FaceKind kind = domain.box().face(axis, side);
    return kind != FaceKind::periodic && kind != FaceKind::open;
  };
  const auto nearly_equal = [](double a, double b, double width) { return std::abs(a - b) < 1e-6 * width; };
  for (int axis = 0; axis < 3; ++axis) {
    is_mirrored_[static_cast<std::size_t>(axis)] = is_mirror(axis, 0) && is_mirror(axis, 1);
    const double width = grid.spacing[axis];
    const double high = grid.low[axis] + width * grid.count[static_cast<std::size_t>(axis)];
    if (!nearly_equal(grid.low[axis], domain.box().low[axis], width) ||
        !nearly_equal(high, domain.box().high[axis], width))
      throw std::invalid_argument("Deposition: the grid must fill the box");
  }
  Vector3 part;
  for (int axis = 0; axis < 3; ++axis) part[axis] = grid.spacing[axis] / CellsAlong::parts(grid, axis);
  min_reach_ = 0.5001 * norm(part);
  beyond_reach_ = 0.5 * norm(grid.spacing - part);
}

void Deposition::find_weights(ThreadTeam& team, std::span<const Vector3> position,
                              std::span<const double> smoothing_length, std::span<const char> is_left_out) {
  count_ = position.size();
  blocks_.resize((count_ + block_size - 1) / block_size);
  team.run(blocks_.size(), [&](std::size_t b) {
    Block& block = blocks_[b];
    Scratch scratch;
    block.particle.clear(), block.rows = block.weights = 0;
    for (std::size_t i = b * block_size; i < std::min((b + 1) * block_size, count_); ++i)
      if (is_left_out.empty() || !is_left_out[i])
        find_weights(position[i], smoothing_length[i], scratch, block);
      else
        block.particle.push_back({.rows = block.rows});
  });
}

void Deposition::find_weights(const Vector3& x, double h, Scratch& scratch, Block& block) const {
  const double reach = std::max(sph::support * h, min_reach_);
  const double per_width = sph::support / reach;
  for (int axis = 0; axis < 3; ++axis)
    scratch.along[static_cast<std::size_t>(axis)].find(
        grid_, domain_.box(), axis, is_mirrored_[static_cast<std::size_t>(axis)], x[axis], reach, per_width);
  const CellsAlong &along_x = scratch.along[0], &along_y = scratch.along[1], &along_z = scratch.along[2];
  const std::size_t columns = (along_x.cell.size() + row_lanes - 1) / row_lanes * row_lanes, rows = along_y.cell.size();
  const std::size_t all_rows = rows * along_z.cell.size();
  scratch.sum.assign(columns * all_rows, 0), scratch.fate.assign(all_rows, RowFate::empty);
  const bool beside_wall = domain_.is_near_wall(x, reach);
  if (beside_wall) {
    find_seen(x, scratch);
    weigh_seen(columns, scratch);
  }
  // In a corner too narrow for a cell's centre no cell is visible: then it has all.
  if (!beside_wall || std::none_of(scratch.sum.begin(), scratch.sum.end(), [](float w) { return w > 0; }))
    weigh_rows({.columns = columns,
                .many_x = along_x.slot.size(),
                .many_y = along_y.slot.size(),
                .many_z = along_z.slot.size(),
                .square_x = along_x.square.data(),
                .square_y = along_y.square.data(),
                .square_z = along_z.square.data(),
                .column_x = along_x.is_plain ? nullptr : along_x.slot.data(),
                .row_y = along_y.slot.data(),
                .row_z = along_z.slot.data()},
               rows, scratch.sum.data(), scratch.fate.data());
  if (!surface_.is_empty()) leave_out_hidden(x, reach, columns, scratch);
  keep(columns, scratch, block);
}

/// Adds the weights of the cells that are visible to those that have their shares.
void Deposition::weigh_seen(std::size_t columns, Scratch& scratch) {
  const auto& [along_x, along_y, along_z] = scratch.along;
  const std::size_t rows = along_y.cell.size();
  for (std::size_t k = 0; k < along_z.slot.size(); ++k)
    for (std::size_t j = 0; j < along_y.slot.size(); ++j) {
      const float across = along_y.square[j] + along_z.square[k];
      if (!(across < static_cast<float>(sph::support * sph::support))) continue;
      const Scratch::Seen* seen = scratch.seen.data() + k * along_x.slot.size();
      for (std::size_t i = 0; i < along_x.slot.size(); ++i) {
        if (!seen[i]) continue;
        const std::size_t row = along_y.slot[j] + rows * seen[i]->z;
        scratch.fate[row] = RowFate::kept;
        scratch.sum[seen[i]->x + columns * row] += weight_at(across + along_x.square[i]);
      }
    }
}

/// Appends the rows of cells that have weights; those beyond open faces count for their sum alone.
void Deposition::keep(std::size_t columns, Scratch& scratch, Block& block) const {
  const auto& [along_x, along_y, along_z] = scratch.along;
  constexpr int left = CellsAlong::left;
  const std::size_t rows = along_y.cell.size(), all_rows = scratch.fate.size();
  if (block.first.size() < block.rows + all_rows) block.first.resize(2 * (block.rows + all_rows));
  if (block.weight.size() < block.weights + scratch.sum.size())
    block.weight.resize(2 * (block.weights + scratch.sum.size()));
  const std::size_t first_row = block.rows;
  for (std::size_t k = 0; k < along_z.cell.size(); ++k)
    for (std::size_t j = 0; j < rows; ++j) {
      RowFate& fate = scratch.fate[j + rows * k];
      if (fate == RowFate::empty) continue;
      if (along_y.cell[j] == left || along_z.cell[k] == left)
        fate = RowFate::lost;
      else
        block.first[block.rows++] =
            static_cast<std::uint32_t>(grid_.index(along_x.cell.front(), along_y.cell[j], along_z.cell[k]));
    }
  float* kept = block.weight.data() + block.weights;
  const double total = keep_rows(all_rows, columns, scratch.fate.data(), scratch.sum.data(), kept);
  const std::size_t weights = columns * (block.rows - first_row);
  if (along_x.cell.back() == left)
    for (std::size_t w = along_x.cell.size() - 1; w < weights; w += columns) kept[w] = 0;
  block.weights += weights;
  block.particle.push_back({.rows = block.rows, .columns = columns, .per_total = 1 / total});
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

/// Takes the weights of cells behind the surface, unless there are no others. A cell that stands for one beyond a
/// mirror is as visible as the cell itself: where the surface meets the mirror, both are visible or neither. Cells on
/// the particle's side of all of the surface that is near are visible; others are tested.
void Deposition::leave_out_hidden(const Vector3& x, double reach, std::size_t columns, Scratch& scratch) const {
  constexpr std::size_t most = 64;           // slabs, and triangles, that are tried one by one
  constexpr double thin = 0.02, wide = 2.0;  // slabs, of the distance
  const double far = reach + beyond_reach_;  // of a cell's centre at most
  const Vector3 around{far, far, far};
  const bool few = surface_.slabs_within(x - around, x + around, thin * far, wide * far, most, scratch.slabs);
  if (scratch.slabs.empty()) return;
  const bool clear = few && find_half_spaces(x, far, scratch.slabs, scratch.half_spaces);
  if (clear && scratch.half_spaces.empty()) return;
  for (int axis = 0; axis < 3; ++axis) {
    const CellsAlong& along = scratch.along[static_cast<std::size_t>(axis)];
    std::vector<double>& centre = scratch.centre[static_cast<std::size_t>(axis)];
    const double width = grid_.spacing[axis], length = width * grid_.count[static_cast<std::size_t>(axis)];
    const bool is_periodic = domain_.box().face(axis, 0) == FaceKind::periodic;
    centre.clear();
    for (const int cell : along.cell) {
      const double c = grid_.low[axis] + (cell + 0.5) * width;
      centre.push_back(is_periodic ? c - length * std::round((c - x[axis]) / length) : c);
    }
  }
  const auto& [along_x, along_y, along_z] = scratch.along;
  scratch.all = scratch.sum;
  bool has_seen = false, sought = false, are_all = false;
  for (std::size_t k = 0; k < along_z.cell.size(); ++k)
    for (std::size_t j = 0; j < along_y.cell.size(); ++j) {
      if (along_y.cell[j] == CellsAlong::left || along_z.cell[k] == CellsAlong::left) continue;
      for (std::size_t i = 0; i < along_x.cell.size(); ++i) {
        float& weight = scratch.sum[i + columns * (j + along_y.cell.size() * k)];
        if (!(weight > 0) || along_x.cell[i] == CellsAlong::left) continue;
        const Vector3 c{scratch.centre[0][i], scratch.centre[1][j], scratch.centre[2][k]};
        const bool is_clear = clear && std::all_of(scratch.half_spaces.begin(), scratch.half_spaces.end(),
                                                   [&](const Slab& slab) { return slab.height(c) > slab.slack; });
        if (!is_clear && !sought) {
          are_all = surface_.near(x, far, most, scratch.near);
          sought = true;
        }
        if (!is_clear && (are_all ? surface_.blocks(x, c, scratch.near) : surface_.blocks(x, c)))
          weight = 0;
        else
          has_seen = true;
      }
    }
  if (!has_seen) scratch.sum = scratch.all;
}

/// Calls body(particle, what it has, rows, cells of its rows, their weights).
template <class Body>
void Deposition::for_each_particle(const Block& block, std::size_t first, Body&& body) const {
  std::size_t row = 0, weight = 0;
  for (std::size_t n = 0; n < block.particle.size(); ++n) {
    const Particle& particle = block.particle[n];
    const std::size_t rows = particle.rows - row;
    body(first + n, particle, rows, block.first.data() + row, block.weight.data() + weight);
    row = particle.rows, weight += rows * particle.columns;
  }
}

void Deposition::deposit(ThreadTeam& team, double solid_volume, MassRatios ratios, std::span<const Vector3> velocity,
                         CellField& fraction, FaceField& flux) const {
  // Cells are shared by particles of several blocks, so pairs of the four sums are the tasks. A single thread reads the
  // weights once for all. Sums in fixed point are of no order.
  constexpr double of_fraction = rounding_to(0x1p-50), of_flux = rounding_to(0x1p-44);  // up to 8, and 512 m/s
  const double share = solid_volume / grid_.volume();
  CellField* const field[] = {&fraction, &flux[0], &flux[1], &flux[2]};
  const bool is_alone = team.size() == 1;
  team.run(is_alone ? 1 : 2, [&](std::size_t task) {
    const std::size_t from = 2 * task, to = is_alone ? 4 : from + 2;
    for (std::size_t n = from; n < to; ++n) std::fill(field[n]->begin(), field[n]->end(), 0.0);
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      for_each_particle(blocks_[b], b * block_size,
                        [&](std::size_t i, const Particle& particle, std::size_t rows, const std::uint32_t* first,
                            const float* weight) {
                          const double amount = share * ratios[i] * particle.per_total;
                          const Vector3& v = velocity[i];
                          const double amounts[] = {amount, amount * v.x, amount * v.y, amount * v.z};
                          if (is_alone)
                            add_rows(rows, particle.columns, first, weight, amounts, of_fraction, of_flux,
                                     {field[0]->data(), field[1]->data(), field[2]->data(), field[3]->data()});
                          else
                            add_rows(rows, particle.columns, first, weight, amounts[from], amounts[from + 1],
                                     task == 0 ? of_fraction : of_flux, of_flux, field[from]->data(),
                                     field[from + 1]->data());
                        });
  });
}

std::array<std::size_t, 2> Deposition::rows() const {
  std::array<std::size_t, 2> range{grid_.size(), 0};
  for (const Block& block : blocks_)
    for (std::size_t r = 0; r < block.rows; ++r)
      range = {std::min<std::size_t>(range[0], block.first[r]), std::max<std::size_t>(range[1], block.first[r])};
  return range;
}

void Deposition::distribute(ThreadTeam& team, double solid_volume, MassRatios ratios, const FaceField& per_solid_volume,
                            std::span<Vector3> received) const {
  const CellField &x = per_solid_volume[0], &y = per_solid_volume[1], &z = per_solid_volume[2];
  team.run(blocks_.size(), [&](std::size_t b) {
    for_each_particle(blocks_[b], b * block_size,
                      [&](std::size_t i, const Particle& particle, std::size_t rows, const std::uint32_t* first,
                          const float* weight) {
                        const Vector3 sum =
                            sum_rows(rows, particle.columns, first, weight, x.data(), y.data(), z.data());
                        received[i] = solid_volume * ratios[i] * particle.per_total * sum;
                      });
  });
}

double Deposition::max_mean(ThreadTeam& team, const FaceField& vector, const CellField& square, double at_least) {
  const CellField &x = vector[0], &y = vector[1], &z = vector[2];
  row_max_.resize((square.size() + row_lanes - 1) / row_lanes);
  find_max(square.size(), square.data(), row_max_.data());
  // A mean is no larger than the largest, but for its rounding.
  const double enough = at_least * at_least * (1 - 1e-12);
  std::vector<double> found(blocks_.size());
  team.run(blocks_.size(), [&](std::size_t b) {
    for_each_particle(
        blocks_[b], b * block_size,
        [&](std::size_t, const Particle& particle, std::size_t rows, const std::uint32_t* first, const float* weight) {
          double bound = 0;
          for (std::size_t r = 0; r < rows; ++r) {
            const std::size_t last = (first[r] + particle.columns - 1) / row_lanes;
            for (std::size_t c = first[r] / row_lanes; c <= last; ++c)
              bound = row_max_[c] > bound ? row_max_[c] : bound;
          }
          if (bound <= enough) return;
          const Vector3 sum = sum_rows(rows, particle.columns, first, weight, x.data(), y.data(), z.data());
          found[b] = std::max(found[b], norm(particle.per_total * sum));
        });
  });
  for (const double of_block : found) at_least = std::max(at_least, of_block);
  return at_least;
}

}  // namespace talus::coupling

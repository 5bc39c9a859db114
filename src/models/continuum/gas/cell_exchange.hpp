// SPDX-License-Identifier: Apache-2.0
/// What a process's particles and the cells of other processes give each other: deposits, and fields of the cells.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "models/air/part.hpp"
#include "models/air/state.hpp"
#include "physics/coupling/deposition.hpp"

namespace talus::continuum {

class CellExchange {
 public:
  /// Together, as all calls. \param part of the cells; outlives this
  CellExchange(const Grid& grid, const air::Part& part);

  /// Takes the rows of cells on which particles of this process have weights.
  void find_rows(const coupling::Deposition& deposition);

  /// Adds up what the particles of all have deposited, on the rows that this process knows; sums in fixed point.
  void add_up(air::Solids& solids);

  /// Brings fields of cells from their owners to the rows of the particles.
  void bring(std::span<CellField* const> fields);

 private:
  void plan();

  Grid grid_;
  const air::Part& part_;
  std::vector<RowRange> known_;  // rows that each process knows, two slabs of each
  RowRange touched_;             // by particles of this process, with room to move
  std::unique_ptr<Plan> deposits_;
  std::vector<std::uint32_t> sent_, received_;  // rows of the grid
  std::vector<double> going_, coming_;
  Halo fields_;
};

}  // namespace talus::continuum

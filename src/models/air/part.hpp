// SPDX-License-Identifier: Apache-2.0
/// The rows of the air that one of several processes advances (a row of cells along x has the number j + count[1] k).
/// Every process has fields of all rows, and knows them on its own rows and some around these.
#pragma once

#include <span>
#include <vector>

#include "numerics/grid/grid.hpp"
#include "ranks/halo.hpp"
#include "ranks/ranks.hpp"
#include "ranks/slabs.hpp"

namespace talus::air {

struct Part {
  const Ranks& ranks;
  std::vector<RowRange> all, own;
  std::vector<RowRange> with_next;  ///< the planes of the own rows and the next one: the faces around own cells
  std::vector<RowRange> beside;     ///< those on both sides: the cells next to these faces
  std::vector<RowRange> midpoint;   ///< those whose velocities act on these faces
  std::vector<RowRange> known;      ///< those on which a step needs the state and the solids

  /// \param slabs of the rows of cells; \param ranks outlive the part
  Part(const Ranks& ranks, const Grid& grid, const Slabs& slabs);

  RowRange own_slab() const { return own.front(); }
  /// Together: brings fields' values on rows that others own, as far as the next step needs them, ghosts among them.
  void refresh(std::span<CellField* const> fields);
  /// Together: brings the first process the values of all rows.
  void gather(std::span<CellField* const> fields) const;
  /// Together: brings fields' values on rows of cells. \param needed by this process, at most two slabs
  Halo halo(std::span<const RowRange> needed) const;

 private:
  Grid grid_;
  Slabs slabs_;
  Halo around_;
};

/// A field as a column of its rows.
inline Halo::Column rows_of(const Grid& grid, CellField& field) {
  return {reinterpret_cast<std::byte*>(field.data()), grid.length(0)};
}

}  // namespace talus::air

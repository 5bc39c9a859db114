// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/sort.hpp"

#include <cstddef>
#include <type_traits>

#include "numerics/cell_grid.hpp"

namespace talus::continuum {

void sort_for_locality(State& state, double cell_size) {
  const std::vector<std::uint32_t> order = spatial_order(state.position, cell_size);
  const auto sort = [&]<class Member>(const FieldInfo& field, Member& column) {
    if constexpr (!std::is_arithmetic_v<Member>) {
      if (!field.of_particles || column.empty()) return;  // not yet filled
      Member sorted(order.size());
      for (std::size_t n = 0; n < order.size(); ++n) sorted[n] = column[order[n]];
      column = std::move(sorted);
    }
  };
  for_each_field(sort, state);
}

}  // namespace talus::continuum

// SPDX-License-Identifier: Apache-2.0
/// The columns of particles of a state, all at once.
#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "models/continuum/state.hpp"

namespace talus::continuum {

/// Gives every column of particles one entry for each of `order`, those of these particles.
inline void select(State& state, const std::vector<std::uint32_t>& order) {
  const auto take = [&]<class Member>(const FieldInfo& field, Member& column) {
    if constexpr (!std::is_arithmetic_v<Member>) {
      if (!field.of_particles || column.empty()) return;
      Member kept(order.size());
      for (std::size_t n = 0; n < order.size(); ++n) kept[n] = column[order[n]];
      column = std::move(kept);
    }
  };
  for_each_field(take, state);
}

/// Gives every column of particles so many entries; new ones are zero.
inline void resize_columns(State& state, std::size_t count) {
  const auto resize = [&]<class Member>(const FieldInfo& field, Member& column) {
    if constexpr (!std::is_arithmetic_v<Member>)
      if (field.of_particles) column.resize(count);
  };
  for_each_field(resize, state);
}

}  // namespace talus::continuum

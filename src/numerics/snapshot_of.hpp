// SPDX-License-Identifier: Apache-2.0
/// The view of a state that observers and files get, from the state's own list of fields.
#pragma once

#include <cstdint>
#include <span>
#include <type_traits>

#include "numerics/field.hpp"
#include "numerics/snapshot.hpp"

namespace talus {

/// All columns of the state that belong into snapshots, and its fields "time" (double) and "step" (std::uint64_t).
/// \param state any type with a for_each_field(visit, state) in its namespace; the view is valid while it is unchanged
template <class State>
Snapshot snapshot_of(const State& state) {
  Snapshot snapshot;
  const auto collect = [&](const FieldInfo& field, const auto& member) {
    using Member = std::decay_t<decltype(member)>;
    if constexpr (std::is_same_v<Member, double>) {
      if (field.name == "time") snapshot.time = member;
    } else if constexpr (std::is_same_v<Member, std::uint64_t>) {
      if (field.name == "step") snapshot.step = member;
    } else if (field.in_snapshots) {
      snapshot.columns.push_back({field.name, field.unit, std::span(member)});
    }
  };
  for_each_field(collect, state);
  return snapshot;
}

}  // namespace talus

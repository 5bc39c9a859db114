// SPDX-License-Identifier: Apache-2.0
/// The description of a field of the state. A model lists its fields and counters once, in a function template
///
///     template <class Visit> void for_each_field(Visit&& visit, State& s) {
///       visit(FieldInfo{"position", "m", FieldRole::kept}, s.position);
///       ...
///     }
///
/// from which snapshots and checkpoints follow. A member is a column (std::vector of double, Vector3 or std::int64_t,
/// one entry per particle unless noted) or a number of the whole state (double or std::uint64_t).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

#include "numerics/snapshot.hpp"

namespace talus {

enum class FieldRole {
  kept,    ///< belongs to the state: checkpointed
  derived  ///< follows from kept fields: written to snapshots only
};

struct FieldInfo {
  std::string_view name;
  std::string_view unit;  ///< SI; "1" for numbers
  FieldRole role = FieldRole::kept;
  bool in_snapshots = true;
  bool of_particles = true;  ///< a column: one entry per particle, in their order
};

// The view of a state that observers and files get, from the state's own list of fields.

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

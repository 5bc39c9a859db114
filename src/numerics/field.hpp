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

#include <string_view>

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

}  // namespace talus

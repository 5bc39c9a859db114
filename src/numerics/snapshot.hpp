// SPDX-License-Identifier: Apache-2.0
/// A read-only view of particles at one time: what observers, files and analysis see of a model.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/vector.hpp"

namespace talus {

class Domain;

/// One column: one entry per particle.
struct ColumnView {
  std::string_view name;
  std::string_view unit;
  std::variant<std::span<const double>, std::span<const Vector3>, std::span<const std::int64_t>> values;
};

/// Says of columns that they are of one sector about an upright axis, of which the whole is so many copies
/// (numerics/whole.hpp).
struct SectorCopies {
  Vector3 axis;                 ///< a place on it, m
  int count = 1;                ///< of the sectors that make up the whole, itself counted
  std::int64_t identities = 0;  ///< of particles in one copy: those of copy k are (identity + k identities) mod count
                                ///< identities
};

/// The particles at one time. Valid as long as the state it was made from is unchanged. The column "position" is always
/// there.
struct Snapshot {
  double time = 0;  ///< s
  std::uint64_t step = 0;
  std::vector<ColumnView> columns;
  const Domain* domain = nullptr;  ///< where the particles are; null: no boundaries, or not known
  std::optional<SectorCopies> copies = std::nullopt;

  /// Number of particles; 0 where a model has none, and no columns.
  std::size_t size() const;
  /// \throws std::out_of_range naming the column and those that are there
  std::span<const double> scalars(std::string_view name) const;
  std::span<const Vector3> vectors(std::string_view name) const;
  std::span<const std::int64_t> integers(std::string_view name) const;
  std::span<const Vector3> positions() const { return vectors("position"); }
  bool has(std::string_view name) const;
};

/// Particles that own their columns: what is read from a file.
struct PointSet {
  struct Column {
    std::string name;
    std::string unit;
    std::variant<std::vector<double>, std::vector<Vector3>, std::vector<std::int64_t>> values;
  };
  double time = 0;
  std::uint64_t step = 0;
  std::vector<Column> columns;
  std::optional<SectorCopies> copies = std::nullopt;

  Snapshot view() const;
};

}  // namespace talus

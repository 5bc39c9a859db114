// SPDX-License-Identifier: Apache-2.0
/// Particles, grids and surfaces at one time: what observers, files and analysis get of a model.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "base/vector.hpp"
#include "numerics/mass_ratios.hpp"

namespace talus {

class Domain;

/// One column: one entry per particle.
struct ColumnView {
  std::string_view name;
  std::string_view unit;
  std::variant<std::span<const double>, std::span<const Vector3>, std::span<const std::int64_t>> values;
};

/// A column that is read piece by piece: it need not be anywhere as a whole.
struct ColumnSource {
  enum class Kind { real, vector, integer, byte };
  std::string name, unit;
  Kind kind = Kind::real;
  /// Writes so many entries, from `first` on, to memory. Calls go from the first to the last, each entry once.
  std::function<void(std::size_t first, std::size_t count, std::byte* to)> read;

  std::size_t entry_bytes() const { return kind == Kind::byte ? 1 : kind == Kind::vector ? 24 : 8; }
};
/// Of a column of doubles, vectors or 64-bit integers.
template <class Entry>
inline constexpr ColumnSource::Kind kind_of = std::is_same_v<Entry, Vector3>  ? ColumnSource::Kind::vector
                                              : std::is_same_v<Entry, double> ? ColumnSource::Kind::real
                                                                              : ColumnSource::Kind::integer;
/// Of a column that is as it is until the source has been read.
ColumnSource source_of(const ColumnView& column);

/// Says of columns that they are of one sector about an upright axis, of which the whole is so many copies
///(`whole_of`).
struct SectorCopies {
  Vector3 axis;                 ///< a position on it, m
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
  MassRatios mass_ratios() const { return {has("mass_ratio") ? scalars("mass_ratio") : std::span<const double>{}}; }
};

/// The same whose columns are read piece by piece: what is written to a file.
struct PointSource {
  double time = 0;
  std::uint64_t step = 0;
  std::size_t count = 0;
  std::vector<ColumnSource> columns;  ///< each with `count` entries
  std::optional<SectorCopies> copies = std::nullopt;
};
/// \throws std::invalid_argument if columns are not equally long
PointSource source_of(const Snapshot& snapshot);

/// Some entries of a column of the particles, which is counted among those that for_each_field names.
struct ColumnPiece {
  std::uint64_t column, first, count;
};

/// Hands over particles piece by piece, in their order; at least one piece, if an empty one.
using Pieces = std::function<void(const std::function<void(const Snapshot& piece)>& take)>;

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

/// Reads some particles of a source, of all columns or of those named.
PointSet points_of(const PointSource& source, std::size_t first, std::size_t count,
                   std::span<const std::string> names = {});

/// Values in the cells of a regular grid: the air.
struct GridSnapshot {
  struct Column {
    std::string name;
    std::string unit;
    std::variant<std::vector<double>, std::vector<Vector3>> values;  ///< one per cell, x fastest
  };
  double time = 0;  ///< s
  std::uint64_t step = 0;
  std::array<int, 3> count{};  ///< cells along x, y, z
  Vector3 low, spacing;        ///< corner, and size of a cell, m
  std::vector<Column> columns;

  std::size_t cells() const {
    return static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(count[2]);
  }
  std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(count[0]) *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(k));
  }
  Vector3 centre(int i, int j, int k) const {
    return low + Vector3{(i + 0.5) * spacing.x, (j + 0.5) * spacing.y, (k + 0.5) * spacing.z};
  }
  /// The cell along an axis that holds a coordinate; the last one for one beyond it.
  int cell_at(int axis, double coordinate) const;

  /// \throws std::out_of_range naming the column
  const std::vector<double>& scalars(std::string_view name) const;
  const std::vector<Vector3>& vectors(std::string_view name) const;
};

/// Values on the triangles of a surface: the walls of a vessel.
struct SurfaceSnapshot {
  double time = 0;  ///< s
  std::uint64_t step = 0;
  std::vector<Vector3> points;                         ///< corners, m
  std::vector<std::array<std::int64_t, 3>> triangles;  ///< numbers of their corners
  std::vector<GridSnapshot::Column> columns;           ///< one entry per triangle
};

/// The particles of all copies, copy by copy: positions, vectors and tensors (six columns NAME_xx, NAME_yy, NAME_zz,
/// NAME_xy, NAME_yz, NAME_zx) turned about the axis. A particle that has passed a face of the sector goes on in the
/// next copy: its identity there is that which it had here. \pre part.copies \throws std::invalid_argument if the
/// copies are too few or too many (Sector) \param columns that the whole has, empty: all
PointSet whole_of(const Snapshot& part, std::span<const std::string> columns = {});

}  // namespace talus

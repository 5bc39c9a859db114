// SPDX-License-Identifier: Apache-2.0
/// A surface cut into fields of about one size, on which is noted what acts there.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/vector.hpp"
#include "numerics/surface/surface.hpp"

namespace talus {

/// What a footprint covers: a field and the one above or below it.
struct FieldShare {
  std::uint32_t field = 0, other = 0;
  float share = 1;  ///< of the footprint that lies on the first
};

class SurfaceFields {
  static constexpr double infinity = std::numeric_limits<double>::infinity();

 public:
  SurfaceFields() = default;
  /// \param size of a field, > 0, m: at most its side, spread_points() \param sector of which the surface has copies
  /// \param low, high corners of the box within which the surface counts, m
  SurfaceFields(const Surface& surface, double size, const std::optional<Sector>& sector = {},
                const Vector3& low = {-infinity, -infinity, -infinity},
                const Vector3& high = {infinity, infinity, infinity});

  std::size_t count() const { return fields_.size(); }
  /// Whether what lies there counts.
  bool counts(const Vector3& x) const {
    return x.x >= from_.x && x.y >= from_.y && x.z >= from_.z && x.x <= to_.x && x.y <= to_.y && x.z <= to_.z;
  }
  /// The middle and normal of each, the area of what counts and is nearer to this middle than to others of its smooth
  /// part, and the patch and part to which it belongs.
  std::span<const SurfacePoint> all() const { return fields_; }

  /// The field of a smooth part that is nearest to a position; of several as near the first. \pre the part has an area
  std::uint32_t at(std::uint32_t part, const Vector3& place) const;

  /// The fields under a footprint half a field high around a position, along the line of steepest descent; on a level
  /// part the field there alone. Particles stand in rows: noted at their middles, a row more or less would make a
  /// quarter of a band's load. \pre the part has an area
  FieldShare under(std::uint32_t part, const Vector3& place) const;

  /// The field of a sector itself that a field is a copy of; without a sector, the field.
  std::size_t original(std::size_t field) const { return sector_ ? field % own() : field; }
  /// A vector at its original as it is at a field, and the reverse.
  Vector3 from_original(std::size_t field, const Vector3& v) const { return turned(field, 1, v); }
  Vector3 to_original(std::size_t field, const Vector3& v) const { return turned(field, -1, v); }

 private:
  std::size_t own() const { return fields_.size() / static_cast<std::size_t>(sector_->copies()); }
  Vector3 turned(std::size_t field, int way, const Vector3& v) const {
    const int copy = sector_ ? static_cast<int>(field / own()) : 0;
    return copy == 0 ? v : sector_->turn(way * copy) * v;
  }
  void find_areas(const Surface& surface);

  double size_ = 0;
  Vector3 from_, to_;
  std::optional<Sector> sector_;
  std::vector<SurfacePoint> fields_;
  // Their middles in the cells of a dense grid: a search is made for every particle at a wall in every step.
  Vector3 low_;
  double cell_ = 1;
  std::array<int, 3> count_{};
  std::vector<std::uint32_t> first_, of_cells_;
  std::array<int, 3> cell_of(const Vector3& x) const;
  std::size_t number(int i, int j, int k) const;
};

/// The triangles of a surface, cut until no edge is longer than a length, each whose middle counts with the field in
/// whose part and nearest to whose middle it is: what is drawn of the fields.
struct FieldMesh {
  std::vector<Vector3> points;                       ///< the corners of all triangles, each once
  std::vector<std::array<std::int64_t, 3>> corners;  ///< of each triangle, numbers of points
  std::vector<std::uint32_t> field;                  ///< of each triangle
};
/// \param edge > 0, m; no area exceeds an eighteenth of its square: flat walls are cut as fine as round ones
FieldMesh mesh_of(const Surface& surface, const SurfaceFields& fields, double edge);

}  // namespace talus

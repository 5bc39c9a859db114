// SPDX-License-Identifier: Apache-2.0
/// A surface cut into fields of about one size, on which is noted what acts there.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vector.hpp"
#include "numerics/surface/surface.hpp"
#include "numerics/surface/surface_points.hpp"

namespace talus {

class SurfaceFields {
 public:
  SurfaceFields() = default;
  /// \param size of a field, > 0, m: at most its side, spread_points()
  SurfaceFields(const Surface& surface, double size);

  std::size_t count() const { return fields_.size(); }
  /// The middle, normal and area of each, and the patch and the smooth part to which it belongs.
  std::span<const SurfacePoint> all() const { return fields_; }

  /// The field of a smooth part that is nearest to a place; of several as near the first. \pre the part has an area
  std::uint32_t at(std::uint32_t part, const Vector3& place) const;

 private:
  double size_ = 0;
  std::vector<SurfacePoint> fields_;
  // Their middles in the cells of a dense grid: a search is made for every particle at a wall in every step.
  Vector3 low_;
  double cell_ = 1;
  std::array<int, 3> count_{};
  std::vector<std::uint32_t> first_, of_cells_;
  std::array<int, 3> cell_of(const Vector3& x) const;
  std::size_t number(int i, int j, int k) const;
};

/// The triangles of a surface, cut until no edge is longer than a length, each with the field in whose part and nearest
/// to whose middle it is: what is drawn of the fields.
struct FieldMesh {
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> field;  ///< of each triangle
};
/// \param edge > 0, m
FieldMesh mesh_of(const Surface& surface, const SurfaceFields& fields, double edge);

}  // namespace talus

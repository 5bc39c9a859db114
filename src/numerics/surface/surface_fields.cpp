// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/surface_fields.hpp"

#include <limits>

namespace talus {

namespace {

constexpr double reach = 1.5;  // in sizes: so near a field's middle is to any of its places, but for rests

std::vector<Vector3> middles(std::span<const SurfacePoint> fields) {
  std::vector<Vector3> places;
  for (const SurfacePoint& field : fields) places.push_back(field.place);
  return places;
}

}  // namespace

SurfaceFields::SurfaceFields(const Surface& surface, double size) : size_(size) {
  if (surface.is_empty()) return;
  fields_ = spread_points(surface, size);
  grid_ = std::make_unique<CellGrid>(middles(fields_), reach * size);
}

std::uint32_t SurfaceFields::at(std::uint32_t part, const Vector3& place) const {
  double closest = std::numeric_limits<double>::infinity();
  std::uint32_t best = 0;
  const auto offer = [&](std::uint32_t n) {
    if (fields_[n].part != part) return;
    const Vector3 d = fields_[n].place - place;
    const double distance = dot(d, d);
    if (distance < closest || (distance == closest && n < best)) closest = distance, best = n;
  };
  grid_->for_each_candidate(place, offer);
  if (closest <= reach * reach * size_ * size_) return best;
  for (std::uint32_t n = 0; n < fields_.size(); ++n) offer(n);
  return best;
}

FieldMesh mesh_of(const Surface& surface, const SurfaceFields& fields, double edge) {
  FieldMesh mesh;
  for (std::uint32_t t = 0; t < surface.triangles().size(); ++t) {
    std::vector<Triangle> left{surface.triangles()[t]};
    while (!left.empty()) {
      const Triangle whole = left.back();
      left.pop_back();
      std::size_t longest = 0;
      double length = 0;
      for (std::size_t c = 0; c < 3; ++c)
        if (const double l = norm(whole.corner[(c + 1) % 3] - whole.corner[c]); l > length) length = l, longest = c;
      if (length <= edge) {
        mesh.field.push_back(fields.at(surface.part(t), whole.middle()));
        mesh.triangles.push_back(whole);
        continue;
      }
      const Vector3 &a = whole.corner[longest], &b = whole.corner[(longest + 1) % 3],
                    &c = whole.corner[(longest + 2) % 3], middle = 0.5 * (a + b);
      left.push_back({{a, middle, c}, whole.patch});
      left.push_back({{middle, b, c}, whole.patch});
    }
  }
  return mesh;
}

}  // namespace talus

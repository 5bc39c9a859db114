// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/surface_fields.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/surface/triangle.hpp"

namespace talus {

namespace {

constexpr double reach = 1.5;  // in sizes: so near a field's middle is to any of its positions, but for rests

constexpr double level = 0.03;  // sine of the angle with the horizontal

constexpr double max_piece = 0.25;  // in sizes: longest edge of the pieces whose areas are given to fields

constexpr double area_of_edge = 1.0 / 18;  // of triangles of a mesh, over the square of their longest edge

constexpr double max_cells = 2e6;

/// Calls visit(number of the triangle, piece) for pieces of the surface without an edge longer than a length, m, nor an
/// area above one, m^2.
template <class Visit>
void for_each_piece(const Surface& surface, double edge, double area, Visit&& visit) {
  std::vector<Triangle> left;
  for (std::uint32_t t = 0; t < surface.triangles().size(); ++t) {
    left.assign(1, surface.triangles()[t]);
    while (!left.empty()) {
      const Triangle whole = left.back();
      left.pop_back();
      std::size_t longest = 0;
      double length = 0;
      for (std::size_t c = 0; c < 3; ++c)
        if (const double l = norm(whole.corner[(c + 1) % 3] - whole.corner[c]); l > length) length = l, longest = c;
      if (length <= edge && norm(whole.area()) <= area) {
        visit(t, whole);
        continue;
      }
      const Vector3 &a = whole.corner[longest], &b = whole.corner[(longest + 1) % 3],
                    &c = whole.corner[(longest + 2) % 3], middle = 0.5 * (a + b);
      left.push_back({{a, middle, c}, whole.patch});
      left.push_back({{middle, b, c}, whole.patch});
    }
  }
}

}  // namespace

SurfaceFields::SurfaceFields(const Surface& surface, double size, const std::optional<Sector>& sector,
                             const Vector3& low, const Vector3& high)
    : size_(size), from_(low), to_(high), sector_(sector) {
  if (surface.is_empty()) return;
  fields_ = spread_points(surface, size, sector);
  low_ = surface.low();
  const Vector3 extent = surface.high() - low_;
  cell_ = reach * size;
  const auto along = [&](double length) { return std::floor(length / cell_) + 1; };
  while (along(extent.x) * along(extent.y) * along(extent.z) > max_cells) cell_ *= 2;
  for (int axis = 0; axis < 3; ++axis) count_[static_cast<std::size_t>(axis)] = static_cast<int>(along(extent[axis]));
  std::vector<std::size_t> cell;
  for (const SurfacePoint& field : fields_) {
    const auto [i, j, k] = cell_of(field.place);
    cell.push_back(number(i, j, k));
  }
  first_.assign(number(count_[0] - 1, count_[1] - 1, count_[2] - 1) + 2, 0);
  for (const std::size_t c : cell) ++first_[c + 1];
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  of_cells_.resize(fields_.size());
  for (std::uint32_t n = 0; n < fields_.size(); ++n) of_cells_[next[cell[n]]++] = n;
  find_areas(surface);
}

void SurfaceFields::find_areas(const Surface& surface) {
  const std::size_t copies = sector_ ? static_cast<std::size_t>(sector_->copies()) : 1, own = fields_.size() / copies;
  std::vector<double> area(own, 0.0);
  const double any = std::numeric_limits<double>::infinity();
  for_each_piece(surface, max_piece * size_, any, [&](std::uint32_t t, const Triangle& piece) {
    const Vector3 x = piece.middle();
    if (!counts(x)) return;
    area[at(surface.part(t), x) % own] += norm(piece.area()) / static_cast<double>(copies);
  });
  for (std::size_t n = 0; n < fields_.size(); ++n) fields_[n].area = area[n % own];
}

std::array<int, 3> SurfaceFields::cell_of(const Vector3& x) const {
  std::array<int, 3> cell{};
  for (std::size_t a = 0; a < 3; ++a) {
    const int axis = static_cast<int>(a);
    cell[a] = static_cast<int>(std::clamp(std::floor((x[axis] - low_[axis]) / cell_), 0.0, double(count_[a] - 1)));
  }
  return cell;
}

std::size_t SurfaceFields::number(int i, int j, int k) const {
  return static_cast<std::size_t>(i) +
         static_cast<std::size_t>(count_[0]) *
             (static_cast<std::size_t>(j) + static_cast<std::size_t>(count_[1]) * static_cast<std::size_t>(k));
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
  const auto [x, y, z] = cell_of(place);
  const int first = std::max(0, x - 1), last = std::min(count_[0] - 1, x + 1);
  for (int k = std::max(0, z - 1); k <= std::min(count_[2] - 1, z + 1); ++k)
    for (int j = std::max(0, y - 1); j <= std::min(count_[1] - 1, y + 1); ++j)
      for (std::uint32_t n = first_[number(first, j, k)]; n < first_[number(last, j, k) + 1]; ++n) offer(of_cells_[n]);
  if (closest <= reach * reach * size_ * size_) return best;
  for (std::uint32_t n = 0; n < fields_.size(); ++n) offer(n);
  return best;
}

FieldShare SurfaceFields::under(std::uint32_t part, const Vector3& place) const {
  constexpr double half_height = 0.25;  // in sizes
  const std::uint32_t own = at(part, place);
  const Vector3& normal = fields_[own].normal;
  const Vector3 down = normal.z * normal - Vector3{0, 0, 1};
  const double slope = norm(down);
  if (!(slope > level)) return {own, own, 1};
  const Vector3 half = (half_height * size_ / slope) * down;
  const std::uint32_t above = at(part, place - half), below = at(part, place + half);
  if (above == below) return {above, above, 1};
  // Where along the footprint, -1 to 1, both middles are equally far.
  const Vector3 a = place - fields_[above].place, b = place - fields_[below].place;
  const double apart = 2 * dot(half, a - b);
  const double border = apart > 0 ? std::clamp((dot(b, b) - dot(a, a)) / apart, -1.0, 1.0) : 0;
  return {above, below, static_cast<float>(0.5 * (1 + border))};
}

FieldMesh mesh_of(const Surface& surface, const SurfaceFields& fields, double edge) {
  FieldMesh mesh;
  std::vector<Triangle> triangles;
  for_each_piece(surface, edge, edge * edge * area_of_edge, [&](std::uint32_t t, const Triangle& piece) {
    const Vector3 x = piece.middle();
    if (!fields.counts(x)) return;
    mesh.field.push_back(fields.at(surface.part(t), x));
    triangles.push_back(piece);
  });
  const TriangleEdges edges(triangles);
  mesh.points.assign(edges.places().begin(), edges.places().end());
  for (const auto& [a, b, c] : edges.corners()) mesh.corners.push_back({a, b, c});
  return mesh;
}

}  // namespace talus

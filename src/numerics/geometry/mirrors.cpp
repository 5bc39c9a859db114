// SPDX-License-Identifier: Apache-2.0
/// Images in walls that are no layers, and from where they are visible.
#include "numerics/geometry/domain.hpp"

#include <algorithm>
#include <cmath>

namespace talus {

namespace {

/// Beyond an open face adjacent faces reach on.
constexpr double far_away = 1e3;  // m

/// Turns the columns for x and z over in a plane with that normal, which has no y.
void reflect(const Vector3& n, Tensor3<>& map) {
  const double x = 2 * (n.x * map.xx + n.z * map.zx), z = 2 * (n.x * map.xz + n.z * map.zz);
  map.xx -= x * n.x, map.zx -= x * n.z;
  map.xz -= z * n.x, map.zz -= z * n.z;
}

/// Least distance of two mirrors that do not cross: one of the ends is nearest.
double distance(const Mirror& a, const Mirror& b) {
  return std::min({distance_to_segment(b.from, a.from, a.to), distance_to_segment(b.to, a.from, a.to),
                   distance_to_segment(a.from, b.from, b.to), distance_to_segment(a.to, b.from, b.to)});
}

}  // namespace

bool same_map(const Image& a, const Image& b, double length) {
  const auto close = [](double x, double y, double slack) { return std::abs(x - y) <= slack; };
  constexpr double rounding = 1e-9;
  return close(a.map.xx, b.map.xx, rounding) && close(a.map.zz, b.map.zz, rounding) &&
         close(a.map.xz, b.map.xz, rounding) && close(a.map.zx, b.map.zx, rounding) &&
         close(a.offset.x, b.offset.x, rounding * length) && close(a.offset.z, b.offset.z, rounding * length);
}

Image mirrored(Image image, const Mirror& mirror) {
  if (mirror.wall < 0) {  // through a periodic face: from the other side
    image.offset += mirror.shift;
    return image;
  }
  reflect(mirror.normal, image.map);
  if (!mirror.printed) reflect(mirror.normal, image.vector_map);
  const double twice = 2 * dot(mirror.normal, image.offset - mirror.from);
  image.offset.x -= twice * mirror.normal.x;
  image.offset.z -= twice * mirror.normal.z;
  return image;
}

void Domain::find_mirrors() {
  for (std::size_t w = 0; w < walls_.size(); ++w)
    mirrors_.push_back({.from = walls_[w].from(),
                        .to = walls_[w].to(),
                        .normal = walls_[w].normal(),
                        .wall = wall_number(static_cast<int>(w)),
                        .shift = {},
                        .printed = false});
  if (layered_) return;
  for (const int axis : {0, 2})
    for (const int side : {0, 1}) {
      const FaceKind kind = box_.face(axis, side);
      if (kind == FaceKind::open) continue;
      const int other = 2 - axis;
      Mirror mirror{.from = box_.low, .to = box_.high, .normal = {}, .wall = -1, .shift = {}, .printed = false};
      mirror.from[axis] = mirror.to[axis] = box_.bound(axis, side);
      if (box_.face(other, 0) == FaceKind::open) mirror.from[other] -= far_away;
      if (box_.face(other, 1) == FaceKind::open) mirror.to[other] += far_away;
      mirror.normal[axis] = 1;
      if (kind == FaceKind::periodic)
        mirror.shift[axis] = (side == 0 ? -1 : 1) * box_.extent(axis);
      else
        mirror.wall = face_number(axis, side);
      mirror.printed = kind == FaceKind::printed;
      mirrors_.push_back(mirror);
    }
}

std::vector<Image> Domain::images_in_walls(double reach) const {
  std::vector<Image> images;
  // The mirror that the line meets last acts first.
  const auto add = [&](std::initializer_list<std::size_t> met) {
    Image image;
    for (std::size_t n = met.size(); n-- > 0;) image = mirrored(image, mirrors_[met.begin()[n]]);
    std::transform(met.begin(), met.end(), image.mirrors.begin(), [](std::size_t m) { return std::int8_t(m); });
    const double length = std::max(box_.extent(0), box_.extent(2));
    if (std::none_of(images.begin(), images.end(), [&](const Image& i) { return same_map(i, image, length); }))
      images.push_back(image);
  };
  for (std::size_t a = 0; a < walls_.size(); ++a) add({a});
  for (std::size_t a = 0; a < walls_.size(); ++a)
    for (std::size_t b = a + 1; b < mirrors_.size(); ++b) {
      if (distance(mirrors_[a], mirrors_[b]) > reach) continue;
      add({a, b}), add({b, a}), add({a, b, a}), add({b, a, b});
    }
  return images;
}

bool Domain::blocks(const Vector3& a, const Vector3& b) const {
  // From both ends the same numbers, so that two never disagree on whether they are mutually visible.
  const bool in_order = a.x != b.x ? a.x < b.x : a.z < b.z;
  const Vector3 &first = in_order ? a : b, &second = in_order ? b : a;
  return std::any_of(walls_.begin(), walls_.end(),
                     [&](const Wall& wall) { return wall.intersection(first, second).has_value(); });
}

bool Domain::is_source_visible(const Vector3& from, const Vector3& to, const Image& image) const {
  if (image.is_identity()) return !blocks(from, to);
  const std::optional<Vector3> end = end_of_line(from, to);
  if (!end) return false;
  const Vector3 off = *end - image.source(to);
  const double slack = 1e-9 * std::max(box_.extent(0), box_.extent(2));
  return std::abs(off.x) < slack && std::abs(off.z) < slack;
}

std::optional<Vector3> Domain::end_of_line(const Vector3& from, const Vector3& to) const {
  if (layered_) {
    Vector3 end = to;
    for (std::size_t w = 0; w < walls_.size(); ++w)
      if (meets_layer(walls_[w], from, to)) end = mirrored(Image{}, mirrors_[w]).position(end);
    return fold(end);
  }
  constexpr int max_turns = 8;
  Vector3 a = from, b = to;
  std::size_t last = mirrors_.size();
  for (int turns = 0; turns < max_turns; ++turns) {
    std::size_t first = mirrors_.size();
    double earliest = 2;
    for (std::size_t m = 0; m < mirrors_.size(); ++m) {
      if (m == last) continue;
      std::optional<double> at;
      if (m < walls_.size()) {
        at = walls_[m].intersection(a, b);
      } else {
        const Mirror& face = mirrors_[m];
        const int axis = face.normal.x != 0 ? 0 : 2;
        const double outward = face.from[axis] > box_.low[axis] ? 1 : -1;
        if (outward * (a[axis] - face.from[axis]) <= 0 && outward * (b[axis] - face.from[axis]) > 0)
          at = (face.from[axis] - a[axis]) / (b[axis] - a[axis]);
      }
      if (at && *at < earliest) earliest = *at, first = m;
    }
    if (first == mirrors_.size()) return b;
    const Mirror& mirror = mirrors_[first];
    a = a + earliest * (b - a);
    if (mirror.wall < 0) {
      a -= mirror.shift;
      b -= mirror.shift;
      // It comes in at the opposite face, from outside: that one is not met.
    } else {
      b = mirrored(Image{}, mirror).position(b);
    }
    last = mirror.wall < 0 ? mirrors_.size() : first;
  }
  return std::nullopt;
}

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/boundary/walls_beyond_faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

namespace talus::continuum {

namespace {

constexpr double slack = 1e-6;  // over the extent of the box: coordinates of files are of single precision

/// One of the box's upright faces. Distances are inwards from it.
struct BoxFace {
  int axis = 0, side = 0;
  double bound = 0, tolerance = 0;

  BoxFace(const Box& box, int along, int at)
      : axis(along), side(at), bound(box.bound(along, at)), tolerance(slack * box.extent(along)) {}
  int inwards_sign() const { return side == 0 ? 1 : -1; }
  double inwards(const Vector3& x) const { return inwards_sign() * (x[axis] - bound); }
};

int corners_in(const Triangle& t, const BoxFace& face) {
  return static_cast<int>(
      std::count_if(t.corner.begin(), t.corner.end(), [&](const Vector3& x) { return x[face.axis] == face.bound; }));
}

/// Calls visit(triangle) for the parts of a triangle on the side of a bound along an axis to which `way`, 1 or -1,
/// leads.
template <class Visit>
void for_each_part(const Triangle& t, int axis, double bound, int way, Visit&& visit) {
  const std::vector<Vector3> polygon = clipped({t.corner.begin(), t.corner.end()}, axis, bound, way);
  for (std::size_t c = 2; c < polygon.size(); ++c) {
    const Triangle part{{polygon[0], polygon[c - 1], polygon[c]}, t.patch};
    if (norm(part.area()) > 0) visit(part);
  }
}

/// The triangles without what lies behind a face. Corners that all but lie in it do.
/// \param whole patches that stay as they are
std::vector<Triangle> cut_at(const BoxFace& face, const std::vector<Triangle>& triangles,
                             const std::set<std::uint32_t>& whole = {}) {
  std::vector<Triangle> kept;
  kept.reserve(triangles.size());
  for (Triangle t : triangles) {
    for (Vector3& x : t.corner)
      if (std::abs(face.inwards(x)) <= face.tolerance) x[face.axis] = face.bound;
    const auto is_behind = [&](const Vector3& x) { return face.inwards(x) < 0; };
    if (whole.contains(t.patch) || std::none_of(t.corner.begin(), t.corner.end(), is_behind))
      kept.push_back(t);
    else
      for_each_part(t, face.axis, face.bound, face.inwards_sign(), [&](const Triangle& part) { kept.push_back(part); });
  }
  return kept;
}

/// Those that have an edge in the face and go on from there into the box.
std::set<std::uint32_t> patches_that_end_at(const BoxFace& face, const std::vector<Triangle>& triangles) {
  std::set<std::uint32_t> patches;
  for (const Triangle& t : triangles)
    if (corners_in(t, face) == 2) patches.insert(t.patch);
  return patches;
}

/// Calls visit(triangle) for the parts nearer to a face than `reach` of patches that end at it, but for what lies in
/// it.
template <class Visit>
void for_each_part_near(const BoxFace& face, double reach, const std::vector<Triangle>& triangles, Visit&& visit) {
  const std::set<std::uint32_t> patches = patches_that_end_at(face, triangles);
  for (const Triangle& t : triangles)
    if (patches.contains(t.patch) && corners_in(t, face) < 3)
      for_each_part(t, face.axis, face.bound + face.inwards_sign() * reach, -face.inwards_sign(), visit);
}

void add_mirror_images(const BoxFace& face, double reach, std::vector<Triangle>& triangles) {
  std::vector<Triangle> images;
  for_each_part_near(face, reach, triangles, [&](Triangle part) {
    for (Vector3& x : part.corner) x[face.axis] = 2 * face.bound - x[face.axis];
    std::swap(part.corner[1], part.corner[2]);  // its normal is the image of the normal
    images.push_back(part);
  });
  triangles.insert(triangles.end(), images.begin(), images.end());
}

/// Patches that reach far enough beyond both faces: their triangles go on there, as those of copies would not.
std::set<std::uint32_t> patches_that_go_on(const BoxFace& low, const BoxFace& high, double reach,
                                           const std::vector<Triangle>& triangles) {
  std::map<std::uint32_t, std::array<double, 2>> inwards;
  for (const Triangle& t : triangles) {
    auto& nearest = inwards.try_emplace(t.patch, std::array<double, 2>{0, 0}).first->second;
    for (const Vector3& x : t.corner)
      nearest = {std::min(nearest[0], low.inwards(x)), std::min(nearest[1], high.inwards(x))};
  }
  std::set<std::uint32_t> patches;
  for (const auto& [patch, nearest] : inwards)
    if (nearest[0] <= -reach && nearest[1] <= -reach) patches.insert(patch);
  return patches;
}

void add_periodic_copies(const Box& box, int axis, double reach, std::vector<Triangle>& triangles) {
  const std::array<BoxFace, 2> sides{BoxFace(box, axis, 0), BoxFace(box, axis, 1)};
  const std::set<std::uint32_t> whole = patches_that_go_on(sides[0], sides[1], reach, triangles);
  for (const BoxFace& face : sides) triangles = cut_at(face, triangles, whole);
  std::vector<Triangle> copies;
  for (const BoxFace& face : sides)
    for_each_part_near(face, reach, triangles, [&](Triangle part) {
      if (whole.contains(part.patch)) return;
      for (Vector3& x : part.corner) x[axis] += face.inwards_sign() * box.extent(axis);
      copies.push_back(part);
    });
  triangles.insert(triangles.end(), copies.begin(), copies.end());
}

}  // namespace

std::vector<Triangle> with_walls_beyond_faces(std::vector<Triangle> triangles, const Box& box, double reach) {
  for (const int axis : {0, 1}) {
    for (const int side : {0, 1})
      if (is_mirror(box.face(axis, side))) triangles = cut_at(BoxFace(box, axis, side), triangles);
    for (const int side : {0, 1})
      if (is_mirror(box.face(axis, side))) add_mirror_images(BoxFace(box, axis, side), reach, triangles);
    if (box.is_periodic(axis)) add_periodic_copies(box, axis, reach, triangles);
  }
  return triangles;
}

}  // namespace talus::continuum

// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/boundary/walls_beyond_faces.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

namespace talus::continuum {

namespace {

constexpr double slack = 1e-6;  // over the extent of the box: coordinates of files are of single precision

/// One of the box's upright faces. Distances are inwards from it.
struct Side {
  int axis = 0, side = 0;
  double bound = 0, tolerance = 0;

  Side(const Box& box, int along, int at)
      : axis(along), side(at), bound(box.bound(along, at)), tolerance(slack * box.extent(along)) {}
  double inwards(const Vector3& x) const { return side == 0 ? x[axis] - bound : bound - x[axis]; }
};

/// How a patch lies at a face.
struct Contact {
  bool has_edge = false, reaches_beyond = false;
};

std::map<std::uint32_t, Contact> contacts(const std::vector<Triangle>& triangles, const Side& face) {
  std::map<std::uint32_t, Contact> patches;
  for (const Triangle& t : triangles) {
    Contact& patch = patches[t.patch];
    int on_face = 0, inside = 0;
    for (const Vector3& x : t.corner) {
      const double distance = face.inwards(x);
      ++(distance > face.tolerance ? inside : on_face);
      patch.reaches_beyond = patch.reaches_beyond || distance < -face.tolerance;
    }
    patch.has_edge = patch.has_edge || (on_face == 2 && inside == 1);
  }
  return patches;
}

/// Calls visit(triangle) for the pieces of a triangle that are nearer to a face than `reach`.
template <class Visit>
void for_each_piece_near(const Triangle& t, const Side& face, double reach, Visit&& visit) {
  const int outwards = face.side == 0 ? -1 : 1;
  const std::vector<Vector3> polygon =
      clipped({t.corner.begin(), t.corner.end()}, face.axis, face.bound - outwards * reach, outwards);
  for (std::size_t c = 2; c < polygon.size(); ++c) {
    const Triangle piece{{polygon[0], polygon[c - 1], polygon[c]}, t.patch};
    if (norm(piece.area()) > 0) visit(piece);
  }
}

bool is_in(const Triangle& t, const Side& face) {
  return std::all_of(t.corner.begin(), t.corner.end(),
                     [&](const Vector3& x) { return std::abs(face.inwards(x)) <= face.tolerance; });
}

void add_mirror_images(const Side& face, double reach, std::vector<Triangle>& triangles) {
  std::map<std::uint32_t, Contact> patches = contacts(triangles, face);
  std::vector<Triangle> images;
  for (const Triangle& t : triangles) {
    const Contact& patch = patches[t.patch];
    if (!patch.has_edge || patch.reaches_beyond || is_in(t, face)) continue;
    for_each_piece_near(t, face, reach, [&](Triangle piece) {
      for (Vector3& x : piece.corner)
        if (std::abs(face.inwards(x)) > face.tolerance) x[face.axis] = 2 * face.bound - x[face.axis];
      std::swap(piece.corner[1], piece.corner[2]);  // its normal is the image of the normal
      images.push_back(piece);
    });
  }
  triangles.insert(triangles.end(), images.begin(), images.end());
}

void add_periodic_copies(const Box& box, int axis, double reach, std::vector<Triangle>& triangles) {
  const Side low(box, axis, 0), high(box, axis, 1);
  std::map<std::uint32_t, Contact> at_low = contacts(triangles, low), at_high = contacts(triangles, high);
  std::vector<Triangle> copies;
  for (const Triangle& t : triangles) {
    const Contact &a = at_low[t.patch], &b = at_high[t.patch];
    if (a.reaches_beyond || b.reaches_beyond) continue;
    for (const auto& [face, ends, way] : {std::tuple{low, a.has_edge, 1}, std::tuple{high, b.has_edge, -1}}) {
      if (!ends || is_in(t, face)) continue;
      for_each_piece_near(t, face, reach, [&, way = way](Triangle piece) {
        for (Vector3& x : piece.corner) x[axis] += way * box.extent(axis);
        copies.push_back(piece);
      });
    }
  }
  triangles.insert(triangles.end(), copies.begin(), copies.end());
}

}  // namespace

std::vector<Triangle> with_walls_beyond_faces(std::vector<Triangle> triangles, const Box& box, double reach) {
  for (const int axis : {0, 1}) {
    for (const int side : {0, 1}) {
      const FaceKind kind = box.face(axis, side);
      if (!is_mirror(kind)) continue;
      const Side face(box, axis, side);
      if (kind == FaceKind::symmetry)
        std::erase_if(triangles, [&](const Triangle& t) {
          return std::all_of(t.corner.begin(), t.corner.end(), [&](const Vector3& x) { return face.inwards(x) < 0; });
        });
      add_mirror_images(face, reach, triangles);
    }
    if (box.is_periodic(axis)) add_periodic_copies(box, axis, reach, triangles);
  }
  return triangles;
}

}  // namespace talus::continuum

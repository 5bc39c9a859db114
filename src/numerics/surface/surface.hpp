// SPDX-License-Identifier: Apache-2.0
/// A surface of triangles: the walls of a vessel, its section, and points spread over it. It has no thickness; grains
/// may stand on either side of it. Its triangles belong to patches, which a gate may open, and to smooth parts, which
/// edges bound.
///
/// A tree of boxes finds the triangles near a position, so that the cost hardly grows with their number. What is made
/// of the triangles is made once: a copy of a surface shares it, and has only its own gates.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/vector.hpp"
#include "numerics/geometry/sector.hpp"
#include "numerics/surface/triangle.hpp"
#include "numerics/surface/triangle_tree.hpp"

namespace talus {

class Surface {
 public:
  Surface() = default;
  static const Surface& none();  ///< without triangles

  /// \param triangles each with an area; \param patches how many there are
  /// \throws std::invalid_argument for a triangle without area, of no patch, or not finite
  Surface(std::vector<Triangle> triangles, std::size_t patches);

  bool is_empty() const { return made_->triangles.empty(); }
  std::span<const Triangle> triangles() const { return made_->triangles; }
  const Vector3& normal(std::size_t triangle) const { return made_->normals[triangle]; }  ///< unit
  std::size_t patches() const { return is_open_.size(); }
  const Vector3& low() const { return made_->low; }  ///< corners of the box around it, m
  const Vector3& high() const { return made_->high; }

  /// Number of the smooth part of a triangle: those of a patch that are joined by edges across which the surface turns
  /// by less than 32 degrees.
  std::uint32_t part(std::size_t triangle) const { return made_->parts[triangle]; }
  std::size_t parts() const { return made_->part_count; }
  /// Number of the flat piece of a part that it belongs to.
  std::uint32_t facet(std::size_t triangle) const { return made_->facets[triangle]; }
  std::size_t facets() const { return made_->facet_count; }

  /// Takes a patch away, so that nothing is crossed there, or puts it back.
  void set_open(std::size_t patch, bool open) { is_open_[patch] = open; }
  bool is_open(std::size_t patch) const { return is_open_[patch]; }

  struct Foot {
    std::uint32_t triangle;
    Vector3 place;    ///< of the surface, m
    double distance;  ///< m
  };
  /// The position of the surface nearest to x, open patches left out; nothing if none is within the distance. A
  /// triangle that is near shortens the search. \param tried its number; any number without one
  std::optional<Foot> nearest(const Vector3& x, double within, std::size_t tried = no_triangle) const;
  static constexpr std::size_t no_triangle = static_cast<std::size_t>(-1);

  struct Crossing {
    std::uint32_t triangle;
    double at;  ///< fraction of the line
  };
  /// Where the straight line from a to b crosses the surface first.
  std::optional<Crossing> first_crossing(const Vector3& a, const Vector3& b) const;
  /// Whether it does. The same from both ends.
  bool blocks(const Vector3& a, const Vector3& b) const;
  /// The same for many b around one a. \param near what near() found within |b - a| of a or more
  bool blocks(const Vector3& a, const Vector3& b, std::span<const std::uint32_t> near) const;
  /// Writes triangles of patches that are not open, among them all within the distance of x, up to `most` of them.
  /// \returns whether these are all
  bool near(const Vector3& x, double within, std::size_t most, std::vector<std::uint32_t>& found) const;
  /// Writes slabs of triangles of patches that are not open, among them all that reach into a box, up to `most` of
  /// them. \param thin, wide the largest slack and extent of a slab of several triangles, m
  /// \returns whether these are all
  bool slabs_within(const Vector3& low, const Vector3& high, double thin, double wide, std::size_t most,
                    std::vector<Slab>& found) const;

 private:
  /// What does not change once it is made: copies of a surface share it.
  struct Made {
    std::vector<Triangle> triangles;
    std::vector<Vector3> normals;
    std::vector<std::uint32_t> parts, facets;
    std::size_t part_count = 0, facet_count = 0;
    Vector3 low, high;
    TriangleTree tree;
  };
  static const std::shared_ptr<const Made>& nothing();
  bool is_on_one_side(std::uint32_t triangle, const Vector3& a, const Vector3& b, double slack) const;

  std::shared_ptr<const Made> made_ = nothing();
  std::vector<bool> is_open_;
};

/// Where the surface meets the plane at that y, open patches left out. \param y m
std::vector<std::array<Vector3, 2>> section_at(const Surface& surface, double y);

struct SurfacePoint {
  Vector3 place;   ///< m
  Vector3 normal;  ///< unit
  double area;     ///< that it stands for, m^2
  std::uint32_t patch, part;
};

/// Cuts every flat piece of the surface into squares of at most `distance`, and takes the middle of what lies in each;
/// rests of less than a third of a square join each other or the nearest square of the same smooth part. So the points
/// are about as many for a surface of any number of triangles of any shape. \param distance > 0, m
/// With a sector, the points of the part of the surface in it, and then the points of each of its copies, in the same
/// order: as symmetric as the surface, whose triangles, and so its smooth parts, turn into each other by the angle of
/// the sector.
std::vector<SurfacePoint> spread_points(const Surface& surface, double distance,
                                        const std::optional<Sector>& sector = {});

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
/// The space that particles live in: a box and thin walls in it.
///
/// What it offers is what grains, air and analysis ask of it, and all that they ask: the images of a particle
/// (images, is_near), which positions are mutually visible (is_visible, blocks, end_of_line), where a particle goes
/// that would pass a boundary (bounce), which boundaries an image loads (loads), and of each boundary its number, its
/// normal, whether a position is next to it and on which side. Walls of any shape have no images: they are a Surface,
/// and act by integrals of the kernel (models/continuum/boundary/vessel_walls.hpp).
///
/// Images. A face that mirrors makes of each particle near it an image behind it; two parallel faces make images of
/// images without end, of which all within reach are listed: in a box thinner than the reach a particle meets several
/// images of the same neighbour and of itself. At edges and corners the images of the faces multiply.
///
/// Walls stand at any angle to the faces and to each other. What is visible in them is what mirrors show: the
/// straight line to an image is followed, turned at each wall or face that it meets, and ends where the source is if
/// the image is visible. So every position around a particle holds one image at most, whatever the angles, and where
/// two images are mutually visible their forces are each other's mirror images. Images of up to three turns are made:
/// corners of 60 degrees and more are filled all around.
///
/// Sector. Instead of a whole circle about an upright axis its space may be a sector of it (sector.hpp): then the
/// images are those turned about the axis, and those of all in floor and top.
///
/// Layers. Where all walls are parallel to a pair of faces, reach from face to face and stand apart from these and from
/// each other, nothing needs to be followed: a wall mirrors all images in the faces once more, to either side, and the
/// position where the line passes its plane decides from where they are visible. That is the quick way, and it is taken
/// in here alone.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "base/vector.hpp"
#include "numerics/geometry/box.hpp"
#include "numerics/geometry/image.hpp"
#include "numerics/geometry/sector.hpp"
#include "numerics/geometry/wall.hpp"

namespace talus {

/// A wall, or a face of the box across x or z, as the mirrors of images: through `from` and `to`.
struct Mirror {
  Vector3 from, to;  ///< m
  Vector3 normal;    ///< unit
  int wall;          ///< that carries the load; -1: none, the face is periodic
  Vector3 shift;     ///< of a periodic face: to where what passes it goes on, m
  bool printed;      ///< it leaves velocities as they are
};

/// Boundaries that can carry load, by number: the six faces, then the walls.
inline constexpr int max_inner_walls = 10;
constexpr int wall_number(int wall) {
  return 6 + wall;
}

class Domain {
 public:
  /// \param apart how far walls stand from faces and from each other at least if they are to be layers, m
  /// \param sector within which particles live; none: the whole box
  /// \throws std::invalid_argument for an empty box, a periodic face without its opposite, more than
  ///         `max_inner_walls` walls, a sector with walls or side faces that are not open
  explicit Domain(const Box& box, std::vector<Wall> walls = {}, double apart = 0, std::optional<Sector> sector = {});

  const Box& box() const { return box_; }
  const std::optional<Sector>& sector() const { return sector_; }
  /// The space of which the sector is a part; without one itself.
  Domain whole() const { return sector_ ? Domain(box_) : *this; }
  const std::vector<Wall>& walls() const { return walls_; }

  /// Whether a gate is still shut that open_gates(time) would open.
  bool has_gates_due(double time) const;

  /// Opens the gates whose time has come, for good. \param time from the opening of the gate of the case, s
  void open_gates(double time = std::numeric_limits<double>::infinity());

  /// How often gates have opened: a change invalidates what follows from the openings.
  int openings() const { return openings_; }

  /// The boundaries, by number, up to wall_number(walls().size()): whether one carries load,
  bool bears_load(int number) const {
    return number < 6 ? is_mirror(box_.faces[static_cast<std::size_t>(number)]) : number < wall_count();
  }
  /// whether it can rub,
  bool is_solid(int number) const {
    return number < 6 ? box_.faces[static_cast<std::size_t>(number)] == FaceKind::wall : number < wall_count();
  }
  int wall_count() const { return wall_number(static_cast<int>(walls_.size())); }
  /// its unit normal, of a face along its axis,
  Vector3 normal(int number) const;
  /// the distance from its plane, to the side of the normal, m,
  double above(int number, const Vector3& x) const;
  /// the side on which a particle at x is: 1 that of the normal, -1 the other; of a face always within the box,
  int side(int number, const Vector3& x) const {
    return number < 6 ? (number % 2 == 0 ? 1 : -1) : above(number, x) >= 0 ? 1 : -1;
  }
  /// and whether it is there, beside x: no opening, no end.
  bool is_beside(int number, const Vector3& x) const { return number < 6 || wall_at(number).is_solid(x); }

  /// The largest reach for which the images are complete: the distance between layers and faces of the same axis.
  double max_reach() const;

  /// All images that can stand within `reach` of the box or of a wall, in a fixed order, those in walls last; the
  /// identity is not among them. \param reach m, at most max_reach()
  std::vector<Image> images(double reach) const;

  /// Whether an image at x lies within `reach` of what made it.
  bool is_near(const Image& image, const Vector3& x, double reach) const;

  /// Whether x is within `reach` of a wall that is not gone. From farther ones all neighbours are visible, and no image
  /// in walls.
  bool is_near_wall(const Vector3& x, double reach) const;

  /// Whether an image at `to`, or its source there through the identity, is visible from `from`, wherever both are
  /// within `margin` (m) of these positions and whichever gates have opened meanwhile. Only layers are looked at
  /// closely.
  enum class Visibility { never, always, may_change };
  Visibility visibility(const Vector3& from, const Vector3& to, const Image& image, double margin) const;

  /// Whether the straight line between two positions inside the box meets the solid part of a wall. The same from both
  /// ends.
  bool blocks(const Vector3& a, const Vector3& b) const;

  /// Whether an image at `to`, or its source there through the identity, is visible from `from`: whether the line
  /// between them, turned where it meets walls and faces, ends at the source. Symmetric in the two
  /// particles.
  bool is_visible(const Vector3& from, const Vector3& to, const Image& image) const {
    return layered_ ? is_visible_past_layers(from, to, image.mirrors[0]) : is_source_visible(from, to, image);
  }

  /// Where the straight line from a position inside the box to another ends in the x-z plane, turned at each wall and
  /// face that it meets; nothing where it is turned without end.
  std::optional<Vector3> end_of_line(const Vector3& from, const Vector3& to) const;

  /// A boundary that an image loads, and what of the image's force, in the direction of the boundary's normal: of a
  /// single one the part along the normal; where the line to the image meets two, the force is the sum of two along
  /// their normals. Those that are loaded come first.
  struct Load {
    int wall = -1;
    Vector3 part;
  };
  std::array<Load, 3> loads(const Image& image) const;

  /// Where a particle that moved from `from` to `to` hits a wall, symmetry or printed face or a wall's solid part: the
  /// image that stands for it on the side it came from. The mirrored motion is what the images would have done.
  /// \returns nothing if it passed none; one boundary at a time: ask again from the new position
  struct Bounce {
    int wall;     ///< number of the boundary
    Image image;  ///< what the particle becomes
  };
  std::optional<Bounce> bounce(const Vector3& from, const Vector3& to) const;

  /// The position inside the box that a point stands for: periodic copies back into the box, mirrored ones too.
  Vector3 fold(const Vector3& x) const;

  /// What a particle at x that has left the sector becomes within it; nothing for others.
  std::optional<Image> back_into_sector(const Vector3& x) const;

  /// The position inside the periodic faces; other axes as they are.
  Vector3 wrap(const Vector3& x) const;

 private:
  const Wall& wall_at(int number) const { return walls_[static_cast<std::size_t>(number - wall_number(0))]; }
  /// Whether the line meets the solid part of a layer, which stands in the copies of the box too.
  bool meets_layer(const Wall& wall, const Vector3& from, const Vector3& to) const {
    return wall.is_above(from) != wall.is_above(to) &&
           wall.is_solid(fold(from + wall.share_to_plane(from, to) * (to - from)));
  }
  /// \param mirror the layer that mirrors the line, -1: none
  bool is_visible_past_layers(const Vector3& from, const Vector3& to, int mirror) const {
    for (int w = 0; w < static_cast<int>(walls_.size()); ++w)
      if (meets_layer(walls_[static_cast<std::size_t>(w)], from, to) != (w == mirror)) return false;
    return true;
  }
  std::optional<bool> meets_layer_within(const Wall& wall, const Vector3& from, const Vector3& to, double margin) const;
  bool is_source_visible(const Vector3& from, const Vector3& to, const Image& image) const;
  bool are_layers(double apart) const;
  double distance_of_layers() const;
  void find_mirrors();
  std::vector<Image> images_in_walls(double reach) const;

  Box box_;
  std::vector<Wall> walls_;
  std::optional<Sector> sector_;
  bool layered_;
  int openings_ = 0;
  std::vector<Mirror> mirrors_;  // walls; unless these are layers, then faces across x and z
};

/// What the mirror shows of an image: reflected, or shifted by a periodic face.
Image mirrored(Image image, const Mirror& mirror);

/// Whether two images show the same positions of the x-z plane, to round-off. \param length of the box, m
bool same_map(const Image& a, const Image& b, double length);

}  // namespace talus

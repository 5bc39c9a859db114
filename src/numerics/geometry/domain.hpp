// SPDX-License-Identifier: Apache-2.0
/// The space that particles live in: a box and thin plates across it, or panels in it. It answers three questions:
/// which images of a particle stand behind the boundaries, which of two points see each other, and where a particle
/// goes that would pass a boundary.
///
/// Images. A face that mirrors makes of each particle near it an image behind it; two parallel faces make images of
/// images without end, of which all within reach are listed: in a box thinner than the reach a particle meets several
/// images of the same neighbour and of itself. At edges and corners the images of the faces multiply. A plate mirrors
/// all of these once more, to either side. Plates and faces of the same axis stand farther apart than the reach.
///
/// Panels stand at any angle to the faces and to each other. What a particle sees in them is what mirrors show: the
/// straight line to an image is followed, turned at each panel or face that it meets, and ends where the source is if
/// the image is seen. So every place around a particle holds one image at most, whatever the angles, and where two see
/// each other's images their forces are each other's mirror images. Images of up to three turns are made: corners of
/// 60 degrees and more are filled all around.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "base/vector.hpp"
#include "numerics/geometry/box.hpp"
#include "numerics/geometry/image.hpp"
#include "numerics/geometry/panel.hpp"
#include "numerics/geometry/plate.hpp"

namespace talus {

/// A panel, or a face of the box across x or z, as the mirrors of images in panels: through `from` and `to`.
struct Mirror {
  Vector3 from, to;  ///< m
  Vector3 normal;    ///< unit
  int wall;          ///< that bears the load; -1: none, the face is periodic
  Vector3 shift;     ///< of a periodic face: to where what passes it goes on, m
  bool printed;      ///< it leaves velocities as they are

  double distance(const Vector3& x) const { return Panel{.name = {}, .from = from, .to = to}.distance(x); }
};

/// Walls that can bear load: the six faces, then the plates or panels.
inline constexpr int most_plates = 10;
inline constexpr int most_walls = 6 + most_plates;
constexpr int wall_of_plate(int plate) {
  return 6 + plate;
}

class Domain {
 public:
  /// \throws std::invalid_argument for an empty box, a periodic face without its opposite, more than `most_plates`
  ///         plates, a plate outside the box, a panel without length, plates and panels together
  Domain(const Box& box, std::vector<Plate> plates, std::vector<Panel> panels = {});

  const Box& box() const { return box_; }
  const std::vector<Plate>& plates() const { return plates_; }
  const std::vector<Panel>& panels() const { return panels_; }
  const std::vector<Mirror>& mirrors() const { return mirrors_; }

  /// Whether a gate is still shut that open_gates(time) would open.
  bool has_gates_due(double time) const;

  /// Opens gates for good: every gate of a plate, and those of panels whose time has come.
  /// \param time from the opening of the gate of the case, s
  void open_gates(double time = std::numeric_limits<double>::infinity());

  /// How often gates have opened: who keeps what follows from the openings looks whether it has changed.
  int openings() const { return openings_; }

  /// Unit normal of a wall, along its axis where it has one. \param wall number of a face, plate or panel
  Vector3 normal(int wall) const;

  /// The largest reach for which the images are complete: the distance between plates and faces of the same axis.
  double largest_reach() const;

  /// All images that can stand within `reach` of the box or of a plate, in a fixed order; the identity is not among
  /// them. \param reach m, at most largest_reach()
  std::vector<Image> images(double reach) const;

  /// Whether an image at x lies within `reach` of what made it.
  bool is_near(const Image& image, const Vector3& x, double reach) const;

  /// Whether x is within `reach` of a plate's plane, so that some of its neighbours may be hidden.
  bool is_near_plate(const Vector3& x, double reach) const;

  /// Whether x is within `reach` of a panel. Farther ones see no image in panels.
  bool is_near_panel(const Vector3& x, double reach) const;

  /// Whether the straight line between two places inside the box meets the solid part of a plate or panel. The same
  /// from both ends.
  bool blocks(const Vector3& a, const Vector3& b) const;

  /// Whether a particle at `from` sees another, or its image, at `to`: the straight line between them passes plates
  /// only through openings, and the plate that mirrors the image exactly where it is solid. Symmetric: `from` sees the
  /// image of `to` in a plate if and only if `to` sees that of `from`.
  /// \param plate the plate that mirrors the image at `to`; -1: none
  bool sees(const Vector3& from, const Vector3& to, int plate = -1) const {
    for (int p = 0; p < static_cast<int>(plates_.size()); ++p) {
      const Plate& wall = plates_[static_cast<std::size_t>(p)];
      const bool crosses = wall.side_of(from) != wall.side_of(to);
      const bool meets_solid = crosses && wall.is_solid(fold(crossing(wall, from, to)));
      if (meets_solid != (p == plate)) return false;
    }
    return true;
  }

  /// The same with panels: whether the line from `from` to an image at `to`, turned where it meets panels and faces,
  /// ends at the image's source.
  bool sees_source(const Vector3& from, const Vector3& to, const Vector3& source) const;

  /// Whether a particle at `from` sees that image of `source`, or the source itself through the identity, whatever
  /// there is in the box.
  bool sees(const Vector3& from, const Vector3& source, const Image& image) const {
    return panels_.empty() ? sees(from, image.position(source), image.plate)
                           : sees_source(from, image.position(source), source);
  }

  /// Where a particle that moved from `from` to `to` hits a wall, symmetry or printed face or a plate's solid part: the
  /// image that stands for it on the side it came from. The mirrored motion is what the images would have done.
  /// \returns nothing if it passed none; one boundary at a time: ask again from the new place
  struct Bounce {
    int wall;     ///< which face or plate
    Image image;  ///< what the particle becomes
  };
  std::optional<Bounce> bounce(const Vector3& from, const Vector3& to) const;

  /// The place inside the box that a point stands for: periodic copies back into the box, mirrored ones too.
  Vector3 fold(const Vector3& x) const;

  /// The place inside the periodic faces; other axes as they are.
  Vector3 wrap(const Vector3& x) const;

 private:
  static Vector3 crossing(const Plate& plate, const Vector3& from, const Vector3& to) {
    const double t = (plate.position - from[plate.axis]) / (to[plate.axis] - from[plate.axis]);
    return from + t * (to - from);
  }

  void find_mirrors();
  std::vector<Image> images_in_panels(double reach) const;

  Box box_;
  std::vector<Plate> plates_;
  std::vector<Panel> panels_;
  int openings_ = 0;
  std::vector<Mirror> mirrors_;  // panels, then faces across x and z; none without panels
};

}  // namespace talus

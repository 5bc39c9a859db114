// SPDX-License-Identifier: Apache-2.0
/// The space that particles live in: a box and thin plates across it. It answers three questions: which images of a
/// particle stand behind the boundaries, which of two points see each other, and where a particle goes that would pass
/// a boundary.
///
/// Images. A face that mirrors makes of each particle near it an image behind it; two parallel faces make images of
/// images without end, of which all within reach are listed: in a box thinner than the reach a particle meets several
/// images of the same neighbour and of itself. At edges and corners the images of the faces multiply. A plate mirrors
/// all of these once more, to either side. Plates and faces of the same axis stand farther apart than the reach.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "base/vector.hpp"
#include "numerics/geometry/box.hpp"
#include "numerics/geometry/plate.hpp"

namespace talus {

/// How an image follows its source: component by component, x' = sign x + offset, v' = vector_sign v.
struct Image {
  Vector3 sign{1, 1, 1};
  Vector3 offset;
  Vector3 vector_sign{1, 1, 1};
  std::array<std::int8_t, 3> side{};  ///< the mirror face, per axis: -1 low, 1 high, 0 none (or periodic)
  std::array<std::int8_t, 3> copy{};  ///< number of the copy per axis, periodic ones too; 0: within the box
  int plate = -1;                     ///< the plate that mirrors it, -1: none

  constexpr Vector3 position(const Vector3& x) const {
    return {sign.x * x.x + offset.x, sign.y * x.y + offset.y, sign.z * x.z + offset.z};
  }
  constexpr Vector3 vector(const Vector3& v) const {
    return {vector_sign.x * v.x, vector_sign.y * v.y, vector_sign.z * v.z};
  }
};

/// Walls that can bear load: the six faces, then the plates.
inline constexpr int most_plates = 2;
inline constexpr int most_walls = 6 + most_plates;
constexpr int wall_of_plate(int plate) {
  return 6 + plate;
}

class Domain {
 public:
  /// \throws std::invalid_argument for an empty box, a periodic face without its opposite, more than `most_plates`
  ///         plates, a plate outside the box
  Domain(const Box& box, std::vector<Plate> plates);

  const Box& box() const { return box_; }
  const std::vector<Plate>& plates() const { return plates_; }

  /// Opens every gate, for good.
  void open_gates();

  /// The largest reach for which the images are complete: the distance between plates and faces of the same axis.
  double largest_reach() const;

  /// All images that can stand within `reach` of the box or of a plate, in a fixed order; the identity is not among
  /// them. \param reach m, at most largest_reach()
  std::vector<Image> images(double reach) const;

  /// Whether an image at x lies within `reach` of what made it.
  bool is_near(const Image& image, const Vector3& x, double reach) const;

  /// Whether x is within `reach` of a plate's plane, so that some of its neighbours may be hidden.
  bool is_near_plate(const Vector3& x, double reach) const;

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

  Box box_;
  std::vector<Plate> plates_;
};

}  // namespace talus

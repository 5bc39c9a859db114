// SPDX-License-Identifier: Apache-2.0
#include "numerics/geometry/domain.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "numerics/geometry/mirrors.hpp"

namespace talus {

namespace {

/// One axis of an image. Copy n > 0 stands behind the high face: mirrored there last, and in turn at both faces n times
/// in all; n < 0 likewise behind the low face. Periodic copies are shifted by n extents.
struct AxisImage {
  int copy = 0;
  double sign = 1, offset = 0, vector_sign = 1;
};

AxisImage axis_mirrored(const AxisImage& image, double plane, FaceKind kind) {
  return {image.copy, -image.sign, 2 * plane - image.offset,
          kind == FaceKind::printed ? image.vector_sign : -image.vector_sign};
}

std::vector<AxisImage> axis_images(const Box& box, int axis, double reach) {
  std::vector<AxisImage> images = {{}};
  for (const int side : {0, 1}) {
    const int direction = side == 0 ? -1 : 1;
    for (int n = 1; (n - 1) * box.extent(axis) <= reach; ++n) {
      AxisImage image{.copy = direction * n};
      if (box.is_periodic(axis)) {
        image.offset = direction * n * box.extent(axis);
      } else {
        // The first of n reflections is at the side from which the last one is at `side`.
        bool exists = true;
        for (int k = n; k >= 1; --k) {
          const int at = k % 2 == 1 ? side : 1 - side;
          exists = exists && is_mirror(box.face(axis, at));
          image = axis_mirrored(image, box.bound(axis, at), box.face(axis, at));
        }
        if (!exists) break;
      }
      images.push_back(image);
    }
  }
  return images;
}

void set_axis(Image& image, const Box& box, int axis, const AxisImage& along) {
  image.sign[axis] = along.sign;
  image.offset[axis] = along.offset;
  image.vector_sign[axis] = along.vector_sign;
  const auto a = static_cast<std::size_t>(axis);
  image.copy[a] = static_cast<std::int8_t>(along.copy);
  if (!box.is_periodic(axis)) image.side[a] = static_cast<std::int8_t>((along.copy > 0) - (along.copy < 0));
}

Image mirrored_at(double plane, int axis, Image image = {}) {
  image.sign[axis] *= -1;
  image.offset[axis] = 2 * plane - image.offset[axis];
  image.vector_sign[axis] *= -1;
  return image;
}

}  // namespace

Domain::Domain(const Box& box, std::vector<Plate> plates, std::vector<Panel> panels)
    : box_(box), plates_(std::move(plates)), panels_(std::move(panels)) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(box.extent(axis) > 0)) throw std::invalid_argument("the box is empty");
    if ((box.face(axis, 0) == FaceKind::periodic) != (box.face(axis, 1) == FaceKind::periodic))
      throw std::invalid_argument("a periodic face needs a periodic one opposite");
  }
  if (!plates_.empty() && !panels_.empty()) throw std::invalid_argument("plates and panels do not go together");
  for (const Panel& panel : panels_)
    if (!(panel.length() > 0)) throw std::invalid_argument("a panel has no length");
  if (plates_.size() + panels_.size() > most_plates) throw std::invalid_argument("too many plates");
  for (const Plate& plate : plates_) {
    if (plate.axis != plates_[0].axis) throw std::invalid_argument("plates must be parallel");
    if (!(plate.position > box.low[plate.axis] && plate.position < box.high[plate.axis]))
      throw std::invalid_argument("a plate must lie inside the box");
  }
  find_mirrors();
}

bool Domain::has_gates_due(double time) const {
  const auto any = [](const auto& walls, auto&& due) {
    return std::any_of(walls.begin(), walls.end(),
                       [&](const auto& wall) { return std::any_of(wall.openings.begin(), wall.openings.end(), due); });
  };
  return any(plates_, [](const Opening& opening) { return opening.shut; }) ||
         any(panels_, [&](const Panel::Opening& opening) { return opening.shut && time >= opening.opens_after; });
}

void Domain::open_gates(double time) {
  if (has_gates_due(time)) ++openings_;
  for (Plate& plate : plates_)
    for (Opening& opening : plate.openings) opening.shut = false;
  for (Panel& panel : panels_)
    for (Panel::Opening& opening : panel.openings) opening.shut = opening.shut && time < opening.opens_after;
}

Vector3 Domain::normal(int wall) const {
  const auto number = static_cast<std::size_t>(wall - wall_of_plate(0));
  if (wall >= wall_of_plate(0) && number < panels_.size()) return panels_[number].normal();
  const int axis = wall < wall_of_plate(0) ? wall / 2 : number < plates_.size() ? plates_[number].axis : 2;
  Vector3 unit;
  unit[axis] = 1;
  return unit;
}

double Domain::largest_reach() const {
  double reach = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < plates_.size(); ++p) {
    const Plate& plate = plates_[p];
    for (const int side : {0, 1})
      if (box_.face(plate.axis, side) != FaceKind::open)
        reach = std::min(reach, std::abs(box_.bound(plate.axis, side) - plate.position));
    for (std::size_t q = 0; q < p; ++q) reach = std::min(reach, std::abs(plates_[q].position - plate.position));
  }
  return reach;
}

std::vector<Image> Domain::images(double reach) const {
  std::vector<Image> images;
  const auto along_x = axis_images(box_, 0, reach);
  const auto along_y = axis_images(box_, 1, reach);
  const auto along_z = axis_images(box_, 2, reach);
  for (int plate = -1; plate < static_cast<int>(plates_.size()); ++plate)
    for (const AxisImage& z : along_z)
      for (const AxisImage& y : along_y)
        for (const AxisImage& x : along_x) {
          if (plate < 0 && x.copy == 0 && y.copy == 0 && z.copy == 0) continue;
          Image image;
          set_axis(image, box_, 0, x);
          set_axis(image, box_, 1, y);
          set_axis(image, box_, 2, z);
          if (plate >= 0) {
            const Plate& wall = plates_[static_cast<std::size_t>(plate)];
            if (image.copy[static_cast<std::size_t>(wall.axis)] != 0) continue;  // farther than the reach
            image = mirrored_at(wall.position, wall.axis, image);
            image.plate = plate;
          }
          images.push_back(image);
        }
  if (panels_.empty()) return images;
  for (const Image& image : images_in_panels(reach))
    for (const AxisImage& y : along_y) {
      Image both = image;
      set_axis(both, box_, 1, y);
      images.push_back(both);
    }
  return images;
}

bool Domain::is_near(const Image& image, const Vector3& x, double reach) const {
  Vector3 place = x;
  for (const std::int8_t number : image.mirrors) {
    if (number < 0) break;
    const Mirror& mirror = mirrors_[static_cast<std::size_t>(number)];
    if (!(mirror.distance(place) <= reach)) return false;
    place = mirrored(Image{}, mirror).source(place);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int copy = image.copy[static_cast<std::size_t>(axis)];
    if (copy < 0 && !(x[axis] >= box_.low[axis] - reach)) return false;
    if (copy > 0 && !(x[axis] <= box_.high[axis] + reach)) return false;
  }
  if (image.plate < 0) return true;
  const Plate& plate = plates_[static_cast<std::size_t>(image.plate)];
  return std::abs(x[plate.axis] - plate.position) <= reach;
}

bool Domain::is_near_plate(const Vector3& x, double reach) const {
  return std::any_of(plates_.begin(), plates_.end(),
                     [&](const Plate& plate) { return std::abs(x[plate.axis] - plate.position) <= reach; });
}

bool Domain::is_near_panel(const Vector3& x, double reach) const {
  return std::any_of(panels_.begin(), panels_.end(), [&](const Panel& panel) { return panel.distance(x) <= reach; });
}

std::optional<Domain::Bounce> Domain::bounce(const Vector3& from, const Vector3& to) const {
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, 1}) {
      const double beyond = side == 0 ? box_.low[axis] - to[axis] : to[axis] - box_.high[axis];
      if (beyond > 0 && is_mirror(box_.face(axis, side)))
        return Bounce{face_number(axis, side), mirrored_at(box_.bound(axis, side), axis)};
    }
  for (int p = 0; p < static_cast<int>(plates_.size()); ++p) {
    const Plate& plate = plates_[static_cast<std::size_t>(p)];
    if (plate.side_of(from) != plate.side_of(to) && plate.is_solid(fold(crossing(plate, from, to))))
      return Bounce{wall_of_plate(p), mirrored_at(plate.position, plate.axis)};
  }
  std::optional<Bounce> first;
  double earliest = 2;
  for (int p = 0; p < static_cast<int>(panels_.size()); ++p) {
    const auto at = panels_[static_cast<std::size_t>(p)].meets(from, to);
    if (!at || *at >= earliest) continue;
    earliest = *at;
    first = Bounce{wall_of_plate(p), mirrored(Image{}, mirrors_[static_cast<std::size_t>(p)])};
  }
  return first;
}

Vector3 Domain::fold(const Vector3& x) const {
  Vector3 inside = wrap(x);
  for (int axis = 0; axis < 3; ++axis) {
    double& c = inside[axis];
    while (true) {
      if (c < box_.low[axis] && is_mirror(box_.face(axis, 0)))
        c = 2 * box_.low[axis] - c;
      else if (c > box_.high[axis] && is_mirror(box_.face(axis, 1)))
        c = 2 * box_.high[axis] - c;
      else
        break;
    }
  }
  return inside;
}

Vector3 Domain::wrap(const Vector3& x) const {
  Vector3 inside = x;
  for (int axis = 0; axis < 3; ++axis)
    if (box_.is_periodic(axis))
      inside[axis] -= box_.extent(axis) * std::floor((x[axis] - box_.low[axis]) / box_.extent(axis));
  return inside;
}

}  // namespace talus

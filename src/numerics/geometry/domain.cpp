// SPDX-License-Identifier: Apache-2.0
#include "numerics/geometry/domain.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace talus {

namespace {

/// One axis of an image. Copy n > 0 stands behind the high face: mirrored there last, and alternately at both faces n
/// times in all; n < 0 likewise behind the low face. Periodic copies are shifted by n extents.
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

double& along_axis(Tensor3<>& map, int axis) {
  return axis == 0 ? map.xx : axis == 1 ? map.yy : map.zz;
}

void set_axis(Image& image, const Box& box, int axis, const AxisImage& along) {
  along_axis(image.map, axis) = along.sign;
  image.offset[axis] = along.offset;
  along_axis(image.vector_map, axis) = along.vector_sign;
  const auto a = static_cast<std::size_t>(axis);
  image.copy[a] = static_cast<std::int8_t>(along.copy);
  if (!box.is_periodic(axis)) image.side[a] = static_cast<std::int8_t>((along.copy > 0) - (along.copy < 0));
}

Image turned_by(const Sector& sector, int angles) {
  Image image;
  image.map = image.vector_map = sector.turn(angles);
  image.offset = sector.turned({}, angles);
  image.turns = static_cast<std::int8_t>(angles);
  return image;
}

Image mirrored_at(double plane, int axis) {
  Image image;
  along_axis(image.map, axis) *= -1;
  image.offset[axis] = 2 * plane - image.offset[axis];
  along_axis(image.vector_map, axis) *= -1;
  return image;
}

}  // namespace

Domain::Domain(const Box& box, std::vector<Wall> walls, double apart, std::optional<Sector> sector)
    : box_(box), walls_(std::move(walls)), sector_(std::move(sector)) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(box.extent(axis) > 0)) throw std::invalid_argument("the box is empty");
    if ((box.face(axis, 0) == FaceKind::periodic) != (box.face(axis, 1) == FaceKind::periodic))
      throw std::invalid_argument("a periodic face needs a periodic one opposite");
  }
  if (walls_.size() > max_inner_walls) throw std::invalid_argument("too many walls");
  const auto is_open = [](FaceKind kind) { return kind == FaceKind::open; };
  if (sector_ && !(walls_.empty() && std::all_of(box.faces.begin(), box.faces.begin() + 4, is_open)))
    throw std::invalid_argument("walls or side faces with a sector");
  layered_ = are_layers(apart);
  find_mirrors();
}

/// Beyond an open face a wall ends, as a layer would not.
bool Domain::are_layers(double apart) const {
  const auto is_layer = [&](const Wall& wall) {
    const int axis = wall.axis(), along = 2 - axis;
    if (axis < 0 || axis != walls_[0].axis()) return false;
    const double low = std::min(wall.from()[along], wall.to()[along]);
    const double high = std::max(wall.from()[along], wall.to()[along]);
    return low <= box_.low[along] && high >= box_.high[along] && box_.face(along, 0) != FaceKind::open &&
           box_.face(along, 1) != FaceKind::open && wall.from()[axis] > box_.low[axis] &&
           wall.from()[axis] < box_.high[axis];
  };
  if (!std::all_of(walls_.begin(), walls_.end(), is_layer)) return false;
  return walls_.empty() || distance_of_layers() >= apart;
}

bool Domain::has_gates_due(double time) const {
  return std::any_of(walls_.begin(), walls_.end(), [&](const Wall& wall) { return wall.has_gates_due(time); });
}

void Domain::open_gates(double time) {
  openings_ += has_gates_due(time);
  for (Wall& wall : walls_) wall.open_gates(time);
}

Vector3 Domain::normal(int number) const {
  if (number >= wall_number(0)) return wall_at(number).normal();
  Vector3 unit;
  unit[number / 2] = 1;
  return unit;
}

double Domain::above(int number, const Vector3& x) const {
  return number < 6 ? x[number / 2] - box_.bound(number / 2, number % 2) : wall_at(number).above(x);
}

double Domain::max_reach() const {
  return layered_ ? distance_of_layers() : std::numeric_limits<double>::infinity();
}

double Domain::distance_of_layers() const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < walls_.size(); ++p) {
    const int axis = walls_[p].axis();
    const double position = walls_[p].from()[axis];
    for (const int side : {0, 1})
      if (box_.face(axis, side) != FaceKind::open) least = std::min(least, std::abs(box_.bound(axis, side) - position));
    for (std::size_t q = 0; q < p; ++q) least = std::min(least, std::abs(walls_[q].from()[axis] - position));
  }
  return least;
}

std::vector<Image> Domain::images(double reach) const {
  std::vector<Image> images;
  const auto along_x = axis_images(box_, 0, reach);
  const auto along_y = axis_images(box_, 1, reach);
  const auto along_z = axis_images(box_, 2, reach);
  const int layers = layered_ ? static_cast<int>(walls_.size()) : 0;
  for (int layer = -1; layer < layers; ++layer)
    for (const AxisImage& z : along_z)
      for (const AxisImage& y : along_y)
        for (const AxisImage& x : along_x) {
          if (layer < 0 && x.copy == 0 && y.copy == 0 && z.copy == 0) continue;
          Image image;
          set_axis(image, box_, 0, x);
          set_axis(image, box_, 1, y);
          set_axis(image, box_, 2, z);
          if (layer >= 0) {
            const auto number = static_cast<std::size_t>(layer);
            if (image.copy[static_cast<std::size_t>(walls_[number].axis())] != 0) continue;  // farther than the reach
            image = mirrored(image, mirrors_[number]);
            image.mirrors[0] = static_cast<std::int8_t>(layer);
          }
          images.push_back(image);
        }
  for (int k = 1; sector_ && k < sector_->copies(); ++k)
    for (const AxisImage& z : along_z) {
      Image image = turned_by(*sector_, k);
      set_axis(image, box_, 2, z);
      images.push_back(image);
    }
  if (layered_) return images;
  // Where a wall meets a face at a right angle, the turns at wall, face and wall again are the one at the face.
  const std::vector<Image> in_faces = images;
  const double length = std::max(box_.extent(0), box_.extent(2));
  for (const Image& image : images_in_walls(reach)) {
    if (std::any_of(in_faces.begin(), in_faces.end(),
                    [&](const Image& i) { return i.copy[1] == 0 && same_map(i, image, length); }))
      continue;
    for (const AxisImage& y : along_y) {
      Image both = image;
      set_axis(both, box_, 1, y);
      images.push_back(both);
    }
  }
  return images;
}

bool Domain::is_near(const Image& image, const Vector3& x, double reach) const {
  if (image.turns != 0 && !(sector_->distance(x) <= reach)) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const int copy = image.copy[static_cast<std::size_t>(axis)];
    if (copy < 0 && !(x[axis] >= box_.low[axis] - reach)) return false;
    if (copy > 0 && !(x[axis] <= box_.high[axis] + reach)) return false;
  }
  Vector3 point = x;
  for (const std::int8_t number : image.mirrors) {
    if (number < 0) break;
    const Mirror& mirror = mirrors_[static_cast<std::size_t>(number)];
    if (!(distance_to_segment(point, mirror.from, mirror.to) <= reach)) return false;
    point = mirrored(Image{}, mirror).source(point);
  }
  return true;
}

bool Domain::is_near_wall(const Vector3& x, double reach) const {
  return std::any_of(walls_.begin(), walls_.end(), [&](const Wall& wall) {
    return std::abs(wall.above(x)) <= reach && !wall.is_gone() && wall.distance(x) <= reach;
  });
}

Domain::Visibility Domain::visibility(const Vector3& from, const Vector3& to, const Image& image, double margin) const {
  if (!layered_) return Visibility::may_change;
  Visibility found = Visibility::always;
  for (int w = 0; w < static_cast<int>(walls_.size()); ++w) {
    const std::optional<bool> meets = meets_layer_within(walls_[static_cast<std::size_t>(w)], from, to, margin);
    if (!meets)
      found = Visibility::may_change;
    else if (*meets != (w == image.mirrors[0]))
      return Visibility::never;
  }
  return found;
}

/// What meets_layer says wherever the ends are within `margin` of these positions; nothing if that varies. The line
/// passes the plane of the wall between its ends.
std::optional<bool> Domain::meets_layer_within(const Wall& wall, const Vector3& from, const Vector3& to,
                                               double margin) const {
  const double own = wall.above(from), other = wall.above(to);
  const bool are_sides_sure = std::min(std::abs(own), std::abs(other)) > margin;
  if (are_sides_sure && (own > 0) == (other > 0)) return false;
  const int along = 2 - wall.axis();
  const double slack = margin + 1e-6 * wall.length();
  const double low = std::min(from[along], to[along]) - slack, high = std::max(from[along], to[along]) + slack;
  if (low < box_.low[along] || high > box_.high[along]) return std::nullopt;
  const double direction = wall.direction()[along], start = wall.from()[along];
  const double begin = direction > 0 ? low - start : start - high, end = begin + (high - low);
  for (const Wall::Opening& opening : wall.openings()) {
    if (end < opening.begin || begin > opening.end) continue;
    if (opening.shut || begin < opening.begin || end > opening.end) return std::nullopt;
    return false;
  }
  if (!are_sides_sure) return std::nullopt;
  return true;
}

std::array<Domain::Load, 3> Domain::loads(const Image& image) const {
  std::array<Load, 3> found;
  std::size_t count = 0;
  for (int axis = 0; axis < 3; ++axis)
    if (const int side = image.side[static_cast<std::size_t>(axis)]; side != 0) {
      const int wall = face_number(axis, side > 0);
      found[count++] = {wall, normal(wall)};
    }
  std::array<int, 2> met{-1, -1};
  for (const std::int8_t number : image.mirrors) {
    const int wall = number < 0 ? -1 : mirrors_[static_cast<std::size_t>(number)].wall;
    if (wall < 0 || wall == met[0] || wall == met[1]) continue;
    met[met[0] < 0 ? 0 : 1] = wall;
  }
  for (std::size_t n = 0; n < 2 && met[n] >= 0; ++n) {
    Vector3 part = normal(met[n]);
    if (met[1] >= 0) {
      const Vector3 other = normal(met[1 - n]);
      const Vector3 across{-other.z, 0, other.x};
      if (const double sine = dot(across, part); std::abs(sine) > 1e-6) part = (1 / sine) * across;
    }
    found[count++] = {met[n], part};
  }
  return found;
}

std::optional<Domain::Bounce> Domain::bounce(const Vector3& from, const Vector3& to) const {
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, 1}) {
      const double beyond = side == 0 ? box_.low[axis] - to[axis] : to[axis] - box_.high[axis];
      if (beyond > 0 && is_mirror(box_.face(axis, side)))
        return Bounce{face_number(axis, side), mirrored_at(box_.bound(axis, side), axis)};
    }
  std::optional<Bounce> first;
  double earliest = 2;
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    const auto at = walls_[w].intersection(from, to);
    if (!at || *at >= earliest) continue;
    earliest = *at;
    first = Bounce{wall_number(static_cast<int>(w)), mirrored(Image{}, mirrors_[w])};
  }
  return first;
}

std::optional<Image> Domain::back_into_sector(const Vector3& x) const {
  const int copy = sector_ ? sector_->copy_at(x) : 0;
  if (copy == 0) return std::nullopt;
  return turned_by(*sector_, sector_->copies() - copy);
}

Vector3 Domain::fold(const Vector3& x) const {
  Vector3 inside = wrap(x);
  if (const auto image = back_into_sector(inside)) inside = image->position(inside);
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

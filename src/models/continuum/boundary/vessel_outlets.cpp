// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/boundary/vessel_outlets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "models/continuum/setup/layout.hpp"

namespace talus::continuum {

namespace {

constexpr double rounding = 1e-9;  // of lengths
constexpr double like_a_circle = 0.1;

bool goes_on(FaceKind face) {
  return face != FaceKind::open;
}

VesselOutlet round_outlet(const Parameters& p, std::size_t part, double height, double diameter) {
  const Vector3 axis = on_axis(p, p.vessel[part]);
  VesselOutlet outlet{.name = name_of(p, part), .middle = {axis.x, axis.y, height}};
  outlet.width = outlet.depth = outlet.narrow = outlet.length = diameter;
  outlet.round = true;
  return outlet;
}

VesselOutlet rectangle(std::string name, const Vector3& middle, double width, double depth) {
  return {.name = std::move(name),
          .middle = middle,
          .width = width,
          .depth = depth,
          .narrow = std::min(width, depth),
          .length = std::max(width, depth)};
}

/// Adds the mirror image of an extent that a plane of symmetry cuts; how far it is drawn beyond the plane does not
/// matter.
void complete(FaceKind low_face, FaceKind high_face, double extent, double& middle, double& width) {
  const double low = middle - 0.5 * width, high = middle + 0.5 * width, slack = rounding * extent;
  const bool at_low = low_face == FaceKind::symmetry && low <= slack;
  const bool at_high = high_face == FaceKind::symmetry && high >= extent - slack;
  if (at_low == at_high) return;  // neither, or a slot without ends
  middle = at_low ? 0 : extent;
  width = 2 * (at_low ? std::min(high, extent) : extent - std::max(low, 0.0));
}

VesselOutlet of_plate(const Parameters& p, std::size_t part) {
  const VesselPart& v = p.vessel[part];
  const VesselBounds around = bounds_of(p, part);
  const Vector3 extent = around.high - around.low;
  VesselOutlet outlet = rectangle(name_of(p, part), around.low + 0.5 * extent, extent.x, extent.y);
  const Vector3 a{v.first_edge[0], v.first_edge[1], 0}, b{v.second_edge[0], v.second_edge[1], 0};
  if (const bool oblique = a.x * a.y != 0 || b.x * b.y != 0; oblique) {
    outlet.length = std::max(norm(a), norm(b));
    outlet.narrow = norm(cross(a, b)) / outlet.length;
    return outlet;
  }
  complete(p.box.left, p.box.right, p.box.width, outlet.middle.x, outlet.width);
  complete(p.box.front, p.box.rear, p.box.depth, outlet.middle.y, outlet.depth);
  return rectangle(outlet.name, outlet.middle, outlet.width, outlet.depth);
}

/// The holes of the parts, whether or not a gate covers them.
std::vector<VesselOutlet> holes(const Parameters& p) {
  std::vector<VesselOutlet> all;
  for (std::size_t n = 0; n < p.vessel.size(); ++n) {
    const VesselPart& v = p.vessel[n];
    if (v.along != Along::z) continue;
    if (v.shape == VesselShape::cone && v.lower_radius > 0)
      all.push_back(round_outlet(p, n, v.bottom, 2 * v.lower_radius));
    if (v.shape == VesselShape::disc && v.hole > 0) all.push_back(round_outlet(p, n, v.height, 2 * v.hole));
    if (v.shape == VesselShape::pyramid && v.lower_width > 0 && v.lower_depth > 0) {
      const Vector3 axis = on_axis(p, v);
      all.push_back(rectangle(name_of(p, n), {axis.x, axis.y, v.bottom}, v.lower_width, v.lower_depth));
    }
  }
  return all;
}

/// Level rims of files: round ones fill their box as a circle does.
std::vector<VesselOutlet> holes_of_files(const Parameters& p) {
  std::vector<VesselOutlet> all;
  for (std::size_t n = 0; n < p.vessel.size(); ++n) {
    if (p.vessel[n].shape != VesselShape::stl) continue;
    for (const Rim& rim : placed_rims(p.vessel[n])) {
      Vector3 low = rim.corners.front(), high = low, area;
      for (std::size_t k = 0; k < rim.corners.size(); ++k) {
        const Vector3& x = rim.corners[k];
        for (int axis = 0; axis < 3; ++axis)
          low[axis] = std::min(low[axis], x[axis]), high[axis] = std::max(high[axis], x[axis]);
        area += 0.5 * cross(x - rim.corners[0], rim.corners[(k + 1) % rim.corners.size()] - rim.corners[0]);
      }
      const double width = high.x - low.x, depth = high.y - low.y, filled = std::abs(area.z) / (width * depth);
      if (high.z - low.z > p.bed.spacing || !(width > 0 && depth > 0)) continue;
      VesselOutlet hole =
          rectangle(name_of(p, n), {0.5 * (low.x + high.x), 0.5 * (low.y + high.y), low.z}, width, depth);
      if (std::abs(width / depth - 1) < like_a_circle && std::abs(4 / std::numbers::pi * filled - 1) < like_a_circle) {
        hole.round = true;  // of the same area
        hole.width = hole.depth = hole.narrow = hole.length = std::sqrt(4 / std::numbers::pi * std::abs(area.z));
      }
      all.push_back(hole);
    }
  }
  return all;
}

/// The hole that a gate shuts, if it is one of them.
const VesselOutlet* covered_by(const std::vector<VesselOutlet>& all, const VesselOutlet& gate, double spacing) {
  for (const VesselOutlet& hole : all) {
    const Vector3 d = hole.middle - gate.middle;
    const double slack = rounding * gate.width;
    if (std::abs(d.z) <= spacing && std::abs(d.x) + 0.5 * hole.width <= 0.5 * gate.width + slack &&
        std::abs(d.y) + 0.5 * hole.depth <= 0.5 * gate.depth + slack)
      return &hole;
  }
  return nullptr;
}

}  // namespace

double first_opening(const std::vector<VesselOutlet>& outlets) {
  double first = outlets.empty() ? 0 : std::numeric_limits<double>::infinity();
  for (const VesselOutlet& outlet : outlets) first = std::min(first, outlet.gate ? outlet.gate->opens_after : 0);
  return first;
}

double distance_of_walls(FaceKind a, FaceKind b, double extent) {
  const int walls = (a == FaceKind::wall ? 1 : 0) + (b == FaceKind::wall ? 1 : 0);
  return walls == 2 ? extent : walls == 1 ? 2 * extent : std::numeric_limits<double>::infinity();
}

bool VesselOutlet::is_beside(const Vector3& x, double margin) const {
  const double along_x = std::abs(x.x - middle.x), along_y = std::abs(x.y - middle.y);
  if (round) return std::hypot(along_x, along_y) <= 0.5 * width + margin;
  return along_x <= 0.5 * width + margin && along_y <= 0.5 * depth + margin;
}

std::vector<VesselOutlet> outlets_of_vessel(const Parameters& p) {
  const std::vector<VesselOutlet> all = holes(p), of_files = holes_of_files(p);
  std::vector<VesselOutlet> outlets;
  for (std::size_t n = 0; n < p.vessel.size(); ++n) {
    const VesselPart& v = p.vessel[n];
    if (!v.gate || v.along != Along::z) continue;
    std::optional<VesselOutlet> gate;
    if (v.shape == VesselShape::disc) gate = round_outlet(p, n, v.height, 2 * v.radius);
    if (v.shape == VesselShape::plate && v.first_edge[2] == 0 && v.second_edge[2] == 0) gate = of_plate(p, n);
    if (!gate) continue;
    const VesselOutlet* hole = covered_by(all, *gate, p.bed.spacing);
    if (!hole) hole = covered_by(of_files, *gate, p.bed.spacing);
    if (hole) {
      VesselOutlet open = *hole;  // grains that lie on the gate have not left
      open.name = gate->name, open.middle.z = std::min(gate->middle.z, hole->middle.z);
      gate = open;
    }
    gate->gate = {v.opens_after, v.closes_after, v.repeats_every};
    outlets.push_back(*gate);
  }
  if (outlets.empty() && !all.empty()) {
    const double lowest = std::min_element(all.begin(), all.end(), [](const auto& a, const auto& b) {
                            return a.middle.z < b.middle.z;
                          })->middle.z;
    for (const VesselOutlet& hole : all)
      if (hole.middle.z <= lowest + rounding) outlets.push_back(hole);
  }
  std::stable_sort(outlets.begin(), outlets.end(),
                   [](const auto& a, const auto& b) { return a.middle.z < b.middle.z; });
  for (VesselOutlet& outlet : outlets) {
    if (outlet.round) continue;
    const auto reaches = [](double middle, double extent, double face) {
      return middle - 0.5 * extent <= rounding * face && middle + 0.5 * extent >= (1 - rounding) * face;
    };
    outlet.endless_along_x =
        goes_on(p.box.left) && goes_on(p.box.right) && reaches(outlet.middle.x, outlet.width, p.box.width);
    outlet.endless_along_y = !outlet.endless_along_x && goes_on(p.box.front) && goes_on(p.box.rear) &&
                             reaches(outlet.middle.y, outlet.depth, p.box.depth);
    if (outlet.endless_along_x)
      outlet.narrow = std::min(outlet.depth, distance_of_walls(p.box.left, p.box.right, p.box.width));
    if (outlet.endless_along_y)
      outlet.narrow = std::min(outlet.width, distance_of_walls(p.box.front, p.box.rear, p.box.depth));
  }
  return outlets;
}

namespace {

constexpr double off_the_plane = 0.01;  // of its narrower side

/// Share of an outlet with a wall between two heights over it, m.
double share_with_wall(const Layout& layout, const VesselOutlet& outlet, double start, double end) {
  const Parameters& p = layout.given;
  Boundary boundary = *layout.boundary;
  boundary.open_all_gates();
  const Surface& surface = boundary.vessel();
  constexpr int across = 16;
  double all = 0, blocked = 0;
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < across; ++j) {
      const auto along = [](int n, double extent) { return ((n + 0.5) / across - 0.5) * extent; };
      const Vector3 x = outlet.middle + Vector3{along(i, outlet.width), along(j, outlet.depth), start};
      if (!outlet.is_beside(x, 0) || x.x < 0 || x.y < 0 || x.x > p.box.width || x.y > p.box.depth) continue;
      ++all;
      blocked += surface.first_crossing(x, x + Vector3{0, 0, end - start}).has_value();
    }
  return all > 0 ? blocked / all : 0;
}

}  // namespace

double share_blocked_below(const Layout& layout, const VesselOutlet& outlet) {
  if (is_mirror(layout.given.box.floor) && outlet.middle.z < outlet.narrow) return 1;
  return share_with_wall(layout, outlet, -off_the_plane * outlet.narrow, -outlet.narrow);
}

double share_covered(const Layout& layout, const VesselOutlet& outlet) {
  return share_with_wall(layout, outlet, -off_the_plane * outlet.narrow, 2 * layout.given.bed.spacing);
}

}  // namespace talus::continuum

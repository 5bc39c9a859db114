// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/vessel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/unit.hpp"
#include "models/continuum/boundary/boundary.hpp"
#include "models/continuum/setup/layout.hpp"

namespace talus::continuum {

namespace {

constexpr double round_off = 0.02;  // of a polygon from its circle, in spacings

/// A closed line of corners at each of two heights, joined by triangles that face its axis. A corner that two lines
/// share is one place.
std::vector<Triangle> band(const std::vector<Vector3>& lower, const std::vector<Vector3>& upper) {
  std::vector<Triangle> triangles;
  const auto add = [&](const Vector3& a, const Vector3& b, const Vector3& c) {
    if (!(a == b) && !(b == c) && !(c == a)) triangles.push_back({{a, b, c}, 0});
  };
  for (std::size_t n = 0; n < lower.size(); ++n) {
    const std::size_t m = (n + 1) % lower.size();
    add(lower[n], upper[n], lower[m]);
    add(lower[m], upper[n], upper[m]);
  }
  return triangles;
}

struct Axis {
  double x, y;
};

Axis axis_of(const Parameters& p, const VesselPart& v) {
  if (v.centre.size() == 2) return {v.centre[0], v.centre[1]};
  return {0.5 * (v.along == Along::x ? p.box.depth : p.box.width),
          0.5 * (v.along == Along::z ? p.box.depth : p.box.height)};
}

/// The number of sides is that of the largest circle of the vessel, so that parts that meet have the same corners.
std::size_t sides(const Parameters& p) {
  double radius = 0;
  for (const VesselPart& v : p.vessel) radius = std::max({radius, v.radius, v.lower_radius, v.upper_radius});
  const double angle = std::acos(std::max(0.0, 1 - round_off * p.bed.spacing / radius));  // half of a side's
  const int multiple = std::lcm(4, sector_of(p) ? sector_of(p)->copies() : 1);  // so that a sector ends at corners
  const double fewest = std::ceil(24.0 / multiple), most = std::ceil(4000.0 / multiple);
  return static_cast<std::size_t>(multiple) *
         static_cast<std::size_t>(std::clamp(std::ceil(std::numbers::pi / angle / multiple), fewest, most));
}

std::vector<Vector3> circle(const Parameters& p, const VesselPart& v, double radius, double z) {
  const Axis axis = axis_of(p, v);
  const auto count = static_cast<double>(sides(p));
  // Between the circle within and the one around it: the polygon of the same area.
  const double angle = 2 * std::numbers::pi / count, around = radius * std::sqrt(angle / std::sin(angle));
  std::vector<Vector3> corners;
  for (double n = 0; n < count; ++n)
    corners.push_back(placed(v, {axis.x + around * std::cos(angle * n), axis.y + around * std::sin(angle * n), z}));
  return corners;
}

std::vector<Vector3> rectangle(const Parameters& p, const VesselPart& v, double width, double depth, double z) {
  const Axis axis = axis_of(p, v);
  const double x = 0.5 * width, y = 0.5 * depth;
  return {{axis.x - x, axis.y - y, z},
          {axis.x + x, axis.y - y, z},
          {axis.x + x, axis.y + y, z},
          {axis.x - x, axis.y + y, z}};
}

Vector3 vector_of(const std::array<double, 3>& a) {
  return {a[0], a[1], a[2]};
}

}  // namespace

Vector3 placed(const VesselPart& v, const Vector3& x) {
  return v.along == Along::z ? x : v.along == Along::x ? Vector3{x.z, x.x, x.y} : Vector3{x.x, x.z, x.y};
}

Vector3 on_axis(const Parameters& p, const VesselPart& v) {
  const Axis axis = axis_of(p, v);
  return placed(v, {axis.x, axis.y, 0});
}

std::string vessel_key(std::size_t n, std::string_view name) {
  return fmt::format("vessel.{}.{}", n + 1, name);
}

std::string name_of(const Parameters& p, std::size_t part) {
  const VesselPart& v = p.vessel[part];
  return v.name.empty() ? fmt::format("{}_{}", choice_name(v.shape), part + 1) : v.name;
}

std::vector<Triangle> triangles_of(const Parameters& p, std::size_t part) {
  const VesselPart& v = p.vessel[part];
  std::vector<Triangle> triangles;
  switch (v.shape) {
    case VesselShape::cylinder:
      triangles = band(circle(p, v, v.radius, v.bottom), circle(p, v, v.radius, v.top));
      break;
    case VesselShape::cone:
      triangles = band(circle(p, v, v.lower_radius, v.bottom), circle(p, v, v.upper_radius, v.top));
      break;
    case VesselShape::disc:
      triangles = band(circle(p, v, v.hole, v.height), circle(p, v, v.radius, v.height));
      break;
    case VesselShape::box:
      triangles = band(rectangle(p, v, v.width, v.depth, v.bottom), rectangle(p, v, v.width, v.depth, v.top));
      break;
    case VesselShape::pyramid:
      triangles = band(rectangle(p, v, v.lower_width, v.lower_depth, v.bottom),
                       rectangle(p, v, v.upper_width, v.upper_depth, v.top));
      break;
    case VesselShape::plate: {
      const Vector3 a = vector_of(v.corner), b = a + vector_of(v.first_edge), d = a + vector_of(v.second_edge);
      const Vector3 c = b + vector_of(v.second_edge);
      triangles = {{{a, b, c}, 0}, {{a, c, d}, 0}};
      break;
    }
    case VesselShape::stl:
      triangles = placed_triangles(v);
      break;
  }
  for (Triangle& t : triangles) t.patch = static_cast<std::uint32_t>(part);
  return triangles;
}

namespace {

VesselBounds no_bounds() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
}

void add(VesselBounds& all, const Vector3& x) {
  for (int axis = 0; axis < 3; ++axis)
    all.low[axis] = std::min(all.low[axis], x[axis]), all.high[axis] = std::max(all.high[axis], x[axis]);
}

}  // namespace

VesselBounds bounds_of(const Parameters& p, std::size_t part) {
  const VesselPart& v = p.vessel[part];
  const Axis axis = axis_of(p, v);
  VesselBounds all = no_bounds();
  const auto around = [&](double width, double depth, double bottom, double top) {
    add(all, placed(v, {axis.x - 0.5 * width, axis.y - 0.5 * depth, bottom}));
    add(all, placed(v, {axis.x + 0.5 * width, axis.y + 0.5 * depth, top}));
  };
  switch (v.shape) {
    case VesselShape::cylinder:
      around(2 * v.radius, 2 * v.radius, v.bottom, v.top);
      break;
    case VesselShape::cone: {
      const double widest = 2 * std::max(v.lower_radius, v.upper_radius);
      around(widest, widest, v.bottom, v.top);
      break;
    }
    case VesselShape::disc:
      around(2 * v.radius, 2 * v.radius, v.height, v.height);
      break;
    case VesselShape::box:
      around(v.width, v.depth, v.bottom, v.top);
      break;
    case VesselShape::pyramid:
      around(std::max(v.lower_width, v.upper_width), std::max(v.lower_depth, v.upper_depth), v.bottom, v.top);
      break;
    case VesselShape::plate: {
      const Vector3 a = vector_of(v.corner), b = vector_of(v.first_edge), c = vector_of(v.second_edge);
      add(all, a), add(all, a + b), add(all, a + c), add(all, a + b + c);
      break;
    }
    case VesselShape::stl:
      if (v.drawn) all = placed_bounds(v);
      break;
  }
  return all;
}

VesselBounds bounds_of_vessel(const Parameters& p) {
  VesselBounds all = no_bounds();
  for (std::size_t n = 0; n < p.vessel.size(); ++n) {
    const VesselBounds own = bounds_of(p, n);
    if (own.low.x <= own.high.x) add(all, own.low), add(all, own.high);  // a file that cannot be read has none
  }
  return all;
}

bool has_unread_file(const Parameters& p) {
  return std::any_of(p.vessel.begin(), p.vessel.end(),
                     [](const VesselPart& v) { return v.shape == VesselShape::stl && !v.drawn; });
}

bool is_moving(const VesselPart& v) {
  return v.spin != 0 || v.slide != 0 || v.belt;
}

namespace {

constexpr double in_plane = 1e-6;  // of a belt's speed

/// A belt that would leave its plane.
void check_motion(const VesselPart& v, std::size_t number, std::vector<Problem>& problems) {
  if (!v.belt) return;
  const Vector3 normal = cross(vector_of(v.first_edge), vector_of(v.second_edge)), belt = vector_of(*v.belt);
  if (std::abs(dot(normal, belt)) > in_plane * norm(normal) * norm(belt))
    problems.push_back({.key = vessel_key(number, "belt"),
                        .what = "would move the plate itself",
                        .allowed = "a velocity along the plate"});
}

/// Whether a name is one of a face or a plate.
bool names_another_wall(const Parameters& p, const std::string& name) {
  if (std::find(face_names.begin(), face_names.end(), name) != face_names.end() || name == "plate") return true;
  for (std::size_t n = 0; n < p.plates.size(); ++n)
    if (name == fmt::format("plates_{}", n + 1)) return true;
  return false;
}

}  // namespace

std::vector<Problem> check_vessel(const Parameters& p) {
  std::vector<Problem> problems;
  for (std::size_t n = 0; n < p.vessel.size(); ++n) {
    const VesselPart& v = p.vessel[n];
    const auto add = [&](std::string_view key, std::string what, std::string allowed) {
      problems.push_back({.key = vessel_key(n, key), .what = std::move(what), .allowed = std::move(allowed)});
    };
    const bool upright = v.shape == VesselShape::cylinder || v.shape == VesselShape::cone ||
                         v.shape == VesselShape::box || v.shape == VesselShape::pyramid;
    if (upright && !(v.top > v.bottom))
      add("top", fmt::format("{:.4g} mm is not above the bottom", v.top / millimetre),
          fmt::format("above {:.4g} mm", v.bottom / millimetre));
    if (v.closes_after && !(*v.closes_after > v.opens_after))
      add("closes_after", fmt::format("{:.4g} s is not after opens_after", *v.closes_after),
          fmt::format("above {:.4g} s", v.opens_after));
    if (v.repeats_every && !(v.closes_after && *v.repeats_every > *v.closes_after - v.opens_after))
      add("repeats_every",
          v.closes_after ? "is not longer than the gate is open" : "given, but the gate does not close",
          v.closes_after ? fmt::format("above {:.4g} s", *v.closes_after - v.opens_after) : "with closes_after");
    if (v.closes_after && p.air.enabled) add("closes_after", "a gate that closes, and air", "left out with air");
    if (v.adhesion && !has_cohesion(p))
      add("adhesion", "the grains do not stick together", "a law with cohesion, such as tensile_strength above 0");
    if (!v.centre.empty() && v.centre.size() != 2) add("centre", "is no place", "two lengths, x and y");
    if (v.shape == VesselShape::disc && !(v.hole < v.radius))
      add("hole", fmt::format("{:.4g} mm leaves no disc", v.hole / millimetre),
          fmt::format("below {:.4g} mm, its radius", v.radius / millimetre));
    if (v.shape == VesselShape::cone && !(std::max(v.lower_radius, v.upper_radius) > 0))
      add("upper_radius", "the cone has no radius", "one of both above 0");
    if (v.shape == VesselShape::pyramid && !(std::max(v.lower_width, v.upper_width) > 0))
      add("upper_width", "the pyramid has no width", "one of both above 0");
    if (v.shape == VesselShape::pyramid && !(std::max(v.lower_depth, v.upper_depth) > 0))
      add("upper_depth", "the pyramid has no depth", "one of both above 0");
    if (v.shape == VesselShape::plate && !(norm(cross(vector_of(v.first_edge), vector_of(v.second_edge))) > 0))
      add("second_edge", "the plate has no area", "an edge at an angle to first_edge");
    if (!std::all_of(v.name.begin(), v.name.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; }))
      add("name", fmt::format("\"{}\" cannot name a column", v.name), "letters, digits and _");
    if (names_another_wall(p, v.name))
      add("name", fmt::format("\"{}\" is a wall of the box", v.name), "a name of its own");
    for (std::size_t m = 0; m < n; ++m)
      if (name_of(p, m) == name_of(p, n)) add("name", "is that of another wall too", "a name of its own");
    check_motion(v, n, problems);
    check_file(v, n, problems);
  }
  if (p.vessel.empty()) return problems;
  const auto refuse = [&](bool given, std::string key, std::string what, std::string allowed) {
    if (given) problems.push_back({.key = std::move(key), .what = std::move(what), .allowed = std::move(allowed)});
  };
  const bool moves = std::any_of(p.vessel.begin(), p.vessel.end(), is_moving);
  refuse(p.air.enabled && moves, "air.enabled", "air does not know walls that move", "false with spin, slide or belt");
  refuse(p.plate.height.has_value(), "plate.height", "a plate across the box and a [[vessel]]", "one of them");
  refuse(p.wedge.half_angle.has_value(), "wedge.half_angle", "a wedge and a [[vessel]]", "one of them");
  refuse(p.walls.friction == Friction::printed, "walls.friction", "the printed rule in a [[vessel]]",
         "\"coulomb\" or \"none\"");
  return problems;
}

}  // namespace talus::continuum

// SPDX-License-Identifier: Apache-2.0
/// Whether the walls of a vessel are where the box is. A file of triangles says neither its unit nor where it belongs:
/// many are drawn about their origin, and the box begins at its own.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "models/continuum/setup/parameters.hpp"
#include "models/continuum/setup/vessel.hpp"

namespace talus::continuum {

namespace {

constexpr double max_over_box = 1000;       // extents
constexpr double min_share_of_file = 0.01;  // of its area within the box: all but none
constexpr double over_edge = 0.1;           // of the box, by which walls that fit may stick out of it
constexpr double min_over_box = 0.05;       // extents: smaller ones are no likely vessel
constexpr double min_spacings = 4;          // nor those of another unit

Vector3 size_of_box(const Parameters& p) {
  return {p.box.width, p.box.depth, p.box.height};
}

double largest(const Vector3& x) {
  return std::max({x.x, x.y, x.z});
}

double area_of(const std::vector<Vector3>& polygon) {
  Vector3 area;
  for (std::size_t n = 2; n < polygon.size(); ++n)
    area += 0.5 * cross(polygon[n - 1] - polygon[0], polygon[n] - polygon[0]);
  return norm(area);
}

std::string span_text(const VesselBounds& b) {
  const double most = std::max({std::abs(b.low.x), std::abs(b.low.y), std::abs(b.low.z), std::abs(b.high.x),
                                std::abs(b.high.y), std::abs(b.high.z)});
  const double unit = most >= 10 ? 1 : 1e-3;
  const auto along = [&](int axis) {
    const auto number = [&](double x) { return std::round(1e6 * x / unit) / 1e6 + 0.0; };
    const double low = number(b.low[axis]), high = number(b.high[axis]);
    // Four digits of the extent itself, far away too.
    const double digits = std::log10(std::max({std::abs(low), std::abs(high), 1e-300}) / std::max(high - low, 1e-9));
    const int precision = std::clamp(4 + static_cast<int>(std::ceil(digits)), 4, 15);
    return fmt::format("{:.{}g}..{:.{}g}", low, precision, high, precision);
  };
  return fmt::format("{} x {} x {} {}", along(0), along(1), along(2), unit == 1 ? "m" : "mm");
}

/// Of a part with another unit.
VesselBounds with_unit(const VesselPart& v, FileUnit unit) {
  VesselPart other = v;
  other.unit = unit;
  return placed_bounds(other);
}

bool has_size_of(const Vector3& box, const VesselBounds& b, double least) {
  const Vector3 extent = b.high - b.low;
  for (int axis = 0; axis < 3; ++axis)
    if (!(extent[axis] <= (1 + over_edge) * box[axis])) return false;
  return largest(extent) >= least;
}

bool is_within(const Vector3& box, const VesselBounds& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(b.low[axis] >= -over_edge * box[axis] && b.high[axis] <= (1 + over_edge) * box[axis])) return false;
  return has_size_of(box, b, min_over_box * largest(box));
}

/// Into the middle of the box, on its floor, where it lies beyond it.
Vector3 shift_into(const Vector3& box, const VesselBounds& b) {
  Vector3 shift;
  for (int axis = 0; axis < 3; ++axis) {
    if (b.low[axis] >= 0 && b.high[axis] <= box[axis]) continue;
    shift[axis] = axis == 2 ? -b.low.z : 0.5 * (box[axis] - b.low[axis] - b.high[axis]);
  }
  return shift;
}

std::string move_text(const VesselPart& v, const Vector3& shift, const VesselBounds& b) {
  const auto length = [&](int axis) {
    const double mm = 1e3 * (v.move[static_cast<std::size_t>(axis)] + shift[axis]);
    return fmt::format("\"{:.15g} mm\"", std::round(1e3 * mm) / 1e3 + 0.0);
  };
  return fmt::format("move = [{}, {}, {}], with which it spans {}", length(0), length(1), length(2),
                     span_text({b.low + shift, b.high + shift}));
}

/// Of a file, what would bring it into the box.
std::string cure_of(const Parameters& p, const VesselPart& v) {
  const Vector3 box = size_of_box(p);
  const VesselBounds own = placed_bounds(v);
  if (has_size_of(box, own, min_spacings * p.bed.spacing)) return move_text(v, shift_into(box, own), own);
  std::optional<FileUnit> fitting, of_size;
  const auto is_larger = [&](FileUnit unit, const std::optional<FileUnit>& than) {
    return !than || metres(unit) > metres(*than);
  };
  for (const FileUnit unit : {FileUnit::mm, FileUnit::cm, FileUnit::inch, FileUnit::m}) {
    const VesselBounds b = with_unit(v, unit);
    if (is_within(box, b) && is_larger(unit, fitting)) fitting = unit;
    if (has_size_of(box, b, min_over_box * largest(box)) && is_larger(unit, of_size)) of_size = unit;
  }
  if (fitting)
    return fmt::format("unit = \"{}\", with which it spans {}", choice_name(*fitting),
                       span_text(with_unit(v, *fitting)));
  if (of_size) {
    const VesselBounds b = with_unit(v, *of_size);
    return fmt::format("unit = \"{}\" and {}", choice_name(*of_size), move_text(v, shift_into(box, b), b));
  }
  FileUnit nearest = v.unit;
  const auto ratio = [&](FileUnit unit) {
    const VesselBounds b = with_unit(v, unit);
    return std::abs(std::log(largest(b.high - b.low) / largest(box)));
  };
  for (const FileUnit unit : {FileUnit::mm, FileUnit::cm, FileUnit::inch, FileUnit::m})
    if (ratio(unit) < ratio(nearest)) nearest = unit;
  const std::string box_or_scale = "a scale and a move with which it lies within, or a box that holds it";
  if (nearest == v.unit) return box_or_scale;
  return fmt::format("unit = \"{}\", with which it spans {}, and {}", choice_name(nearest),
                     span_text(with_unit(v, nearest)), box_or_scale);
}

}  // namespace

double share_in_box(const Parameters& p, std::size_t part) {
  const Vector3 box = size_of_box(p);
  const double slack = 1e-9 * largest(box);  // walls on a face are within
  const VesselBounds own = bounds_of(p, part);
  bool whole = true;
  for (int axis = 0; axis < 3; ++axis) whole = whole && own.low[axis] >= -slack && own.high[axis] <= box[axis] + slack;
  if (whole) return 1;
  double all = 0, inside = 0;
  for (const Triangle& t : triangles_of(p, part)) {
    std::vector<Vector3> polygon(t.corner.begin(), t.corner.end());
    all += area_of(polygon);
    for (int axis = 0; axis < 3 && polygon.size() > 2; ++axis)
      polygon = clipped(clipped(polygon, axis, -slack, 1), axis, box[axis] + slack, -1);
    inside += area_of(polygon);
  }
  return all > 0 ? std::min(1.0, inside / all) : 0;
}

std::string extents_text(const Parameters& p, std::size_t part) {
  return fmt::format("{} spans {}, the box {}", name_of(p, part), span_text(bounds_of(p, part)),
                     span_text({{0, 0, 0}, size_of_box(p)}));
}

std::vector<Problem> check_extents(const Parameters& p) {
  std::vector<Problem> problems;
  const Vector3 box = size_of_box(p);
  if (!(box.x > 0 && box.y > 0 && box.z > 0)) return problems;
  for (std::size_t n = 0; n < p.vessel.size(); ++n) {
    const VesselPart& v = p.vessel[n];
    const bool of_file = v.shape == VesselShape::stl;
    if (of_file && !v.drawn) continue;
    const VesselBounds own = bounds_of(p, n);
    const double extent = largest(own.high - own.low), share = share_in_box(p, n);
    std::string fault;
    if (extent > max_over_box * largest(box))
      fault = "it is more than a thousand times as large as the box";
    else if (extent < (of_file ? p.bed.spacing : p.grains.diameter))
      fault = of_file ? fmt::format("it is smaller than bed.spacing, {:.4g} mm", 1e3 * p.bed.spacing)
                      : "it is smaller than a grain";
    else if (!(share > 0))
      fault = "no part of it lies within";
    else if (of_file && share < min_share_of_file)
      fault =
          share < 1e-4 ? "next to no part of it lies within" : fmt::format("{:.2g} % of it lies within", 100 * share);
    if (fault.empty()) continue;
    problems.push_back({.key = vessel_key(n, of_file ? "file" : "shape"),
                        .what = extents_text(p, n) + ": " + fault,
                        .allowed = of_file ? cure_of(p, v) : "a wall of which a part lies within"});
  }
  return problems;
}

}  // namespace talus::continuum

// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "numerics/sph/cubic_spline.hpp"

namespace talus::continuum {

namespace {

constexpr double millimetre = 1e-3;

struct Extent {
  double low, high;
};

Extent bed_along_x(const Parameters& p) {
  return {p.bed.left.value_or(0), p.bed.right.value_or(p.box.width)};
}

double bed_bottom(const Parameters& p) {
  return p.bed.bottom.value_or(p.plate.height.value_or(0));
}

void check_faces(const Parameters& p, std::vector<Problem>& problems) {
  const auto pair = [&](const char* first, FaceKind a, const char* second, FaceKind b) {
    if ((a == FaceKind::periodic) == (b == FaceKind::periodic)) return;
    const bool first_is = a == FaceKind::periodic;
    problems.push_back({.key = first_is ? second : first,
                        .what = fmt::format("is not periodic, but {} is", first_is ? first : second),
                        .allowed = "both or neither"});
  };
  pair("box.left", p.box.left, "box.right", p.box.right);
  pair("box.front", p.box.front, "box.rear", p.box.rear);
  pair("box.floor", p.box.floor, "box.top", p.box.top);
}

void check_plate(const Parameters& p, std::vector<Problem>& problems) {
  const auto add = [&](const char* key, std::string what, std::string allowed) {
    problems.push_back({.key = key, .what = std::move(what), .allowed = std::move(allowed)});
  };
  if (!p.plate.height) {
    if (p.plate.slit_left || p.plate.slit_right)
      add(p.plate.slit_left ? "plate.slit_left" : "plate.slit_right", "given, but there is no plate", "plate.height");
    return;
  }
  // Images reach twice the support and the skin; lumps grow as they thin out, so some room is left.
  const double room = 3 * sph::support * p.bed.spacing;
  if (*p.plate.height < room || *p.plate.height > p.box.height - room)
    add("plate.height", fmt::format("{:.4g} mm is too near to floor or top", *p.plate.height / millimetre),
        fmt::format("{:.4g} to {:.4g} mm: six spacings from both", room / millimetre,
                    (p.box.height - room) / millimetre));
  if (p.plate.slit_left.has_value() != p.plate.slit_right.has_value()) {
    add(p.plate.slit_left ? "plate.slit_right" : "plate.slit_left", "missing: the slit needs both its ends",
        "a length");
  } else if (p.plate.slit_left && !(*p.plate.slit_left < *p.plate.slit_right && *p.plate.slit_right <= p.box.width)) {
    add("plate.slit_right", fmt::format("{:.4g} mm leaves no slit", *p.plate.slit_right / millimetre),
        "above plate.slit_left, at most box.width");
  }
}

void check_bed(const Parameters& p, std::vector<Problem>& problems) {
  const auto add = [&](const char* key, std::string what, std::string allowed) {
    problems.push_back({.key = key, .what = std::move(what), .allowed = std::move(allowed)});
  };
  const Extent x = bed_along_x(p);
  if (!(x.low < x.high && x.high <= p.box.width))
    add(p.bed.right ? "bed.right" : "bed.left", "leaves no bed within the box", "bed.left < bed.right <= box.width");
  const double top = bed_bottom(p) + p.bed.height;
  if (top > p.box.height)
    add("bed.height", fmt::format("the bed would reach {:.4g} mm, past the top", top / millimetre),
        fmt::format("at most {:.4g} mm above its bottom", (p.box.height - bed_bottom(p)) / millimetre));
  const double shortest = std::min({x.high - x.low, p.box.depth, p.bed.height});
  if (shortest < 0.5 * p.bed.spacing)
    add("bed.spacing", fmt::format("{:.4g} mm is more than twice the bed's least extent", p.bed.spacing / millimetre),
        fmt::format("at most {:.4g} mm", 2 * shortest / millimetre));
  const Lattice lattice = lattice_of(p);
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(lattice.spacing[axis] / p.bed.spacing - 1) > 0.15)
      add("bed.spacing",
          fmt::format("along {} the lumps would stand {:.4g} mm apart", "xyz"[axis],
                      lattice.spacing[axis] / millimetre),
          "a spacing that divides the bed's width, the box's depth and the bed's height nearly evenly");
}

}  // namespace

std::vector<Problem> check(const Parameters& p) {
  std::vector<Problem> problems;
  check_faces(p, problems);
  check_plate(p, problems);
  check_bed(p, problems);
  for (const Problem& problem : granular::check(p.law)) problems.push_back(problem);
  if (p.law.collisions != granular::Collisions::none && !(p.gravity.acceleration > 0))
    problems.push_back({.key = "law.collisions",
                        .what = "Eqs 13 and 14 measure rates by (g/D)^(1/2), and there is no gravity",
                        .allowed = "none without gravity"});
  if (p.gate.opens != GateOpens::at_time && p.gate.time > 0)
    problems.push_back({.key = "gate.time",
                        .what = fmt::format("given, but gate.opens is \"{}\"", choice_name(p.gate.opens)),
                        .allowed = "gate.opens = \"at-time\""});
  return problems;
}

Domain domain_of(const Parameters& p) {
  const Box box{.low = {0, 0, 0},
                .high = {p.box.width, p.box.depth, p.box.height},
                .faces = {p.box.left, p.box.right, p.box.front, p.box.rear, p.box.floor, p.box.top}};
  std::vector<Plate> plates;
  if (p.plate.height) {
    Plate plate{.axis = 2, .position = *p.plate.height, .openings = {}};
    if (p.plate.slit_left && p.plate.slit_right) {
      // The rim of an opening is solid: one that ends at a face has none there, nor at front and rear.
      const double left = *p.plate.slit_left > 0 ? *p.plate.slit_left : -p.box.width;
      const double right = *p.plate.slit_right < p.box.width ? *p.plate.slit_right : 2 * p.box.width;
      plate.openings.push_back({.low = {left, -p.box.depth, 0},
                                .high = {right, 2 * p.box.depth, 0},
                                .shut = p.gate.opens != GateOpens::from_the_start});
    }
    plates.push_back(std::move(plate));
  }
  return {box, std::move(plates)};
}

Lattice lattice_of(const Parameters& p) {
  const Extent x = bed_along_x(p);
  const Vector3 extent{x.high - x.low, p.box.depth, p.bed.height};
  Lattice lattice{.corner = {x.low, 0, bed_bottom(p)}, .spacing = {}, .count = {}, .mass = 0};
  for (int axis = 0; axis < 3; ++axis) {
    const auto count = std::max<std::int64_t>(1, std::llround(extent[axis] / p.bed.spacing));
    lattice.count[static_cast<std::size_t>(axis)] = count;
    lattice.spacing[axis] = extent[axis] / static_cast<double>(count);
  }
  lattice.mass = p.bed.packing * p.grains.density * lattice.spacing.x * lattice.spacing.y * lattice.spacing.z;
  return lattice;
}

}  // namespace talus::continuum

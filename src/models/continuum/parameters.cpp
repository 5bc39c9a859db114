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
  return p.bed.bottom.value_or(p.wedge.half_angle ? p.wedge.height : p.plate.height.value_or(0));
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

void check_wedge(const Parameters& p, std::vector<Problem>& problems) {
  if (!p.wedge.half_angle) {
    if (p.wedge.outlet > 0 || p.wedge.height > 0)
      problems.push_back({.key = p.wedge.outlet > 0 ? "wedge.outlet" : "wedge.height",
                          .what = "given, but there is no wedge",
                          .allowed = "wedge.half_angle"});
    return;
  }
  if (!(p.wedge.outlet < p.box.width))
    problems.push_back({.key = "wedge.outlet",
                        .what = fmt::format("{:.4g} mm leaves no walls", p.wedge.outlet / millimetre),
                        .allowed = fmt::format("below {:.4g} mm, box.width", p.box.width / millimetre)});
  const double rise = 0.5 * (p.box.width - p.wedge.outlet) / std::tan(*p.wedge.half_angle);
  if (p.wedge.height + rise > p.box.height)
    problems.push_back(
        {.key = "wedge.height",
         .what = fmt::format("the walls would reach {:.4g} mm, past the top", (p.wedge.height + rise) / millimetre),
         .allowed = "walls that end within the box"});
  if (p.plate.height)
    problems.push_back({.key = "plate.height", .what = "a plate and a wedge together", .allowed = "one of them"});
}

void check_inclined_plates(const Parameters& p, std::vector<Problem>& problems) {
  const std::size_t taken = (p.plate.height ? 1 : 0) + (p.wedge.half_angle ? 3 : 0);
  if (taken + p.plates.size() > most_plates)
    problems.push_back({.key = "plates",
                        .what = fmt::format("{} plates, gate and walls of a wedge counted", taken + p.plates.size()),
                        .allowed = fmt::format("at most {}", most_plates)});
  for (std::size_t n = 0; n < p.plates.size(); ++n) {
    const auto& plate = p.plates[n];
    const auto add = [&](int key, std::string what, std::string allowed) {
      problems.push_back(
          {.key = std::string(plate_key(n, key)), .what = std::move(what), .allowed = std::move(allowed)});
    };
    if (plate.from.size() != 2 || plate.to.size() != 2) {
      add(plate.from.size() != 2 ? 0 : 1, "is no place", "two lengths, x and z: [\"10 mm\", \"50 mm\"]");
      continue;
    }
    const double length = std::hypot(plate.to[0] - plate.from[0], plate.to[1] - plate.from[1]);
    if (!(length > p.bed.spacing)) add(1, "leaves a plate shorter than bed.spacing", "another place");
    double end = 0;
    bool in_order = plate.openings.size() % 2 == 0;
    for (const double place : plate.openings) in_order = in_order && place >= end && place <= length, end = place;
    if (!in_order)
      add(2, "are no pairs of places along the plate",
          fmt::format("an even number of lengths, rising, up to {:.4g} mm", length / millimetre));
    if (plate.opens_after && plate.openings.empty()) add(3, "given, but there are no openings", "openings");
  }
}

Panel panel_between(std::string name, double x0, double z0, double x1, double z1) {
  return {.name = std::move(name), .from = {x0, 0, z0}, .to = {x1, 0, z1}, .openings = {}};
}

std::vector<Panel> panels_of(const Parameters& p) {
  std::vector<Panel> panels;
  const bool gated = p.gate.opens != GateOpens::from_the_start;
  if (const auto outlet = outlet_of(p); outlet && p.wedge.half_angle) {
    const double top = outlet->height + outlet->left / std::tan(*p.wedge.half_angle);
    panels.push_back(panel_between("wedge_left", outlet->left, outlet->height, 0, top));
    panels.push_back(panel_between("wedge_right", outlet->right, outlet->height, p.box.width, top));
    if (gated && p.wedge.outlet > 0) {
      panels.push_back(panel_between("wedge_gate", outlet->left, outlet->height, outlet->right, outlet->height));
      // Its ends are the ends of the walls: all of it goes.
      panels.back().openings.push_back({.begin = -p.box.width, .end = 2 * p.box.width, .shut = true});
    }
  }
  if (p.plates.empty()) return panels;
  if (p.plate.height) {
    Panel plate = panel_between("plate", 0, *p.plate.height, p.box.width, *p.plate.height);
    if (const auto slit = outlet_of(p))
      plate.openings.push_back({.begin = slit->left, .end = slit->right, .shut = gated});
    panels.insert(panels.begin(), std::move(plate));
  }
  for (std::size_t n = 0; n < p.plates.size(); ++n) {
    const auto& given = p.plates[n];
    Panel plate =
        panel_between(fmt::format("plates_{}", n + 1), given.from[0], given.from[1], given.to[0], given.to[1]);
    for (std::size_t k = 0; k + 1 < given.openings.size(); k += 2)
      plate.openings.push_back({.begin = given.openings[k],
                                .end = given.openings[k + 1],
                                .shut = given.opens_after && (gated || *given.opens_after > 0),
                                .opens_after = given.opens_after.value_or(0)});
    panels.push_back(std::move(plate));
  }
  return panels;
}

}  // namespace

std::string_view plate_key(std::size_t n, int key) {
  constexpr std::size_t most = most_plates + 1;  // one more than allowed, for the message
  static const auto keys = [] {
    std::array<std::array<std::string, 4>, most> all;
    constexpr const char* names[4] = {"from", "to", "openings", "opens_after"};
    for (std::size_t k = 0; k < most; ++k)
      for (std::size_t name = 0; name < 4; ++name) all[k][name] = fmt::format("plates.{}.{}", k + 1, names[name]);
    return all;
  }();
  return keys.at(n)[static_cast<std::size_t>(key)];
}

std::optional<Outlet> outlet_of(const Parameters& p) {
  if (p.wedge.half_angle)
    return Outlet{p.wedge.height, 0.5 * (p.box.width - p.wedge.outlet), 0.5 * (p.box.width + p.wedge.outlet)};
  if (p.plate.height && p.plate.slit_left && p.plate.slit_right)
    return Outlet{*p.plate.height, *p.plate.slit_left, *p.plate.slit_right};
  return std::nullopt;
}

std::vector<Problem> check(const Parameters& p) {
  std::vector<Problem> problems;
  check_faces(p, problems);
  check_plate(p, problems);
  check_wedge(p, problems);
  check_inclined_plates(p, problems);
  check_bed(p, problems);
  for (const Problem& problem : granular::check(p.law)) problems.push_back(problem);
  if (p.law.strain == granular::Strain::displacements)
    problems.push_back({.key = "law.strain",
                        .what = "lumps do not keep the places of their last reset yet",
                        .allowed = "\"rate\"; talus law takes either"});
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
  if (std::vector<Panel> panels = panels_of(p); !panels.empty()) return {box, {}, std::move(panels)};
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

std::vector<Vector3> bed_positions(const Parameters& p) {
  const Lattice lattice = lattice_of(p);
  const Domain domain = domain_of(p);
  const auto at = [&](double i, double j, double k) {
    return lattice.corner +
           Vector3{(i + 0.5) * lattice.spacing.x, (j + 0.5) * lattice.spacing.y, (k + 0.5) * lattice.spacing.z};
  };
  const Vector3 top = at(0.5 * static_cast<double>(lattice.count[0] - 1), 0, static_cast<double>(lattice.count[2] - 1));
  std::vector<Vector3> positions;
  for (std::int64_t k = 0; k < lattice.count[2]; ++k)
    for (std::int64_t j = 0; j < lattice.count[1]; ++j)
      for (std::int64_t i = 0; i < lattice.count[0]; ++i) {
        const Vector3 x = at(double(i), double(j), double(k));
        if (domain.panels().empty() || (!domain.is_near_panel(x, 0.25 * p.bed.spacing) && !domain.blocks(x, top)))
          positions.push_back(x);
      }
  return positions;
}

}  // namespace talus::continuum

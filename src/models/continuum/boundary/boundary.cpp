// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/boundary/boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "models/continuum/boundary/walls_beyond_faces.hpp"
#include "models/continuum/setup/layout.hpp"
#include "models/continuum/setup/parameters.hpp"

namespace talus::continuum {

namespace {

using Openings = std::vector<Wall::Opening>;

constexpr double reach_beyond_faces =
    4;  // spacings of the coarsest particles: what acts on one, with its list's margin

/// From `begin` to `end` along a wall. The rim of an opening is solid: one that ends where the wall does has none
/// there.
Wall::Opening opening(double begin, double end, double length, bool shut, double opens_after = 0) {
  return {.begin = begin > 0 ? begin : -length,
          .end = end < length ? end : 2 * length,
          .shut = shut,
          .opens_after = opens_after};
}

/// [plate], [wedge] and [[plates]].
std::vector<Wall> walls_of(const Parameters& p) {
  std::vector<Wall> walls;
  const bool gated = p.gate.opens != GateOpens::from_the_start;
  const auto slit = slit_of(p);
  if (p.plate.height) {
    Openings openings;
    if (slit) openings.push_back(opening(slit->left, slit->right, p.box.width, gated));
    walls.emplace_back("plate", Vector3{0, 0, *p.plate.height}, Vector3{p.box.width, 0, *p.plate.height}, openings);
  }
  if (p.wedge.half_angle) {
    const double top = slit->height + slit->left / std::tan(*p.wedge.half_angle);
    const Vector3 left{slit->left, 0, slit->height}, right{slit->right, 0, slit->height};
    walls.emplace_back("wedge_left", left, Vector3{0, 0, top});
    walls.emplace_back("wedge_right", right, Vector3{p.box.width, 0, top});
    // Its ends are the ends of the walls: all of it goes.
    if (gated && p.wedge.outlet > 0)
      walls.emplace_back("wedge_gate", left, right, Openings{opening(0, p.box.width, p.box.width, true)});
  }
  for (std::size_t n = 0; n < p.plates.size(); ++n) {
    const auto& given = p.plates[n];
    const Vector3 from{given.from[0], 0, given.from[1]}, to{given.to[0], 0, given.to[1]};
    Openings openings;
    for (std::size_t k = 0; k + 1 < given.openings.size(); k += 2)
      openings.push_back(opening(given.openings[k], given.openings[k + 1], std::hypot(to.x - from.x, to.z - from.z),
                                 given.opens_after && (gated || *given.opens_after > 0),
                                 given.opens_after.value_or(0)));
    walls.emplace_back(fmt::format("plates_{}", n + 1), from, to, openings);
  }
  return walls;
}

Box box_of(const Parameters& p) {
  return {.low = {0, 0, 0},
          .high = {p.box.width, p.box.depth, p.box.height},
          .faces = {p.box.left, p.box.right, p.box.front, p.box.rear, p.box.floor, p.box.top}};
}

Domain domain_of(const Parameters& p) {
  Box box = box_of(p);
  const std::optional<Sector> sector = sector_of(p);
  if (!sector) return Domain(box, walls_of(p), min_distance_of_layers(p));
  std::fill_n(box.faces.begin(), 4, FaceKind::open);  // no grains come so far
  return Domain(box, {}, 0, sector);
}

Surface surface_of(const Parameters& p) {
  if (p.vessel.empty()) return {};
  std::vector<Triangle> triangles;
  for (std::size_t n = 0; n < p.vessel.size(); ++n) {
    const std::vector<Triangle> part = triangles_of(p, n);
    triangles.insert(triangles.end(), part.begin(), part.end());
  }
  if (!p.box.sector) {
    const double reach = std::ldexp(reach_beyond_faces, static_cast<int>(p.levels.count)) * p.bed.spacing;
    triangles = with_walls_beyond_faces(std::move(triangles), box_of(p), reach);
  }
  return Surface(std::move(triangles), p.vessel.size());
}

std::optional<WallMotion> motion_of(const Parameters& p, const VesselPart& v) {
  if (!is_moving(v)) return std::nullopt;
  if (v.belt) return WallMotion{{(*v.belt)[0], (*v.belt)[1], (*v.belt)[2]}, {}, {}};
  const Vector3 axis = placed(v, {0, 0, 1});
  return WallMotion{v.slide * axis, v.spin * axis, on_axis(p, v)};
}

}  // namespace

Boundary::Boundary(const Parameters& p) : domain_(domain_of(p)), vessel_(surface_of(p)) {
  const double friction = p.walls.friction == Friction::coulomb ? p.walls.coefficient : 0;
  const double adhesion = wall_adhesion(p);
  for (const char* const face : face_names) patches_.push_back({face, friction, adhesion, {}, {}});
  for (const Wall& wall : domain_.walls()) patches_.push_back({wall.name(), friction, adhesion, {}, {}});
  for (std::size_t n = 0; n < p.vessel.size(); ++n) {
    const VesselPart& v = p.vessel[n];
    patches_.push_back(
        {.name = name_of(p, n),
         .friction = p.walls.friction == Friction::coulomb ? v.friction.value_or(friction) : 0,
         .adhesion = wall_adhesion(p, v.adhesion),
         .gate = v.gate ? std::optional(GateTimes{v.opens_after, v.closes_after, v.repeats_every}) : std::nullopt,
         .motion = motion_of(p, v)});
  }
}

bool Boundary::vessel_has_gates_due(double time) const {
  for (std::size_t n = 0; n < vessel_.patches(); ++n)
    if (vessel_.is_open(n) != patches_[patch_of_part(n)].is_away(time)) return true;
  return false;
}

void Boundary::move_gates(double time) {
  domain_.open_gates(time);
  for (std::size_t n = 0; n < vessel_.patches(); ++n) vessel_.set_open(n, patches_[patch_of_part(n)].is_away(time));
}

void Boundary::open_all_gates() {
  domain_.open_gates(std::numeric_limits<double>::infinity());
  for (std::size_t n = 0; n < vessel_.patches(); ++n) vessel_.set_open(n, patches_[patch_of_part(n)].gate.has_value());
}

std::optional<double> Boundary::shut_since(double time) const {
  std::optional<double> last;
  for (const Patch& patch : patches_) {
    if (patch.is_away(time)) return std::nullopt;
    if (patch.gate) last = std::max(last, patch.gate->closed_before(time));
  }
  return last;
}

int Boundary::openings() const {
  int open = domain_.openings();
  for (std::size_t n = 0; n < vessel_.patches(); ++n) open += vessel_.is_open(n);
  return open;
}

}  // namespace talus::continuum

// SPDX-License-Identifier: Apache-2.0
/// Triangles of files: what is wrong with them, and how they come to stand in the box.
#include "models/continuum/setup/vessel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

#include "base/tensor.hpp"
#include "models/continuum/setup/parameters.hpp"

namespace talus::continuum {

namespace {

using Kind = SurfaceFault::Kind;

constexpr std::size_t max_faults = 5;

std::string place_text(const Vector3& x, FileUnit unit) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) {}", x.x, x.y, x.z, choice_name(unit));
}

/// Right-handed about an axis. Quarters of a circle are exact: what was level stays so.
Tensor3<> rotation(int axis, double angle) {
  const double quarters = angle / (0.5 * std::numbers::pi), whole = std::round(quarters);
  double c = std::cos(angle), s = std::sin(angle);
  if (std::abs(quarters - whole) < 1e-12) {
    const int quarter = static_cast<int>(std::fmod(std::fmod(whole, 4) + 4, 4));
    c = quarter == 0 ? 1 : quarter == 2 ? -1 : 0, s = quarter == 1 ? 1 : quarter == 3 ? -1 : 0;
  }
  if (axis == 0) return {1, 0, 0, 0, c, -s, 0, s, c};
  if (axis == 1) return {c, 0, s, 0, 1, 0, -s, 0, c};
  return {c, -s, 0, s, c, 0, 0, 0, 1};
}

Tensor3<> tensor_of(const Turn& turn) {
  constexpr double quarter = 0.5 * std::numbers::pi;
  const Tensor3<> upright = turn.up == Along::y   ? rotation(0, quarter)
                            : turn.up == Along::x ? rotation(1, -quarter)
                                                  : rotation(2, 0);
  return rotation(2, turn.angles[2]) * (rotation(1, turn.angles[1]) * (rotation(0, turn.angles[0]) * upright));
}

VesselBounds around(std::span<const Triangle> triangles, const Tensor3<>& turn) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  VesselBounds all{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for (const Triangle& t : triangles)
    for (const Vector3& c : t.corner) {
      const Vector3 x = turn * c;
      for (int axis = 0; axis < 3; ++axis)
        all.low[axis] = std::min(all.low[axis], x[axis]), all.high[axis] = std::max(all.high[axis], x[axis]);
    }
  return all;
}

/// The last step of all: the order of places along an axis is kept, so that bounds may be taken before it.
Vector3 scaled_and_moved(const VesselPart& v, const Vector3& x) {
  return v.scale * metres(v.unit) * x + Vector3{v.move[0], v.move[1], v.move[2]};
}

/// "12 of 96", of triangles of a file.
std::string some_of(std::size_t count, std::size_t all) {
  return fmt::format("{} of {} triangles", count, all);
}

}  // namespace

DrawnSurface::DrawnSurface(std::vector<Triangle> of_file)
    : size_of_file_(of_file.size()),
      faults_(faults_of(of_file, true)),
      mended_(talus::mended(of_file, faults_)),
      rims_(rims_of(mended_.triangles)) {}

VesselBounds DrawnSurface::bounds(const Turn& turn) const {
  const std::scoped_lock lock(mutex_);
  if (turn_ != turn) bounds_ = around(mended_.triangles, tensor_of(turn)), turn_ = turn;
  return bounds_;
}

double metres(FileUnit unit) {
  constexpr double all[] = {1, 1e-2, 1e-3, 25.4e-3};
  return all[static_cast<std::size_t>(unit)];
}

Turn turn_of(const VesselPart& v) {
  return {v.up, v.rotate};
}

std::vector<Triangle> placed_triangles(const VesselPart& v) {
  std::vector<Triangle> triangles;
  if (!v.drawn) return triangles;
  triangles.assign(v.drawn->triangles().begin(), v.drawn->triangles().end());
  const Tensor3<> turn = tensor_of(turn_of(v));
  for (Triangle& t : triangles)
    for (Vector3& corner : t.corner) corner = scaled_and_moved(v, turn * corner);
  return triangles;
}

std::vector<Rim> placed_rims(const VesselPart& v) {
  std::vector<Rim> rims;
  if (!v.drawn) return rims;
  rims.assign(v.drawn->rims().begin(), v.drawn->rims().end());
  const Tensor3<> turn = tensor_of(turn_of(v));
  for (Rim& rim : rims)
    for (Vector3& corner : rim.corners) corner = scaled_and_moved(v, turn * corner);
  return rims;
}

VesselBounds placed_bounds(const VesselPart& v) {
  const VesselBounds turned = v.drawn->bounds(turn_of(v));
  return {scaled_and_moved(v, turned.low), scaled_and_moved(v, turned.high)};
}

void check_file(const VesselPart& v, std::size_t n, std::vector<Problem>& problems) {
  if (!v.drawn) return;
  const auto add = [&](const std::string& what, std::string allowed = {}) {
    problems.push_back({.key = vessel_key(n, "file"), .what = v.file + ": " + what, .allowed = std::move(allowed)});
  };
  std::size_t told = 0, all = 0;
  for (const SurfaceFault& fault : v.drawn->faults()) {
    if (fault.kind != Kind::not_finite && !(fault.kind == Kind::open_rim && v.closed)) continue;
    if (++all > max_faults) continue;
    ++told;
    add(fmt::format("triangle {} at {}: {}", fault.triangle + 1, place_text(fault.place, v.unit), text_of(fault.kind)),
        "a surface without such triangles");
  }
  if (all > told) add(fmt::format("{} more such faults", all - told));
  if (all == 0 && v.drawn->triangles().empty()) add("none of its triangles has an area", "a surface");
}

std::vector<std::string> remarks_of_vessel(const Parameters& p) {
  std::vector<std::string> remarks;
  for (std::size_t n = 0; n < p.vessel.size(); ++n) {
    const VesselPart& v = p.vessel[n];
    if (v.shape != VesselShape::stl || !v.drawn) continue;
    const MendedSurface& mended = v.drawn->mended();
    const std::size_t all = v.drawn->size_of_file();
    const std::string name = std::filesystem::path(v.file).filename();
    const auto add = [&](const std::string& text) {
      remarks.push_back(fmt::format("{}: {}: {}", vessel_key(n, "file"), name, text));
    };
    const auto first = [](const std::vector<std::uint32_t>& of) { return of.front() + 1; };
    if (!mended.flat.empty())
      add(fmt::format("{} without an area left out, triangle {} the first", some_of(mended.flat.size(), all),
                      first(mended.flat)));
    if (!mended.twice.empty())
      add(fmt::format("{} that are there twice left out, triangle {} the first", some_of(mended.twice.size(), all),
                      first(mended.twice)));
    if (!mended.turned.empty())
      add(fmt::format("{} turned over, triangle {} the first: neighbours had their normals on different sides",
                      some_of(mended.turned.size(), all), first(mended.turned)));
    if (!mended.without_outside.empty())
      add(fmt::format("no turning of triangles puts all normals on one side, at {} for example; walls do without",
                      place_text(mended.without_outside.front(), v.unit)));
    if (!mended.branching.empty())
      add(fmt::format("more than two triangles meet at {} edges, at {} for example", mended.branching.size(),
                      place_text(mended.branching.front(), v.unit)));
    const auto through = std::count_if(v.drawn->faults().begin(), v.drawn->faults().end(),
                                       [](const SurfaceFault& f) { return f.kind == Kind::crossing_another; });
    const auto one = std::find_if(v.drawn->faults().begin(), v.drawn->faults().end(),
                                  [](const SurfaceFault& f) { return f.kind == Kind::crossing_another; });
    if (through > 0)
      add(fmt::format("the surface passes through itself in {} places, triangles {} and {} at {} for example", through,
                      one->triangle + 1, *one->other + 1, place_text(one->place, v.unit)));
  }
  return remarks;
}

}  // namespace talus::continuum

// SPDX-License-Identifier: Apache-2.0
#include "base/unit.hpp"
#include "models/continuum/setup/bed.hpp"
#include "models/continuum/setup/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/cell_grid.hpp"

namespace talus::continuum {

namespace {

constexpr std::size_t max_told = 10;
constexpr double min_apart_in_file = 0.2;  // in spacings: sheared particles come as near as half a spacing
constexpr double min_from_wall = 0.3;      // in spacings: particles rest at half of one, and come as near as 0.47
constexpr double min_usual = 0.6;  // in spacings: the median distance to the nearest one; flowing grains have 0.8
constexpr double max_packing = 0.74;
constexpr const char* faces[] = {"left face", "right face", "front face", "rear face", "floor", "top"};

/// As a user finds it in the file.
std::string number_of(const GivenBed& bed, std::size_t n) {
  return bed.lines.empty() ? fmt::format("particle {}", n) : fmt::format("line {}", bed.lines[n]);
}

bool is_finite(const Vector3& x) {
  return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z);
}

}  // namespace

std::vector<Problem> check_given_bed(const Parameters& p) {
  const GivenBed& bed = *p.bed.given;
  std::vector<Problem> problems;
  std::size_t found = 0;
  const auto add = [&](std::size_t n, std::string_view what, std::string allowed) {
    if (++found <= max_told)
      problems.push_back({.key = "bed.file",
                          .what = fmt::format("{}: {}: {}", p.bed.file, number_of(bed, n), what),
                          .allowed = std::move(allowed)});
  };
  if (bed.position.empty())
    return {{.key = "bed.file", .what = fmt::format("{} has no particles", p.bed.file), .allowed = "at least one"}};
  const Vector3 size{p.box.width, p.box.depth, p.box.height};
  const FaceKind kinds[] = {p.box.left, p.box.right, p.box.front, p.box.rear, p.box.floor, p.box.top};
  bool finite = true;
  for (std::size_t n = 0; n < bed.position.size(); ++n) {
    const Vector3& x = bed.position[n];
    const bool is_number = is_finite(x) && (bed.velocity.empty() || is_finite(bed.velocity[n]));
    finite = finite && is_number;
    if (!is_number) {
      add(n, "position or velocity is not finite", "finite numbers");
      continue;
    }
    for (int axis = 0; axis < 3; ++axis)
      if (!(x[axis] >= 0 && x[axis] <= size[axis]))
        add(n, fmt::format("{} = {:.6g} mm is outside the box", "xyz"[axis], x[axis] / millimetre),
            fmt::format("0 to {:.6g} mm", size[axis] / millimetre));
    const double most = max_packing * p.grains.density;
    if (!bed.density.empty() && !(bed.density[n] > 0 && bed.density[n] <= most))
      add(n, fmt::format("density = {:.6g} kg/m3", bed.density[n]),
          fmt::format("above 0 and up to {:.6g} kg/m3, {:g} of grains.density", most, max_packing));
  }
  if (finite && p.bed.spacing > 0 && found == 0) {
    const double apart = min_apart_in_file * p.bed.spacing;
    const Vector3 extent = bed.high - bed.low;
    const double finest = std::ldexp(std::max({extent.x, extent.y, extent.z}), -19);  // of a CellGrid
    const CellGrid grid(bed.position, std::max(min_usual * p.bed.spacing, finest));
    std::size_t close = 0;
    for (std::size_t n = 0; n < bed.position.size(); ++n) {
      double nearest = std::numeric_limits<double>::infinity();
      grid.for_each_candidate(bed.position[n], [&](std::uint32_t m) {
        if (m == n) return;
        const double distance = norm(bed.position[n] - bed.position[m]);
        nearest = std::min(nearest, distance);
        if (m > n && distance < apart)
          add(n, fmt::format("is {:.3g} mm from {}", distance / millimetre, number_of(bed, m)),
              fmt::format("at least {:.3g} mm, {:g} of bed.spacing", apart / millimetre, min_apart_in_file));
      });
      close += nearest < min_usual * p.bed.spacing;
    }
    if (found == 0 && 2 * close > bed.position.size())
      problems.push_back(
          {.key = "bed.spacing",
           .what = fmt::format("{:.4g} mm, but most particles of {} have another within {:.3g} mm of them",
                               p.bed.spacing / millimetre, p.bed.file, min_usual * p.bed.spacing / millimetre),
           .allowed = "the distance of the particles in the file"});
  }
  if (finite && problems.empty())
    for (std::size_t n = 0; n < bed.position.size(); ++n)
      for (int axis = 0; axis < 3; ++axis)
        for (const int side : {0, 1}) {
          const double distance = side == 0 ? bed.position[n][axis] : size[axis] - bed.position[n][axis];
          if (kinds[static_cast<std::size_t>(2 * axis + side)] == FaceKind::wall &&
              distance < min_from_wall * p.bed.spacing)
            add(n, fmt::format("is {:.3g} mm from the {}", distance / millimetre, faces[2 * axis + side]),
                fmt::format("at least {:.3g} mm, {:g} of bed.spacing", min_from_wall * p.bed.spacing / millimetre,
                            min_from_wall));
        }
  if (found > max_told)
    problems.push_back({.key = "bed.file",
                        .what = fmt::format("{}: {} more such particles", p.bed.file, found - max_told),
                        .allowed = ""});
  return problems;
}

}  // namespace talus::continuum

// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/bed.hpp"
#include "models/continuum/setup/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "numerics/cell_grid.hpp"

namespace talus::continuum {

namespace {

constexpr double millimetre = 1e-3;
constexpr std::size_t max_told = 10;
constexpr double min_apart = 0.2;  // in spacings: sheared particles come as near as half a spacing

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
    if (!bed.density.empty() && !(bed.density[n] > 0 && std::isfinite(bed.density[n])))
      add(n, fmt::format("density = {:.6g} kg/m3", bed.density[n]), "above 0 kg/m3");
  }
  if (finite && p.bed.spacing > 0 && found == 0) {
    const double apart = min_apart * p.bed.spacing;
    const Vector3 extent = bed.high - bed.low;
    const double finest = std::ldexp(std::max({extent.x, extent.y, extent.z}), -19);  // of a CellGrid
    const CellGrid grid(bed.position, std::max(apart, finest));
    for (std::size_t n = 0; n < bed.position.size(); ++n)
      grid.for_each_candidate(bed.position[n], [&](std::uint32_t m) {
        const double distance = norm(bed.position[n] - bed.position[m]);
        if (m > n && distance < apart)
          add(n, fmt::format("is {:.3g} mm from {}", distance / millimetre, number_of(bed, m)),
              fmt::format("at least {:.3g} mm, {:g} of bed.spacing", apart / millimetre, min_apart));
      });
  }
  if (found > max_told)
    problems.push_back({.key = "bed.file",
                        .what = fmt::format("{}: {} more such particles", p.bed.file, found - max_told),
                        .allowed = ""});
  return problems;
}

}  // namespace talus::continuum

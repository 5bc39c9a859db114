// SPDX-License-Identifier: Apache-2.0
#include "analysis/free_surface.hpp"

#include <cmath>
#include <limits>
#include <optional>

#include "analysis/statistics.hpp"

namespace talus {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// The height between a row that is at or above the level and the next higher one, which is below it.
double crossing(const Section& packing, std::size_t column, std::size_t row, double level) {
  const double below = packing.at(column, row), above = packing.at(column, row + 1);
  return packing.z(row) + packing.height * (below - level) / (below - above);
}

double height_of_column(const Section& packing, std::size_t column, std::size_t first, std::size_t last,
                        Vessel::Search search, double level) {
  const auto is_grains = [&](std::size_t row) { return packing.at(column, row) >= level; };
  if (search == Vessel::Search::from_above) {
    for (std::size_t row = last - 1; row-- > first;)
      if (is_grains(row) && !is_grains(row + 1)) return crossing(packing, column, row, level);
    return none;
  }
  if (!is_grains(first)) return none;
  for (std::size_t row = first; row + 1 < last; ++row)
    if (!is_grains(row + 1)) return crossing(packing, column, row, level);
  return none;
}

/// The line through the heights of a stretch; nothing for fewer than three.
std::optional<Line> line(const FreeSurface& surface, double from, double to) {
  std::vector<double> x, z;
  for (std::size_t n = 0; n < surface.x.size(); ++n)
    if (surface.x[n] >= from && surface.x[n] <= to && std::isfinite(surface.z[n])) {
      x.push_back(surface.x[n]);
      z.push_back(surface.z[n]);
    }
  if (x.size() < 3) return std::nullopt;
  return fit_line(x, z);
}

}  // namespace

double FreeSurface::height(double at) const {
  for (std::size_t n = 1; n < x.size(); ++n)
    if (x[n - 1] <= at && at <= x[n]) {
      if (at == x[n - 1]) return z[n - 1];
      if (at == x[n]) return z[n];
      return std::lerp(z[n - 1], z[n], (at - x[n - 1]) / (x[n] - x[n - 1]));
    }
  // Between a wall and the middle of the first or last column.
  if (x.size() > 1 && at < x.front() && at > 1.5 * x[0] - 0.5 * x[1] - 1e-12) return z.front();
  if (x.size() > 1 && at > x.back() && at < 1.5 * x.back() - 0.5 * x[x.size() - 2] + 1e-12) return z.back();
  return none;
}

FreeSurface free_surface(const Section& packing, const Vessel& vessel, double level) {
  std::size_t first = 0, last = packing.rows;
  while (first < packing.rows && packing.z(first) < vessel.bottom) ++first;
  while (last > first && packing.z(last - 1) > vessel.top) --last;
  FreeSurface surface;
  for (std::size_t column = 0; column < packing.columns; ++column) {
    surface.x.push_back(packing.x(column));
    surface.z.push_back(last - first < 2 ? none : height_of_column(packing, column, first, last, vessel.search, level));
  }
  return surface;
}

double surface_angle(const FreeSurface& surface, double middle) {
  constexpr double far = std::numeric_limits<double>::infinity();
  const auto left = line(surface, -far, middle), right = line(surface, middle, far);
  if (!left && !right) return none;
  return std::atan(0.5 * (std::abs((left ? left : right)->slope) + std::abs((right ? right : left)->slope)));
}

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
#include "analysis/heap_slopes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/statistics.hpp"

namespace talus {

namespace {

/// Mean over up to two neighbours on each side, as many on one as on the other, none of them beyond a gap.
std::vector<double> smoothed(const std::vector<double>& z) {
  std::vector<double> means(z.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t n = 0; n < z.size(); ++n) {
    if (!std::isfinite(z[n])) continue;
    double sum = z[n];
    std::size_t wide = 0;
    while (wide < 2 && n > wide && n + wide + 1 < z.size() && std::isfinite(z[n - wide - 1]) &&
           std::isfinite(z[n + wide + 1])) {
      ++wide;
      sum += z[n - wide] + z[n + wide];
    }
    means[n] = sum / static_cast<double>(2 * wide + 1);
  }
  return means;
}

HeapSlope fitted(const FreeSurface& surface, std::size_t first, std::size_t last) {
  HeapSlope slope{.from = surface.x[first], .to = surface.x[last]};
  const double margin = 0.1 * slope.length();
  std::vector<double> x, z;
  for (std::size_t n = first; n <= last; ++n)
    if (surface.x[n] >= slope.from + margin && surface.x[n] <= slope.to - margin) {
      x.push_back(surface.x[n]);
      z.push_back(surface.z[n]);
    }
  slope.slope = fit_line(x, z).slope;
  return slope;
}

}  // namespace

double HeapSlope::angle() const {
  return std::atan(std::abs(slope));
}

std::vector<HeapSlope> heap_slopes(const FreeSurface& surface, double least_length) {
  const std::vector<double> z = smoothed(surface.z);
  std::vector<HeapSlope> slopes;
  for (std::size_t first = 0; first + 1 < z.size();) {
    const double direction = z[first + 1] - z[first];
    std::size_t last = first;
    // A comparison with nan is false: gaps end a stretch.
    while (last + 1 < z.size() && (z[last + 1] - z[last]) * direction > 0) ++last;
    if (surface.x[last] - surface.x[first] > least_length) slopes.push_back(fitted(surface, first, last));
    first = std::max(last, first + 1);
  }
  return slopes;
}

ReposeAngle repose_angle(std::span<const HeapSlope> slopes, double middle) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  ReposeAngle found{none, none, none, none};
  double longest_left = 0, longest_right = 0;
  for (const HeapSlope& slope : slopes) {
    const bool is_left = 0.5 * (slope.from + slope.to) < middle;
    double& longest = is_left ? longest_left : longest_right;
    if (slope.length() > longest) {
      longest = slope.length();
      (is_left ? found.left : found.right) = slope.angle();
    }
    found.steepest = std::fmax(found.steepest, slope.angle());
  }
  found.mean = std::isnan(found.left)    ? found.right
               : std::isnan(found.right) ? found.left
                                         : 0.5 * (found.left + found.right);
  return found;
}

}  // namespace talus

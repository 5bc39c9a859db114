// SPDX-License-Identifier: Apache-2.0
#include "analysis/free_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "analysis/curve.hpp"
#include "analysis/statistics.hpp"
#include "numerics/sph/cubic_spline.hpp"

namespace talus {

namespace {

/// Cells along an axis that a disc may touch: [first, last).
struct Cells {
  std::size_t first, last;
};
Cells cells_within(double centre, double reach, double origin, double cell, std::size_t count) {
  const auto bounded = [&](double n) {
    return static_cast<std::size_t>(std::clamp(n, 0.0, static_cast<double>(count)));
  };
  return {bounded(std::floor((centre - reach - origin) / cell)), bounded(std::ceil((centre + reach - origin) / cell))};
}

Section empty_section(const Box& box, double width, double height) {
  Section s;
  s.x0 = box.low.x;
  s.z0 = box.low.z;
  s.columns = static_cast<std::size_t>(std::max(1.0, std::round(box.extent(0) / width)));
  s.rows = static_cast<std::size_t>(std::max(1.0, std::round(box.extent(2) / height)));
  s.width = box.extent(0) / static_cast<double>(s.columns);
  s.height = box.extent(2) / static_cast<double>(s.rows);
  s.value.assign(s.columns * s.rows, 0.0);
  return s;
}

}  // namespace

Section packing_section(const Particles& particles, const Domain& domain, double width, double height) {
  const Box& box = domain.box();
  Section section = empty_section(box, width, height);
  double reach = 0;
  for (const double h : particles.smoothing_length) reach = std::max(reach, sph::support * h);
  // Images along y are in the line's integral already.
  std::vector<Image> images = domain.images(reach);
  std::erase_if(images, [](const Image& image) { return image.copy[1] != 0; });
  images.insert(images.begin(), Image{});

  const double middle = 0.5 * (box.low.y + box.high.y), depth = box.extent(1);
  for (std::size_t i = 0; i < particles.position.size(); ++i) {
    const double h = particles.smoothing_length[i], support = sph::support * h;
    const Vector3 source{particles.position[i].x, middle, particles.position[i].z};
    for (const Image& image : images) {
      if (!domain.is_near(image, image.position(source), support)) continue;
      const Vector3 particle = image.position(source);
      const Cells along_x = cells_within(particle.x, support, section.x0, section.width, section.columns);
      const Cells along_z = cells_within(particle.z, support, section.z0, section.height, section.rows);
      for (std::size_t row = along_z.first; row < along_z.last; ++row)
        for (std::size_t column = along_x.first; column < along_x.last; ++column) {
          const Vector3 cell{section.x(column), middle, section.z(row)};
          const double dx = cell.x - particle.x, dz = cell.z - particle.z;
          const double distance = std::sqrt(dx * dx + dz * dz);
          if (distance < support && domain.is_visible(cell, particle, image))
            section.value[row * section.columns + column] +=
                particles.solid_volume_of(i) / depth * sph::cubic_spline_line(distance, h);
        }
    }
  }
  return section;
}

namespace {

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
    return no_value;
  }
  if (!is_grains(first)) return no_value;
  for (std::size_t row = first; row + 1 < last; ++row)
    if (!is_grains(row + 1)) return crossing(packing, column, row, level);
  return no_value;
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
  return no_value;
}

FreeSurface free_surface(const Section& packing, const Vessel& vessel, double level) {
  std::size_t first = 0, last = packing.rows;
  while (first < packing.rows && packing.z(first) < vessel.bottom) ++first;
  while (last > first && packing.z(last - 1) > vessel.top) --last;
  FreeSurface surface;
  for (std::size_t column = 0; column < packing.columns; ++column) {
    surface.x.push_back(packing.x(column));
    surface.z.push_back(last - first < 2 ? no_value
                                         : height_of_column(packing, column, first, last, vessel.search, level));
  }
  return surface;
}

namespace {

/// The tangent of a line's angle with what is level. \param level dZ/dx of that
double against(double level, double slope) {
  return (slope - level) / (1 + slope * level);
}

}  // namespace

double surface_angle(const FreeSurface& surface, double middle, double tilt) {
  constexpr double far = std::numeric_limits<double>::infinity();
  const auto left = line(surface, -far, middle), right = line(surface, middle, far);
  if (!left && !right) return no_value;
  const auto steepness = [level = std::tan(tilt)](const auto& half) { return std::abs(against(level, half->slope)); };
  return std::atan(0.5 * (steepness(left ? left : right) + steepness(right ? right : left)));
}

namespace {

/// Mean over up to two neighbours on each side, as many on one as on the other, none of them beyond a gap.
std::vector<double> smoothed(const std::vector<double>& z) {
  std::vector<double> means(z.size(), no_value);
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

std::vector<HeapSlope> heap_slopes(const FreeSurface& surface, double min_length, double tilt) {
  const double level = std::tan(tilt);
  std::vector<double> z = smoothed(surface.z);
  for (std::size_t n = 0; n < z.size(); ++n) z[n] -= level * surface.x[n];
  std::vector<HeapSlope> slopes;
  for (std::size_t first = 0; first + 1 < z.size();) {
    const double direction = z[first + 1] - z[first];
    std::size_t last = first;
    // A comparison with nan is false: gaps end a stretch.
    while (last + 1 < z.size() && (z[last + 1] - z[last]) * direction > 0) ++last;
    if (surface.x[last] - surface.x[first] > min_length) {
      slopes.push_back(fitted(surface, first, last));
      slopes.back().slope = against(level, slopes.back().slope);
    }
    first = std::max(last, first + 1);
  }
  return slopes;
}

ReposeAngle repose_angle(std::span<const HeapSlope> slopes, double middle) {
  ReposeAngle found{no_value, no_value, no_value, no_value};
  double max_left = 0, max_right = 0;
  for (const HeapSlope& slope : slopes) {
    const bool is_left = 0.5 * (slope.from + slope.to) < middle;
    double& longest = is_left ? max_left : max_right;
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

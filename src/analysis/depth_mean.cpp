// SPDX-License-Identifier: Apache-2.0
#include "analysis/depth_mean.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/sph/cubic_spline_line.hpp"

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
                particles.solid_volume / depth * sph::cubic_spline_line(distance, h);
        }
    }
  }
  return section;
}

}  // namespace talus

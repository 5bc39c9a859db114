// SPDX-License-Identifier: Apache-2.0
#include "analysis/particle_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace talus {

namespace {

double largest_support(const Particles& particles) {
  double h = 0;
  for (const double length : particles.smoothing_length) {
    if (!(length > 0) || !std::isfinite(length)) throw std::invalid_argument("a smoothing length is not above 0");
    h = std::max(h, length);
  }
  return sph::support * (h > 0 ? h : 1);
}

/// \param any whether there are particles: without, the reach means nothing
std::vector<Image> identity_and_images(const Domain& domain, double reach, bool any) {
  std::vector<Image> images;
  if (any) images = domain.images(reach);
  images.insert(images.begin(), Image{});
  return images;
}

}  // namespace

Particles particles_of_density(std::span<const Vector3> position, std::span<const double> density, double mass,
                               double grain_density, std::optional<double> smoothing_length) {
  Particles particles{.position = position, .smoothing_length = {}, .volume = {}, .solid_volume = mass / grain_density};
  for (const double rho : density) {
    particles.volume.push_back(mass / rho);
    particles.smoothing_length.push_back(smoothing_length.value_or(sph::smoothing_length(mass, rho)));
  }
  return particles;
}

Particles particles_of_spheres(std::span<const Vector3> position, double radius) {
  const double cube = 8 * radius * radius * radius;
  return {.position = position,
          .smoothing_length = std::vector<double>(position.size(), 2 * radius),
          .volume = std::vector<double>(position.size(), cube),
          .solid_volume = std::numbers::pi / 6 * cube};
}

ParticleField::ParticleField(Particles particles, Domain domain, Places places)
    : particles_(std::move(particles)),
      domain_(std::move(domain)),
      reach_(largest_support(particles_)),
      images_(identity_and_images(domain_, reach_, !particles_.position.empty())),
      grid_(particles_.position, reach_) {
  low_ = high_ = particles_.position.empty() ? Vector3{} : particles_.position[0];
  for (const Vector3& x : particles_.position)
    for (int axis = 0; axis < 3; ++axis) {
      low_[axis] = std::min(low_[axis], x[axis]);
      high_[axis] = std::max(high_[axis], x[axis]);
    }
  if (places == Places::many) list_images();
}

void ParticleField::list_images() {
  if (particles_.position.empty()) return;
  std::vector<double> sorted = particles_.smoothing_length;
  const auto median = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), median, sorted.end());
  constexpr double wider = 1.25;
  const double most = wider * *median;
  lists_ = {list_of(0, most), list_of(most, std::numeric_limits<double>::infinity())};
}

/// Of the particles whose smoothing lengths are above one and at most another.
ParticleField::List ParticleField::list_of(double above, double most) const {
  const std::span<const std::uint32_t> order = grid_.order();
  std::vector<std::uint32_t> chosen;  // places in that order
  List list;
  for (std::uint32_t k = 0; k < order.size(); ++k)
    if (const double h = particles_.smoothing_length[order[k]]; h > above && h <= most) {
      chosen.push_back(k);
      list.smoothing_length = std::max(list.smoothing_length, h);
    }
  if (chosen.empty()) return list;
  const double reach = sph::support * list.smoothing_length;
  // Particles whose cells follow each other are mostly near each other: images of a sphere of them that is far from all
  // that its images are seen in need no test.
  constexpr std::size_t together = 16;
  constexpr double rounding = 1 + 1e-6;
  const auto group = [&](std::size_t s) {
    return std::span(chosen).subspan(together * s, std::min(together, chosen.size() - together * s));
  };
  std::vector<std::pair<Vector3, double>> spheres((chosen.size() + together - 1) / together);
  for (std::size_t s = 0; s < spheres.size(); ++s) {
    Vector3 low = particles_.position[order[group(s)[0]]], high = low;
    for (const std::uint32_t k : group(s))
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], particles_.position[order[k]][axis]);
        high[axis] = std::max(high[axis], particles_.position[order[k]][axis]);
      }
    spheres[s] = {0.5 * (low + high), 0.5 * norm(high - low)};
  }
  std::vector<Listed> found;
  std::vector<Vector3> places;
  for (std::uint32_t n = 0; n < images_.size(); ++n) {
    const Image& image = images_[n];
    const auto is_near = [&](const Vector3& place, double more) {
      return image.is_identity() || domain_.is_near(image, place, rounding * (reach + more));
    };
    for (std::size_t s = 0; s < spheres.size(); ++s) {
      if (!is_near(image.position(spheres[s].first), spheres[s].second)) continue;
      for (const std::uint32_t k : group(s)) {
        const Vector3 place = image.position(particles_.position[order[k]]);
        if (!is_near(place, 0)) continue;
        places.push_back(place);
        found.push_back(
            {place, particles_.smoothing_length[order[k]], std::uint64_t{n} * order.size() + k, order[k], n});
      }
    }
  }
  // Stored cell by cell, so that neighbours stand together.
  const CellGrid unsorted(places, reach);
  for (const std::uint32_t n : unsorted.order()) list.entries.push_back(found[n]);
  for (std::size_t n = 0; n < places.size(); ++n) places[n] = list.entries[n].place;
  list.grid.emplace(places, reach);
  return list;
}

/// In the order in which they are found without lists: image by image, and cell by cell in each. Those that are too far
/// away to count are left out: they would add zeros.
template <class Visit>
void ParticleField::for_each_listed(const Vector3& x, Visit&& visit) const {
  struct Near {
    std::uint64_t rank;
    const Listed* entry;
  };
  thread_local std::vector<Near> near;
  near.clear();
  constexpr double rounding = 1 + 1e-9;
  for (const List& list : lists_) {
    if (!list.grid) continue;
    list.grid->for_each_candidate(x, [&](std::uint32_t n) {
      const Listed& entry = list.entries[n];
      const Vector3 d = entry.place - x;
      const double reach = rounding * sph::support * entry.smoothing_length;
      if (dot(d, d) < reach * reach) near.push_back({entry.rank, &entry});
    });
  }
  std::sort(near.begin(), near.end(), [](const Near& a, const Near& b) { return a.rank < b.rank; });
  for (const auto& [rank, entry] : near) {
    const Image& image = images_[entry->image];
    if (domain_.is_visible(x, entry->place, image)) visit(entry->source, image, entry->place - x);
  }
}

template <class Visit>
void ParticleField::for_each_near(const Vector3& x, Visit&& visit) const {
  if (particles_.position.empty()) return;
  if (!lists_.empty()) return for_each_listed(x, visit);
  for (const Image& image : images_) {
    const Vector3 source = image.source(x);
    bool within = true;
    for (int axis = 0; axis < 3; ++axis)
      within = within && source[axis] > low_[axis] - reach_ && source[axis] < high_[axis] + reach_;
    if (!within) continue;
    grid_.for_each_candidate(source, [&](std::uint32_t j) {
      const Vector3 place = image.position(particles_.position[j]), d = place - x;
      if (dot(d, d) < reach_ * reach_ && domain_.is_visible(x, place, image)) visit(j, image, d);
    });
  }
}

double ParticleField::packing(const Vector3& x) const {
  double sum = 0;
  for_each_near(x, [&](std::uint32_t j, const Image&, const Vector3& d) {
    sum += sph::cubic_spline(norm(d), particles_.smoothing_length[j]);
  });
  return particles_.solid_volume * sum;
}

double ParticleField::value(const Vector3& x, std::span<const double> column) const {
  double sum = 0, weights = 0;
  for_each_near(x, [&](std::uint32_t j, const Image&, const Vector3& d) {
    const double weight = particles_.volume[j] * sph::cubic_spline(norm(d), particles_.smoothing_length[j]);
    sum += weight * column[j];
    weights += weight;
  });
  return weights > 0 ? sum / weights : std::numeric_limits<double>::quiet_NaN();
}

Vector3 ParticleField::value(const Vector3& x, std::span<const Vector3> column) const {
  Vector3 sum;
  double weights = 0;
  for_each_near(x, [&](std::uint32_t j, const Image& image, const Vector3& d) {
    const double weight = particles_.volume[j] * sph::cubic_spline(norm(d), particles_.smoothing_length[j]);
    sum += weight * image.vector(column[j]);
    weights += weight;
  });
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return weights > 0 ? (1 / weights) * sum : Vector3{none, none, none};
}

std::vector<std::size_t> particles_around(std::span<const Vector3> position, const Vector3& place, double reach) {
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < position.size(); ++i)
    if (std::abs(position[i].x - place.x) < reach && std::abs(position[i].z - place.z) < reach) near.push_back(i);
  return near;
}

}  // namespace talus

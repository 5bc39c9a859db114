// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/filling.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

namespace talus::continuum {

namespace {

constexpr double most_places = 2e7;  // of a lattice that is looked at

Parameters with_layers(const Parameters& p, std::int64_t layers) {
  Parameters q = p;
  q.bed.mass = std::nullopt;
  q.bed.height = static_cast<double>(layers) * p.bed.spacing;
  return q;
}

/// Layers from the bottom of the bed to the top of vessel or box; 0 where that cannot be said.
std::int64_t most_layers(const Parameters& p) {
  const bool sized = p.bed.spacing > 0 && p.box.width > 0 && p.box.depth > 0 && p.box.height > 0;
  if (!sized) return 0;
  const double top = p.vessel.empty() ? p.box.height : std::min(p.box.height, bounds_of_vessel(p).high.z);
  const double layers = std::floor((top - bed_bottom(p)) / p.bed.spacing + 1e-9);
  if (!(layers >= 1 && layers < most_places)) return 0;
  return places_of(lattice_of(with_layers(p, static_cast<std::int64_t>(layers)))) <= most_places
             ? static_cast<std::int64_t>(layers)
             : 0;
}

}  // namespace

double count_of_mass(const Parameters& p) {
  return std::round(*p.bed.mass / (copies_of(p) * lattice_of(with_layers(p, 1)).mass));
}

Parameters with_level(const Parameters& p) {
  if (!p.beds.empty()) {
    Parameters filled = p;
    filled.bed.height = with_level(with_bed_alone(p, 0)).bed.height;
    for (std::size_t n = 0; n < p.beds.size(); ++n)
      filled.beds[n].height = with_level(with_bed_alone(p, n + 1)).bed.height;
    return filled;
  }
  if (p.bed.given) {
    Parameters filled = p;
    filled.bed.height = p.bed.given->high.z - p.bed.given->low.z + p.bed.spacing;
    return filled;
  }
  if (!p.bed.mass) return p;
  const std::int64_t most = most_layers(p);
  if (most == 0) return p;
  const double wanted = count_of_mass(p);
  const auto holds = [&](std::int64_t layers) { return bed_count(with_layers(p, layers)) >= wanted; };
  std::int64_t low = 0, high = most;  // low does not hold it
  while (high - low > 1) {
    const std::int64_t middle = (low + high) / 2;
    (holds(middle) ? high : low) = middle;
  }
  Parameters filled = p;
  filled.bed.height = with_layers(p, high).bed.height;
  return filled;
}

std::vector<Problem> check_mass(const Parameters& p) {
  if (!p.bed.mass || !(p.bed.height > 0)) return {};
  Parameters whole = p;
  whole.bed.mass = std::nullopt;
  const double room = bed_count(whole), wanted = count_of_mass(p), least = copies_of(p) * lattice_of(whole).mass;
  if (wanted >= 1 && wanted <= room) return {};
  return {{.key = "bed.mass",
           .what = wanted < 1 ? fmt::format("{:.4g} kg is less than a particle", *p.bed.mass)
                              : fmt::format("{:.4g} kg is more than there is room for", *p.bed.mass),
           .allowed = fmt::format("{:.4g} to {:.4g} kg", least, room * least)}};
}

}  // namespace talus::continuum

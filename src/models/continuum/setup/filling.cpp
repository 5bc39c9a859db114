// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/layout.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

namespace talus::continuum {

namespace {

constexpr double max_positions_of_filling = 2e7;  // of a lattice that is looked at

Parameters with_layers(const Parameters& p, std::int64_t layers) {
  Parameters q = p;
  q.bed.mass = std::nullopt;
  q.bed.height = static_cast<double>(layers) * p.bed.spacing;
  return q;
}

/// Layers from the bottom of the bed to the top of vessel or box; 0 where that cannot be said.
std::int64_t max_layers(const Parameters& p) {
  const bool sized = p.bed.spacing > 0 && p.box.width > 0 && p.box.depth > 0 && p.box.height > 0;
  if (!sized) return 0;
  const double top = p.vessel.empty() ? p.box.height : std::min(p.box.height, bounds_of_vessel(p).high.z);
  const double layers = std::floor((top - bed_bottom(p)) / p.bed.spacing + 1e-9);
  if (!(layers >= 1 && layers < max_positions_of_filling)) return 0;
  return lattice_of(with_layers(p, static_cast<std::int64_t>(layers))).positions() <= max_positions_of_filling
             ? static_cast<std::int64_t>(layers)
             : 0;
}

}  // namespace

double count_of_mass(const Parameters& p) {
  const auto sector = sector_of(p);
  return std::round(*p.bed.mass / ((sector ? sector->copies() : 1) * lattice_of(with_layers(p, 1)).mass));
}

Layout with_level(const Layout& layout) {
  const Parameters& p = layout.given;
  Parameters filled = p;
  if (!p.beds.empty()) {
    filled.bed.height = with_level(layout.with_bed_alone(0)).given.bed.height;
    for (std::size_t n = 0; n < p.beds.size(); ++n)
      filled.beds[n].height = with_level(layout.with_bed_alone(n + 1)).given.bed.height;
    return layout.with(filled);
  }
  if (p.bed.given) {
    filled.bed.height = p.bed.given->high.z - p.bed.given->low.z + p.bed.spacing;
    return layout.with(filled);
  }
  if (!p.bed.mass) return layout;
  const std::int64_t most = max_layers(p);
  if (most == 0) return layout;
  const double wanted = count_of_mass(p);
  const auto holds = [&](std::int64_t layers) { return bed_count(layout.with(with_layers(p, layers))) >= wanted; };
  std::int64_t low = 0, high = most;  // low does not hold it
  while (high - low > 1) {
    const std::int64_t middle = (low + high) / 2;
    (holds(middle) ? high : low) = middle;
  }
  filled.bed.height = with_layers(p, high).bed.height;
  return layout.with(filled);
}

std::vector<Problem> check_mass(const Layout& layout) {
  const Parameters& p = layout.given;
  if (!p.bed.mass || !(p.bed.height > 0)) return {};
  Parameters whole = p;
  whole.bed.mass = std::nullopt;
  const Layout full = layout.with(whole);
  const double room = bed_count(full), wanted = count_of_mass(p), least = layout.copies * full.lattice.mass;
  if (wanted >= 1 && wanted <= room) return {};
  return {{.key = "bed.mass",
           .what = wanted < 1 ? fmt::format("{:.4g} kg is less than a particle", *p.bed.mass)
                              : fmt::format("{:.4g} kg is more than there is room for", *p.bed.mass),
           .allowed = fmt::format("{:.4g} to {:.4g} kg", least, room * least)}};
}

}  // namespace talus::continuum

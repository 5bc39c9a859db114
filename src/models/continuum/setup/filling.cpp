// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/unit.hpp"
#include "models/continuum/setup/bed_walls.hpp"
#include "models/continuum/setup/layout.hpp"

namespace talus::continuum {

namespace {

constexpr double max_positions_of_filling = 2e7;  // of a lattice that is looked at

Parameters with_layers(const Parameters& p, std::int64_t layers) {
  Parameters q = p;
  q.bed.mass = std::nullopt;
  q.bed.height = static_cast<double>(layers) * p.bed.spacing;
  return q;
}

double layers_up_to(const Parameters& p, double top) {
  return std::floor((top - bed_bottom(p)) / p.bed.spacing + 1e-9);
}

/// Whether faces of the box are on all sides of the bed, as high as the vessel is.
bool is_between_faces(const Layout& up_to_top) {
  const Parameters& p = up_to_top.given;
  const Extent x = bed_along_x(p), y = bed_along_y(p);
  const auto is_closed = [&](std::size_t side, double end, double face, FaceKind kind) {
    if (kind == FaceKind::open || end != face) return false;
    const auto wall = p.bed.walls ? p.bed.walls->ends[side] : std::nullopt;
    return !wall || (side % 2 == 0 ? *wall <= face : *wall >= face);
  };
  return is_closed(0, x.low, 0, p.box.left) && is_closed(1, x.high, p.box.width, p.box.right) &&
         is_closed(2, y.low, 0, p.box.front) && is_closed(3, y.high, p.box.depth, p.box.rear);
}

/// Layers from the bottom of the bed to the top of the vessel, or to that of the box where there is no vessel, where
/// its walls end below the bed, or where faces of the box go on beside the bed above them; 0 where that cannot be said.
std::int64_t max_layers(const Layout& layout) {
  const Parameters& p = layout.given;
  const bool sized = p.bed.spacing > 0 && p.box.width > 0 && p.box.depth > 0 && p.box.height > 0;
  if (!sized || has_unread_file(p)) return 0;
  const auto fits = [&](double layers) {
    return layers >= 1 && layers < max_positions_of_filling &&
           lattice_of(with_layers(p, static_cast<std::int64_t>(layers))).positions() <= max_positions_of_filling;
  };
  double layers = layers_up_to(p, p.box.height);
  if (!p.vessel.empty()) {
    const double of_vessel = layers_up_to(p, std::min(p.box.height, bounds_of_vessel(p).high.z));
    const bool is_beside = of_vessel >= 1 && fits(of_vessel);
    if (is_beside && !is_between_faces(layout.with(with_layers(p, static_cast<std::int64_t>(of_vessel)))))
      layers = of_vessel;
  }
  return fits(layers) ? static_cast<std::int64_t>(layers) : 0;
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
  const std::int64_t most = max_layers(layout);
  if (most == 0) return layout;
  const auto holds = [&](std::int64_t layers) {  // the lattice may be another where the bed reaches other walls
    const Layout tried = layout.with(with_layers(p, layers));
    Parameters with_mass = tried.given;
    with_mass.bed.mass = p.bed.mass;
    return bed_count(tried) >= count_of_mass(with_mass);
  };
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
  if (!p.bed.mass || has_unread_file(p)) return {};
  if (!(p.bed.height > 0)) {
    const double bottom = bed_bottom(p) / millimetre, top = p.box.height / millimetre;
    if (layers_up_to(p, p.box.height) < 1)
      return {{.key = "bed.mass",
               .what = fmt::format("no layer has room between the bed's bottom, {:.4g} mm, and the top, {:.4g} mm",
                                   bottom, top),
               .allowed = "a lower bed.bottom, or a higher box"}};
    return {{.key = "bed.spacing",
             .what = fmt::format("{:.4g} mm: more than {:.0e} places would have to be looked at for bed.mass",
                                 p.bed.spacing / millimetre, max_positions_of_filling),
             .allowed = "a larger one, or bed.height in place of bed.mass"}};
  }
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

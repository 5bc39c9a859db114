// SPDX-License-Identifier: Apache-2.0
/// The surface of the vessel, made once for all who ask.
#include <mutex>
#include <utility>
#include <vector>

#include "models/continuum/setup/parameters.hpp"
#include "models/continuum/setup/vessel.hpp"

namespace talus::continuum {

Surface surface_of(const Parameters& p) {
  return p.vessel.empty() ? Surface() : p.surface->of(p);
}

Surface VesselSurface::of(const Parameters& p) {
  std::vector<Part> parts;
  for (std::size_t n = 0; n < p.vessel.size(); ++n) {
    const VesselPart& v = p.vessel[n];
    if (v.shape == VesselShape::stl)
      parts.push_back({v.drawn, v.unit, turn_of(v), v.scale, v.move, {}});
    else
      parts.push_back({nullptr, {}, {}, 1, {}, triangles_of(p, n)});
  }
  const std::scoped_lock lock(mutex_);
  if (parts == parts_) return surface_;
  std::vector<Triangle> all;
  for (std::size_t n = 0; n < p.vessel.size(); ++n) {
    const std::vector<Triangle> own = parts[n].drawn ? triangles_of(p, n) : parts[n].triangles;
    all.insert(all.end(), own.begin(), own.end());
  }
  surface_ = Surface(std::move(all), p.vessel.size());
  parts_ = std::move(parts);
  return surface_;
}

}  // namespace talus::continuum

// SPDX-License-Identifier: Apache-2.0
/// The bed in a vessel.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "models/continuum/layout.hpp"
#include "models/continuum/parameters.hpp"
#include "models/continuum/vessel.hpp"

namespace talus::continuum {

namespace {

constexpr double on_the_wall = 0.02, least_distance = 0.4;  // from walls, in spacings

/// The places of the lattice and which of them hold particles, x fastest.
struct Places {
  const Parameters& parameters;
  Lattice lattice = lattice_of(parameters);
  Surface surface = surface_of(parameters);
  Domain domain = domain_of(parameters);
  std::vector<char> taken =
      std::vector<char>(static_cast<std::size_t>(lattice.count[0] * lattice.count[1] * lattice.count[2]));

  using Index = std::array<std::int64_t, 3>;
  std::size_t number(const Index& n) const {
    return static_cast<std::size_t>((n[2] * lattice.count[1] + n[1]) * lattice.count[0] + n[0]);
  }
  Vector3 at(const Index& n) const {
    Vector3 x = lattice.corner;
    for (int axis = 0; axis < 3; ++axis)
      x[axis] += (static_cast<double>(n[static_cast<std::size_t>(axis)]) + 0.5) * lattice.spacing[axis];
    return x;
  }
  /// In the highest layer, in the middle of what the vessel takes of the lattice.
  Index top() const {
    const VesselBounds around = bounds_of_vessel(parameters);
    Index n{0, 0, lattice.count[2] - 1};
    for (int axis = 0; axis < 2; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const double low = lattice.corner[axis], extent = static_cast<double>(lattice.count[a]) * lattice.spacing[axis];
      const double from = std::max(low, around.low[axis]), to = std::min(low + extent, around.high[axis]);
      const double middle = from < to ? 0.5 * (from + to) : low + 0.5 * extent;
      n[a] = std::clamp<std::int64_t>(static_cast<std::int64_t>((middle - low) / lattice.spacing[axis]), 0,
                                      lattice.count[a] - 1);
    }
    return n;
  }
  bool is_clear(const Vector3& x) const {
    return !surface.nearest(x, on_the_wall * parameters.bed.spacing) &&
           !domain.is_near_wall(x, 0.25 * parameters.bed.spacing);
  }
  /// Farther from the wall, if it is too near.
  Vector3 moved_off(const Vector3& x) const {
    const double room = least_distance * parameters.bed.spacing;
    const auto foot = surface.nearest(x, room);
    return foot ? foot->place + (room / foot->distance) * (x - foot->place) : x;
  }
  bool is_hidden(const Vector3& a, const Vector3& b) const { return surface.blocks(a, b) || domain.blocks(a, b); }
};

}  // namespace

std::vector<Vector3> bed_in_vessel(const Parameters& p) {
  Places places{p};
  const auto& count = places.lattice.count;
  const Places::Index top = places.top();
  std::vector<Places::Index> border;
  if (places.is_clear(places.at(top))) border.push_back(top), places.taken[places.number(top)] = 1;
  while (!border.empty()) {
    const Places::Index n = border.back();
    border.pop_back();
    const Vector3 x = places.at(n);
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int step : {-1, 1}) {
        Places::Index next = n;
        next[axis] += step;
        if (next[axis] < 0 || next[axis] >= count[axis] || places.taken[places.number(next)]) continue;
        const Vector3 y = places.at(next);
        if (!places.is_clear(y) || places.is_hidden(x, y)) continue;
        places.taken[places.number(next)] = 1;
        border.push_back(next);
      }
  }
  std::vector<Vector3> positions;
  for (Places::Index n{0, 0, 0}; n[2] < count[2]; ++n[2])
    for (n[1] = 0; n[1] < count[1]; ++n[1])
      for (n[0] = 0; n[0] < count[0]; ++n[0])
        if (places.taken[places.number(n)]) positions.push_back(places.moved_off(places.at(n)));
  return positions;
}

}  // namespace talus::continuum

// SPDX-License-Identifier: Apache-2.0
/// The bed in a vessel: the places of a lattice, and which of them it fills.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "models/continuum/setup/layout.hpp"
#include "models/continuum/setup/parameters.hpp"
#include "models/continuum/setup/vessel.hpp"

namespace talus::continuum {

/// What grains leave a vessel through by their weight.
struct LevelOpening {
  std::string name;
  Vector3 middle, low, high;  ///< of it, and the corners of the box around it, m
  bool is_gate;
};
/// The gates of the vessel that are more level than upright; without any its outlet, if it has one (outlet_of_vessel).
std::vector<LevelOpening> level_openings(const Parameters& parameters);

/// The places of all layers and which of them hold particles, layer by layer.
struct VesselPlaces {
  /// The places of a layer, as they are seen from above, and which stand beside each.
  struct Layer {
    std::vector<Vector3> places;
    std::vector<double> azimuth;  ///< of the places of rings, as a share of the sector's angle
    std::vector<std::vector<std::uint32_t>> beside;
    std::uint32_t middle = 0;  ///< of what the vessel takes of the layer
  };
  struct Index {
    std::uint32_t place;
    std::size_t layer;
  };

  const Parameters& parameters;
  Lattice lattice;
  Surface surface;
  Domain domain;
  Layer layer;
  std::size_t layers;
  std::vector<char> taken;

  /// \param parameters must outlive it
  explicit VesselPlaces(const Parameters& parameters);

  std::size_t number(const Index& n) const { return n.layer * layer.places.size() + n.place; }
  Vector3 at(const Index& n) const;
  bool is_clear(const Vector3& x) const;
  /// Farther from the wall, if it is too near.
  Vector3 moved_off(const Vector3& x) const;
  bool is_hidden(const Vector3& a, const Vector3& b) const;
  /// The nearest place that is seen from x, in its layer or the lowest one above it; else in the one below.
  std::optional<Index> visible_from(const Vector3& x) const;
  /// Where the bed begins to be filled: see bed.inside.
  std::vector<Index> seeds() const;
  /// Takes what is connected with the seeds.
  void fill();
  template <class Visit>
  void for_each_beside(const Index& n, Visit&& visit) const {
    for (const std::uint32_t place : layer.beside[n.place]) visit(Index{place, n.layer});
    if (n.layer > 0) visit(Index{n.place, n.layer - 1});
    if (n.layer + 1 < layers) visit(Index{n.place, n.layer + 1});
  }
};

}  // namespace talus::continuum

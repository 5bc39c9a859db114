// SPDX-License-Identifier: Apache-2.0
/// The bed in a vessel: the places of a lattice, and which of them it fills.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "models/continuum/setup/layout.hpp"

namespace talus::continuum {

/// What grains leave a vessel through by their weight.
struct LevelOpening {
  std::string name;
  Vector3 middle, low, high;  ///< of it, and the corners of the box around it, m
  bool is_gate;
};
/// The gates of the vessel that are more level than upright; without any its lowest outlet, if it has one.
std::vector<LevelOpening> level_openings(const Layout& layout);

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

  const Layout& layout;
  const Lattice& lattice;
  const Surface& surface;
  const Domain& domain;
  Layer layer;
  std::size_t layers;
  std::vector<char> taken;

  /// \param layout must outlive it
  explicit VesselPlaces(const Layout& layout);
  VesselPlaces(Layout&&) = delete;

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

/// The places of a lattice that the bed of the case fills: those that are connected with bed.inside, else with what
/// lies above the level gates or the outlet, else with the middle of its top as far as the vessel takes it in, by steps
/// from place to place that no wall crosses; those nearer to a wall than the contact distance
/// (physics/sph/wall_contact.hpp) are moved off it to that distance. In a sector the places of a layer stand on rings
/// about the axis, all of one area and evenly spread along each, so that they are as far from its faces as from each
/// other.
std::vector<Vector3> bed_in_vessel(const Layout& layout);

}  // namespace talus::continuum

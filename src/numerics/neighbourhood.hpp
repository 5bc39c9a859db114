// SPDX-License-Identifier: Apache-2.0
/// The surroundings of particles in a domain: their ghosts, which are images of particles behind mirrors and periodic
/// faces, and for each particle the list of those particles and ghosts that it may interact with. Ghosts have no state:
/// each is a source and an image, and takes its position and its values from them at every evaluation.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "base/vector.hpp"
#include "numerics/geometry/domain.hpp"
#include "numerics/neighbour_list.hpp"
#include "numerics/surface/surface.hpp"

namespace talus {

struct Ghost {
  std::uint32_t source;
  std::uint32_t image;  ///< number in Neighbourhood::images()
};

/// Points of which others hold the rest: those of one process among several.
struct PartOfPoints {
  std::span<const char> is_copy;  ///< of each point: a neighbour of others only, without a list; empty: none is
  double reach = 0, margin = 0;   ///< the largest of all parts, m; 0: that of these points
};

class Neighbourhood {
 public:
  /// \param domain, vessel outlive it; \param vessel particles hidden behind it when the lists are built are not listed
  explicit Neighbourhood(const Domain& domain, const Surface& vessel = Surface::none())
      : domain_(domain), vessel_(vessel) {}
  explicit Neighbourhood(Domain&&) = delete;

  const Domain& domain() const { return domain_; }
  const Surface& vessel() const { return vessel_; }

  /// Finds ghosts and neighbours: all pairs with |x_i - x_j| <= a_i + m_i + a_j + m_j.
  /// \param position inside the domain, m; \param radius a, m; \param margin m >= 0 by which a particle may move and
  /// grow while the lists hold, m; one entry per particle
  /// \throws std::invalid_argument if the largest reach, 2 (a + m), passes the domain's, or a position is not finite
  void build(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> radius,
             std::span<const double> margin, const PartOfPoints& part = {});
  /// The same with half of a skin for all, m.
  void build(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> radius, double skin) {
    build(team, position, radius, std::vector<double>(position.size(), 0.5 * skin));
  }

  /// True if no particle has moved and grown by more than its margin since the list was built, so that no pair closer
  /// than a_i + a_j is missing. False for a position that is not finite. Copies do not count.
  bool holds(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> radius) const;

  double reach() const { return reach_; }  ///< of the lists: no pair in them was farther apart, m
  std::size_t particles() const { return first_ghost_.size(); }
  bool is_copy(std::size_t i) const { return !is_copy_.empty() && is_copy_[i]; }
  std::span<const Ghost> ghosts() const { return ghosts_; }
  std::span<const Image> images() const { return images_; }
  const Image& image(const Ghost& ghost) const { return images_[ghost.image]; }

  /// The neighbours of particle i, itself not among them, sorted: first particles, then ghosts, numbered from
  /// particles() on. All of them are visible, unless sight_may_change(i): then ask the domain about the undecided ones.
  std::span<const std::uint32_t> of(std::size_t i) const { return list_.of(i); }
  std::size_t pairs() const { return list_.pairs(); }                          ///< listed, those with ghosts among them
  std::size_t first_ghost_of(std::size_t i) const { return first_ghost_[i]; }  ///< index into of(i)
  bool sight_may_change(std::size_t i) const { return sight_may_change_[i]; }
  /// Of each of of(i), whether its visibility is undecided; empty unless sight_may_change(i).
  std::span<const char> in_doubt(std::size_t i) const {
    return std::span(in_doubt_).subspan(first_doubt_[i], first_doubt_[i + 1] - first_doubt_[i]);
  }

  /// How far a particle was from the vessel at least when the lists were built, m; infinite beyond the reach of its
  /// neighbours. It follows from the particle alone, whoever its neighbours in memory are.
  double distance_from_vessel(std::size_t i) const { return distance_.empty() ? infinity : distance_[i]; }
  /// Whether a line between two positions of the particle can meet the vessel, as far as that distance tells.
  bool may_meet_vessel(std::size_t i, const Vector3& a, const Vector3& b) const {
    const double free = distance_from_vessel(i);
    if (free == infinity) return false;
    const Vector3 from = a - reference_[i], to = b - reference_[i];
    return !(dot(from, from) < free * free && dot(to, to) < free * free);
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  void find_distances(ThreadTeam& team, std::span<const Vector3> points);
  std::size_t keep_unhidden(std::span<const Vector3> points, std::size_t i, std::span<std::uint32_t> near) const;
  void find_ghosts(ThreadTeam& team, std::span<const Vector3> position);

  const Domain& domain_;
  const Surface& vessel_;
  bool built_ = false;
  std::vector<char> is_copy_;
  double max_margin_ = 0;
  double reach_ = 0;
  std::vector<Vector3> reference_;  // of particles and ghosts
  std::vector<double> max_radius_;  // that one may have moved, and its radius be, together, m
  std::vector<Image> images_;
  std::vector<Ghost> ghosts_;
  NeighbourList list_;
  std::vector<std::uint32_t> first_ghost_;
  std::vector<char> sight_may_change_;
  std::vector<std::size_t> first_doubt_;  // of a particle; one more than particles
  std::vector<char> in_doubt_;
  struct Slabs {
    bool all = false;  // that are near the group: else too many
    std::vector<Slab> of;
  };
  std::vector<Slabs> slabs_;      // of the vessel near particles, by group
  std::vector<double> distance_;  // from the vessel, of particles and ghosts; empty without one
};

}  // namespace talus

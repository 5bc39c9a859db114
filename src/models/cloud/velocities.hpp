// SPDX-License-Identifier: Apache-2.0
/// The velocities of all grains at given positions, Eq. 4a: the Stokes velocity of each grain under weight and contact
/// forces, plus the flow induced by all others. This is the right-hand side that the integrators evaluate.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "base/vector.hpp"
#include "models/cloud/mobility_sum.hpp"
#include "models/cloud/parameters.hpp"
#include "numerics/neighbour_list.hpp"
#include "ranks/ranks.hpp"

namespace talus::cloud {

class Velocities {
 public:
  /// \param radius m, one per grain; copied
  /// \param ranks processes that share the sum over pairs, each with all grains: this and the evaluation are calls
  /// together; outlive it
  Velocities(const Parameters& parameters, std::span<const double> radius, const Ranks& ranks = one_process());

  /// Chooses how the sum over pairs is computed from here on. \returns the cut-off of the spectral sum, m; 0: direct
  double choose_sum(std::span<const Vector3> position) const { return sum_.choose(position); }

  /// Sets what the sum depends on bitwise: the order in which it stores the grains, and what choose_sum returned.
  void arrange_sum(std::span<const std::int64_t> order, double cutoff);

  /// Evaluates Eq. 4a. \param position m; \param velocity m/s, overwritten
  void operator()(ThreadTeam& team, std::span<const Vector3> position, std::span<Vector3> velocity);

  /// Of the last evaluation.
  std::span<const Vector3> contact_force() const { return contact_force_; }
  std::span<const double> overlap() const { return overlap_; }
  double max_overlap() const { return max_overlap_; }

  const MobilitySum& sum() const { return sum_; }

 private:
  void find_contacts(ThreadTeam& team, std::span<const Vector3> position);

  Parameters parameters_;
  bool touches_slope_;
  std::vector<double> radius_;
  std::vector<Vector3> weight_;  // less buoyancy, its part in the plane of motion
  NeighbourList neighbours_;
  MobilitySum sum_;
  std::vector<Vector3> force_, contact_force_;
  std::vector<double> overlap_;
  double max_overlap_ = 0;
};

/// The part of a vector along the motion.
Vector3 in_plane(const Vector3& v, Motion motion);

}  // namespace talus::cloud

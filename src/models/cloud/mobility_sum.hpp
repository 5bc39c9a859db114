// SPDX-License-Identifier: Apache-2.0
/// The sum over all pairs of grains, direct or spectral: the choice of a case (fluid.sum), and of its grains.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "base/vector.hpp"
#include "models/cloud/pair_sum.hpp"
#include "models/cloud/parameters.hpp"
#include "models/cloud/spectral_sum.hpp"
#include "ranks/ranks.hpp"

namespace talus::cloud {

/// The accuracy of the spectral sum that a case may use for so many grains; none if its sum is direct. \see fluid.sum
const SpectralAccuracy* spectral_accuracy_of(const Parameters& parameters, double grains);

class MobilitySum {
 public:
  /// Together. \param radius m, one per grain; copied \param ranks outlive it
  MobilitySum(const Parameters& parameters, std::span<const double> radius, const Ranks& ranks = one_process());

  /// The cheapest way for grains at these positions. \returns the cut-off of the spectral sum, m; 0: direct
  double choose(std::span<const Vector3> position) const;

  /// Takes a way that `choose` returned, for this run or an interrupted one. \param order as PairSum::reorder
  void arrange(std::vector<std::uint32_t> order, double cutoff);

  /// As PairSum::velocities, together. Where grains have moved so far apart that a grid has no room, the sum is direct.
  void velocities(ThreadTeam& team, std::span<const Vector3> position, std::span<const Vector3> force,
                  std::span<Vector3> velocity);

  /// Of the spectral sum, if it may be used.
  const SpectralAccuracy* accuracy() const { return accuracy_; }

  /// Processor time of messages until now, s.
  double seconds_of_messages() const { return seconds_ + (direct_ ? direct_->seconds_of_messages() : 0); }

 private:
  PairSum& direct();
  bool sum_spectral(ThreadTeam& team, std::span<const Vector3> position, std::span<const Vector3> force,
                    std::span<Vector3> velocity);

  const Ranks& ranks_;
  PairSum::Options options_;
  const SpectralAccuracy* accuracy_;
  bool always_spectral_;
  std::vector<double> radius_;
  std::vector<std::uint32_t> order_;
  double cutoff_ = 0;
  std::optional<PairSum> direct_;  // made when it is needed first: it takes 1 kB a grain
  std::optional<SpectralSum> spectral_;
  double seconds_ = 0;
};

}  // namespace talus::cloud

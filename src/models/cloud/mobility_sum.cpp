// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/mobility_sum.hpp"

#include <utility>

#include "base/system.hpp"

namespace talus::cloud {

namespace {

// The spectral sum is cheaper from about 1000 grains on in a plane and 2500 in space; smaller clouds, the papers' 2000
// and the 10,000 of cases/avalanche-3d.toml among them, keep the sum that errs by rounding alone
// (docs/design/cloud-sums.md).
constexpr double min_in_plane = 5000, min_in_space = 20000;

}  // namespace

const SpectralAccuracy* spectral_accuracy_of(const Parameters& p, double grains) {
  if (p.fluid.mobility == hydrodynamics::Mobility::none || p.fluid.sum == Sum::direct) return nullptr;
  const double least = p.motion == Motion::xyz ? min_in_space : min_in_plane;
  if (p.fluid.sum == Sum::automatic && grains < least) return nullptr;
  return spectral_accuracy(p.fluid.sum_error);
}

MobilitySum::MobilitySum(const Parameters& p, std::span<const double> radius, const Ranks& ranks)
    : ranks_(ranks),
      options_({.mobility = p.fluid.mobility,
                .motion = p.motion,
                .precision = p.fluid.precision,
                .instruction_set = p.integration.instruction_set,
                .viscosity = p.fluid.viscosity}),
      accuracy_(spectral_accuracy_of(p, static_cast<double>(radius.size()))),
      always_spectral_(p.fluid.sum == Sum::spectral),
      radius_(radius.begin(), radius.end()) {
  if (accuracy_)
    spectral_.emplace(options_, *accuracy_, radius_);
  else
    direct();
}

PairSum& MobilitySum::direct() {
  if (!direct_) direct_.emplace(options_, radius_, order_, ranks_);
  return *direct_;
}

double MobilitySum::choose(std::span<const Vector3> position) const {
  if (!spectral_) return 0;
  const auto plan = spectral_->plan(position);
  if (!plan) return 0;
  return always_spectral_ || plan->cost < plan->direct_cost ? plan->cutoff : 0;
}

void MobilitySum::arrange(std::vector<std::uint32_t> order, double cutoff) {
  order_ = std::move(order);
  cutoff_ = cutoff;
  if (direct_) direct_->reorder(order_);
  if (!spectral_) return;
  spectral_->reorder(order_);
  if (cutoff_ > 0) spectral_->set_cutoff(cutoff_);
}

/// The first process has the whole sum, and tells it. \returns as SpectralSum::velocities
bool MobilitySum::sum_spectral(ThreadTeam& team, std::span<const Vector3> position, std::span<const Vector3> force,
                               std::span<Vector3> velocity) {
  const bool here = ranks_.is_first() && spectral_->velocities(team, position, force, velocity);
  const Stopwatch watch(seconds_);
  const bool done = ranks_.value_from_first(here);
  if (done) ranks_.from_first(std::as_writable_bytes(velocity));
  return done;
}

void MobilitySum::velocities(ThreadTeam& team, std::span<const Vector3> position, std::span<const Vector3> force,
                             std::span<Vector3> velocity) {
  if (spectral_ && cutoff_ > 0 && sum_spectral(team, position, force, velocity)) return;
  direct().velocities(team, position, force, velocity);
}

}  // namespace talus::cloud

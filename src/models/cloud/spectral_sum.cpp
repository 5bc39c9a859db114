// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/spectral_sum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "models/cloud/spectral_sum/engine.hpp"

namespace talus::cloud {

namespace {

// The finite size's share of the smooth part, s/r_c^2, stays below a hundredth: larger ones need a finer grid.
constexpr double least_cutoff_over_radius = 8;

// Cut-offs that are tried: a third of an octave apart, from the least on.
constexpr double cutoff_ratio = 1.26;
constexpr int most_trials = 60;

/// Seconds, on one thread of an AMD Zen 4 or 5 (benchmarks/README.md): their ratios choose.
struct Costs {
  double sphere, pair, node;
};

Costs costs_of(const SpectralAccuracy& accuracy) {
  const double numbers = accuracy.single ? 1 : 2, points = accuracy.points / 4.0;
  return {.sphere = numbers * (30e-9 + 60e-9 * points * points),
          .pair = (accuracy.single ? 0.42e-9 : 1.1e-9) * (7 + accuracy.degree) / 14,
          .node = numbers * 45e-9};
}

double cost_of_pair(Precision precision) {
  return precision == Precision::single_precision ? 0.15e-9 : 0.3e-9;
}

/// Pairs of spheres in the same cells of a lattice, both ways.
double pairs_in(const Lattice& lattice, std::span<const Vector3> position, std::vector<std::uint32_t>& spheres) {
  spheres.assign(lattice.columns * lattice.rows, 0);
  for (const Vector3& x : position)
    ++spheres[static_cast<std::size_t>(lattice.cells_along(1, x)) * lattice.columns +
              static_cast<std::size_t>(lattice.cells_along(0, x))];
  double pairs = 0;
  for (const std::uint32_t n : spheres) pairs += static_cast<double>(n) * n;
  return pairs;
}

void require(bool condition, const char* what) {
  if (!condition) throw std::invalid_argument(what);
}

double nodes_of(const Lattice& lattice, const SpectralAccuracy& accuracy) {
  return static_cast<double>(nodes_along(lattice.columns, accuracy)) *
         static_cast<double>(nodes_along(lattice.rows, accuracy));
}

}  // namespace

SpectralSum::SpectralSum(const Options& options, const SpectralAccuracy& accuracy, std::span<const double> radius) {
  require(options.motion != Motion::xyz, "the spectral sum is for spheres in a plane");
  require(options.mobility != hydrodynamics::Mobility::none, "without a mobility there is nothing to sum");
  engine_ = make_engine(options, accuracy, radius);
  engine_->cutoff = least_cutoff();
}

SpectralSum::~SpectralSum() = default;
SpectralSum::SpectralSum(SpectralSum&&) noexcept = default;
SpectralSum& SpectralSum::operator=(SpectralSum&&) noexcept = default;

void SpectralSum::reorder(std::span<const std::uint32_t> order) {
  std::vector<bool> seen(engine_->order.size(), false);
  bool permutation = order.size() == seen.size();
  for (std::size_t n = 0; permutation && n < order.size(); ++n) {
    permutation = order[n] < seen.size() && !seen[order[n]];
    if (permutation) seen[order[n]] = true;
  }
  require(permutation, "the order is no permutation of the spheres");
  engine_->order.assign(order.begin(), order.end());
}

double SpectralSum::cutoff() const {
  return engine_->cutoff;
}

double SpectralSum::least_cutoff() const {
  const std::vector<double>& radius = engine_->radius;
  return radius.empty() ? 1 : least_cutoff_over_radius * *std::max_element(radius.begin(), radius.end());
}

void SpectralSum::set_cutoff(double cutoff) {
  require(cutoff > 0 && cutoff >= least_cutoff(), "the cut-off is shorter than the spheres allow");
  engine_->cutoff = cutoff;
}

bool SpectralSum::velocities(ThreadTeam& team, std::span<const Vector3> position, std::span<const Vector3> force,
                             std::span<Vector3> velocity) {
  Engine& engine = *engine_;
  require(
      position.size() == engine.radius.size() && force.size() == position.size() && velocity.size() == position.size(),
      "positions, forces and velocities have not one entry a sphere");
  if (position.empty()) return true;
  const Extent extent = extent_of(team, position, engine.axis);
  if (!extent.finite) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    std::fill(velocity.begin(), velocity.end(), Vector3{nan, nan, nan});
    return true;
  }
  const Lattice lattice = lattice_over(extent, engine.axis, 0.5 * engine.cutoff);
  if (!(nodes_of(lattice, engine.accuracy) <= most_nodes)) return false;
  engine.velocities(team, lattice, position, force, velocity);
  return true;
}

std::optional<SpectralPlan> SpectralSum::plan(std::span<const Vector3> position) const {
  const Engine& engine = *engine_;
  if (position.empty()) return std::nullopt;
  ThreadTeam alone(1);
  const Extent extent = extent_of(alone, position, engine.axis);
  if (!extent.finite) return std::nullopt;
  const Costs costs = costs_of(engine.accuracy);
  const auto count = static_cast<double>(position.size());
  SpectralPlan best{.cutoff = 0,
                    .cost = std::numeric_limits<double>::infinity(),
                    .direct_cost = cost_of_pair(engine.options.precision) * count * count};
  std::vector<std::uint32_t> spheres;
  double cutoff = least_cutoff();
  for (int k = 0; k < most_trials; ++k, cutoff *= cutoff_ratio) {
    const double nodes = nodes_of(lattice_over(extent, engine.axis, 0.5 * cutoff), engine.accuracy);
    if (!(nodes <= most_nodes)) continue;
    // The cells around a sphere are as large as a square of 2.5 cut-offs.
    const double grid = costs.node * nodes;
    const double cost = grid + costs.sphere * count +
                        costs.pair * pairs_in(lattice_over(extent, engine.axis, 2.5 * cutoff), position, spheres);
    if (cost < best.cost) best.cutoff = cutoff, best.cost = cost;
    if (cost > 2 * best.cost || grid < 0.01 * cost) break;
  }
  return best;
}

}  // namespace talus::cloud

// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/spectral_sum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/error.hpp"
#include "models/cloud/spectral_sum/engine.hpp"

namespace talus::cloud {

namespace {

// The finite size's share of the smooth part, s/r_c^2, stays below a hundredth: larger ones need a finer grid.
constexpr double min_cutoff_over_radius = 8;

// Cut-offs that are tried: a third of an octave apart, from the least on.
constexpr double cutoff_ratio = 1.26;
constexpr int max_cutoffs = 60;

/// Seconds, on one thread of an AMD Zen 4 or 5 (benchmarks/README.md): their ratios choose.
struct Costs {
  double sphere, pair, node;
};

Costs costs_of(const SpectralSum::Engine& engine) {
  const SpectralAccuracy& accuracy = engine.accuracy;
  const double numbers = accuracy.single ? 1 : 2, points = accuracy.points / 4.0;
  const double pair = (accuracy.single ? 0.42e-9 : 1.1e-9) * (7 + accuracy.degree) / 14;
  if (engine.directions == 2)
    return {.sphere = numbers * (30e-9 + 60e-9 * points * points), .pair = pair, .node = numbers * 45e-9};
  return {
      .sphere = numbers * (70e-9 + 160e-9 * points * points * points), .pair = 1.3 * pair, .node = numbers * 180e-9};
}

double cost_of_pair(Precision precision) {
  return precision == Precision::single_precision ? 0.15e-9 : 0.3e-9;
}

/// Pairs of spheres in cells that a loop over near pairs takes together, both ways: at most near_reach apart along each
/// axis.
double near_pairs(const Lattice& lattice, std::span<const Vector3> position) {
  std::vector<std::uint32_t> spheres(lattice.columns() * lattice.all_rows(), 0);
  for (const Vector3& x : position) {
    std::size_t cell = 0;
    for (std::size_t k = 3; k-- > 0;)
      cell =
          cell * lattice.count[k] + (lattice.count[k] == 1 ? 0 : static_cast<std::size_t>(lattice.cells_along(k, x)));
    ++spheres[cell];
  }
  // Sums over the cells around, one axis after the other.
  std::vector<std::uint32_t> around = spheres, line;
  for (std::size_t k = 0, stride = 1; k < 3; stride *= lattice.count[k++]) {
    const std::size_t length = lattice.count[k];
    line.assign(length + 2 * near_reach + 1, 0);
    for (std::size_t begin = 0; begin < around.size();
         begin += begin % stride == stride - 1 ? stride * (length - 1) + 1 : 1) {
      for (std::size_t n = 0; n < length; ++n) line[n + near_reach] = around[begin + n * stride];
      std::uint32_t sum = 0;
      for (std::size_t n = 0; n < 2 * near_reach; ++n) sum += line[n];
      for (std::size_t n = 0; n < length; ++n) {
        sum += line[n + 2 * near_reach];
        around[begin + n * stride] = sum;
        sum -= line[n];
      }
    }
  }
  double pairs = 0;
  for (std::size_t n = 0; n < spheres.size(); ++n) pairs += static_cast<double>(spheres[n]) * around[n];
  return pairs;
}

double nodes_of(const Lattice& lattice, const SpectralSum::Engine& engine) {
  double nodes = 1;
  for (std::size_t k = 0; k < engine.directions; ++k)
    nodes *= static_cast<double>(nodes_along(lattice.count[k], engine.accuracy));
  return nodes;
}

Lattice lattice_over(const Extent& extent, const SpectralSum::Engine& engine, double cell) {
  return lattice_over(extent, engine.axis, engine.directions, cell);
}

}  // namespace

SpectralSum::SpectralSum(const Options& options, const SpectralAccuracy& accuracy, std::span<const double> radius) {
  require(options.mobility != hydrodynamics::Mobility::none, "without a mobility there is nothing to sum");
  engine_ = make_engine(options, accuracy, radius);
  engine_->cutoff = min_cutoff();
}

SpectralSum::~SpectralSum() = default;
SpectralSum::SpectralSum(SpectralSum&&) noexcept = default;
SpectralSum& SpectralSum::operator=(SpectralSum&&) noexcept = default;

void SpectralSum::reorder(std::span<const std::uint32_t> order) {
  std::vector<bool> used(engine_->order.size(), false);
  bool permutation = order.size() == used.size();
  for (std::size_t n = 0; permutation && n < order.size(); ++n) {
    permutation = order[n] < used.size() && !used[order[n]];
    if (permutation) used[order[n]] = true;
  }
  require(permutation, "the order is no permutation of the spheres");
  engine_->order.assign(order.begin(), order.end());
}

double SpectralSum::cutoff() const {
  return engine_->cutoff;
}

double SpectralSum::min_cutoff() const {
  const std::vector<double>& radius = engine_->radius;
  return radius.empty() ? 1 : min_cutoff_over_radius * *std::max_element(radius.begin(), radius.end());
}

void SpectralSum::set_cutoff(double cutoff) {
  require(cutoff > 0 && cutoff >= min_cutoff(), "the cut-off is shorter than the spheres allow");
  engine_->cutoff = cutoff;
}

bool SpectralSum::velocities(ThreadTeam& team, std::span<const Vector3> position, std::span<const Vector3> force,
                             std::span<Vector3> velocity) {
  Engine& engine = *engine_;
  require(
      position.size() == engine.radius.size() && force.size() == position.size() && velocity.size() == position.size(),
      "positions, forces and velocities have not one entry a sphere");
  if (position.empty()) return true;
  const Extent extent = extent_of(team, position, engine.axis, engine.directions);
  if (!extent.finite) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    std::fill(velocity.begin(), velocity.end(), Vector3{nan, nan, nan});
    return true;
  }
  const Lattice lattice = lattice_over(extent, engine, 0.5 * engine.cutoff);
  if (!(nodes_of(lattice, engine) <= max_nodes)) return false;
  engine.velocities(team, lattice, position, force, velocity);
  return true;
}

std::optional<SpectralPlan> SpectralSum::plan(std::span<const Vector3> position) const {
  const Engine& engine = *engine_;
  if (position.empty()) return std::nullopt;
  ThreadTeam alone(1);
  const Extent extent = extent_of(alone, position, engine.axis, engine.directions);
  if (!extent.finite) return std::nullopt;
  const Costs costs = costs_of(engine);
  const auto count = static_cast<double>(position.size());
  SpectralPlan best{.cutoff = 0,
                    .cost = std::numeric_limits<double>::infinity(),
                    .direct_cost = cost_of_pair(engine.options.precision) * count * count};
  double cutoff = min_cutoff();
  for (int k = 0; k < max_cutoffs; ++k, cutoff *= cutoff_ratio) {
    const Lattice lattice = lattice_over(extent, engine, 0.5 * cutoff);
    const double nodes = nodes_of(lattice, engine);
    if (!(nodes <= max_nodes)) continue;
    const double grid = costs.node * nodes;
    const double cost = grid + costs.sphere * count + costs.pair * near_pairs(lattice, position);
    if (cost < best.cost) best.cutoff = cutoff, best.cost = cost;
    if (cost > 2 * best.cost || grid < 0.01 * cost) break;
  }
  return best;
}

}  // namespace talus::cloud

// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/splitting.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "base/random.hpp"
#include "models/continuum/evaluation.hpp"
#include "models/continuum/level_cases.hpp"

namespace talus::continuum {
namespace {

/// Columns as they may be in a flow.
void stir(State& s) {
  Random random(7);
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    s.velocity[i] = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    s.density[i] *= random.uniform(0.95, 1.05);
    for (auto& column : s.material.stress) column[i] = random.uniform(-1000, 1000);
  }
}

double volume_mean(const State& s, const std::vector<double>& column) {
  double sum = 0;
  for (std::size_t i = 0; i < column.size(); ++i) sum += s.mass_of(i) / s.density[i] * column[i];
  return sum / Content(s).volume;
}

void expect_unique_identities(const State& s) {
  EXPECT_EQ(std::set<std::int64_t>(s.identity.begin(), s.identity.end()).size(), s.identity.size());
  for (const std::int64_t n : s.identity) EXPECT_LT(n, static_cast<std::int64_t>(s.population.next_identity));
}

TEST(Splitting, ABedIsLaidWithAllItsMassAndEveryLevel) {
  const Parameters p = bed_of_levels(2);
  const State s = initial_state(setup_of(p));
  EXPECT_EQ(Content(s).mass_ratio, 24.0 * 8 * 16);
  std::array<int, 3> count{};
  for (const double ratio : s.mass_ratio) ++count[static_cast<std::size_t>(level_of(ratio))];
  for (const int n : count) EXPECT_GT(n, 10);
  const Levels levels{Layout(p)};
  for (std::size_t i = 0; i < s.position.size(); ++i)
    if (norm(s.position[i]) < 8 * spacing) {
      EXPECT_EQ(s.mass_ratio[i], 1);
    }
  EXPECT_EQ(s.merged_energy, 0);
  expect_unique_identities(s);
}

/// The same bed with its fine corner elsewhere: what was coarse there splits, what was fine here merges.
TEST(Splitting, KeepsMassMomentumVolumeAndMeansAndBooksTheEnergyThatMergingTakes) {
  const Parameters p = bed_of_levels(2);
  const auto setup = setup_of(p);
  State s = initial_state(setup);
  stir(s);
  Parameters other = p;
  other.levels.low = {20 * spacing, 0, 10 * spacing};
  other.levels.high = {24 * spacing, 8 * spacing, 16 * spacing};
  const Content before(s);
  const double stress = volume_mean(s, s.material.stress[0]);
  const auto fine_before = std::count(s.mass_ratio.begin(), s.mass_ratio.end(), 1.0);
  Share alone(one_process());
  split_and_merge(Levels{Layout(other)}, *setup.boundary, other, alone, s);
  const Content after(s);
  EXPECT_EQ(after.mass_ratio, before.mass_ratio);
  EXPECT_NEAR(after.volume, before.volume, 1e-12 * before.volume);
  EXPECT_LT(norm(after.momentum - before.momentum), 1e-12 * std::sqrt(before.energy * s.mass * before.mass_ratio));
  EXPECT_GT(s.merged_energy, 0);
  EXPECT_NEAR(after.energy + s.merged_energy, before.energy, 1e-12 * before.energy);
  EXPECT_NEAR(volume_mean(s, s.material.stress[0]), stress, 1e-9);
  EXPECT_LT(std::count(s.mass_ratio.begin(), s.mass_ratio.end(), 1.0), fine_before);
  std::size_t fine = 0;
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    const Vector3& x = s.position[i];
    if (!(x.x > 19 * spacing && x.z > 9 * spacing)) continue;
    ++fine;
    EXPECT_EQ(level_of(s.mass_ratio[i]), 0);
  }
  EXPECT_GT(fine, 5u * 8 * 7 * 8 / 10);
  expect_unique_identities(s);
  for (const auto& column : s.material.history) EXPECT_EQ(column.size(), s.position.size());
}

TEST(Splitting, PartsOfALatticeAreTheLatticeOfTheNextLevel) {
  // A block all of whose particles have eight times the mass, away from its surfaces.
  Parameters p = bed_of_levels(1);
  p.levels.low = p.levels.high = std::array{-1.0, -1.0, -1.0};
  const auto setup = setup_of(p);
  State s = initial_state(setup);
  for (const double ratio : s.mass_ratio) ASSERT_EQ(ratio, 8);
  p.levels.low = {0, 0, 0}, p.levels.high = {1, 1, 1};
  Share alone(one_process());
  split_and_merge(Levels{Layout(p)}, *setup.boundary, p, alone, s);
  ASSERT_EQ(s.position.size(), 24u * 8 * 16);
  const auto off_lattice = [](double x) { return std::abs(x / spacing - 0.5 - std::round(x / spacing - 0.5)); };
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    EXPECT_EQ(s.mass_ratio[i], 1);
    if (s.position[i].z > 14 * spacing) continue;
    for (int axis = 0; axis < 3; ++axis) EXPECT_LT(off_lattice(s.position[i][axis]), 1e-9);
  }
}

/// Crowded in a corner of three walls, of which only the nearest is a mirror.
TEST(Splitting, PartsThatAreRelaxedPassNoWall) {
  Parameters p = bed_of_levels(1);
  p.box.left = p.box.right = p.box.front = p.box.rear = p.box.floor = p.box.top = FaceKind::open;
  p.vessel = {plate("left", {2, 0, 0}, {0, 8, 0}, {0, 0, 16}), plate("front", {0, 2, 0}, {24, 0, 0}, {0, 0, 16}),
              plate("floor", {0, 0, 2}, {24, 0, 0}, {0, 8, 0})};
  p.levels.low = p.levels.high = std::array{-1.0, -1.0, -1.0};
  p.bed.left = p.bed.front = p.bed.bottom = 2 * spacing, p.bed.height = 12 * spacing;
  const auto setup = setup_of(p);
  State s = initial_state(setup);
  const auto crowded = [](double x) { return 2 * spacing + 0.7 * (x - 2 * spacing); };
  for (Vector3& x : s.position) x = {crowded(x.x), crowded(x.y), crowded(x.z)};
  p.levels.low = {0, 0, 0}, p.levels.high = {1, 1, 1};
  Share alone(one_process());
  split_and_merge(Levels{Layout(p)}, *setup.boundary, p, alone, s);
  for (const Vector3& x : s.position) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_GT(x[axis], 2 * spacing);
  }
  EXPECT_GT(s.position.size(), 1000u);
}

TEST(Splitting, NothingMergesAcrossAPlate) {
  Parameters p = bed_of_levels(1);
  p.levels.low = p.levels.high = std::array{-1.0, -1.0, -1.0};
  p.bed.height = 15 * spacing;
  // Through the middle of the cells in which particles merge.
  p.plate = {.height = 7 * spacing, .slit_left = 0, .slit_right = 8 * spacing};
  p.bed.bottom = 0;
  const State s = initial_state(setup_of(p));
  for (std::size_t i = 0; i < s.position.size(); ++i)
    if (s.position[i].x > 9 * spacing && s.mass_ratio[i] > 1) {
      EXPECT_GT(std::abs(s.position[i].z - 7 * spacing), 0.4 * spacing);
    }
}

TEST(Splitting, ForcesBetweenParticlesOfAllSizesConserveMomentum) {
  for (const PairPrecision precision : {PairPrecision::in_double, PairPrecision::in_single}) {
    Parameters p = bed_of_levels(2);
    p.box.left = p.box.right = p.box.front = p.box.rear = p.box.floor = p.box.top = FaceKind::open;
    p.integration.pair_precision = precision;
    Evaluation e(p);
    stir(e.state);
    e.evaluate();
    Vector3 total;
    double sizes = 0;
    for (std::size_t i = 0; i < e.state.position.size(); ++i) {
      total += e.state.mass_of(i) * e.rates.acceleration[i];
      sizes += e.state.mass_of(i) * norm(e.rates.acceleration[i]);
    }
    EXPECT_LT(norm(total), (precision == PairPrecision::in_double ? 1e-13 : 1e-6) * sizes);
  }
}

TEST(Splitting, GradientsOfLinearFieldsAreExactAcrossLevels) {
  Parameters p = bed_of_levels(2);
  p.box.left = p.box.right = p.box.front = p.box.rear = p.box.floor = p.box.top = FaceKind::open;
  Evaluation e(p);
  const Tensor3<> exact{1, -2, 0.5, 3, -1, 0.25, 0.75, 2, -0.5};
  e.velocity([&](const Vector3& x) { return exact * x; });
  e.evaluate();
  for (std::size_t i = 0; i < e.state.position.size(); ++i) {
    const Tensor3<> d = e.rates.velocity_gradient[i] - exact;
    for (const double c : {d.xx, d.xy, d.xz, d.yx, d.yy, d.yz, d.zx, d.zy, d.zz}) EXPECT_NEAR(c, 0, 1e-9);
  }
}

TEST(Splitting, UnequalMassesOfOneSizeGiveWhatEqualMassesGive) {
  Parameters p = bed_of_levels(1);
  p.levels.high = {1, 1, 1};  // all are fine
  Evaluation levels(p);
  p.levels = {};
  Evaluation uniform(p);
  stir(levels.state), stir(uniform.state);
  levels.evaluate(), uniform.evaluate();
  ASSERT_EQ(levels.state.position, uniform.state.position);
  for (std::size_t i = 0; i < levels.state.position.size(); ++i) {
    const Vector3 &a = levels.rates.acceleration[i], &b = uniform.rates.acceleration[i];
    EXPECT_LT(norm(a - b), 1e-11 * (norm(b) + 1));
    EXPECT_NEAR(levels.rates.kernel_density[i], uniform.rates.kernel_density[i], 1e-9);
    EXPECT_NEAR(levels.rates.density_rate[i], uniform.rates.density_rate[i], 1e-7);
  }
}

class SplittingRun : public testing::TestWithParam<Parameters> {};
INSTANTIATE_TEST_SUITE_P(, SplittingRun, testing::Values(moving_bed(1), moving_bed_in_air(2 * spacing)),
                         [](const auto& of) { return of.param.air.enabled ? "InAir" : "InAVacuum"; });

TEST_P(SplittingRun, KeepsItsBitsOnAnyNumberOfThreadsAndWhenItIsResumed) {
  const Parameters& p = GetParam();
  ThreadTeam one(1), two(2);
  Continuum a(p), b(p), resumed(p);
  a.begin(one), b.begin(two);
  for (int n = 0; n < 150; ++n) a.advance(one), b.advance(two);
  EXPECT_EQ(a.state().position, b.state().position);
  resumed.mutable_state() = a.state();
  resumed.resume(two);
  const std::uint64_t made = a.state().population.next_identity;
  for (int n = 0; n < 150; ++n) a.advance(one), resumed.advance(two);
  EXPECT_EQ(a.state().position, resumed.state().position);
  EXPECT_EQ(a.state().velocity, resumed.state().velocity);
  EXPECT_EQ(a.state().mass_ratio, resumed.state().mass_ratio);
  EXPECT_EQ(a.state().identity, resumed.state().identity);
  EXPECT_GT(a.state().population.next_identity, made) << "nothing has split meanwhile";
  EXPECT_GT(a.state().merged_energy, 0) << "nothing has merged";
  EXPECT_EQ(Content(a.state()).mass_ratio, 24.0 * 8 * 16);
  // All momentum that is not gravity's is the floor's or the air's.
  const State& s = a.state();
  EXPECT_EQ(norm(s.air.impulse) > 0.001 * norm(s.gravity_impulse), p.air.enabled);
  Vector3 given = s.gravity_impulse + s.damping_impulse + s.air.impulse;
  for (const Vector3& received : s.patch_impulse) given -= received;
  const Vector3 began = (s.mass * 24 * 8 * 16) * Vector3{1, 0, 0};
  EXPECT_LT(norm(Content(s).momentum - began - given), 1e-10 * norm(began));
}

/// Vertical stress over the weight above, of layers of four spacings from the bottom, once the bed rests.
std::array<double, 4> stress_over_weight(Parameters p, ThreadTeam& team) {
  p.gate = {.opens = GateOpens::at_time, .time = 1};
  p.settle.damping_time = 0.01;
  p.settle.loading_time = 0.1;
  p.bed.height = 24 * spacing, p.box.height = 28 * spacing;
  Continuum model(p);
  model.begin(team);
  while (model.state().time < 0.25) model.advance(team);
  const State& s = model.state();
  std::array<double, 4> stress{}, weight{};
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    const auto layer = static_cast<std::size_t>(s.position[i].z / (4 * spacing));
    if (layer >= stress.size()) continue;
    const double volume = s.mass_of(i) / s.density[i];
    stress[layer] += volume * s.material.stress[2][i];
    weight[layer] += volume * bulk_density(p) * p.gravity.acceleration * (24 * spacing - s.position[i].z);
  }
  for (std::size_t n = 0; n < stress.size(); ++n) stress[n] /= weight[n];
  return stress;
}

TEST(Splitting, ABedAtRestBearsTheSamePressureAcrossLevels) {
  ThreadTeam team(2);
  const Parameters p = bed_of_levels(1);
  Parameters fine = p;
  fine.levels = {};
  const auto levels = stress_over_weight(p, team), uniform = stress_over_weight(fine, team);
  for (std::size_t n = 0; n < levels.size(); ++n) EXPECT_NEAR(levels[n] / uniform[n], 1, 0.03) << "layer " << n;
}

}  // namespace
}  // namespace talus::continuum

// SPDX-License-Identifier: Apache-2.0
/// Run by mpirun on several processes, each of which runs the case by itself too: the bits are the same.
#include "models/continuum/share.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <utility>

#include "models/continuum/columns.hpp"
#include "models/continuum/gas/atmosphere.hpp"
#include "models/continuum/level_cases.hpp"
#include "models/continuum/vessel_parts.hpp"
#include "ranks/petsc/processes.hpp"

namespace talus::continuum {
namespace {

/// The same processes, among which the particles are dealt out without regard to where they are, at each cut in another
/// way.
class Shuffled final : public Ranks {
 public:
  explicit Shuffled(const Ranks& ranks) : Ranks(ranks.rank(), ranks.size()), ranks_(ranks) {}
  void join(Votes& votes) const override { ranks_.join(votes); }
  void add_up(std::span<double> sums) const override { ranks_.add_up(sums); }
  std::string gather_at_first(const std::string& own) const override { return ranks_.gather_at_first(own); }
  std::string gather(const std::string& own) const override { return ranks_.gather(own); }
  void from_first(std::span<std::byte> bytes) const override { ranks_.from_first(bytes); }
  std::unique_ptr<Plan> plan(std::span<const std::size_t> counts) const override { return ranks_.plan(counts); }
  std::unique_ptr<Partition> partition() const override { return std::make_unique<Dealt>(size()); }
  int on_this_machine() const override { return ranks_.on_this_machine(); }
  [[noreturn]] void abort(int status) const override {
    ranks_.abort(status);
    std::abort();
  }

 private:
  class Dealt final : public Partition {
   public:
    explicit Dealt(int size) : size_(size) {}
    void cut(std::span<const Vector3>, std::span<const double>) override { ++cuts_; }
    int rank_of(const Vector3& x) const override {
      const double mixed = std::abs(std::sin(1e6 * x.x + 3e6 * x.y + 7e6 * x.z + cuts_));
      return static_cast<int>(1e4 * mixed) % size_;
    }
    void ranks_of(const Vector3&, const Vector3&, std::vector<int>& ranks) const override {
      ranks.clear();
      for (int r = 0; r < size_; ++r) ranks.push_back(r);
    }

   private:
    int size_, cuts_ = 0;
  };
  const Ranks& ranks_;
};

struct Started {
  ThreadTeam team{1};
  Setup setup;
  State state;
  Workspace workspace;

  Started(const Parameters& p, const Ranks& ranks)
      : setup(p), state(initial_state(setup, ranks.rank(), ranks.size())), workspace(setup, state, ranks) {
    begin(team, setup, state, workspace);
  }
  void step() { advance(team, setup, state, workspace); }

  /// The neighbours of a particle, in order: identity and image, -1 for themselves.
  std::vector<std::pair<std::int64_t, std::int64_t>> neighbours(std::size_t i) const {
    const Neighbourhood& around = workspace.pairs.neighbourhood();
    std::vector<std::pair<std::int64_t, std::int64_t>> found;
    for (const std::uint32_t n : around.of(i)) {
      if (n < around.particles()) {
        found.emplace_back(state.identity[n], -1);
      } else {
        const Ghost& ghost = around.ghosts()[n - around.particles()];
        found.emplace_back(state.identity[ghost.source], ghost.image);
      }
    }
    return found;
  }
};

std::map<std::int64_t, std::size_t> numbers_of(const State& s) {
  std::map<std::int64_t, std::size_t> numbers;
  for (std::size_t i = 0; i < s.identity.size(); ++i) numbers[s.identity[i]] = i;
  return numbers;
}

/// Every kept field of the first process's whole state.
void expect_same_state(const Started& alone, Started& part) {
  Share& share = part.workspace.share;
  share.collect_window(part.state.wall_loads);
  if (part.workspace.air) part.workspace.air->gather(part.state.air);
  State whole = part.state;
  const std::size_t count = share.of_all(0);
  resize_columns(whole, count);
  std::uint64_t number = 0;
  const auto read = [&]<class Member>(const FieldInfo& field, Member& member) {
    if constexpr (!std::is_arithmetic_v<Member>) {
      if (!field.of_particles) return;
      // In two pieces.
      auto* const to = reinterpret_cast<std::byte*>(member.data());
      const std::size_t half = count / 2;
      share.read(part.state, {number, 0, half}, to);
      share.read(part.state, {number++, half, count - half}, to + half * sizeof(member[0]));
    }
  };
  for_each_field(read, whole);
  if (!processes().is_first()) return;
  std::vector<std::string> fields;
  const auto write = [&]<class Member>(const FieldInfo& field, const Member& member) {
    if constexpr (std::is_arithmetic_v<Member>)
      fields.push_back(std::string(field.name) + std::string(reinterpret_cast<const char*>(&member), sizeof member));
    else
      fields.push_back(std::string(field.name) +
                       std::string(reinterpret_cast<const char*>(member.data()), member.size() * sizeof(member[0])));
  };
  for_each_field(write, alone.state);
  const std::vector<std::string> expected = std::move(fields);
  fields.clear();
  for_each_field(write, whole);
  ASSERT_EQ(fields.size(), expected.size());
  for (std::size_t n = 0; n < fields.size(); ++n)
    EXPECT_TRUE(fields[n] == expected[n]) << expected[n].substr(0, 12) << ", step " << alone.state.step;
}

/// Of the particles that this process owns: no neighbour is missing, and none is in another place.
void expect_same_lists(const Started& alone, const Started& part) {
  const auto numbers = numbers_of(alone.state);
  for (std::size_t i = 0; i < part.state.identity.size(); ++i) {
    if (part.workspace.share.owns(i))
      ASSERT_EQ(part.neighbours(i), alone.neighbours(numbers.at(part.state.identity[i])));
    else
      ASSERT_TRUE(part.neighbours(i).empty());
  }
}

std::vector<std::int64_t> owned(const Started& run) {
  std::vector<std::int64_t> owned;
  for (std::size_t i = 0; i < run.state.identity.size(); ++i)
    if (run.workspace.share.owns(i)) owned.push_back(run.state.identity[i]);
  std::sort(owned.begin(), owned.end());
  return owned;
}

/// \param must_move whether particles must have changed their owners \returns the state at the end of one process
State expect_same_bits(const Parameters& p, int steps, const Ranks& ranks, bool must_move) {
  Started alone(p, one_process()), part(p, ranks);
  const std::vector<std::int64_t> at_start = owned(part);
  EXPECT_GE(static_cast<double>(at_start.size() * static_cast<std::size_t>(ranks.size())),
            0.2 * static_cast<double>(alone.state.position.size()));
  for (int n = 0; n < steps; ++n) {
    if (n % 20 == 0) expect_same_lists(alone, part);
    alone.step(), part.step();
  }
  expect_same_lists(alone, part);
  expect_same_state(alone, part);
  const std::uint64_t others = sum_of(ranks, owned(part) != at_start);
  EXPECT_TRUE(others > 0 || !must_move);
  EXPECT_EQ(part.workspace.share.of_all(0), alone.state.position.size());
  return alone.state;
}

Parameters falling_block() {
  Parameters p = column(12, 5, 8, 8);
  make_granular(p);
  p.integration.method = Method::leapfrog;
  p.integration.courant = 0.6;
  p.bed.left = 0.03, p.bed.right = 0.08, p.bed.bottom = 0.02;
  p.bed.disorder = 0.2;
  p.bed.velocity = {3.0, 1.0, -2.0};
  return p;
}

TEST(Share, BoxWithWalls) {
  expect_same_bits(falling_block(), 80, processes(), true);
}

TEST(Share, PeriodicFaces) {
  Parameters p = falling_block();
  p.box.left = p.box.right = p.box.front = p.box.rear = FaceKind::periodic;
  expect_same_bits(p, 80, processes(), true);
}

TEST(Share, MidpointRule) {
  Parameters p = falling_block();
  p.integration.method = Method::runge_kutta;
  expect_same_bits(p, 40, processes(), true);
}

TEST(Share, SinglePrecision) {
  Parameters p = falling_block();
  p.integration.pair_precision = PairPrecision::in_single;
  expect_same_bits(p, 60, processes(), true);
}

TEST(Share, OwnersThatLieAnywhere) {
  expect_same_bits(falling_block(), 30, Shuffled(processes()), true);
}

/// What the air gives and what it is left with is the same too.
TEST(Share, AirThatEveryProcessHas) {
  Parameters p = falling_block();
  p.air.enabled = true;
  p.air.cell = spacing;
  expect_same_bits(p, 60, processes(), false);
  p.integration.method = Method::runge_kutta;
  p.box.left = p.box.right = FaceKind::periodic;
  p.air.gas.boundaries.kind[0] = p.air.gas.boundaries.kind[1] = FlowBoundary::periodic;
  expect_same_bits(p, 30, Shuffled(processes()), true);
}

TEST(Share, AirWhoseCellsAreShared) {
  Parameters p = falling_block();
  p.air.enabled = true;
  p.air.cell = spacing / 3;
  ASSERT_TRUE(is_air_shared(air_grid(p)));
  expect_same_bits(p, 12, processes(), false);
  p.box.left = p.box.right = FaceKind::periodic;
  p.air.gas.boundaries.kind[0] = p.air.gas.boundaries.kind[1] = FlowBoundary::periodic;
  expect_same_bits(p, 8, Shuffled(processes()), false);
}

/// The gate opens on the way: the air meets other walls.
TEST(Share, SharedAirInAVessel) {
  Parameters p = shut_silo();
  p.gate.opens = GateOpens::at_time;
  p.gate.time = 4e-4;
  p.air.enabled = true;
  p.air.cell = spacing / 1.5;
  ASSERT_TRUE(is_air_shared(air_grid(p)));
  expect_same_bits(p, 15, processes(), false);
}

TEST(Share, VesselWithAGate) {
  Parameters p = shut_silo();
  p.gate.opens = GateOpens::at_time;
  p.gate.time = 1e-3;
  p.removal.outside = true;
  expect_same_bits(p, 60, processes(), false);
  expect_same_bits(p, 30, Shuffled(processes()), true);
}

void expect_split_and_merged(const Parameters& p, const State& s) {
  EXPECT_GT(s.population.next_identity, initial_state(Setup(p)).position.size()) << "nothing has split";
  EXPECT_GT(s.merged_energy, 0) << "nothing has merged";
}

/// Parts, and those that merge, have neighbours on other processes.
TEST(Share, ParticlesOfSeveralSizes) {
  const Parameters p = moving_bed(1);
  const State s = expect_same_bits(p, 90, processes(), true);
  expect_split_and_merged(p, s);
  EXPECT_EQ(Content(s).mass_ratio, 24.0 * 8 * 16);
}

TEST(Share, ParticlesOfSeveralSizesThatLieAnywhere) {
  const Parameters p = moving_bed(2);
  expect_split_and_merged(p, expect_same_bits(p, 40, Shuffled(processes()), true));
}

TEST(Share, ParticlesOfSeveralSizesInAir) {
  Parameters p = moving_bed_in_air(spacing / 2);
  p.bed.velocity = {3, 0, 0};
  ASSERT_TRUE(is_air_shared(air_grid(p)));
  expect_split_and_merged(p, expect_same_bits(p, 40, processes(), true));
}

TEST(Share, ParticlesOfSeveralSizesInASector) {
  const Parameters p = sector_of_levels();
  const State s = expect_same_bits(p, 90, processes(), true);
  expect_split_and_merged(p, s);
  EXPECT_GT(s.population.removed, 0u);
}

/// Some processes own nothing.
TEST(Share, HardlyAnyParticles) {
  Parameters p = column(2, 1, 1, 10);
  p.bed.bottom = 4 * spacing;
  Started alone(p, one_process()), part(p, processes());
  for (int n = 0; n < 30; ++n) alone.step(), part.step();
  expect_same_lists(alone, part);
  expect_same_state(alone, part);
}

/// The report of what goes wrong somewhere is thrown everywhere.
TEST(Share, AFailureIsThatOfAll) {
  Parameters p = falling_block();
  p.integration.step = 1;
  Started part(p, processes());
  std::string what;
  try {
    part.step();
  } catch (const NumericalError& error) {
    what = error.what();
  }
  EXPECT_FALSE(what.empty());
  std::string all;
  for (int r = 0; r < processes().size(); ++r) all += what;
  EXPECT_EQ(processes().gather(what), all);
}

}  // namespace
}  // namespace talus::continuum

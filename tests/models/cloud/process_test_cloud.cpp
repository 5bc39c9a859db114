// SPDX-License-Identifier: Apache-2.0
/// Run by mpirun on several processes, each of which computes the same by itself too: the bits are the same.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "models/cloud/cases.hpp"
#include "models/cloud/pair_sum_cases.hpp"
#include "ranks/petsc/processes.hpp"

namespace talus::cloud {
namespace {

bool same_bits(const std::vector<Vector3>& one, const std::vector<Vector3>& other) {
  return one.size() == other.size() && std::memcmp(one.data(), other.data(), one.size() * sizeof(Vector3)) == 0;
}

/// Fewer tasks than processes among them, and rows that end within a task.
TEST(PairSumOfProcesses, HasTheBitsOfOneProcess) {
  for (const std::size_t count : {1, 17, 130, 1000})
    for (const Mobility mobility : both_laws)
      for (const Motion motion : {Motion::xz, Motion::xyz})
        for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
          const Spheres spheres = random_spheres(count, count, motion);
          const PairSum::Options options{mobility, motion, precision, InstructionSet::automatic, viscosity};
          std::vector<std::uint32_t> order(count);
          for (std::size_t n = 0; n < count; ++n) order[n] = static_cast<std::uint32_t>(count - 1 - n);
          ThreadTeam team(2);
          PairSum sum(options, spheres.radius, {}, processes());
          for (const bool reversed : {false, true}) {
            if (reversed) sum.reorder(order);
            std::vector<Vector3> velocity(count, Vector3{7, 7, 7});
            sum.velocities(team, spheres.position, spheres.force, velocity);
            EXPECT_TRUE(
                same_bits(velocity, velocities(spheres, options, 1, reversed ? order : std::span(order).first(0))))
                << name(options) << count << (reversed ? " reversed" : "");
          }
        }
}

/// Each process computes some of the tasks, and no task is computed twice.
TEST(SharedTasks, AreDealtOutAndAddedUpOnce) {
  const std::vector<std::size_t> begin{0, 64, 128, 256, 320};
  const std::size_t rows = 400, dimensions = 2;
  SharedTasks shared(processes(), begin, rows, dimensions);
  // Task t has the value 10^t in the first component of each of its rows, and the row in the second.
  std::vector<std::vector<double>> values;
  std::vector<TaskSums> own;
  for (std::size_t t = 0; t < begin.size(); ++t) {
    if (!shared.has(t)) continue;
    std::vector<double>& sums = values.emplace_back(2 * (rows - begin[t]), std::pow(10.0, t));
    for (std::size_t n = begin[t]; n < rows; ++n) sums[rows - begin[t] + n - begin[t]] = static_cast<double>(n);
  }
  for (std::size_t t = 0, next = 0; t < begin.size(); ++t)
    if (shared.has(t)) own.push_back({values[next++].data(), begin[t], rows - begin[t], padding});
  EXPECT_EQ(sum_of(processes(), own.size()), begin.size());
  ThreadTeam team(1);
  const std::vector<TaskSums> all = shared.collect(team, own);
  ASSERT_EQ(all.size(), begin.size());
  for (std::size_t row = shared.first_row(); row < shared.end_row(); row += padding)
    for (std::size_t t = 0; t < begin.size() && all[t].begin <= row; ++t) {
      const double* const found = all[t].sums + (row - all[t].begin) / padding * all[t].of_rows;
      EXPECT_EQ(found[3], std::pow(10.0, t)) << "row " << row;
      EXPECT_EQ(found[all[t].of_component + 3], static_cast<double>(row + 3));
    }
  EXPECT_EQ(sum_of(processes(), shared.end_row() - shared.first_row()), rows);
}

/// A run with the direct or the spectral sum, and what it needs to know of the first process.
TEST(CloudOfProcesses, TakesTheStepsOfOneProcess) {
  for (const Sum sum : {Sum::direct, Sum::spectral}) {
    Parameters p = disc(300);
    p.fluid.sum = sum;
    ThreadTeam team(1);
    Cloud alone = started(p, team), shared(p, pack(p), processes());
    shared.begin(team);
    for (int n = 0; n < 40; ++n) alone.advance(team), shared.advance(team);
    EXPECT_EQ(shared.state().time, alone.state().time);
    EXPECT_EQ(shared.state().sum_cutoff, alone.state().sum_cutoff);
    EXPECT_TRUE(same_bits(shared.state().position, alone.state().position));
    EXPECT_TRUE(same_bits(shared.state().velocity, alone.state().velocity));
    shared.gather();
    EXPECT_THAT(shared.sharing(), testing::StartsWith(std::to_string(processes().size()) + " processes"));
  }
}

TEST(CloudOfProcesses, FailsOnAllOfThem) {
  Parameters p = disc(2);
  ThreadTeam team(1);
  Cloud cloud(p, {{{0, 0, 0}, {0, 0, 0}}, {p.particles.radius, p.particles.radius}}, processes());
  EXPECT_THROW(cloud.begin(team), NumericalError);
}

}  // namespace
}  // namespace talus::cloud

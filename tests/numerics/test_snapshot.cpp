// SPDX-License-Identifier: Apache-2.0
#include "numerics/snapshot.hpp"

#include <gtest/gtest.h>

#include <set>

#include "base/tensor.hpp"
#include "numerics/geometry/sector.hpp"

namespace talus {
namespace {

/// Two particles in a quarter about (1, 2); the second came in through a face and is in the third copy here.
PointSet quarter() {
  return {.time = 0.5,
          .step = 7,
          .columns = {{"position", "m", std::vector<Vector3>{{2, 2, 3}, {1.5, 2.5, 4}}},
                      {"velocity", "m/s", std::vector<Vector3>{{1, 0, 5}, {0, 1, 6}}},
                      {"identity", "1", std::vector<std::int64_t>{0, 1 + 2 * 2}},
                      {"density", "kg/m3", std::vector<double>{10, 11}},
                      {"stress_xx", "Pa", std::vector<double>{1, 2}},
                      {"stress_xy", "Pa", std::vector<double>{3, 4}},
                      {"stress_yy", "Pa", std::vector<double>{5, 6}},
                      {"stress_yz", "Pa", std::vector<double>{7, 8}},
                      {"stress_zx", "Pa", std::vector<double>{9, 10}},
                      {"stress_zz", "Pa", std::vector<double>{11, 12}}},
          .copies = SectorCopies{.axis = {1, 2, 0}, .count = 4, .identities = 2}};
}

TEST(Whole, HoldsEveryCopyTurned) {
  const PointSet part = quarter();
  const PointSet all = whole_of(part.view());
  const Snapshot whole = all.view();
  EXPECT_FALSE(whole.copies);
  EXPECT_EQ(whole.time, 0.5);
  EXPECT_EQ(whole.step, 7u);
  ASSERT_EQ(whole.size(), 8u);
  const auto x = whole.positions();
  EXPECT_LT(norm(x[2] - Vector3{1, 3, 3}), 1e-15);
  EXPECT_LT(norm(x[4] - Vector3{0, 2, 3}), 1e-15);
  EXPECT_LT(norm(whole.vectors("velocity")[2] - Vector3{0, 1, 5}), 1e-15);
  EXPECT_EQ(whole.scalars("density")[7], 11);
  // In the copy at a right angle x has become y, and y the reverse of x.
  EXPECT_NEAR(whole.scalars("stress_yy")[2], 1, 1e-15);
  EXPECT_NEAR(whole.scalars("stress_xx")[2], 5, 1e-15);
  EXPECT_NEAR(whole.scalars("stress_xy")[2], -3, 1e-15);
  EXPECT_NEAR(whole.scalars("stress_yz")[2], 9, 1e-15);
  EXPECT_NEAR(whole.scalars("stress_zx")[2], -7, 1e-15);
  EXPECT_NEAR(whole.scalars("stress_zz")[2], 11, 1e-15);
  const auto identity = whole.integers("identity");
  EXPECT_EQ(std::set(identity.begin(), identity.end()).size(), 8u);
  EXPECT_EQ(identity[2], 2);
  EXPECT_EQ(identity[1], 5);
  EXPECT_EQ(identity[5], 1) << "two copies on it is the one that left there";
}

TEST(Whole, HasTheColumnsThatAreAskedFor) {
  const PointSet part = quarter(), all = whole_of(part.view());
  const std::string asked[] = {"position", "stress_yy"};
  const PointSet some = whole_of(part.view(), asked);
  ASSERT_EQ(some.columns.size(), 2u);
  EXPECT_EQ(std::get<std::vector<Vector3>>(some.columns[0].values),
            std::get<std::vector<Vector3>>(all.columns[0].values));
  EXPECT_EQ(std::get<std::vector<double>>(some.columns[1].values),
            std::get<std::vector<double>>(all.columns[6].values));
}

TEST(Whole, OfTooFewCopiesIsNone) {
  PointSet part = quarter();
  part.copies->count = 2;
  EXPECT_THROW(whole_of(part.view()), std::invalid_argument);
}

}  // namespace
}  // namespace talus

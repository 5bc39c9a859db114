// SPDX-License-Identifier: Apache-2.0
/// Heaps of spheres as `talus analyze --as repose|surface|packing|layers` measures them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/points/measures.hpp"
#include "base/error.hpp"

namespace talus::app {
namespace {

constexpr double a = 0.5e-3;  // m

/// A roof of spheres 2 a apart on a simple cubic lattice, `angle` degrees steep on both sides, 200 of them wide.
std::vector<Vector3> roof(double angle, const Vector3& corner) {
  std::vector<Vector3> points;
  for (int i = 0; i < 200; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0;
           (k + 0.5) * 2 * a < 0.01 + std::tan(angle * std::numbers::pi / 180) * (0.1 - std::abs((i - 99.5) * 2 * a));
           ++k)
        points.push_back(corner + Vector3{2 * a * i, 2 * a * j, 2 * a * k});
  return points;
}

Measured measured(Measure measure, const std::vector<Vector3>& points) {
  Snapshot snapshot;
  snapshot.columns.push_back({"position", "m", std::span<const Vector3>(points)});
  return measure(PointsToMeasure("points", snapshot, a), "", 0);
}

double value(const Measured& m, std::string_view name) {
  for (const NamedValue& q : m.quantities)
    if (q.name == name) return q.value;
  ADD_FAILURE() << name;
  return 0;
}

TEST(HeapMeasures, AngleOfReposeOfARoofAnywhere) {
  for (const double angle : {15.0, 25.0, 33.0}) {
    const Measured m = measured(measure_repose, roof(angle, {-3, 7, 2}));
    EXPECT_NEAR(value(m, "repose_angle"), angle, 0.5);
    EXPECT_NEAR(value(m, "repose_angle_left"), value(m, "repose_angle_right"), 1e-6);
    EXPECT_EQ(m.rows.size(), 2u);
  }
}

TEST(HeapMeasures, SurfaceOfARoof) {
  const Measured m = measured(measure_surface, roof(25, {0, 0, a}));
  EXPECT_EQ(m.rows.size(), 200u);
  EXPECT_NEAR(value(m, "surface_angle"), 25, 0.5);
  EXPECT_NEAR(value(m, "surface_z_max"), 0.01 + 0.1 * std::tan(25 * std::numbers::pi / 180), 2 * a);
}

TEST(HeapMeasures, PackingOfALattice) {
  const Measured m = measured(measure_packing, roof(0, {0, 0, 0}));
  EXPECT_NEAR(value(m, "packing_median"), std::numbers::pi / 6, 0.015);
  EXPECT_NEAR(value(m, "packing_max"), std::numbers::pi / 6, 0.015);
  EXPECT_NEAR(m.rows[5][1], std::numbers::pi / 6, 0.015);
  EXPECT_LT(m.rows.back()[1], 1e-9) << "above the heap";
}

TEST(HeapMeasures, MeansOfAColumnInLayers) {
  // Three layers of 2, 1 and 3 points; none in between.
  const std::vector<Vector3> points = {{0, 0, 1}, {1, 0, 1.5}, {0, 0, 4.5}, {0, 0, 10}, {1, 0, 10.5}, {2, 0, 11}};
  const std::vector<double> stress = {70, 90, 40, 1, 2, 6};
  Snapshot snapshot;
  snapshot.columns.push_back({"position", "m", std::span<const Vector3>(points)});
  snapshot.columns.push_back({"stress_zz", "Pa", std::span<const double>(stress)});
  const PointsToMeasure set("points", snapshot, 0.5);
  const Measured m = measure_layers(set, "stress_zz", 5);
  const std::vector<std::vector<double>> expected = {{1.25, 80, 2}, {4.5, 40, 1}, {10.5, 3, 3}};
  EXPECT_EQ(m.rows, expected);
  EXPECT_EQ(m.columns[1].unit, "Pa");
  EXPECT_THROW(measure_layers(set, "stress_xy", 5), InputError);
  const Measured one = measure_layers(set, "position_z", 1);
  ASSERT_EQ(one.rows.size(), 1u);
  EXPECT_DOUBLE_EQ(one.rows[0][1], one.rows[0][0]);
}

}  // namespace
}  // namespace talus::app

// SPDX-License-Identifier: Apache-2.0
/// Snapshots of a hopper made by hand, whose numbers are known.
#include "analysis/hopper_estimators.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "analysis/paper_hopper.hpp"

namespace talus {
namespace {

using namespace paper_hopper;
using std::numbers::pi;

/// The end as it might be: two wedges of 30 degrees left in the hopper, a roof of 25 degrees in the bin.
std::vector<Vector3> heaps() {
  const double steep = std::tan(pi / 6), gentle = std::tan(25 * pi / 180);
  auto points = test::lattice(width, depth, 0, plate, h,
                              [&](double x, double z) { return z < 0.03 + gentle * (0.05 - std::abs(x - 0.05)); });
  const auto above = test::lattice(width, depth, plate, height, h,
                                   [&](double x, double z) { return z - plate < steep * (std::abs(x - 0.05) - 0.02); });
  points.insert(points.end(), above.begin(), above.end());
  return points;
}

TEST(HopperNumbers, FrameOfTwoHeaps) {
  test::GrainColumns now(heaps(), bulk_density, grain_density, gate + 1);
  test::GrainColumns before = now;
  before.time -= 0.02;
  for (Vector3& x : before.position) x.x += 2e-6;  // 0.1 mm/s
  for (std::size_t i = 0; i < now.position.size(); ++i) {
    now.stress_zz[i] = 600;
    now.stress_xx[i] = now.stress_yy[i] = 400;
  }
  now.density.assign(now.density.size(), 1.02 * bulk_density);
  const HopperSetting paper = setting();
  HopperSnapshot snapshot(paper, now.view(), gate);
  EXPECT_TRUE(std::isnan(hopper::quiescent_speed(snapshot))) << "there is no snapshot before";
  const Snapshot earlier = before.view();
  snapshot.before = [&] { return &earlier; };
  const auto is = [&](HopperRun::Numbers::Number number) { return number(snapshot); };
  EXPECT_NEAR(snapshot.time, 1, 1e-12);
  EXPECT_NEAR(is(hopper::repose_angle_in<hopper::Where::bin, &ReposeAngle::mean>), 25, 1);
  EXPECT_NEAR(is(hopper::repose_angle_in<hopper::Where::bin, &ReposeAngle::steepest>), 25, 1.5);
  EXPECT_NEAR(is(hopper::repose_angle_in<hopper::Where::hopper, &ReposeAngle::mean>), 30, 1);
  EXPECT_NEAR(is(hopper::surface_angle_in<hopper::Where::hopper>), 30, 1);
  EXPECT_NEAR(is(hopper::surface_angle_in<hopper::Where::bin>), 25, 1);
  EXPECT_NEAR(is(hopper::quiescent_speed), 1e-4, 1e-12);
  EXPECT_NEAR(is(hopper::stress_ratio), 2.0 / 3, 1e-12);
  EXPECT_EQ(is(hopper::inertial_share), 1);
  EXPECT_NEAR(is(hopper::density_drift), 0.02, 1e-12);
  EXPECT_NEAR(is(hopper::packing_max), 0.6, 1e-12);
  EXPECT_NEAR(is(hopper::left_right_imbalance), 0, 1e-12);
  EXPECT_EQ(is(hopper::gradient<&GradientSizes::shear_max>), 0);
  EXPECT_DOUBLE_EQ(is(hopper::mass), particle_mass * double(now.position.size()));
}

TEST(HopperNumbers, ASnapshotWithoutParticlesHasNoNumbers) {
  const test::GrainColumns none({}, bulk_density, grain_density, gate + 1);
  const HopperSetting paper = setting();
  const HopperSnapshot snapshot(paper, none.view(), gate);
  for (const auto& m : columns_of_snapshots(hopper_measures()))
    EXPECT_TRUE(m.name == "left_right_imbalance" || std::isnan(m.estimator.number(snapshot))) << m.name;
  EXPECT_EQ(hopper::mass(snapshot), 0);
}

/// A full hopper over an empty bin with a stream of half the slit's width, that narrows to a quarter half-way down.
TEST(HopperNumbers, FrameOfAStream) {
  auto points = test::lattice(width, depth, plate, plate + 50 * h, h);
  const std::size_t bed = points.size();
  const auto stream = test::lattice(width, depth, 30e-3, 60 * h, h,
                                    [&](double x, double z) { return std::abs(x - 0.05) < (z > 0.075 ? 10 : 5) * h; });
  points.insert(points.end(), stream.begin(), stream.end());
  test::GrainColumns now(points, bulk_density, grain_density, gate + 0.2);
  for (std::size_t i = bed; i < points.size(); ++i) now.packing[i] = 0.4;
  for (std::size_t i = 0; i < points.size(); ++i) now.velocity[i].z = i < bed ? -0.2 : -1;
  for (std::size_t i = 0; i < points.size(); ++i) now.stress_zz[i] = i < bed ? 500 : 50;
  now.packing[bed - 1] = 0.9;  // one particle is no percentile
  const HopperSetting paper = setting();
  const HopperSnapshot snapshot(paper, now.view(), gate);
  const auto is = [&](HopperRun::Numbers::Number number) { return number(snapshot); };
  EXPECT_NEAR(is(hopper::packing_max), 0.6, 1e-12);
  EXPECT_NEAR(is(hopper::surface_angle_in<hopper::Where::hopper>), 0, 0.01);
  EXPECT_TRUE(std::isnan(is(hopper::repose_angle_in<hopper::Where::hopper, &ReposeAngle::mean>)));
  EXPECT_EQ(is(hopper::inertial_share), 1) << "nothing shears";
}

/// Where grains may be: above the plate, beside the slit below it, in the stream; slow, fast and free ones.
TEST(HopperNumbers, TheShareOfSlowFlow) {
  struct Grain {
    Vector3 position;
    double pressure, shear_rate;
  };
  constexpr double slow = 0, fast = 1000;  // 1/s: I = 0.2 at 2500 Pa
  constexpr double above = plate + 0.02, below = plate - 0.02, beside = 0.01, middle = 0.05;
  const std::vector<Grain> grains = {{{beside, 0, above}, 2500, slow}, {{middle, 0, above}, 2500, slow},
                                     {{middle, 0, above}, 2500, fast}, {{middle, 0, above}, 0, slow},
                                     {{beside, 0, below}, 2500, slow}, {{beside, 0, below}, 0, slow},
                                     {{middle, 0, below}, 2500, fast}, {{middle, 0, below}, 2500, slow}};
  test::GrainColumns now(std::vector<Vector3>(grains.size()), bulk_density, grain_density, gate + 0.2);
  for (std::size_t i = 0; i < grains.size(); ++i) {
    now.position[i] = grains[i].position;
    now.stress_xx[i] = now.stress_yy[i] = now.stress_zz[i] = grains[i].pressure;
    now.shear_rate[i] = grains[i].shear_rate;
  }
  const HopperSetting paper = setting();
  const HopperSnapshot snapshot(paper, now.view(), gate);
  EXPECT_DOUBLE_EQ(hopper::inertial_share(snapshot), 2.0 / 4) << "above the outlet; those that bear nothing as fast";
  HopperSetting box = setting();
  box.shape.outlet.reset();
  const HopperSnapshot whole(box, now.view(), gate);
  EXPECT_DOUBLE_EQ(hopper::inertial_share(whole), 4.0 / 8) << "without an outlet, of all";
}

}  // namespace
}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/time_scale.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "models/continuum/cases.hpp"

namespace talus::continuum {
namespace {

/// A hopper whose lengths are so many times those of a laboratory: an outlet of 40 mm under a bed of 80 mm.
Parameters hopper(double scale) {
  Parameters p;
  p.box.width = 0.1 * scale, p.box.depth = 0.1 * scale, p.box.height = 0.3 * scale;
  p.plate.height = 0.1 * scale, p.plate.slit_left = 0.03 * scale, p.plate.slit_right = 0.07 * scale;
  p.bed.spacing = 5e-3 * scale, p.bed.height = 0.08 * scale;
  return p;
}

TEST(TimeScales, GrowWithTheRootOfTheOutlet) {
  const TimeScales small = time_scales_of(hopper(1)), large = time_scales_of(hopper(100));
  EXPECT_NEAR(small.length, 0.04, 1e-12);
  EXPECT_NEAR(small.time, std::sqrt(0.04 / 9.81), 1e-12);
  EXPECT_NEAR(small.settled_speed, 0.5e-3, 0.01e-3);
  EXPECT_NEAR(small.settled_duration, 20e-3, 1e-3);
  EXPECT_NEAR(small.averaging_time, 20e-3, 1e-3);
  EXPECT_NEAR(small.settling_limit, 1.35, 0.01);
  for (double TimeScales::*number : {&TimeScales::time, &TimeScales::settled_speed, &TimeScales::settled_duration,
                                     &TimeScales::averaging_time, &TimeScales::settling_limit})
    EXPECT_NEAR(large.*number, 10 * small.*number, 1e-9);
  EXPECT_EQ(small.peak_time(), 0.5 * small.averaging_time);
}

TEST(TimeScales, AreWhatTheCaseGives) {
  Parameters p = hopper(100);
  p.settle.speed = 0.5e-3, p.settle.duration = 20e-3, p.settle.max_time = 1, p.analysis.averaging_time = 20e-3;
  const TimeScales given = time_scales_of(p);
  EXPECT_EQ(given.settled_speed, 0.5e-3);
  EXPECT_EQ(given.settled_duration, 20e-3);
  EXPECT_EQ(given.settling_limit, 1);
  EXPECT_EQ(given.peak_time(), 10e-3);
  EXPECT_EQ(loading_time(p, 0.08, given, 1), 0.25) << "a quarter of settle.max_time";
}

TEST(TimeScales, AreOfTheNarrowerSideOrTheBed) {
  Parameters p = hopper(1);
  p.box.front = p.box.rear = FaceKind::wall;
  p.box.depth = 0.01;
  EXPECT_NEAR(*outlet_width_of(p), 0.01, 1e-12) << "walls in front and behind";
  p.box.front = p.box.rear = FaceKind::symmetry;
  EXPECT_NEAR(*outlet_width_of(p), 0.04, 1e-12) << "a slit without end";
  p.plate.slit_left = 0;
  p.box.left = FaceKind::symmetry;
  EXPECT_NEAR(*outlet_width_of(p), 0.14, 1e-12) << "half of one that is twice as wide";
  p.plate = {};
  EXPECT_FALSE(outlet_width_of(p));
  EXPECT_NEAR(time_scales_of(p).length, 0.08, 1e-12);
  p.gravity.acceleration = 0;
  EXPECT_TRUE(std::isfinite(time_scales_of(p).time));
}

TEST(TimeScales, AVesselThatIsFilledIsWaitedFor) {
  Parameters p = hopper(1);
  const double without = time_scales_of(p).settling_limit;
  p.inlets.resize(1);
  p.inlets[0].clock = InletClock::start;
  p.inlets[0].to = 30.0;
  EXPECT_NEAR(time_scales_of(p).settling_limit, 30 + without, 1e-9);
}

TEST(Loading, InLayersAFrontRisesThroughTheBed) {
  const Loading at_once(Filling::at_once, 2, 1, 10), layers(Filling::layers, 2, 1, 10);
  for (const double z : {0.5, 1.0, 6.0, 11.0}) {
    EXPECT_NEAR(at_once.share(1, z), 0.5, 1e-12);
    EXPECT_EQ(layers.share(2, z), 1) << "the whole weight at the end";
    EXPECT_EQ(layers.share(0, z), 0);
  }
  // Half way: below the front all of the weight, above it none; a height takes a tenth of the time.
  EXPECT_EQ(layers.share(1, 1 + 0.44 * 10), 1);
  EXPECT_EQ(layers.share(1, 1 + 0.56 * 10), 0);
  EXPECT_NEAR(layers.share(1, 6), 0.5, 1e-12);
  EXPECT_EQ(layers.share(1, 20), 0) << "above the bed as at its top";
  EXPECT_FALSE(at_once.is_by_height(1));
  EXPECT_TRUE(layers.is_by_height(1));
  EXPECT_FALSE(layers.is_by_height(2));
  EXPECT_EQ(Loading(Filling::layers, 0, 1, 10).share(0, 5), 1) << "a bed that has its weight from the start";
}

TEST(Loading, InLayersTakesFourTimesAsLong) {
  Parameters p = hopper(1);
  const TimeScales scales = time_scales_of(p);
  const double at_once = loading_time(p, 0.08, scales, 50);
  p.settle.filling = Filling::layers;
  EXPECT_NEAR(loading_time(p, 0.08, scales, 50), 4 * at_once, 1e-12);
}

}  // namespace
}  // namespace talus::continuum

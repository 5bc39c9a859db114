// SPDX-License-Identifier: Apache-2.0
/// The surface of a vessel is made once for all who ask, and again for other triangles.
#include <gtest/gtest.h>

#include <memory>

#include "models/continuum/vessel_parts.hpp"

namespace talus::continuum {
namespace {

TEST(VesselSurface, IsMadeOnceForTheParametersAndTheirCopies) {
  Parameters p = room(12, 12, 12);
  p.vessel = {disc("bottom", 4, 2)};
  const Surface first = surface_of(p);
  Parameters copy = p;
  copy.walls.coefficient = 0.1;
  EXPECT_EQ(surface_of(copy).triangles().data(), first.triangles().data());
  copy.vessel[0].height = 3 * spacing;
  EXPECT_EQ(surface_of(copy).low().z, 3 * spacing) << "other triangles";
  EXPECT_EQ(surface_of(p).low().z, 2 * spacing);

  VesselPart drawn = named("drawn", VesselShape::stl);
  drawn.unit = FileUnit::m;
  drawn.drawn = std::make_shared<DrawnSurface>(triangles_of(p, 0));
  p.vessel = {drawn};
  const Surface of_file = surface_of(p);
  EXPECT_EQ(of_file.high().x, first.high().x);
  EXPECT_EQ(surface_of(p).triangles().data(), of_file.triangles().data());
  p.vessel[0].unit = FileUnit::cm;
  EXPECT_EQ(surface_of(p).high().x, 0.01 * first.high().x) << "of another size";
  Surface opened = surface_of(p);
  opened.open(0);
  EXPECT_FALSE(surface_of(p).is_open(0)) << "all gates are shut";
}

}  // namespace
}  // namespace talus::continuum

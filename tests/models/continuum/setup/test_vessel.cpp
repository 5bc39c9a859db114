// SPDX-License-Identifier: Apache-2.0
/// Walls of any shape in space: loads, friction, gates, and that nothing gets through.
/// (longer than 400 lines because its tests share rooms, walls and runs that settle)
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/continuum/block_on_incline.hpp"
#include "models/continuum/boundary/vessel_loads.hpp"
#include "models/continuum/cases.hpp"
#include "models/continuum/drawn_parts.hpp"
#include "models/continuum/setup/vessel.hpp"
#include "models/continuum/vessel_parts.hpp"

namespace talus::continuum {
namespace {

using std::numbers::pi;

/// Grains without stiffness against shear.
void make_liquid(Parameters& p) {
  p.law = granular::LinearElastic::Parameters{.lambda = 2e5, .shear_modulus = 1e2};
  p.sph.viscosity_alpha = 0.3;
  p.gate.opens = GateOpens::when_settled;
  p.integration.method = Method::leapfrog;
  p.integration.courant = 0.8;
  p.settle = {.speed = 2e-2, .duration = 0.01, .max_time = 2, .loading_time = {}, .damping_time = 5e-3};
}

/// What every patch of the vessel received over a while after the bed has settled, N.
std::vector<Vector3> settled_forces(Continuum& model, ThreadTeam& team, double duration) {
  const State& s = model.state();
  while (s.gate_time < 0) model.advance(team);
  const std::vector<Vector3> before(vessel_impulse(s).begin(), vessel_impulse(s).end());
  const double begin = s.time;
  while (s.time < begin + duration) model.advance(team);
  std::vector<Vector3> force;
  for (std::size_t n = 0; n < before.size(); ++n)
    force.push_back((1 / (s.time - begin)) * (vessel_impulse(s)[n] - before[n]));
  return force;
}

TEST(Vessel, FloorAndWallsOfABoxBearTheHydrostaticLoad) {
  Parameters p = room(10, 10, 24);
  make_liquid(p);
  p.bed.height = 8 * spacing;
  p.vessel = {plate("west", {1, 1, 4}, {0, 8, 0}, {0, 0, 16}), plate("east", {9, 1, 4}, {0, 8, 0}, {0, 0, 16}),
              plate("south", {1, 1, 4}, {8, 0, 0}, {0, 0, 16}), plate("north", {1, 9, 4}, {8, 0, 0}, {0, 0, 16}),
              plate("bottom", {1, 1, 4}, {8, 0, 0}, {0, 8, 0})};
  ThreadTeam team(2);
  Continuum model = started(p, team);
  const State& s = model.state();
  ASSERT_EQ(s.position.size(), 512u);
  const auto force = settled_forces(model, team, 0.03);
  const double weight = s.mass * 9.81 * 512;
  const double sideways = 0.5 * bulk_density(p) * 9.81 * std::pow(8 * spacing, 3);
  EXPECT_NEAR(-force[4].z, weight, 0.01 * weight);
  for (std::size_t n = 0; n < 4; ++n) {
    EXPECT_NEAR(norm(force[n]), sideways, 0.02 * sideways) << n;
    EXPECT_NEAR(force[n].z, 0, 1e-9 * weight) << "a smooth wall bears nothing along itself";
  }
  EXPECT_LT(force[0].x, 0);
  EXPECT_GT(force[3].y, 0);
  EXPECT_LT(norm(momentum_error(s)), 1e-11 * norm(s.gravity_impulse));

  // The fields of a wall together received what it did; their mean pressure is that of their depth.
  const Surface surface = Boundary(p).vessel();
  const SurfaceFields fields = load_fields(Layout(p));
  EXPECT_EQ(count_load_fields(Layout(p)), fields.count());
  ASSERT_EQ(s.wall_loads.push.size(), fields.count());
  std::vector<Vector3> received(p.vessel.size());
  for (std::size_t n = 0; n < fields.count(); ++n)
    received[fields.all()[n].patch] += s.wall_loads.received_of(fields, n);
  for (std::size_t n = 0; n < p.vessel.size(); ++n)
    EXPECT_LT(norm(received[n] - vessel_impulse(s)[n]), 1e-12 * norm(vessel_impulse(s)[n])) << n;
  const double top = 4 * spacing + 8 * spacing, gamma = bulk_density(p) * 9.81;
  const auto bands = load_bands(p, fields);
  ASSERT_EQ(bands.size(), 4 * 4 + 1u) << "16 spacings high: four bands of four";
  Parameters coarser = p;
  coarser.levels.count = 1;
  EXPECT_EQ(load_bands(coarser, fields).size(), 4 * 2 + 1u) << "eight spacings are four of the coarsest";
  EXPECT_EQ(bands[0].name, "west.1");
  EXPECT_EQ(bands.back().name, "bottom");
  EXPECT_TRUE(bands.back().is_level());
  EXPECT_NEAR(bands[0].sine, 0, 1e-12);
  for (const LoadBand& band : bands) {
    double area = 0, pressure = 0;
    for (const std::uint32_t n : band.fields) {
      area += fields.all()[n].area;
      pressure += fields.all()[n].area * s.wall_loads.pressure[n];
    }
    pressure /= area;
    EXPECT_NEAR(area, band.area, 1e-12 * area);
    const double depth = band.is_level() ? 8 * spacing : std::max(0.0, top - 0.5 * (band.low + band.high));
    EXPECT_NEAR(pressure, gamma * depth, 0.05 * gamma * 8 * spacing) << band.name;
  }
}

TEST(Vessel, LoadsAtRestAndTheLargestAreMeansOverWindows) {
  Parameters p = room(4, 4, 8);
  p.vessel = {plate("bottom", {0, 0, 2}, {4, 0, 0}, {0, 4, 0})};
  const SurfaceFields fields = load_fields(Layout(p));
  ASSERT_EQ(fields.count(), 4u);
  WallLoads loads = no_loads(4, 1);
  const double area = fields.all()[2].area;
  double time = 0;
  const auto press = [&](double force, int windows) {
    for (int n = 0; n < 10 * windows; ++n) {
      add_load({{2, 2, 1}, force * 1e-3, {0.25 * force * 1e-3, 0, -force * 1e-3}}, fields, loads);
      close_window(fields, time += 1.0001e-3, 10e-3, loads);
    }
  };
  press(3, 1), press(1, 2);
  EXPECT_NEAR(loads.max_pressure[2], 3 / area, 1e-3 * 3 / area);
  EXPECT_NEAR(loads.max_time[2], 5e-3, 1e-4);
  begin_flow(fields, time, loads);
  EXPECT_NEAR(loads.rest_pressure[2], 1 / area, 1e-3 / area);
  EXPECT_NEAR(loads.rest_traction[2].x, 0.25 / area, 1e-3 / area);
  EXPECT_EQ(loads.max_pressure[2], 0);
  press(2, 1), press(0, 1);
  EXPECT_NEAR(loads.max_pressure[2], 2 / area, 1e-3 * 2 / area);
  EXPECT_NEAR(loads.max_time[2], 35e-3, 1e-4);
  const FieldMesh mesh = mesh_of(Boundary(p).vessel(), fields, 3 * spacing);
  const SurfaceSnapshot shown = loads_on(mesh, fields, loads, time, 30.003e-3);
  const auto& in_flow = std::get<std::vector<double>>(shown.columns[4].values);
  ASSERT_EQ(shown.columns[4].name, "pressure_in_flow");
  for (std::size_t n = 0; n < mesh.field.size(); ++n)
    EXPECT_NEAR(in_flow[n], mesh.field[n] == 2 ? 1 / area : 0, 1e-3 / area);
  EXPECT_EQ(loads.push[0], 0);
}

TEST(Vessel, ALoadIsSharedByTwoFieldsAndKeptWhole) {
  Parameters p = room(4, 4, 8);
  p.vessel = {plate("bottom", {0, 0, 2}, {4, 0, 0}, {0, 4, 0})};
  const SurfaceFields fields = load_fields(Layout(p));
  WallLoads loads = no_loads(4, 1);
  add_load({{2, 1, 0.25F}, 8, {0, 4, -8}}, fields, loads);
  EXPECT_EQ(loads.push_of(fields, 2), 2);
  EXPECT_EQ(loads.push_of(fields, 1), 6);
  EXPECT_EQ(loads.received_of(fields, 2), Vector3(0, 1, -2));
  EXPECT_EQ(loads.received_of(fields, 1), Vector3(0, 3, -6));
}

TEST(Vessel, OnlyWhatLiesInTheBoxCountsAsAreaOfABand) {
  // A quarter of a cylinder between two planes of symmetry through its axis.
  Parameters p = room(12, 12, 20);
  VesselPart bin = named("bin", VesselShape::cylinder);
  bin.centre = {0, 0};
  bin.radius = 10 * spacing, bin.bottom = 2 * spacing, bin.top = 18 * spacing;
  p.vessel = {bin};
  const SurfaceFields fields = load_fields(Layout(p));
  double area = 0;
  for (const LoadBand& band : load_bands(p, fields)) area += band.area;
  const double quarter = 0.5 * std::numbers::pi * 10 * 16 * spacing * spacing;
  EXPECT_NEAR(area, quarter, 0.01 * quarter);
}

TEST(Vessel, FloorAndWallOfACylinderBearTheHydrostaticLoad) {
  // In two halves: the load of each is that on its projection, 2 R wide.
  constexpr double radius = 5.5;
  Parameters p = room(13, 13, 24);
  make_liquid(p);
  p.bed.height = 8 * spacing;
  std::vector<Triangle> half[2];
  constexpr int sides = 48;
  const auto at = [](int n, double z) {
    const double angle = 2 * pi * (n % sides) / sides;
    return spacing * Vector3{6.5 + radius * std::cos(angle), 6.5 + radius * std::sin(angle), z};
  };
  for (int n = 0; n < sides; ++n) {
    auto& of = half[n >= sides / 2];
    of.push_back({{at(n, 4), at(n, 20), at(n + 1, 4)}, 0});
    of.push_back({{at(n + 1, 4), at(n, 20), at(n + 1, 20)}, 0});
  }
  p.vessel = {drawn("north", half[0]), drawn("south", half[1]), disc("bottom", 5.51, 4)};
  ASSERT_THAT(check(p), testing::IsEmpty());
  ThreadTeam team(2);
  Continuum model = started(p, team);
  const State& s = model.state();
  const double count = double(s.position.size()), volume = pi * radius * radius * 8;
  EXPECT_NEAR(count, volume, 0.03 * volume);
  const auto force = settled_forces(model, team, 0.03);
  const double weight = s.mass * 9.81 * count, depth = 8 * spacing * count / volume;
  const double sideways = 0.5 * bulk_density(p) * 9.81 * depth * depth * 2 * radius * spacing;
  EXPECT_NEAR(-force[2].z, weight, 0.01 * weight);
  EXPECT_NEAR(force[0].y, sideways, 0.05 * sideways) << "its depth is known to a particle's";
  EXPECT_NEAR(force[1].y, -force[0].y, 0.02 * sideways);
  EXPECT_NEAR(force[0].z, 0, 1e-9 * weight);
}

TEST(Vessel, ATriangulatedBoxBearsWhatMirrorsBear) {
  Parameters p = room(10, 10, 24);
  make_liquid(p);
  p.bed.height = 8 * spacing;
  VesselPart walls = named("walls", VesselShape::box);
  walls.width = walls.depth = 8 * spacing, walls.bottom = 4 * spacing, walls.top = 20 * spacing;
  p.vessel = {walls, plate("bottom", {1, 1, 4}, {8, 0, 0}, {0, 8, 0})};
  Parameters mirrors = column(8, 8, 8, 8);
  make_liquid(mirrors);
  mirrors.box.front = mirrors.box.rear = FaceKind::wall;
  ThreadTeam team(2);
  Continuum model = started(p, team), mirrored = started(mirrors, team);
  const auto force = settled_forces(model, team, 0.03);
  const auto expected = settled_wall_forces(mirrored, team, 0.03);
  EXPECT_EQ(model.state().position.size(), mirrored.state().position.size());
  EXPECT_NEAR(force[1].z, expected[4].z, -0.01 * expected[4].z);
  const auto level = [](const State& s) {
    double z = 0;
    for (const Vector3& x : s.position) z += x.z;
    return z / double(s.position.size());
  };
  EXPECT_NEAR(level(model.state()) - 4 * spacing, level(mirrored.state()), 0.03 * spacing);
}

/// Acceleration of a block down a plate at that angle. \param coefficient 0: smooth
double acceleration_down(double angle, double coefficient) {
  Parameters p = free_block(1, 1, 1);
  p.walls.coefficient = 5;  // that of the wall itself counts
  p.walls.friction_from = FrictionFrom::start;
  make_granular(p);
  p.walls.friction = coefficient > 0 ? Friction::coulomb : Friction::none;
  p.box.width = 3;
  p.box.front = p.box.rear = FaceKind::periodic;
  p.bed.bottom = 9;
  p.bed.left = 0.5, p.bed.right = 0.5 + spacing;
  const double x0 = 0.3, z0 = 5, length = 3;
  VesselPart incline = named("incline", VesselShape::plate);
  incline.corner = {x0, -5 * spacing, z0};
  incline.first_edge = {length * std::cos(angle), 0, -length * std::sin(angle)};
  incline.second_edge = {0, 11 * spacing, 0};
  if (coefficient > 0) incline.friction = coefficient;
  p.vessel = {incline};
  ThreadTeam team(1);
  Parameters alone = p;
  alone.vessel.clear();
  Continuum model(p);
  return acceleration_of_block(model, Continuum(alone).state(), {x0, 0, z0}, angle, team);
}

TEST(Vessel, ABlockSlidesOnAPlateAsCoulombSays) {
  const double angle = 15 * half_turn / 180;
  const double smooth = 9.81 * std::sin(angle), rubbing = 9.81 * (std::sin(angle) - 0.2 * std::cos(angle));
  EXPECT_NEAR(acceleration_down(angle, 0), smooth, 0.01 * smooth);
  EXPECT_NEAR(acceleration_down(angle, 0.2), rubbing, 0.1 * smooth);
  EXPECT_NEAR(acceleration_down(angle, 0.35), 0, 0.06 * smooth)
      << "it sticks, but for its front: tan 15 degrees is 0.27";
}

TEST(Vessel, ALayerThatSlidesOnAFloorStopsAsCoulombSays) {
  Parameters p = column(6, 6, 4, 8);
  make_granular(p);
  p.box.left = p.box.right = p.box.front = p.box.rear = FaceKind::periodic;
  p.box.floor = FaceKind::open;
  p.bed.velocity = {0.3, 0, 0};
  p.walls.coefficient = 0.2;
  p.walls.friction_from = FrictionFrom::start;
  p.vessel = {plate("bottom", {-4, -4, 2}, {14, 0, 0}, {0, 14, 0})};
  p.bed.bottom = 2 * spacing;
  ThreadTeam team(1);
  Continuum model = started(p, team);
  const State& s = model.state();
  const double count = double(s.position.size());
  const Vector3 given = momentum(s);
  while (s.time < 0.1) model.advance(team);
  EXPECT_NEAR(momentum(s).x / (s.mass * count), 0.3 - 0.2 * 9.81 * s.time, 0.02 * 0.3);
  while (s.time < 0.2) model.advance(team);
  EXPECT_NEAR(momentum(s).x / (s.mass * count), 0, 0.01 * 0.3) << "at rest since 0.153 s";
  EXPECT_LT(norm(momentum_error(s) - given), 1e-11 * norm(s.gravity_impulse));
}

/// A small cone under a cylinder, with a gate.
Parameters small_silo() {
  Parameters p = room(20, 20, 34);
  make_granular(p);
  p.box.floor = FaceKind::wall;
  VesselPart cylinder = named("", VesselShape::cylinder), cone = named("", VesselShape::cone);
  cylinder.radius = 6.5 * spacing, cylinder.bottom = 15 * spacing, cylinder.top = 30 * spacing;
  cone.lower_radius = 3 * spacing, cone.upper_radius = 6.5 * spacing;
  cone.bottom = 9 * spacing, cone.top = 15 * spacing;
  VesselPart gate = disc("gate", 3, 9);
  gate.gate = true;
  p.vessel = {cylinder, cone, gate};
  p.bed.height = 12 * spacing;
  p.integration.method = Method::leapfrog;
  p.integration.courant = 0.6;
  p.gate.opens = GateOpens::at_time;
  p.gate.time = 0.02;
  p.walls.friction_from = FrictionFrom::start;
  return p;
}

TEST(Vessel, NothingLeaksFromASilo) {
  const Parameters p = small_silo();
  ASSERT_THAT(check(p), testing::IsEmpty());
  ThreadTeam team(2);
  Continuum model = started(p, team);
  const State& s = model.state();
  const std::size_t count = s.position.size();
  ASSERT_GT(count, 800u);
  Boundary boundary(p);
  const Surface& surface = boundary.vessel();
  std::size_t passed = 0;
  while (s.time < 0.12) {
    const auto before = by_identity(s, s.position);
    if (s.gate_time >= 0) boundary.move_gates(s.time - s.gate_time);
    model.advance(team);
    const auto after = by_identity(s, s.position);
    passed = 0;
    for (std::size_t n = 0; n < count; ++n) {
      ASSERT_FALSE(surface.blocks(before[n], after[n])) << "at " << s.time;
      passed += after[n].z < 9 * spacing;
    }
    if (s.gate_time < 0) {
      ASSERT_EQ(passed, 0u);
    }
  }
  EXPECT_GT(passed, count / 50);
  EXPECT_EQ(s.position.size(), count);
  EXPECT_LT(norm(momentum_error(s)), 1e-11 * norm(s.gravity_impulse));
}

/// Shut into the stream: what is above stays above, and a run resumed before or after it keeps its bits.
TEST(Vessel, AGateThatClosesHoldsWhatIsAboveIt) {
  Parameters p = small_silo();
  p.vessel[2].closes_after = 0.06;
  ASSERT_THAT(check(p), testing::IsEmpty());
  ThreadTeam team(2), one(1);
  Continuum model = started(p, team), resumed(p);
  const State& s = model.state();
  const auto below = [&] {
    return std::count_if(s.position.begin(), s.position.end(), [](const Vector3& x) { return x.z < 9 * spacing; });
  };
  const auto restart = [&] { resumed.mutable_state() = s, resumed.resume(one); };
  const auto run_both_to = [&](double time) {
    restart();
    while (s.time < time) model.advance(team), resumed.advance(one);
    EXPECT_EQ(s.position, resumed.state().position);
  };
  while (s.time < 0.075) model.advance(team);
  run_both_to(0.0801);
  const std::ptrdiff_t passed = below();
  EXPECT_GT(passed, 10);
  run_both_to(0.09);
  while (s.time < 0.12) model.advance(team);
  EXPECT_EQ(below(), passed);
  EXPECT_LT(norm(momentum_error(s)), 1e-11 * norm(s.gravity_impulse));
  double fastest = 0;
  for (std::size_t i = 0; i < s.position.size(); ++i)
    if (s.position[i].z > 9 * spacing) fastest = std::max(fastest, norm(s.velocity[i]));
  EXPECT_LT(fastest, 0.5) << "nobody is shot out of the gate";
}

TEST(Vessel, NothingLeaksAroundACornerThatPointsIntoTheBed) {
  // A step in the floor: grains flow over its edge, which they see from two sides.
  Parameters p = room(12, 6, 26);
  make_granular(p);
  p.box.front = p.box.rear = FaceKind::symmetry;
  p.integration.method = Method::leapfrog;
  p.integration.courant = 0.6;
  p.walls.friction_from = FrictionFrom::start;
  p.bed.bottom = 4 * spacing, p.bed.height = 12 * spacing;
  p.vessel = {plate("west", {1, -4, 8}, {0, 14, 0}, {0, 0, 16}), plate("east", {11, -4, 4}, {0, 14, 0}, {0, 0, 20}),
              plate("step", {1, -4, 8}, {5, 0, 0}, {0, 14, 0}), plate("riser", {6, -4, 4}, {0, 14, 0}, {0, 0, 4}),
              plate("bottom", {6, -4, 4}, {5, 0, 0}, {0, 14, 0})};
  ASSERT_THAT(check(p), testing::IsEmpty());
  ThreadTeam team(2);
  Continuum model(p);
  for (Vector3& u : model.mutable_state().velocity) u = {0.6, 0, -0.2};
  model.begin(team);
  const State& s = model.state();
  const std::size_t count = s.position.size();
  ASSERT_GT(count, 500u);
  const Surface surface = Boundary(p).vessel();
  while (s.time < 0.06) {
    const auto before = by_identity(s, s.position);
    model.advance(team);
    const auto after = by_identity(s, s.position);
    for (std::size_t n = 0; n < count; ++n) ASSERT_FALSE(surface.blocks(before[n], after[n])) << "at " << s.time;
  }
  for (const Vector3& x : s.position)
    ASSERT_TRUE(x.z > 8 * spacing || (x.x > 6 * spacing && x.z > 4 * spacing)) << x.x << ' ' << x.z;
  EXPECT_GT(vessel_impulse(s)[1].x, 0) << "they have run against the wall on the right";
}

TEST(Vessel, TheBitsDependNeitherOnThreadsNorOnResuming) {
  const Parameters p = small_silo();
  ThreadTeam one(1), two(2);
  Continuum model = started(p, one), other = started(p, two);
  const auto same = [](const State& a, const State& b) {
    return a.time == b.time && a.position == b.position && a.velocity == b.velocity &&
           a.material.stress == b.material.stress && a.patch_impulse == b.patch_impulse && a.density == b.density;
  };
  while (model.state().time < 0.015) model.advance(one), other.advance(two);
  ASSERT_TRUE(same(model.state(), other.state()));
  for (const double until : {0.025, 0.03}) {  // resumed before and after the gate opens
    Continuum resumed(p);
    resumed.mutable_state() = model.state();
    resumed.resume(two);
    while (model.state().time < until) model.advance(one), resumed.advance(two);
    EXPECT_TRUE(same(model.state(), resumed.state())) << until;
  }
  EXPECT_GE(model.state().gate_time, 0);
}

TEST(Vessel, ThinPlatesKeepTheirSidesApart) {
  // Grains pressed together above a plate; those below it have nothing to do with them.
  Parameters p = room(8, 8, 12);
  p.gravity.acceleration = 0;
  p.vessel = {plate("layer", {-4, -4, 6}, {16, 0, 0}, {0, 16, 0})};
  p.bed.bottom = 2 * spacing, p.bed.height = 8 * spacing;
  p.bed.packing = 0.6;
  ThreadTeam team(1);
  Parameters whole = p;
  whole.vessel.clear();
  Continuum model(p);
  State& s = model.mutable_state();
  const auto impulses = s.patch_impulse;
  s = Continuum(whole).state();
  s.patch_impulse = impulses;
  for (std::size_t i = 0; i < s.position.size(); ++i)
    if (s.position[i].z > 6 * spacing)
      for (std::size_t c = 0; c < 3; ++c) s.material.stress[c][i] = 100;
  model.begin(team);
  for (int n = 0; n < 3; ++n) model.advance(team);
  for (std::size_t i = 0; i < s.position.size(); ++i)
    if (s.position[i].z < 6 * spacing) {
      ASSERT_EQ(norm(s.velocity[i]), 0) << s.position[i].z;
    }
  EXPECT_LT(vessel_impulse(s)[0].z, 0) << "pressed from above";
}

TEST(Vessel, ContradictionsAreToldAllAtOnce) {
  Parameters p = small_silo();
  p.vessel[0].top = p.vessel[0].bottom;
  p.vessel[1].centre = {1};
  p.vessel[1].name = "floor";  // the box has one, with columns of its own
  p.vessel[2].hole = 2 * p.vessel[2].radius;
  p.vessel.push_back(p.vessel[2]);
  p.air.enabled = true;
  p.vessel[0].spin = 1;
  std::vector<std::string> keys;
  for (const Problem& problem : check(p)) keys.push_back(problem.key);
  EXPECT_THAT(keys, testing::IsSupersetOf({"vessel.1.top", "vessel.2.centre", "vessel.2.name", "vessel.3.hole",
                                           "vessel.4.hole", "vessel.4.name", "air.enabled"}));
}

TEST(Vessel, FaultsOfAFileNameTheTriangle) {
  Parameters p = small_silo();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  p.vessel.push_back(drawn(
      "chute", {{{Vector3{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, 0}, {{Vector3{0, 0, 0}, {0.5, 0, 0}, {nan, 0, 0}}, 0}}));
  p.vessel.back().file = "chute.stl";
  const auto problems = check(p);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "vessel.4.file");
  EXPECT_THAT(problems[0].what, testing::HasSubstr("chute.stl: triangle 2 at"));
  EXPECT_THAT(problems[0].what, testing::HasSubstr("a coordinate is not a number"));
}

TEST(Vessel, ARimOfAFileThatIsToBeClosedIsAFault) {
  Parameters p = small_silo();
  const Vector3 a{20, 0, 0}, b{30, 0, 0}, c{20, 10, 0}, d{20, 0, 10};
  p.vessel.push_back(drawn("body", {{{a, c, b}, 0}, {{a, b, d}, 0}, {{a, d, c}, 0}}));
  p.vessel.back().file = "body.stl";
  p.vessel.back().unit = FileUnit::mm;
  EXPECT_THAT(check(p), testing::IsEmpty()) << "a vessel has rims";
  p.vessel.back().closed = true;
  const auto problems = check(p);
  ASSERT_EQ(problems.size(), 3u);
  EXPECT_EQ(problems[0].key, "vessel.4.file");
  EXPECT_EQ(problems[0].what,
            "body.stl: triangle 1 at (25, 5, 0) mm: no triangle joins it at an edge: the surface is not closed there");
}

}  // namespace
}  // namespace talus::continuum

// SPDX-License-Identifier: Apache-2.0
/// A sector in place of a whole vessel.
#include "models/continuum/sector.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <any>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "models/continuum/cases.hpp"
#include "models/continuum/regime.hpp"
#include "models/continuum/setup/layout.hpp"
#include "models/continuum/vessel_parts.hpp"
#include "models/continuum/whole_circle.hpp"
#include "numerics/snapshot.hpp"

namespace talus::continuum {
namespace {

using std::numbers::pi;

constexpr double radius = 6;  // spacings

/// A cone under a cylinder, and a gate.
Parameters silo(double degrees) {
  Parameters p = shut_silo();
  p.box.sector = degrees * pi / 180;
  p.bed.height = 10 * spacing;
  p.walls.friction_from = FrictionFrom::start;
  return p;
}

Parameters cylinder_with_floor(double degrees) {
  Parameters p = silo(degrees);
  p.vessel[1] = disc("bottom", radius, 12);
  p.vessel.pop_back();
  return p;
}

double value(const std::vector<NamedValue>& values, const std::string& name) {
  for (const NamedValue& v : values)
    if (v.name == name) return v.value;
  ADD_FAILURE() << name;
  return std::nan("");
}

TEST(Sector, FeelsWhatAWholeCircleOfItsCopiesFeels) {
  for (const auto& [degrees, parts] : {std::pair{90.0, false}, {30.0, false}, {20.0, false}, {20.0, true}})
    for (const bool walls : {false, true}) {
      Parameters p = parts ? silo_of_parts(degrees) : silo(degrees);
      const State s = disordered(p);
      const Sector sector = *sector_of(p);
      const State whole = unfolded(s, sector);
      const std::size_t own = s.position.size();
      ASSERT_EQ(whole.position.size(), own * static_cast<std::size_t>(sector.copies()));
      const Domain part = Boundary(p).domain();
      const Sums of_part(p, part, s, walls), of_whole(p, part.whole(), whole, walls);
      double largest = 0, max_open = 0;
      for (std::size_t i = 0; i < own; ++i) {
        largest = std::max(largest, norm(of_part.rates.acceleration[i]));
        max_open = std::max(max_open, std::abs(of_part.rates.density_rate[i]));
      }
      // The points of walls are floats.
      const double rounding = walls ? 2e-6 : 1e-12;
      for (std::size_t n = 0; n < whole.position.size(); ++n) {
        const Vector3 turned = sector.turn(static_cast<int>(n / own)) * of_part.rates.acceleration[n % own];
        ASSERT_LT(norm(of_whole.rates.acceleration[n] - turned), rounding * largest) << degrees << walls << n;
        ASSERT_NEAR(of_whole.rates.density_rate[n], of_part.rates.density_rate[n % own], rounding * max_open);
        ASSERT_NEAR(of_whole.rates.kernel_density[n], of_part.rates.kernel_density[n % own],
                    rounding * of_part.rates.kernel_density[n % own]);
      }
      if (!walls) continue;
      EXPECT_GT(of_part.rates.at_vessel.size(), 10u);
      ASSERT_EQ(of_whole.rates.at_vessel.size(),
                of_part.rates.at_vessel.size() * static_cast<std::size_t>(sector.copies()));
    }
}

TEST(Sector, AParticleThatLeavesItGoesOnInTheNextCopy) {
  Parameters p = silo(20);
  State s = disordered(p);
  const Sector sector = *sector_of(p);
  const Domain domain = Boundary(p).domain();
  const auto by_identity = [&] {
    std::map<std::int64_t, std::pair<Vector3, Vector3>> all;
    const PointSet points = talus::whole_of(part_of(s, sector).view());
    const Snapshot view = points.view();
    for (std::size_t n = 0; n < view.size(); ++n)
      all[view.integers("identity")[n]] = {view.positions()[n], view.vectors("velocity")[n]};
    return all;
  };
  // Out through either face, and around more than half of the circle.
  for (std::size_t i = 0; i < s.position.size(); ++i) s.position[i] = sector.turned(s.position[i], int(i % 3) - 1);
  s.position[7] = sector.turned(s.position[7], 11);
  const auto before = by_identity();
  ASSERT_EQ(before.size(), 18 * s.position.size()) << "no two have the same identity";
  const auto along_velocity = [&](const std::array<std::vector<double>, 6>& columns) {
    const Vector3& u = s.velocity[7];
    return double_dot(tensor_at(columns, 7), {u.x * u.x, u.y * u.y, u.z * u.z, u.x * u.y, u.y * u.z, u.z * u.x});
  };
  const double pushed = along_velocity(s.material.stress), stretched = along_velocity(s.lasting_rate);
  const double speed = norm(s.velocity[7]);
  return_to_sector(domain, Material(p), s);
  for (const Vector3& x : s.position) EXPECT_EQ(sector.copy_at(x), 0);
  EXPECT_NEAR(along_velocity(s.material.stress), pushed, 1e-12 * 1000);
  EXPECT_NEAR(norm(s.velocity[7]), speed, 1e-15);
  EXPECT_NEAR(along_velocity(s.lasting_rate), stretched, 1e-12 * 100);
  for (const auto& [identity, after] : by_identity()) {
    EXPECT_LT(norm(after.first - before.at(identity).first), 1e-14);
    EXPECT_LT(norm(after.second - before.at(identity).second), 1e-14);
  }
}

TEST(Sector, TheBedIsThatOfTheWholeVessel) {
  for (const double degrees : {90.0, 45.0, 20.0, 10.0}) {
    Parameters p = cylinder_with_floor(degrees);
    ASSERT_THAT(check(p), testing::IsEmpty());
    const State s = initial_state(setup_of(p));
    const double whole = Layout(p).copies * s.mass * double(s.position.size());
    const double expected = bulk_density(p) * pi * std::pow(radius * spacing, 2) * p.bed.height;
    EXPECT_NEAR(whole, expected, 1e-9 * expected) << "whole rings of one area";
    EXPECT_EQ(bed_count(Layout(p)), double(s.position.size()));
    double nearest = 1;
    const State all = unfolded(s, *sector_of(p));
    for (std::size_t i = 0; i < s.position.size(); ++i) {
      EXPECT_EQ(sector_of(p)->copy_at(s.position[i]), 0);
      for (std::size_t j = 0; j < all.position.size(); ++j)
        if (i != j && sector_of(p)->radius(s.position[i]) > 3.5 * spacing)
          nearest = std::min(nearest, norm(all.position[j] - s.position[i]) / spacing);
    }
    EXPECT_GT(nearest, 0.6) << "also across the faces";
    p.bed.mass = 0.37 * whole;
    p.bed.height = 0;
    const Parameters filled = with_level(Layout(p)).given;
    ASSERT_THAT(check(filled), testing::IsEmpty());
    const State part = initial_state(setup_of(filled));
    EXPECT_NEAR(Layout(p).copies * part.mass * double(part.position.size()), 0.37 * whole,
                0.5001 * Layout(p).copies * part.mass);
  }
}

/// The bytes of every field.
std::map<std::string, std::string> bytes_of(const State& s) {
  std::map<std::string, std::string> fields;
  const auto add = [&]<class Member>(const FieldInfo& field, const Member& member) {
    std::string& bytes = fields[std::string(field.name)];
    if constexpr (std::is_arithmetic_v<Member>)
      bytes.assign(reinterpret_cast<const char*>(&member), sizeof member);
    else
      bytes.assign(reinterpret_cast<const char*>(member.data()), member.size() * sizeof(member[0]));
  };
  for_each_field(add, s);
  return fields;
}

void expect_same_bits(const State& a, const State& b) {
  const auto others = bytes_of(b);
  for (const auto& [name, bytes] : bytes_of(a)) EXPECT_TRUE(bytes == others.at(name)) << name;
}

TEST(Sector, FlowsTheSameForAnyThreadsAndResumed) {
  Parameters p = silo(30);
  p.gate.opens = GateOpens::at_time;
  p.gate.time = 0.05;
  ThreadTeam one(1), two(2);
  Continuum model = started(p, one), shared = started(p, two);
  const State& s = model.state();
  const std::size_t count = s.position.size();
  while (s.time < 0.15) model.advance(one), shared.advance(two);
  expect_same_bits(s, shared.state());
  EXPECT_GT(std::count_if(s.sector_turns.begin(), s.sector_turns.end(), [](auto n) { return n != 0; }), 0)
      << "some have passed a face";

  // What is kept of a state, as a checkpoint has it.
  std::vector<std::any> kept;
  for_each_field(
      [&](const FieldInfo& field, const auto& member) {
        if (field.role == FieldRole::kept) kept.emplace_back(member);
      },
      s);
  Continuum resumed(p);
  std::size_t next = 0;
  for_each_field(
      [&](const FieldInfo& field, auto& member) {
        if (field.role == FieldRole::kept) member = std::any_cast<std::decay_t<decltype(member)>>(kept[next++]);
      },
      resumed.mutable_state());
  resumed.resume(two);
  for (int n = 0; n < 40; ++n) model.advance(one), resumed.advance(two);
  expect_same_bits(s, resumed.state());

  EXPECT_EQ(s.position.size(), count);
  const auto totals = model.totals();
  double balance = value(totals, "momentum_z") - value(totals, "impulse_gravity_z");
  for (const char* wall : {"cylinder", "cone", "gate"}) balance += value(totals, std::string("impulse_") + wall + "_z");
  EXPECT_LT(std::abs(balance), 1e-11 * std::abs(value(totals, "impulse_gravity_z"))) << "all are of the whole";
  EXPECT_NEAR(value(totals, "impulse_gravity_z"), 12 * s.gravity_impulse.z, 1e-12 * std::abs(s.gravity_impulse.z));
  EXPECT_EQ(value(totals, "momentum_x"), 0);
  const Snapshot whole = model.snapshot();
  EXPECT_EQ(whole.size(), 12 * count);
  const auto identities = whole.integers("identity");
  EXPECT_EQ(std::set(identities.begin(), identities.end()).size(), 12 * count);
  EXPECT_FALSE(whole.domain->sector());
  const PointSource stored = model.stored();
  EXPECT_EQ(stored.count, count) << "a file holds the sector once";
  ASSERT_TRUE(stored.copies);
  EXPECT_EQ(stored.copies->count, 12);
}

/// Means over a while after the bed has settled, N.
struct SettledLoads {
  double weight, on_bottom, pressing_on_bottom, pressing_on_cylinder;
};

SettledLoads settled_loads(const Parameters& p, WallLoads& noted) {
  ThreadTeam team(2);
  Continuum model = started(p, team);
  const State& s = model.state();
  while (s.gate_time < 0) model.advance(team);
  const auto before = model.totals();
  const double begin = s.time;
  while (s.time < begin + 0.05) model.advance(team);
  const auto after = model.totals();
  SettledLoads loads{};
  for (std::size_t n = 0; n < after.size(); ++n) {
    const double force = (after[n].value - before[n].value) / (s.time - begin);
    if (after[n].name == "impulse_gravity_z") loads.weight = -force;
    if (after[n].name == "impulse_bottom_z") loads.on_bottom = -force;
    if (after[n].name == "normal_impulse_bottom") loads.pressing_on_bottom = force;
    if (after[n].name.starts_with("normal_impulse_cylinder")) loads.pressing_on_cylinder += force;
  }
  noted = s.wall_loads;
  return loads;
}

TEST(Sector, LoadsAreThoseOfTheWholeVessel) {
  Parameters p = cylinder_with_floor(20);
  p.law = granular::LinearElastic::Parameters{.lambda = 2e5, .shear_modulus = 1e2};
  p.sph.viscosity_alpha = 0.3;
  p.walls.friction = Friction::none;
  p.gate.opens = GateOpens::when_settled;
  p.settle = {.speed = 5e-3, .duration = 0.03, .max_time = 2, .loading_time = {}, .damping_time = 5e-3};
  p.bed.height = 7 * spacing;
  Parameters whole = p;
  whole.box.sector = std::nullopt;
  WallLoads noted, of_whole;
  const SettledLoads loads = settled_loads(p, noted), expected = settled_loads(whole, of_whole);
  const double weight = bulk_density(p) * 9.81 * pi * std::pow(radius * spacing, 2) * p.bed.height;
  EXPECT_NEAR(loads.weight, weight, 1e-4 * weight) << "kicks are staggered";
  EXPECT_NEAR(loads.on_bottom, weight, 0.01 * weight);
  EXPECT_NEAR(loads.pressing_on_bottom, loads.on_bottom, 1e-9 * weight);
  // Six spacings from the axis a ring of particles has another push than a lattice.
  EXPECT_NEAR(loads.pressing_on_cylinder / loads.weight, expected.pressing_on_cylinder / expected.weight,
              0.08 * expected.pressing_on_cylinder / expected.weight);
  // Fields of all copies bear the same, turned.
  const Layout layout(p);
  const SurfaceFields fields = load_fields(layout);
  EXPECT_EQ(count_load_fields(layout), fields.count());
  const Sector sector = *layout.sector();
  const std::size_t own = fields.count() / static_cast<std::size_t>(sector.copies());
  for (std::size_t n = 0; n < fields.count(); ++n) {
    const std::size_t next = (n + own) % fields.count();
    const double push = noted.push_of(fields, n);
    const Vector3 received = noted.received_of(fields, n);
    EXPECT_NEAR(noted.push_of(fields, next), push, 1e-12 * push);
    EXPECT_LE(norm(noted.received_of(fields, next) - sector.turn(1) * received), 1e-12 * norm(received));
    EXPECT_NEAR(norm(fields.all()[next].place - sector.turned(fields.all()[n].place, 1)), 0, 1e-14);
    EXPECT_EQ(fields.original(n), n % own);
    EXPECT_LE(norm(fields.to_original(n, fields.from_original(n, received)) - received), 1e-12 * norm(received));
  }
  // A load on a field of a copy is one on its original, turned back.
  WallLoads once = no_loads(fields.count(), 1);
  const Vector3 force{0.25, 0, -1};
  add_load({{static_cast<std::uint32_t>(2 * own + 3), 0, 1}, 1, sector.turn(2) * force}, fields, once);
  EXPECT_LE(norm(once.received_of(fields, 3) - force), 1e-12);
  EXPECT_LE(norm(once.received_of(fields, 3 + own) - sector.turn(1) * force), 1e-12);
  EXPECT_EQ(once.push_of(fields, 4), 0);
}

std::vector<std::string> faults_of(const Parameters& p) {
  std::vector<std::string> keys;
  for (const Problem& problem : check(p)) keys.push_back(problem.key);
  return keys;
}

TEST(CheckSector, WhatContradictsItIsNamedAtOnce) {
  EXPECT_THAT(faults_of(silo(20)), testing::IsEmpty());
  Parameters p = silo(25);
  p.air.enabled = true;
  p.inlets.resize(1);
  p.plates.resize(1);
  p.bed.left = 0, p.bed.right = 5 * spacing;
  p.bed.velocity = {1, 0, 0};
  EXPECT_THAT(faults_of(p), testing::IsSupersetOf({"box.sector", "air.enabled", "inlet", "plates", "bed.left",
                                                   "bed.right", "bed.velocity"}));
  for (const Problem& problem : check_sector(p))
    if (problem.key == "box.sector") {
      EXPECT_THAT(problem.allowed, testing::HasSubstr("25.7143 deg"));
    }
  p = silo(20);
  p.vessel.clear();
  EXPECT_THAT(faults_of(p), testing::Contains("box.sector"));
}

TEST(CheckSector, WallsThatAreNotRoundAboutTheAxisAreRefused) {
  Parameters p = silo(20);
  p.vessel[0].centre = {7.9 * spacing, 8 * spacing};
  EXPECT_THAT(faults_of(p), testing::ElementsAre("vessel.1.shape"));
  p = silo(20);
  p.vessel.push_back(plate("insert", {6, 6, 15}, {2, 0, 0}, {0, 2, 0}));
  EXPECT_THAT(faults_of(p), testing::ElementsAre("vessel.4.shape"));
  p = silo(90);
  VesselPart bin = named("bin", VesselShape::box);
  bin.width = bin.depth = 14 * spacing, bin.bottom = 2 * spacing, bin.top = 28 * spacing;
  p.vessel.push_back(bin);
  EXPECT_THAT(faults_of(p), testing::ElementsAre("vessel.4.shape")) << "each of its sides turns into another one";
}

TEST(CheckSector, ADrawnBodyMayBeRound) {
  const auto drawn = [](int sides) {
    Parameters p = silo(20);
    std::vector<Triangle> triangles;
    const auto at = [&](int n, double z) {
      const double angle = 2 * pi * n / sides;
      return Vector3{8 + radius * std::cos(angle), 8 + radius * std::sin(angle), z};
    };
    for (int n = 0; n < sides; ++n) {
      triangles.push_back({{at(n, 12), at(n, 26), at(n + 1, 12)}, 0});
      triangles.push_back({{at(n + 1, 12), at(n, 26), at(n + 1, 26)}, 0});
    }
    p.vessel[0] = named("drawn", VesselShape::stl);
    p.vessel[0].unit = FileUnit::cm;
    p.vessel[0].drawn = std::make_shared<DrawnSurface>(triangles);
    return p;
  };
  EXPECT_THAT(faults_of(drawn(36)), testing::IsEmpty());
  EXPECT_THAT(faults_of(drawn(32)), testing::ElementsAre("vessel.1.shape"));
}

TEST(SectorRegime, SaysWhatIsComputedAndWarnsOfACoarseAxis) {
  const auto lines_of = [](double degrees, double finer = 1) {
    Parameters p = silo(degrees);
    p.bed.spacing /= finer;
    std::map<std::string, RegimeLine> lines;
    for (const RegimeLine& line : regime_of_case(setup_of(p))) lines[line.quantity] = line;
    return lines;
  };
  EXPECT_EQ(lines_of(20).at("sector").value, "20 deg");
  EXPECT_EQ(lines_of(90).at("outlet over the sector's axis").value, "2.66") << "3 spacings over (4/pi)^(1/2)";
  EXPECT_TRUE(lines_of(90).at("outlet over the sector's axis").warning) << "below 2.8";
  EXPECT_FALSE(lines_of(90, 1.1).at("outlet over the sector's axis").warning);
}

}  // namespace
}  // namespace talus::continuum

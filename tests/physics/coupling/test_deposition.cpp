// SPDX-License-Identifier: Apache-2.0
#include "physics/coupling/deposition.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.hpp"

namespace talus::coupling {
namespace {

constexpr double cell = 1.25e-3, spacing = 5e-3 / 3;

/// 20 x 5 x 40 mm: thinner than the kernel is wide; the plate across it has a slit from 7.5 to 12.5 mm.
struct Silo {
  ThreadTeam team{1};
  Grid grid{.count = {16, 4, 32}, .low = {}, .spacing = {cell, cell, cell}};
  Domain domain;
  Deposition deposition;
  std::vector<Vector3> position, velocity;
  std::vector<double> smoothing_length, mass_ratio;
  CellField fraction;
  FaceField flux;
  double volume = 0.6 * spacing * spacing * spacing;

  explicit Silo(FaceKind front = FaceKind::symmetry, int threads = 1)
      : Silo(Domain({.low = {},
                     .high = {20e-3, 5e-3, 40e-3},
                     .faces = {FaceKind::wall, FaceKind::wall, front, front, FaceKind::wall, FaceKind::open}},
                    {Wall("plate", {0, 0, 15e-3}, {20e-3, 0, 15e-3}, {{7.5e-3, 12.5e-3}})}),
             threads) {}
  explicit Silo(const Domain& around, int threads = 1)
      : team(threads), domain(around), deposition(grid, domain), fraction(grid.cell_field()), flux(grid.face_field()) {}

  void place(const Vector3& x, const Vector3& u = {}) {
    position.push_back(x), velocity.push_back(u), smoothing_length.push_back(spacing);
  }
  void fill(double low, double high) {
    for (int k = 0; low + (k + 0.5) * spacing < high; ++k)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 12; ++i) place({(i + 0.5) * spacing, (j + 0.5) * spacing, low + (k + 0.5) * spacing});
  }
  void deposit() {
    deposition.find_weights(team, position, smoothing_length);
    deposition.deposit(team, volume, {mass_ratio}, velocity, fraction, flux);
  }
};

double total(const Grid& grid, const CellField& field) {
  double sum = 0;
  for (int k = 0; k < grid.count[2]; ++k)
    for (int j = 0; j < grid.count[1]; ++j)
      for (int i = 0; i < grid.count[0]; ++i) sum += grid.volume() * field[grid.index(i, j, k)];
  return sum;
}

void place_at_random(Silo& silo, int count) {
  Random random(5);
  for (int n = 0; n < count; ++n)
    silo.place({20e-3 * random.uniform(), 5e-3 * random.uniform(), 30e-3 * random.uniform()},  // out of the top's reach
               {random.normal(), random.normal(), random.normal()});
  for (double& h : silo.smoothing_length) h *= random.uniform(0.3, 1.5);  // some reach less than a cell
}

TEST(Deposition, ConservesVolumeAndMomentum) {
  for (const FaceKind front : {FaceKind::symmetry, FaceKind::periodic}) {
    Silo silo(front);
    place_at_random(silo, 500);
    silo.deposit();
    EXPECT_NEAR(total(silo.grid, silo.fraction) / (500 * silo.volume), 1, 1e-13);
    for (int a = 0; a < 3; ++a) {
      double momentum = 0;
      for (const Vector3& u : silo.velocity) momentum += silo.volume * u[a];
      EXPECT_NEAR(total(silo.grid, silo.flux[static_cast<std::size_t>(a)]), momentum, 1e-12 * 500 * silo.volume);
    }
  }
}

TEST(Deposition, AParticleOfEightTimesTheMassCountsEightTimes) {
  Silo silo;
  place_at_random(silo, 300);
  for (std::size_t i = 0; i < 300; ++i) silo.mass_ratio.push_back(i % 3 == 0 ? 8 : 1);
  silo.deposit();
  double momentum = 0;
  for (std::size_t i = 0; i < 300; ++i) momentum += silo.mass_ratio[i] * silo.volume * silo.velocity[i].x;
  EXPECT_NEAR(total(silo.grid, silo.fraction) / ((100 * 8 + 200) * silo.volume), 1, 1e-13);
  EXPECT_NEAR(total(silo.grid, silo.flux[0]), momentum, 1e-11 * 300 * silo.volume);
  FaceField ones = silo.grid.face_field();
  for (auto& component : ones) std::fill(component.begin(), component.end(), 1.0);
  std::vector<Vector3> received(300);
  silo.deposition.distribute(silo.team, silo.volume, {silo.mass_ratio}, ones, received);
  for (std::size_t i = 0; i < 300; ++i)
    EXPECT_NEAR(received[i].z, silo.mass_ratio[i] * silo.volume, 1e-12 * silo.volume);
}

TEST(Deposition, ALongCellHasWhatCellsInARowHaveInItsPlace) {
  for (const FaceKind front : {FaceKind::wall, FaceKind::periodic, FaceKind::open}) {
    Silo silo(front);
    place_at_random(silo, 500);
    silo.deposit();
    Grid deep = silo.grid;
    deep.count[1] = 1, deep.spacing.y = 5e-3;
    Deposition deposition(deep, silo.domain);
    CellField fraction = deep.cell_field();
    FaceField flux = deep.face_field();
    deposition.find_weights(silo.team, silo.position, silo.smoothing_length);
    deposition.deposit(silo.team, silo.volume, {}, silo.velocity, fraction, flux);
    const auto row_mean = [&](const CellField& field, int i, int k) {
      double sum = 0;
      for (int j = 0; j < 4; ++j) sum += field[silo.grid.index(i, j, k)];
      return sum / 4;
    };
    const double largest = *std::max_element(fraction.begin(), fraction.end());
    for (int k = 0; k < 32; ++k)
      for (int i = 0; i < 16; ++i) {
        EXPECT_NEAR(fraction[deep.index(i, 0, k)], row_mean(silo.fraction, i, k), 1e-6 * largest) << i << ' ' << k;
        EXPECT_NEAR(flux[1][deep.index(i, 0, k)], row_mean(silo.flux[1], i, k), 4e-6 * largest) << i << ' ' << k;
      }
  }
}

TEST(Deposition, HandsBackWithTheSameWeights) {
  Silo silo;
  place_at_random(silo, 300);
  silo.deposit();
  FaceField given = silo.grid.face_field();
  Random random(9);
  for (auto& component : given)
    for (double& g : component) g = random.normal();
  std::vector<Vector3> received(300);
  silo.deposition.distribute(silo.team, silo.volume, {}, given, received);
  for (int a = 0; a < 3; ++a) {
    const auto& g = given[static_cast<std::size_t>(a)];
    CellField product = silo.fraction;
    for (std::size_t c = 0; c < product.size(); ++c) product[c] *= g[c];
    double sum = 0, size = 0;
    for (const Vector3& r : received) sum += r[a], size += std::abs(r[a]);
    EXPECT_NEAR(sum, total(silo.grid, product), 1e-13 * size);
  }
}

TEST(Deposition, ABedIsAsDenseAtWallsAndPlateAsWithin) {
  Silo silo;
  silo.fill(15e-3, 35e-3);
  silo.deposit();
  // Layers from the plate up to one reach below the surface, on the solid part and away from the slit.
  for (int k = 12; k < 25; ++k)
    for (int j = 0; j < 4; ++j)
      for (const int i : {0, 1, 2, 14, 15})
        EXPECT_NEAR(silo.fraction[silo.grid.index(i, j, k)], 0.6, 0.012) << i << ' ' << k;
}

TEST(Deposition, APlateHidesWhatIsBehindItAndItsSlitDoesNot) {
  Silo silo;
  silo.place({2.5e-3, 2.5e-3, 15.5e-3});
  silo.deposit();
  double below = 0;
  for (int k = 0; k < 12; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 16; ++i) below += silo.fraction[silo.grid.index(i, j, k)];
  EXPECT_EQ(below, 0);

  Silo open;
  open.place({10e-3, 2.5e-3, 15.5e-3});
  open.deposit();
  EXPECT_GT(open.fraction[open.grid.index(8, 2, 11)], 0);
  double through = 0, all = 0;
  for (int k = 0; k < 32; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 16; ++i) {
        const double s = open.fraction[open.grid.index(i, j, k)];
        all += s, through += k < 12 ? s : 0;
      }
  EXPECT_GT(through, 0.25 * all);
}

TEST(Deposition, OfAParticleThatLeavesTheAirHasTheShareWithinTheBox) {
  double before = 1;
  for (const double z : {36e-3, 38.7e-3, 39.999e-3, 40.001e-3, 41.3e-3, 44e-3}) {  // the open top is at 40 mm
    Silo silo;
    silo.place({10e-3, 2e-3, z}, {0, 0, 1});
    silo.deposit();
    const double share = total(silo.grid, silo.fraction) / silo.volume;
    EXPECT_LE(share, before + 1e-13);
    if (std::abs(z - 40e-3) < 2e-6) {
      EXPECT_NEAR(share, 0.5, 0.12);  // the faces of the cells do not halve a kernel
    }
    before = share;
    std::vector<Vector3> received(1);
    FaceField given = silo.grid.face_field();
    for (auto& component : given) component.assign(component.size(), 1);
    silo.deposition.distribute(silo.team, silo.volume, {}, given, received);
    EXPECT_NEAR(received[0].x / silo.volume, share, 1e-13);  // as much as it gives
  }
  EXPECT_EQ(before, 0);
}

/// Wherever the lattice of a stream that leaves stands to the face, the last cells are as dense as those within.
TEST(Deposition, AStreamIsAsDenseAtTheFaceItLeavesThroughAsWithin) {
  for (const double shift : {0.05, 0.25, 0.5, 0.75, 0.95}) {
    Silo silo;
    silo.fill(20e-3 + shift * spacing, 46e-3);
    silo.deposit();
    for (int k = 28; k < 32; ++k)
      for (int i = 0; i < 16; ++i) EXPECT_NEAR(silo.fraction[silo.grid.index(i, 2, k)], 0.6, 0.012) << shift;
  }
}

TEST(Deposition, GivesTheSameBitsForAnyNumberOfThreads) {
  Silo one(FaceKind::symmetry, 1), three(FaceKind::symmetry, 3);
  for (Silo* silo : {&one, &three}) place_at_random(*silo, 400), silo->deposit();
  EXPECT_EQ(one.fraction, three.fraction);
  EXPECT_EQ(one.flux, three.flux);
}

TEST(Deposition, TheLargestMeanIsThatOfAllParticlesOrWhatIsKnown) {
  Silo silo;
  place_at_random(silo, 300);
  silo.deposit();
  FaceField given = silo.grid.face_field();
  CellField square = silo.grid.cell_field();
  Random random(11);
  for (auto& component : given)
    for (double& g : component) g = random.normal();
  for (std::size_t c = 0; c < square.size(); ++c) {
    for (const auto& component : given) square[c] += component[c] * component[c];
  }
  std::vector<Vector3> mean(300);
  silo.deposition.distribute(silo.team, 1, {}, given, mean);
  double largest = 0;
  for (const Vector3& m : mean) largest = std::max(largest, norm(m));
  EXPECT_DOUBLE_EQ(silo.deposition.max_mean(silo.team, given, square, 0), largest);
  EXPECT_DOUBLE_EQ(silo.deposition.max_mean(silo.team, given, square, 0.999 * largest), largest);
  EXPECT_EQ(silo.deposition.max_mean(silo.team, given, square, 1.5 * largest), 1.5 * largest);
}

TEST(Deposition, RefusesAGridThatDoesNotFillTheBox) {
  Silo silo;
  Grid shifted = silo.grid;
  shifted.low.x = 1e-4;
  EXPECT_THROW(Deposition(shifted, silo.domain), std::invalid_argument);
  Grid coarse{.count = {8, 2, 16}, .low = {}, .spacing = {2 * cell, 2 * cell, 2 * cell}};
  EXPECT_NO_THROW(Deposition(coarse, silo.domain));
}

/// A wall across the box that does not lie on faces of the cells still parts them.
TEST(Deposition, AWallBetweenFacesOfCellsHidesWhatIsBehindIt) {
  for (const double above : {0.3e-3, 0.9e-3}) {
    const double height = 15e-3 + above;
    Silo silo(Domain({.low = {},
                      .high = {20e-3, 5e-3, 40e-3},
                      .faces = {FaceKind::wall, FaceKind::wall, FaceKind::symmetry, FaceKind::symmetry, FaceKind::wall,
                                FaceKind::open}},
                     {Wall("plate", {0, 0, height}, {20e-3, 0, height})}));
    silo.place({3e-3, 2e-3, height + 0.4e-3});
    silo.deposit();
    EXPECT_NEAR(total(silo.grid, silo.fraction), silo.volume, 1e-14 * silo.volume);
    for (int k = 0; k < 32; ++k)
      for (int i = 0; i < 16; ++i) {
        if (silo.grid.centre(i, 0, k).z < height) {
          EXPECT_EQ(silo.fraction[silo.grid.index(i, 1, k)], 0) << k;
        }
      }
  }
}

/// What a wall hides gets nothing, the rest all; at a periodic face the wall counts from the copy beside it.
TEST(Deposition, NothingIsSpreadBehindAWallAtAnAngle) {
  for (const FaceKind side : {FaceKind::wall, FaceKind::periodic}) {
    const Wall slope("slope", {4e-3, 0, 5e-3}, {17e-3, 0, 25e-3});
    const Domain sloping(
        {.low = {},
         .high = {20e-3, 5e-3, 40e-3},
         .faces = {side, side, FaceKind::symmetry, FaceKind::symmetry, FaceKind::wall, FaceKind::wall}},
        {slope});
    Silo silo(sloping);
    place_at_random(silo, 200);
    silo.deposit();
    EXPECT_NEAR(total(silo.grid, silo.fraction), 200 * silo.volume, 1e-12 * 200 * silo.volume);

    const double s = 0.4 * slope.length(), away = 0.4 * spacing;
    for (const double to : {-away, away}) {
      Silo one(sloping);
      one.place(slope.from() + s * slope.direction() + to * slope.normal());
      one.deposit();
      int reached = 0;
      for (int k = 0; k < one.grid.count[2]; ++k)
        for (int j = 0; j < one.grid.count[1]; ++j)
          for (int i = 0; i < one.grid.count[0]; ++i) {
            if (one.fraction[one.grid.index(i, j, k)] == 0) continue;
            ++reached;
            EXPECT_FALSE(one.domain.blocks(one.position[0], one.grid.centre(i, j, k)));
          }
      EXPECT_GT(reached, 20);
      EXPECT_NEAR(total(one.grid, one.fraction), one.volume, 1e-14 * one.volume);
    }
  }
}

}  // namespace
}  // namespace talus::coupling

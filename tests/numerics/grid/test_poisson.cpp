// SPDX-License-Identifier: Apache-2.0
#include "numerics/grid/poisson.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "base/random.hpp"

namespace talus {
namespace {

using std::numbers::pi;
constexpr std::array<bool, 3> not_periodic{false, false, false};

/// Conductances of a coefficient at the faces' centres; those of the box are zero unless the boundary is open.
template <class Coefficient>
FaceField conductances(const Grid& grid, bool open_box, const std::array<bool, 3>& periodic,
                       Coefficient&& coefficient) {
  FaceField faces = grid.face_field();
  const auto [nx, ny, nz] = grid.count;
  for (int axis = 0; axis < 3; ++axis)
    for (int k = 0; k < nz + (axis == 2); ++k)
      for (int j = 0; j < ny + (axis == 1); ++j)
        for (int i = 0; i < nx + (axis == 0); ++i) {
          const auto a = static_cast<std::size_t>(axis);
          const int place = axis == 0 ? i : axis == 1 ? j : k;
          const bool is_end = (place == 0 || place == grid.count[a]) && !periodic[a];
          Vector3 x = grid.centre(i, j, k);
          x[axis] -= 0.5 * grid.spacing[axis];
          const double plain = coefficient(x) * grid.face_area(axis) / grid.spacing[axis];
          faces[a][grid.index(i, j, k)] = !is_end ? plain : open_box ? 2 * plain : 0;
        }
  return faces;
}

template <class Body>
void for_each_cell(const Grid& grid, Body&& body) {
  for (int k = 0; k < grid.count[2]; ++k)
    for (int j = 0; j < grid.count[1]; ++j)
      for (int i = 0; i < grid.count[0]; ++i) body(i, j, k, grid.index(i, j, k));
}

/// Value of -div(c grad p) for p = sin(pi x) sin(pi y) sin(pi z) and c = 1 + x + 0.5 y z, p = 0 on the unit cube's
/// faces.
double max_error(int n) {
  const Grid grid{.count = {n, n, n}, .low = {}, .spacing = {1.0 / n, 1.0 / n, 1.0 / n}};
  ThreadTeam team;
  PoissonSolver solver(grid, not_periodic);
  solver.set_conductance(
      team, conductances(grid, true, not_periodic, [](const Vector3& x) { return 1 + x.x + 0.5 * x.y * x.z; }));
  CellField source = grid.cell_field(), value = grid.cell_field();
  const auto exact = [](const Vector3& x) { return std::sin(pi * x.x) * std::sin(pi * x.y) * std::sin(pi * x.z); };
  for_each_cell(grid, [&](int i, int j, int k, std::size_t c) {
    const Vector3 x = grid.centre(i, j, k);
    const double coefficient = 1 + x.x + 0.5 * x.y * x.z;
    const double gradient = pi * (std::cos(pi * x.x) * std::sin(pi * x.y) * std::sin(pi * x.z) +
                                  0.5 * x.z * std::sin(pi * x.x) * std::cos(pi * x.y) * std::sin(pi * x.z) +
                                  0.5 * x.y * std::sin(pi * x.x) * std::sin(pi * x.y) * std::cos(pi * x.z));
    source[c] = grid.volume() * (coefficient * 3 * pi * pi * exact(x) - gradient);
  });
  solver.solve(team, source, value, {.tolerance = 1e-10});
  double error = 0;
  for_each_cell(grid, [&](int i, int j, int k, std::size_t c) {
    error = std::max(error, std::abs(value[c] - exact(grid.centre(i, j, k))));
  });
  return error;
}

TEST(PoissonSolver, ConvergesWithSecondOrderToAManufacturedSolution) {
  const double coarse = max_error(12), fine = max_error(24);
  EXPECT_LT(fine, 2e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1);
}

/// A box with a plate across it that has a slit, coefficients from 0.01 to 1 at random, and sources at random.
struct Silo {
  std::array<bool, 3> periodic;
  Grid grid{.count = {20, 4, 30}, .low = {0, 0, 0}, .spacing = {0.1, 0.1, 0.1}};
  FaceField conductance;
  CellField source;

  Silo(bool open_top, bool slit, std::array<bool, 3> periodic_axes = {false, true, false}) : periodic(periodic_axes) {
    Random random(7);
    conductance =
        conductances(grid, false, periodic, [&](const Vector3&) { return std::pow(10.0, -2 * random.uniform()); });
    const auto [nx, ny, nz] = grid.count;
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        if (!(slit && i >= 7 && i < 13)) conductance[2][grid.index(i, j, 13)] = 0;
        if (open_top) conductance[2][grid.index(i, j, nz)] = 0.2;
      }
    for (int k = 0; k < nz; ++k) {
      for (int i = 0; i < nx && periodic[1]; ++i)
        conductance[1][grid.index(i, ny, k)] = conductance[1][grid.index(i, 0, k)];
      for (int j = 0; j < ny && periodic[0]; ++j)
        conductance[0][grid.index(nx, j, k)] = conductance[0][grid.index(0, j, k)];
    }
    source = grid.cell_field();
    for_each_cell(grid, [&](int, int, int, std::size_t c) { source[c] = random.uniform() - 0.5; });
    if (!open_top) balance(0, slit ? nz : 13), balance(slit ? nz : 13, nz);
  }

  void balance(int from, int to) {
    double total = 0;
    int cells = 0;
    for_each_cell(grid, [&](int, int, int k, std::size_t c) {
      if (k >= from && k < to) total += source[c], ++cells;
    });
    for_each_cell(grid, [&](int, int, int k, std::size_t c) {
      if (k >= from && k < to) source[c] -= total / cells;
    });
  }

  CellField solve(int threads, double tolerance, int* iterations = nullptr, CellField value = {}) const {
    ThreadTeam team(threads);
    PoissonSolver solver(grid, periodic);
    solver.set_conductance(team, conductance);
    if (value.empty()) value = grid.cell_field();
    const auto outcome = solver.solve(team, source, value, {.tolerance = tolerance});
    if (iterations) *iterations = outcome.iterations;
    return value;
  }

  /// Red-black successive over-relaxation, the paper's way: the independent reference.
  CellField relax(double factor, int sweeps) const {
    CellField value = grid.cell_field();
    const std::array<int, 3> count = grid.count;
    for (int sweep = 0; sweep < sweeps; ++sweep)
      for (int colour = 0; colour < 2; ++colour)
        for_each_cell(grid, [&](int i, int j, int k, std::size_t c) {
          if (((i + j + k) & 1) != colour) return;
          double flow = source[c], diagonal = 0;
          for (int axis = 0; axis < 3; ++axis)
            for (const int side : {0, 1}) {
              const auto a = static_cast<std::size_t>(axis);
              std::array<int, 3> to{i, j, k};
              to[a] += side;
              const double g = conductance[a][grid.index(to[0], to[1], to[2])];
              to[a] += side - 1;
              diagonal += g;
              if (periodic[a]) to[a] = (to[a] + count[a]) % count[a];
              if (to[a] >= 0 && to[a] < count[a]) flow += g * value[grid.index(to[0], to[1], to[2])];
            }
          value[c] += factor * (flow / diagonal - value[c]);
        });
    return value;
  }
};

/// Largest difference over the largest value.
double relative_difference(const Grid& grid, const CellField& a, const CellField& b) {
  double difference = 0, largest = 0;
  for_each_cell(grid, [&](int, int, int, std::size_t c) {
    difference = std::fmax(difference, std::abs(a[c] - b[c]));
    largest = std::fmax(largest, std::abs(a[c]));
    EXPECT_TRUE(std::isfinite(a[c]) && std::isfinite(b[c]));
  });
  return difference / largest;
}

double mean(const Grid& grid, const CellField& value, int from, int to) {
  double total = 0;
  int cells = 0;
  for_each_cell(grid, [&](int, int, int k, std::size_t c) {
    if (k >= from && k < to) total += value[c], ++cells;
  });
  return total / cells;
}

TEST(PoissonSolver, AgreesWithRelaxationThroughASlit) {
  const Silo silo(true, true);
  EXPECT_LT(relative_difference(silo.grid, silo.solve(1, 1e-9), silo.relax(1.95, 3000)), 1e-6);
}

TEST(PoissonSolver, AgreesWithRelaxationOnAPeriodicBox) {
  const Silo silo(false, true, {true, true, false});
  CellField relaxed = silo.relax(1.8, 4000);
  const double shift = mean(silo.grid, relaxed, 0, 30);
  for (double& v : relaxed) v -= shift;
  EXPECT_LT(relative_difference(silo.grid, silo.solve(1, 1e-9), relaxed), 1e-6);
}

TEST(PoissonSolver, GivesClosedRegionsAMeanOfZeroEach) {
  const Silo silo(false, false);
  const CellField value = silo.solve(1, 1e-10);
  const CellField relaxed = silo.relax(1.8, 4000);
  EXPECT_NEAR(mean(silo.grid, value, 0, 13), 0, 1e-12);
  EXPECT_NEAR(mean(silo.grid, value, 13, 30), 0, 1e-12);
  // Each region's value agrees with the relaxation's up to that region's constant.
  const double below = mean(silo.grid, relaxed, 0, 13), above = mean(silo.grid, relaxed, 13, 30);
  CellField shifted = relaxed;
  for_each_cell(silo.grid, [&](int, int, int k, std::size_t c) { shifted[c] -= k < 13 ? below : above; });
  EXPECT_LT(relative_difference(silo.grid, value, shifted), 1e-6);
}

TEST(PoissonSolver, RefusesSourcesThatDoNotBalanceInAClosedRegion) {
  Silo silo(false, false);
  silo.source[silo.grid.index(3, 2, 20)] += 0.5;
  try {
    silo.solve(1, 1e-8);
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("do not balance"));
  }
}

TEST(PoissonSolver, FindsTheLevelOfARegionBehindABedThatHardlyLetsAirThrough) {
  // All that the lower half emits leaves by the middle, whose conductance is 1e-8 of the others': less than single
  // precision holds beside them.
  const Grid grid{.count = {16, 1, 16}, .low = {}, .spacing = {1, 1, 1}};
  FaceField faces = conductances(grid, false, not_periodic, [](const Vector3&) { return 1.0; });
  for (int i = 0; i < 16; ++i) {
    faces[2][grid.index(i, 0, 8)] = 1e-8;
    faces[2][grid.index(i, 0, 16)] = 2;
  }
  ThreadTeam team;
  PoissonSolver solver(grid, not_periodic);
  solver.set_conductance(team, faces);
  Random random(2);
  CellField source = grid.cell_field(), value = grid.cell_field();
  double emitted = 0, passed = 0;
  for_each_cell(grid, [&](int, int, int k, std::size_t c) {
    source[c] = random.uniform(0, 1);
    if (k < 8) emitted += source[c];
  });
  solver.solve(team, source, value, {.tolerance = 1e-6});
  for (int i = 0; i < 16; ++i) passed += 1e-8 * (value[grid.index(i, 0, 7)] - value[grid.index(i, 0, 8)]);
  EXPECT_NEAR(passed, emitted, 1e-5 * emitted);
}

TEST(PoissonSolver, NamesTheWorstCellWhenItDoesNotConverge) {
  const Silo silo(true, true);
  ThreadTeam team;
  PoissonSolver solver(silo.grid, silo.periodic);
  solver.set_conductance(team, silo.conductance);
  CellField source = silo.grid.cell_field(), value = silo.grid.cell_field();
  source[silo.grid.index(4, 1, 22)] = 1;
  try {
    solver.solve(team, source, value, {.tolerance = 1e-6, .max_iterations = 0});
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.report().place, testing::HasSubstr("(4, 1, 22)"));
    EXPECT_THAT(error.report().term, testing::HasSubstr("residual"));
  }
}

TEST(PoissonSolver, NeedsFewIterationsAndFewerFromAGoodGuess) {
  const Silo silo(true, true);
  int cold = 0, warm = 0;
  CellField value = silo.solve(1, 1e-6, &cold);
  for (double& v : value) v *= 1.001;
  silo.solve(1, 1e-6, &warm, value);
  EXPECT_LE(cold, 32);
  EXPECT_LE(warm, cold - 5);
}

/// A cone of closed faces, a staircase, in a box with an open top; it is open below and above.
FaceField cone_in_a_box(const Grid& grid) {
  FaceField faces = conductances(grid, false, not_periodic, [](const Vector3&) { return 1.0; });
  const auto inside = [&](int i, int j, int k) {
    const Vector3 x = grid.centre(i, j, k);
    return x.z > 0.3 && x.z < 0.8 && std::hypot(x.x - 0.5, x.y - 0.5) < 0.1 + 0.6 * (x.z - 0.3);
  };
  for_each_cell(grid, [&](int i, int j, int k, std::size_t c) {
    if (i > 0 && inside(i - 1, j, k) != inside(i, j, k)) faces[0][c] = 0;
    if (j > 0 && inside(i, j - 1, k) != inside(i, j, k)) faces[1][c] = 0;
    const bool is_end = k > 0 && (grid.centre(i, j, k - 1).z < 0.3 || grid.centre(i, j, k).z > 0.8);
    if (k > 0 && !is_end && inside(i, j, k - 1) != inside(i, j, k)) faces[2][c] = 0;
    if (k + 1 == grid.count[2]) faces[2][grid.index(i, j, k + 1)] = 2 / grid.spacing.x;
  });
  return faces;
}

TEST(PoissonSolver, NeedsFewIterationsBesideWallsAtAnAngle) {
  const int n = 32;
  const Grid grid{.count = {n, n, n}, .low = {}, .spacing = {1.0 / n, 1.0 / n, 1.0 / n}};
  CellField source = grid.cell_field(), value = grid.cell_field(), on_two = grid.cell_field();
  Random random(5);
  for_each_cell(grid, [&](int, int, int, std::size_t c) { source[c] = random.uniform() - 0.4; });
  ThreadTeam team, two(2);
  for (const auto& [threads, found] : {std::pair{&team, &value}, {&two, &on_two}}) {
    PoissonSolver solver(grid, not_periodic);
    solver.set_conductance(*threads, cone_in_a_box(grid));
    EXPECT_LE(solver.solve(*threads, source, *found, {.tolerance = 1e-6}).iterations, 24);
  }
  EXPECT_EQ(value, on_two);
}

TEST(PoissonSolver, GivesTheSameBitsForAnyNumberOfThreads) {
  const Silo silo(true, true);
  const CellField one = silo.solve(1, 1e-8);
  EXPECT_EQ(one, silo.solve(2, 1e-8));
  EXPECT_EQ(one, silo.solve(3, 1e-8));
}

TEST(PoissonSolver, RefusesAnOddPeriodicAxis) {
  EXPECT_THROW(PoissonSolver({.count = {5, 1, 1}, .low = {}, .spacing = {1, 1, 1}}, {true, false, false}),
               std::invalid_argument);
}

TEST(PoissonSolver, TakesAPeriodicAxisOfOneCell) {
  Grid grid{.count = {6, 1, 1}, .low = {}, .spacing = {1, 1, 1}};
  FaceField conductance = grid.face_field();
  for (int i = 0; i <= 6; ++i) conductance[0][grid.index(i, 0, 0)] = 1;
  for (int i = 0; i < 6; ++i) conductance[1][grid.index(i, 0, 0)] = conductance[1][grid.index(i, 1, 0)] = 5;
  CellField source = grid.cell_field(), value = grid.cell_field();
  for (int i = 0; i < 6; ++i) source[grid.index(i, 0, 0)] = 1;
  ThreadTeam team;
  PoissonSolver solver(grid, {false, true, true});
  solver.set_conductance(team, conductance);
  solver.solve(team, source, value, {.tolerance = 1e-12});
  // Outflow 3 through each end over conductance 1, then 2 and 1 less.
  for (const auto& [i, exact] : {std::pair{0, 3.0}, {1, 5.0}, {2, 6.0}, {3, 6.0}, {4, 5.0}, {5, 3.0}})
    EXPECT_NEAR(value[grid.index(i, 0, 0)], exact, 1e-10);
}

}  // namespace
}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
/// The pressure solver on several processes against the same on one: every bit.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "base/random.hpp"
#include "numerics/grid/poisson.hpp"
#include "ranks/petsc/processes.hpp"

namespace talus {
namespace {

/// Conductances that vary by `contrast`, walls through which nothing passes, and sources.
struct Problem {
  Grid grid;
  std::array<bool, 3> periodic{};
  FaceField conductance = grid.face_field();
  CellField source = grid.cell_field(), storage = grid.cell_field();

  /// \param is_wall (axis, i, j, k) of a low face; \param open_top whether the high faces along z are open
  template <class IsWall>
  Problem(std::array<int, 3> count, std::array<bool, 3> rings, double contrast, bool open_top, IsWall&& is_wall)
      : grid{.count = count, .low = {}, .spacing = {1, 1, 1}}, periodic(rings) {
    Random random(7);
    for_each_cell([&](int i, int j, int k, std::size_t c) {
      for (std::size_t a = 0; a < 3; ++a) {
        const int at = a == 0 ? i : a == 1 ? j : k;
        const double size = std::pow(contrast, -random.uniform());
        if ((at > 0 || rings[a]) && !is_wall(static_cast<int>(a), i, j, k)) conductance[a][c] = size;
      }
      if (open_top && k + 1 == count[2]) conductance[2][c + static_cast<std::size_t>(grid.stride(2))] = 2;
      source[c] = random.uniform() - 0.5;
    });
  }
  template <class Body>
  void for_each_cell(Body&& body) const {
    for (int k = 0; k < grid.count[2]; ++k)
      for (int j = 0; j < grid.count[1]; ++j)
        for (int i = 0; i < grid.count[0]; ++i) body(i, j, k, grid.index(i, j, k));
  }
  void vary() {
    for_each_cell([&](int i, int j, int k, std::size_t c) {
      for (auto& faces : conductance) faces[c] *= 1 + 0.1 * std::sin(0.7 * i + 1.3 * j + 0.9 * k);
      storage[c] = 1e-3 * (1 + i % 3);
    });
  }
  /// Sources of every closed region balance: what leaves a cell enters the next one along x, y or z.
  void balance() {
    source = grid.cell_field();
    for_each_cell([&](int i, int j, int k, std::size_t c) {
      for (int axis = 0; axis < 3; ++axis) {
        const int at = axis == 0 ? i : axis == 1 ? j : k;
        const auto a = static_cast<std::size_t>(axis);
        if (at == 0 || !(conductance[a][c] > 0)) continue;
        const double flow = std::sin(1.1 * i + 2.3 * j + 0.3 * k + axis);
        source[c] += flow, source[c - static_cast<std::size_t>(grid.stride(axis))] -= flow;
      }
    });
  }
};

constexpr std::size_t least_cells = 500;  // so that several levels are shared

class Solvers {
 public:
  explicit Solvers(const Problem& problem)
      : one_(problem.grid, problem.periodic), all_(problem.grid, problem.periodic, processes(), least_cells) {}

  /// Hands the solver of all processes nothing but own cells and their faces.
  void set_conductance(const Problem& problem, bool stores = false) {
    FaceField own = problem.conductance;
    for_each_other(problem, [&](std::size_t c) {
      for (int axis = 0; axis < 3; ++axis) {
        own[static_cast<std::size_t>(axis)][c] = std::nan("");
        own[static_cast<std::size_t>(axis)][c + static_cast<std::size_t>(problem.grid.stride(axis))] = std::nan("");
      }
    });
    for_each_own(problem, [&](std::size_t c) {
      for (int axis = 0; axis < 3; ++axis)
        for (const std::size_t f : {c, c + static_cast<std::size_t>(problem.grid.stride(axis))})
          own[static_cast<std::size_t>(axis)][f] = problem.conductance[static_cast<std::size_t>(axis)][f];
    });
    one_.set_conductance(team_, problem.conductance, stores ? &problem.storage : nullptr);
    all_.set_conductance(team_, own, stores ? &problem.storage : nullptr);
  }
  void expect_equal(const Problem& problem, const PoissonSolver::Stop& stop) {
    CellField source = problem.source;
    for_each_other(problem, [&](std::size_t c) { source[c] = std::nan(""); });
    const PoissonSolver::Outcome expected = one_.solve(team_, problem.source, value_, stop);
    const PoissonSolver::Outcome found = all_.solve(team_, source, own_value_, stop);
    EXPECT_EQ(found.iterations, expected.iterations);
    EXPECT_EQ(found.residual, expected.residual);
    EXPECT_GT(found.iterations, 0);
    std::size_t differing = 0;
    for_each_own(problem, [&](std::size_t c) { differing += own_value_[c] != value_[c]; });
    EXPECT_EQ(differing, 0u);
  }
  void begin(const Problem& problem) { value_ = own_value_ = problem.grid.cell_field(); }
  PoissonSolver& all() { return all_; }

 private:
  template <class Body>
  void for_each_own(const Problem& problem, Body&& body) const {
    const RowRange own = all_.slabs().own();
    problem.for_each_cell([&](int, int j, int k, std::size_t c) {
      const auto row = static_cast<std::size_t>(j + problem.grid.count[1] * k);
      if (row >= own.begin && row < own.end) body(c);
    });
  }
  template <class Body>
  void for_each_other(const Problem& problem, Body&& body) const {
    const RowRange own = all_.slabs().own();
    problem.for_each_cell([&](int, int j, int k, std::size_t c) {
      const auto row = static_cast<std::size_t>(j + problem.grid.count[1] * k);
      if (row < own.begin || row >= own.end) body(c);
    });
  }

  ThreadTeam team_;
  PoissonSolver one_, all_;
  CellField value_, own_value_;
};

/// Cold, warm after the coefficients have changed, and with storage.
void expect_same_bits(Problem problem, const PoissonSolver::Stop& stop = {.tolerance = 1e-7}) {
  Solvers solvers(problem);
  solvers.begin(problem);
  solvers.set_conductance(problem);
  solvers.expect_equal(problem, stop);
  problem.vary();
  solvers.set_conductance(problem);
  solvers.expect_equal(problem, stop);
  solvers.set_conductance(problem, true);
  solvers.expect_equal(problem, stop);
}

constexpr auto no_walls = [](int, int, int, int) { return false; };

TEST(PoissonSolverOnProcesses, OpenBox) {
  expect_same_bits(Problem({130, 4, 40}, {}, 30, true, no_walls));
}

TEST(PoissonSolverOnProcesses, CrossSection) {
  expect_same_bits(Problem({150, 1, 90}, {}, 30, true, no_walls));
}

TEST(PoissonSolverOnProcesses, PlateWithASlit) {
  expect_same_bits(Problem({97, 5, 43}, {}, 1000, true,
                           [](int axis, int i, int, int k) { return axis == 2 && k == 17 && (i < 40 || i > 55); }));
}

TEST(PoissonSolverOnProcesses, PeriodicAlongAllAxes) {
  Problem problem({128, 4, 40}, {true, true, true}, 30, false, no_walls);
  problem.balance();
  expect_same_bits(problem);
}

TEST(PoissonSolverOnProcesses, PeriodicGridThatCannotBeCoarsened) {
  Problem problem({130, 1, 66}, {true, false, true}, 3, false, no_walls);
  problem.balance();
  expect_same_bits(problem);
}

/// A cone, whose walls part coarse cells, closed pockets that lie across the borders of slabs, and cells by themselves.
TEST(PoissonSolverOnProcesses, WallsThatPartCoarseCells) {
  const auto inside = [](int i, int j, int k) {
    return k > 6 && k < 41 && std::hypot(i - 50.0, 2.0 * j - 12.0) < 3 + 1.1 * (k - 6);
  };
  Problem problem({100, 12, 48}, {}, 30, true, [&](int axis, int i, int j, int k) {
    const int low[3] = {i - (axis == 0), j - (axis == 1), k - (axis == 2)};
    const bool by_itself =
        (i % 17 == 3 && j == 5 && k % 5 == 2) || (low[0] % 17 == 3 && low[1] == 5 && low[2] % 5 == 2);
    const bool pocket = (i < 4) != (low[0] < 4);
    return by_itself || pocket || inside(i, j, k) != inside(low[0], low[1], low[2]);
  });
  for (int k = 0; k < 48; ++k)  // the pocket has no opening
    for (int j = 0; j < 12; ++j)
      for (int i = 0; i < 4; ++i) problem.conductance[2][problem.grid.index(i, j, 48)] = 0;
  problem.balance();
  expect_same_bits(problem);
}

TEST(PoissonSolverOnProcesses, WhatSinglePrecisionDoesNotResolve) {
  Problem problem({110, 2, 60}, {}, 1, true, no_walls);
  for (int j = 0; j < 2; ++j)  // a bed that hardly lets through what the cells below it emit
    for (int i = 0; i < 110; ++i) problem.conductance[2][problem.grid.index(i, j, 30)] = 1e-8;
  for (double& source : problem.source) source += 0.5;
  expect_same_bits(problem, {.tolerance = 1e-6});
}

TEST(PoissonSolverOnProcesses, WallsThatOpen) {
  const auto plate = [](int axis, int, int, int k) { return axis == 2 && k == 21; };
  Problem shut({120, 3, 42}, {}, 30, true, plate), open({120, 3, 42}, {}, 30, true, no_walls);
  shut.balance(), open.balance();
  Solvers solvers(shut);
  solvers.begin(shut);
  for (const Problem* problem : {&shut, &open, &shut}) {
    solvers.set_conductance(*problem);
    solvers.expect_equal(*problem, {.tolerance = 1e-6});
  }
}

TEST(PoissonSolverOnProcesses, FailTogether) {
  const Problem closed({120, 3, 42}, {}, 30, false, no_walls);  // sources that do not balance
  Solvers solvers(closed);
  solvers.begin(closed);
  solvers.set_conductance(closed);
  try {
    solvers.expect_equal(closed, {});
    FAIL() << "the sources do not balance";
  } catch (const NumericalError&) {
  }
  ThreadTeam team;
  CellField value = closed.grid.cell_field();
  std::string said, expected;
  try {
    PoissonSolver one(closed.grid, closed.periodic);
    one.set_conductance(team, closed.conductance);
    one.solve(team, closed.source, value, {});
  } catch (const NumericalError& error) {
    expected = error.what();
  }
  try {
    solvers.all().solve(team, closed.source, value, {});
  } catch (const NumericalError& error) {
    said = error.what();
  }
  EXPECT_EQ(said, expected);
  EXPECT_FALSE(said.empty());
}

}  // namespace
}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
/// The air alone; among grains: test_flow_among_grains.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flow_case.hpp"

namespace talus::air {
namespace {

using std::numbers::pi;

/// Taylor & Green's decaying vortices on a periodic square of side 2 pi: largest error of the velocity, over its size,
/// at t = 0.25 and viscosity 0.1, and the share of the energy against the exact one.
struct Vortices {
  double error, energy;
};
Vortices taylor_green(int n, int steps, double upwind) {
  const double h = 2 * pi / n, nu = 0.1, end = 0.25;
  Parameters p;
  p.boundaries = all(FlowBoundary::periodic);
  p.viscosity = nu * p.density();
  p.upwind = upwind;
  p.tolerance = 1e-9;
  Case c({.count = {n, 1, n}, .low = {}, .spacing = {h, h, h}}, p);
  const auto exact = [&](const Vector3& x, double t) {
    const double decay = std::exp(-2 * nu * t);
    return Vector3{decay * std::sin(x.x) * std::cos(x.z), 0, -decay * std::cos(x.x) * std::sin(x.z)};
  };
  c.set_velocity([&](const Vector3& x) { return exact(x, 0); });
  c.begin();
  c.advance(end / steps, steps);
  EXPECT_FALSE(c.flow.is_viscosity_implicit());
  Vortices result{0, 0};
  double energy = 0;
  for_each_cell(c.grid, [&](int i, int j, int k, std::size_t f) {
    for (const int axis : {0, 2}) {
      const double u = c.state.velocity[static_cast<std::size_t>(axis)][f];
      const double right = exact(face_centre(c.grid, axis, i, j, k), end)[axis];
      result.error = std::max(result.error, std::abs(u - right));
      result.energy += u * u, energy += right * right;
    }
  });
  result.energy /= energy;
  return result;
}

TEST(AirFlow, LetsTaylorGreenVorticesDecayAsTheyShouldWithSecondOrder) {
  const Vortices coarse = taylor_green(16, 10, 0), fine = taylor_green(32, 20, 0);
  EXPECT_NEAR(fine.energy, 1, 5e-3);
  EXPECT_LT(fine.error, 5e-3);
  EXPECT_NEAR(std::log2(coarse.error / fine.error), 2, 0.2);
}

/// A cavity of side 1 whose lid moves with velocity 1 at Re 100, steady in the end: extreme velocities on its middle
/// lines. Those of the tables of Ghia, Ghia & Shin 1982 are 1.5 to 3.4 % nearer to 0 than those of Botella & Peyret
/// 1998 (Computers & Fluids 27, 421), whose spectral solution has seven digits.
struct Cavity {
  double min_u, min_w, max_w;
};
Cavity cavity(int n, double dt, double end) {
  Parameters p;
  p.boundaries = all(FlowBoundary::no_slip);
  p.boundaries.kind[2] = p.boundaries.kind[3] = FlowBoundary::periodic;
  p.boundaries.wall_velocity[5] = {1, 0, 0};
  p.viscosity = 0.01 * p.density();
  p.upwind = 0;
  Case c({.count = {n, 1, n}, .low = {}, .spacing = {1.0 / n, 1.0 / n, 1.0 / n}}, p);
  c.begin();
  c.advance(dt, static_cast<int>(std::lround(end / dt)));
  Cavity extremes{0, 0, 0};
  for (int m = 0; m < n; ++m) {
    const double w = c.state.velocity[2][c.grid.index(m, 0, n / 2)];
    extremes.min_u = std::min(extremes.min_u, c.state.velocity[0][c.grid.index(n / 2, 0, m)]);
    extremes.min_w = std::min(extremes.min_w, w);
    extremes.max_w = std::max(extremes.max_w, w);
  }
  return extremes;
}

/// On 128 cells: validation/cavity.
TEST(AirFlow, DrivenCavityComesNearGhiasOnACoarseGrid) {
  const Cavity coarse = cavity(20, 0.025, 12.5);
  EXPECT_NEAR(coarse.min_u / -0.21090, 1, 0.05);
  EXPECT_NEAR(coarse.min_w / -0.24533, 1, 0.05);
  EXPECT_NEAR(coarse.max_w / 0.17527, 1, 0.05);
}

/// Mean of a plane Poiseuille flow along x between rough walls over the exact one. It creeps: what open ends take from
/// the pressure does not count.
double poiseuille_flow(double steps_over_limit, bool& implicit) {
  const int n = 8;
  const double height = 1e-3, h = height / n, mu = 0.01, drop = 0.02, length = 4 * h;
  Parameters p;
  p.boundaries = all(FlowBoundary::no_slip);
  p.boundaries.kind[0] = p.boundaries.kind[1] = FlowBoundary::open;
  p.boundaries.kind[2] = p.boundaries.kind[3] = FlowBoundary::periodic;
  p.boundaries.pressure[0] = drop;
  p.viscosity = mu;
  p.tolerance = 1e-9;
  Case c({.count = {4, 1, n}, .low = {}, .spacing = {h, h, h}}, p);
  c.begin();
  const double dt = steps_over_limit * h * h / (12 * mu / p.density());
  c.advance(dt, static_cast<int>(std::ceil(2 * height * height * p.density() / mu / dt)));
  implicit = c.flow.is_viscosity_implicit();
  double mean = 0;
  for (int k = 0; k < n; ++k) mean += c.state.velocity[0][c.grid.index(2, 0, k)] / n;
  return mean / (drop / length * height * height / (12 * mu));
}

TEST(AirFlow, PoiseuilleFlowIsThatOfTheFormulaWithEitherViscosity) {
  // On n cells the parabola is lifted by the wall's half cells: the mean is 1 + 2/n^2 times the exact one.
  bool implicit = true;
  EXPECT_NEAR(poiseuille_flow(0.9, implicit), 1 + 2 / 64.0, 1e-3);
  EXPECT_FALSE(implicit);
  EXPECT_NEAR(poiseuille_flow(30, implicit), 1 + 2 / 64.0, 1e-3);
  EXPECT_TRUE(implicit);
}

}  // namespace
}  // namespace talus::air

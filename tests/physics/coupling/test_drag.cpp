// SPDX-License-Identifier: Apache-2.0
#include "physics/coupling/drag.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace talus::coupling {
namespace {

constexpr DragMedium glass_in_air{.density = 1.204, .viscosity = 1.82e-5, .diameter = 200e-6, .slip_factor = 1};
constexpr double gravity = 9.81, grain_density = 2500;

/// Pressure gradient across a fixed bed: Phi dP/dz = beta u with u = U/Phi.
double pressure_gradient(DragLaw law, double void_fraction, double superficial) {
  const double velocity = superficial / void_fraction;
  return drag_coefficient(law, glass_in_air, 1 - void_fraction, velocity) * velocity / void_fraction;
}

TEST(Drag, OfAFixedBedIsThatOfTheClosedFormulas) {
  EXPECT_NEAR(pressure_gradient(DragLaw::schiller_naumann_umekage_yuu, 0.4, 0.01), 2152, 1);
  EXPECT_NEAR(pressure_gradient(DragLaw::ergun_wen_yu, 0.4, 0.01), 3849, 1);
  // Ergun 1952 in its own form.
  const double u = 0.01, d = 200e-6, mu = 1.82e-5, rho = 1.204, e = 0.4;
  const double ergun =
      150 * mu * (1 - e) * (1 - e) * u / (e * e * e * d * d) + 1.75 * rho * (1 - e) * u * u / (e * e * e * d);
  EXPECT_NEAR(pressure_gradient(DragLaw::ergun_wen_yu, 0.4, 0.01), ergun, 1e-9 * ergun);
}

/// Superficial velocity at which the pressure bears the bed.
double minimum_fluidisation(DragLaw law) {
  const double weight = (grain_density - glass_in_air.density) * gravity * 0.6;
  double low = 0, high = 1;
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    (pressure_gradient(law, 0.4, middle) < weight ? low : high) = middle;
  }
  return low;
}

TEST(Drag, LiftsABedAtTheKnownVelocities) {
  EXPECT_NEAR(minimum_fluidisation(DragLaw::schiller_naumann_umekage_yuu), 0.059, 5e-4);
  EXPECT_NEAR(minimum_fluidisation(DragLaw::ergun_wen_yu), 0.038, 5e-4);
}

/// Velocity at which the drag of a single bead is its weight.
double terminal_velocity(DragLaw law, const DragMedium& air, double density_difference) {
  const double dilute = 1e-9;
  double low = 0, high = 3;
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    const bool is_slower = drag_coefficient(law, air, dilute, middle) * middle / dilute < density_difference * gravity;
    (is_slower ? low : high) = middle;
  }
  return low;
}

TEST(Drag, OfASingleGrainIsThatOfSchillerAndNaumannInBothLaws) {
  DragMedium round = glass_in_air;
  round.density = 1.2;
  for (const DragLaw law : {DragLaw::schiller_naumann_umekage_yuu, DragLaw::ergun_wen_yu}) {
    // Stokes' drag at small slip.
    const double volume = std::numbers::pi / 6 * std::pow(200e-6, 3);
    EXPECT_NEAR(drag_coefficient(law, glass_in_air, 1e-9, 1e-9) / 1e-9 * volume,
                3 * std::numbers::pi * 1.82e-5 * 200e-6, 1e-12);
    // 1.413 m/s at 1.2 kg/m^3 without buoyancy, 1.411 with both.
    EXPECT_NEAR(terminal_velocity(law, round, grain_density), 1.4132, 1e-4);
    EXPECT_NEAR(terminal_velocity(law, glass_in_air, grain_density - glass_in_air.density), 1.4114, 1e-4);
  }
}

TEST(Drag, OfManyGrainsIsEquation20) {
  const double solid = 0.5, slip = 0.3;
  const double reynolds = 200e-6 * slip * 1.204 / 1.82e-5;
  const double n = solid / (std::numbers::pi / 6 * 8e-12);  // grains per volume
  const double zeta = 3.8 - 5.4 / 0.5 + 2.6 / 0.25;
  DragMedium thin = glass_in_air;
  thin.slip_factor = 12;
  const double printed =
      3 * std::numbers::pi * 1.82e-5 * 200e-6 * (1 + 0.15 * std::pow(reynolds, 0.687)) * n * zeta / 12;
  EXPECT_NEAR(schiller_naumann_umekage_yuu(thin, solid, slip), printed, 1e-12 * printed);
}

TEST(Drag, NeighboursRaiseItFromThatOfASingleGrain) {
  EXPECT_NEAR(umekage_yuu(1), 1, 1e-12);
  EXPECT_NEAR(umekage_yuu(0.4), 6.55, 1e-12);
}

TEST(SlipDecay, IsTheExactSolution) {
  // rho Phi du/dt = -beta (u - u_p) + rho Phi f in many small steps of Heun's method.
  const double u_p = -0.7, f = 3, t_slip = 15e-6, dt = 40e-6;
  double u = 0.4;
  const int steps = 4000;
  const auto rate = [&](double v) { return (u_p - v) / t_slip + f; };
  for (int n = 0; n < steps; ++n) {
    const double h = dt / steps, k = rate(u);
    u += 0.5 * h * (k + rate(u + h * k));
  }
  const SlipDecay exact = slip_decay(dt / t_slip);
  EXPECT_NEAR(u_p + exact.decay * (0.4 - u_p) + exact.mean * dt * f, u, 1e-7);
  EXPECT_EQ(slip_decay(0).decay, 1);
  EXPECT_EQ(slip_decay(0).mean, 1);
  EXPECT_NEAR(slip_decay(1e4).mean, 1e-4, 1e-15);
}

}  // namespace
}  // namespace talus::coupling

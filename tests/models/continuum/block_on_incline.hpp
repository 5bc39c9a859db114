// SPDX-License-Identifier: Apache-2.0
/// A block of particles on an incline, whatever the incline is made of.
#pragma once

#include <gtest/gtest.h>

#include "models/continuum/cases.hpp"

namespace talus::continuum {

/// Acceleration down the incline over 0.25 s, after 0.15 s in which the block takes hold, m/s^2.
/// \param model of a case with the incline \param one state of a single particle without it \param foot a place on the
/// incline, from which it goes down along x \param angle of the incline, rad
inline double acceleration_of_block(Continuum& model, const State& one, const Vector3& foot, double angle,
                                    ThreadTeam& team) {
  State& s = model.mutable_state();
  const auto impulses = s.patch_impulse;
  s = one;
  s.patch_impulse = impulses;
  // Ten particles in a row and three layers, half a spacing above the incline.
  const Vector3 down{std::cos(angle), 0, -std::sin(angle)}, up{std::sin(angle), 0, std::cos(angle)};
  const auto repeat = [&](auto& column) { column.assign(30, column[0]); };
  repeat(s.position), repeat(s.velocity), repeat(s.density), repeat(s.identity);
  for (auto& column : s.material.stress) repeat(column);
  for (auto& column : s.material.collisional)
    if (!column.empty()) repeat(column);
  for (auto& column : s.material.history) repeat(column);
  for (std::size_t n = 0; n < 30; ++n) {
    s.identity[n] = std::int64_t(n);
    s.position[n] = foot + Vector3{0, 0.5 * spacing, 0} + (0.3 + double(n % 10) * spacing) * down +
                    ((0.5 + double(n / 10)) * spacing) * up;
  }
  model.begin(team);
  while (s.time < 0.15) model.advance(team);
  const double first = dot(momentum(s), down) / (30 * s.mass), begin = s.time;
  while (s.time < begin + 0.25) model.advance(team);
  EXPECT_LT(norm(momentum_error(s)), 1e-11 * norm(s.gravity_impulse));
  for (const Vector3& x : s.position) EXPECT_GT(dot(x - foot, up), 0) << "through the incline";
  return (dot(momentum(s), down) / (30 * s.mass) - first) / (s.time - begin);
}

}  // namespace talus::continuum

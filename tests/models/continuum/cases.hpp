// SPDX-License-Identifier: Apache-2.0
/// Small cases for the tests of the continuum model.
#pragma once

#include <array>
#include <cmath>

#include "models/continuum/model.hpp"
#include "numerics/sph/cubic_spline.hpp"

namespace talus::continuum {

inline constexpr double spacing = 1e-2;

/// The law, collisions, viscosity and time integration of Yuu & Umekage 2011, in place of the defaults.
inline Parameters as_printed() {
  Parameters p;
  p.law = granular::YuuUmekageIsotropic::Parameters{};
  p.collisions.form = granular::Collisions::printed;
  p.sph.viscosity_alpha = 0.05;
  p.integration.method = Method::runge_kutta;
  p.integration.courant = default_courant(Method::runge_kutta);
  return p;
}

/// A frictionless box whose particles fill it along x and y to a height; elastic grains, no viscosity, no gate.
/// \param count particles along x, y, z; \param room free height above, in spacings
inline Parameters column(double x, double y, double z, double room = 0) {
  Parameters p = as_printed();
  p.box.width = x * spacing;
  p.box.depth = y * spacing;
  p.box.height = (z + room) * spacing;
  p.bed.spacing = spacing;
  p.bed.height = z * spacing;
  p.bed.packing = 0.6;
  p.law = granular::LinearElastic::Parameters{.lambda = 0.8e6, .shear_modulus = 0.6e6};
  p.collisions.form = granular::Collisions::none;
  p.sph.viscosity_alpha = 0;
  p.sph.smoothing = Smoothing::fixed;
  p.walls.friction = Friction::none;
  p.gate.opens = GateOpens::from_the_start;
  return p;
}

/// Grains that rub, bear no tension, and are fifty times softer than beads.
inline void make_granular(Parameters& p) {
  p.law = granular::DruckerPrager::Parameters{.fits = {.scale = 0.2}};
  p.sph.viscosity_alpha = 0.2;
  p.sph.smoothing = Smoothing::local;
  p.walls.friction = Friction::coulomb;
}

/// A block in the middle of empty space.
inline Parameters free_block(double x, double y, double z) {
  Parameters p = column(x, y, z);
  p.box = {.width = 1, .depth = y * spacing, .height = 10};
  p.box.left = p.box.right = p.box.front = p.box.rear = p.box.floor = p.box.top = FaceKind::open;
  p.bed.left = 0.5 - 0.5 * x * spacing;
  p.bed.right = 0.5 + 0.5 * x * spacing;
  p.bed.bottom = 5;
  return p;
}

inline double bulk_density(const Parameters& p) {
  return p.bed.packing * p.grains.density;
}

/// Sum of `term` over the places of a cubic lattice of unit spacing within three spacings of one of them.
template <class Term>
double lattice_sum(Term term) {
  double sum = 0;
  for (int i = -3; i <= 3; ++i)
    for (int j = -3; j <= 3; ++j)
      for (int k = -3; k <= 3; ++k) sum += term(i, std::sqrt(double(i * i + j * j + k * k)));
  return sum;
}

/// Moment of the kernel's gradient on the cubic lattice: divergences of stress come out larger by this factor.
/// \param smoothing_length in spacings
inline double lattice_moment(double smoothing_length = 1) {
  return lattice_sum([&](int i, double r) { return -sph::cubic_spline_slope(r, smoothing_length) * i * i; });
}

/// The kernel's sum on the cubic lattice over what it is in a continuum. \param smoothing_length in spacings
inline double lattice_density(double smoothing_length) {
  return lattice_sum([&](int, double r) { return sph::cubic_spline(r, smoothing_length); });
}

/// A column in the order of the particles at the start.
template <class T>
std::vector<T> by_identity(const State& s, const std::vector<T>& column) {
  std::vector<T> ordered(column.size());
  for (std::size_t i = 0; i < column.size(); ++i) ordered[static_cast<std::size_t>(s.identity[i])] = column[i];
  return ordered;
}

inline Vector3 momentum(const State& s) {
  Vector3 sum;
  for (const Vector3& v : s.velocity) sum += v;
  return s.mass * sum;
}

/// In a TEST the name of the type is one of Google Test's.
inline Setup setup_of(const Parameters& p) {
  return Setup(p);
}

/// The setup of a case with another speed of sound, m/s.
inline Setup setup_with(const Parameters& p, double sound_speed) {
  Setup setup(p);
  setup.sound_speed = sound_speed;
  return setup;
}

/// What the parts of a vessel received, N s. \pre no plates
inline std::span<const Vector3> vessel_impulse(const State& s) {
  return std::span(s.patch_impulse).subspan(6);
}

/// Momentum of the particles less all that they were given: zero but for round-off.
inline Vector3 momentum_error(const State& s) {
  Vector3 error = momentum(s) - s.gravity_impulse + s.damping_impulse - s.air.impulse;
  for (const Vector3& impulse : s.patch_impulse) error += impulse;
  return error;
}

/// A model at the start of its run.
inline Continuum started(const Parameters& p, ThreadTeam& team) {
  Continuum model(p);
  model.begin(team);
  return model;
}

/// Expects bitwise identical results of a run on one thread, on three, and on three from a state at half of the steps.
inline void expect_same_for_any_threads_and_resumed(const Parameters& p, int steps) {
  ThreadTeam one(1), three(3);
  Continuum a = started(p, one), b = started(p, three), resumed(p);
  for (int n = 0; n < steps / 2; ++n) a.advance(one), b.advance(three);
  resumed.mutable_state() = a.state();
  resumed.resume(three);
  for (int n = steps / 2; n < steps; ++n) a.advance(one), b.advance(three), resumed.advance(three);
  for (const Continuum* other : {&b, &resumed}) {
    EXPECT_EQ(a.state().position, other->state().position);
    EXPECT_EQ(a.state().velocity, other->state().velocity);
    EXPECT_EQ(a.state().material.stress, other->state().material.stress);
    EXPECT_EQ(a.state().patch_impulse, other->state().patch_impulse);
  }
}

/// Lets the bed settle, and go on for a while. \returns mean force on each wall over that while, N
inline std::vector<Vector3> settled_wall_forces(Continuum& model, ThreadTeam& team, double duration) {
  const State& s = model.state();
  while (s.gate_time < 0) model.advance(team);
  const auto before = s.patch_impulse;
  const double begin = s.time;
  while (s.time < begin + duration) model.advance(team);
  std::vector<Vector3> force;
  for (std::size_t w = 0; w < before.size(); ++w)
    force.push_back((1 / (s.time - begin)) * (s.patch_impulse[w] - before[w]));
  return force;
}

/// A bed on a plate with a slit.
inline Parameters small_hopper() {
  Parameters p = column(12, 2, 10, 40);
  p.plate.height = 15 * spacing;
  p.plate.slit_left = 3.6 * spacing;
  p.plate.slit_right = 8.3 * spacing;
  p.sph.viscosity_alpha = 0.2;
  p.sph.smoothing = Smoothing::local;
  p.walls.friction = Friction::coulomb;
  p.law = granular::LinearElastic::Parameters{.lambda = 4e5, .shear_modulus = 1e3};
  return p;
}

}  // namespace talus::continuum

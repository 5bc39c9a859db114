// SPDX-License-Identifier: Apache-2.0
/// The Rotne-Prager tensor split into a smooth part, which a grid can carry, and a rest without reach.
///
/// The tensor is made of derivatives of the distance r alone: (I + dd/r^2)/r = lap(r) I - grad grad r and
/// (I - 3 dd/r^2)/r^3 = -grad grad lap(r)/2, the derivatives taken in space. In its place the smooth part takes the
/// function F that r becomes when it is averaged over a window along the line,
///     F(r) = int |r - t| phi(t) dt,  phi even, of unit mass, 0 beyond 1,
/// so that F'' = 2 phi, F is even and smooth at r = 0, and F = r beyond 1: there the rest is exactly 0. The window is
///     phi(t) ~ y^(m/2) I_m(beta sqrt y),  y = 1 - t^2,
/// (Kaiser and Bessel's of order m), whose spectrum is as good as confined to wave numbers below beta; it is an entire
/// function of t^2, so that polynomials in t^2 represent the smooth part. Derivation: EQUATIONS.md.
///
/// Lengths in units of the cut-off, the distance beyond which nothing is left of the rest.
#pragma once

#include <vector>

#include "physics/hydrodynamics/mobility.hpp"

namespace talus::cloud {

class Split {
 public:
  /// \param beta width of the window's spectrum, > 0; \param order m of the window, at least 2
  Split(double beta, int order);

  /// The smooth part of (I + dd/r^2)/r. \param distance at least 0, over the cut-off
  hydrodynamics::PairMobility<double> stokeslet(double distance) const;

  /// The smooth part of (I - 3 dd/r^2)/r^3. As -grad grad h its isotropic part is -h'/r.
  hydrodynamics::PairMobility<double> dipole(double distance) const;

  /// Polynomials in v = 2 r^2 - 1, r < 1, in powers of v from 0 on: of the stokeslet's isotropic and radial parts and
  /// of the dipole's, one after the other, each of degree + 1 numbers.
  std::vector<double> polynomials(int degree) const;

 private:
  /// A derivative with respect to t^2 of the window, and of Q = (1/t) int_0^t phi.
  double window(double square, int derivative) const;
  double mean(double square, int derivative) const;

  int order_;
  std::vector<double> series_;         // of phi in y, the first power being y^m
  std::vector<double> node_, weight_;  // quadrature on [0, 1]
};

}  // namespace talus::cloud

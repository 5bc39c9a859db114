// SPDX-License-Identifier: Apache-2.0
/// The kernel's integrals over what lies beyond a wall, as seen from a particle: along every ray from the particle all
/// that is farther than the wall is taken for wall. A piece of a wall of area A at distance r, whose normal makes an
/// angle with the ray, hides the solid angle A cos/r^2; the radial integrals are known in closed form. So corners,
/// rims, thin plates and curved walls need nothing of their own.
///
/// Sources: walls by integrals of the kernel over their surface, Kulasegaram, Bonet, Lewis & Profit, Comput. Mech. 33,
/// 316 (2004); Ferrand, Laurence, Rogers, Violeau & Kassiotis, Int. J. Numer. Methods Fluids 71, 446 (2013). completed:
/// the rays, and the fields beyond the wall (models/continuum/pairs/wall_sums.hpp).
#pragma once

#include <cmath>
#include <numbers>

#include "base/simd.hpp"

namespace talus::sph {

/// Integrals from r to the end of the kernel's support: of W s^2, of -W' s^2 (1/m) and of -W' s^3. Over the whole
/// sphere 4 pi density = 1 and 4 pi/3 moment = 1.
template <class Number>
struct RadialIntegrals {
  Number density, slope, moment;
};

/// \param q r/h, any number from 0; \param inverse_h 1/m
template <class Number>
TALUS_INLINE RadialIntegrals<Number> radial_integrals(Number q, Number inverse_h) {
  // Integrals of (2-t)^m t^n up to 2 in powers of u = 2 - t, and of (1-t)^m t^n up to 1 in powers of v = 1 - t: exact
  // to the end of the support, where they vanish as a power, and never negative.
  const Number u = maximum(Number(2.0) - q, Number(0.0)), v = maximum(Number(1.0) - q, Number(0.0));
  const Number u3 = u * u * u, v3 = v * v * v;
  // Horner's rule from the last coefficient.
  const auto series = [](const Number& x, double last, auto... coefficients) {
    Number sum = last;
    ((sum = multiply_add(sum, x, Number(coefficients))), ...);
    return sum;
  };
  const Number outer_density = u3 * u * series(u, 1.0 / 6, -0.8, 1.0);
  const Number outer_slope = u3 * series(u, 0.2, -1.0, 4.0 / 3);
  const Number outer_moment = u3 * series(u, -1.0 / 6, 1.2, -3.0, 8.0 / 3);
  const Number inner_density = v3 * v * series(v, 1.0 / 6, -0.4, 0.25);
  const Number inner_slope = v3 * series(v, 0.2, -0.5, 1.0 / 3);
  const Number inner_moment = v3 * series(v, -1.0 / 6, 0.6, -0.75, 1.0 / 3);
  constexpr double factor = 1 / (4 * std::numbers::pi);
  return {factor * (outer_density - 4.0 * inner_density), factor * inverse_h * (3.0 * outer_slope - 12.0 * inner_slope),
          factor * (3.0 * outer_moment - 12.0 * inner_moment)};
}

/// Sums over the points of a smooth part of a wall, with the solid angle o of each, the unit vector e to it, its
/// distance r and its unit normal n on the side of the particle.
template <class Number>
struct WallSums {
  Number density = 0.0;    ///< sum o density: the share of the kernel that is beyond the wall
  Number slope[3] = {};    ///< sum o slope e, 1/m
  Number moment[6] = {};   ///< sum o moment e e: xx yy zz xy yz zx
  Number closing[3] = {};  ///< sum o moment e/r, 1/m
  Number normal[3] = {};   ///< sum o slope n, 1/m
  Number nearness = 0.0;   ///< sum o slope cos/r, 1/m^2
  Number weight = 0.0;     ///< sum o slope, 1/m
  Number distance = 0.0;   ///< sum o slope times the distance from the point's plane, 1

  /// \param d from the particle to a point of the wall, m; \param n the wall's unit normal, to either side; \param area
  /// that the point stands for, m^2; \param h smoothing length of the particle, m
  TALUS_INLINE void add(const Number (&d)[3], const Number (&n)[3], Number area, double h) {
    // A particle nearer to a wall than the points of the wall are to each other would feel them one by one: it is taken
    // to be a little farther from the wall's plane.
    const double blur = 0.0225 * h * h;  // (0.15 h)^2
    const Number below = multiply_add(d[0], n[0], multiply_add(d[1], n[1], d[2] * n[2]));
    const Number side = select(below > Number(0.0), Number(-1.0), Number(1.0));
    const Number level = multiply_add(below, below, Number(blur));
    const Number height = level * reciprocal_sqrt(level);
    const Number square = multiply_add(d[0], d[0], multiply_add(d[1], d[1], multiply_add(d[2], d[2], Number(blur))));
    const Number inverse = reciprocal_sqrt(square);
    const Number cosine = height * inverse, angle = area * cosine * inverse * inverse;
    const RadialIntegrals<Number> of = radial_integrals<Number>(square * inverse * (1 / h), Number(1 / h));
    const Number s = angle * of.slope, m = angle * of.moment, lift = multiply_add(side, height, below);
    const Number e[3] = {inverse * negative_multiply_add(lift, n[0], d[0]),
                         inverse * negative_multiply_add(lift, n[1], d[1]),
                         inverse * negative_multiply_add(lift, n[2], d[2])};
    const Number towards = s * side;
    density = multiply_add(angle, of.density, density);
    for (int a = 0; a < 3; ++a) {
      const Number me = m * e[a];
      slope[a] = multiply_add(s, e[a], slope[a]);
      moment[a] = multiply_add(me, e[a], moment[a]);
      moment[3 + a] = multiply_add(me, e[(a + 1) % 3], moment[3 + a]);
      closing[a] = multiply_add(me, inverse, closing[a]);
      normal[a] = multiply_add(towards, n[a], normal[a]);
    }
    nearness = multiply_add(s * cosine, inverse, nearness);
    weight = weight + s;
    distance = negative_multiply_add(towards, below, distance);
  }
};

/// The sum `weight` times h for a plane without end at a distance of q h, as `add` blurs it.
inline double weight_of_plane(double q) {
  // 2 pi q/r^2 dr is the solid angle of the ring of the plane from r to r + dr.
  constexpr int steps = 64;
  const double height = std::sqrt(q * q + 0.0225), step = (2 - height) / steps;
  double sum = 0;
  for (int n = 0; n < steps && step > 0; ++n) {
    const double r = height + (n + 0.5) * step;
    sum += radial_integrals(r, 1.0).slope / (r * r);
  }
  return 2 * std::numbers::pi * height * step * sum;
}

}  // namespace talus::sph

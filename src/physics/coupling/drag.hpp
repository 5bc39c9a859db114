// SPDX-License-Identifier: Apache-2.0
/// The drag between grains and air, S = beta (u - u_p): force on the grains in a unit volume of grains and air, whose
/// momentum balance for the air has the pressure term -Phi grad P (Yuu & Umekage 2011, Eqs 18 and 20).
#pragma once

#include <cmath>
#include <cstdint>

#include "base/elementary.hpp"

namespace talus::coupling {

enum class DragLaw : std::uint8_t {
  schiller_naumann_umekage_yuu,  ///< as Yuu & Umekage 2011 print it
  ergun_wen_yu                   ///< Gidaspow 1994
};

/// What a drag law asks of the air and of the grains.
struct DragMedium {
  double density;      ///< of the air, kg/m^3
  double viscosity;    ///< of the air, Pa s
  double diameter;     ///< of a grain, m
  double slip_factor;  ///< C_c, 1 in dense air
};

/// Re_p = D_p |u - u_p| rho / mu.
constexpr double grain_reynolds(const DragMedium& medium, double slip) {
  return (medium.diameter * medium.density / medium.viscosity) * slip;
}

/// Drag of one sphere over Stokes' drag, 1 + 0.15 Re^0.687; Re < 1000 (Schiller & Naumann 1933).
TALUS_INLINE double schiller_naumann(double reynolds) {
  return 1 + 0.15 * power_of(reynolds, 0.687);
}

/// Effect of the neighbours on the drag, 3.8 - 5.4/Phi + 2.6/Phi^2; packing below 0.74 (Umekage & Yuu 1999; Yuu &
/// Umekage 2011, Eq. 21). 1 for a single grain.
constexpr double umekage_yuu(double void_fraction) {
  const double inverse = 1 / void_fraction;
  return 3.8 + (2.6 * inverse - 5.4) * inverse;
}

/// beta of Yuu & Umekage 2011, Eqs 20 and 21: 3 pi mu D_p (1 + 0.15 Re_p^0.687) n zeta(Phi) / C_c.
/// \param solid_fraction 1 - Phi, 0 to 0.74; \param slip |u - u_p|, m/s; \returns kg/(m^3 s)
TALUS_INLINE double schiller_naumann_umekage_yuu(const DragMedium& medium, double solid_fraction, double slip) {
  // 3 pi mu D n = 18 mu (1 - Phi)/D^2
  const double stokes = 18 * medium.viscosity / (medium.diameter * medium.diameter * medium.slip_factor);
  return stokes * solid_fraction * schiller_naumann(grain_reynolds(medium, slip)) * umekage_yuu(1 - solid_fraction);
}

/// beta of Gidaspow 1994: Ergun 1952 below a void fraction of 0.8, Wen & Yu 1966 above, with a jump there;
/// the part of friction is divided by the slip factor.
/// \param solid_fraction 1 - Phi; \param slip |u - u_p|, m/s; \returns kg/(m^3 s)
TALUS_INLINE double ergun_wen_yu(const DragMedium& medium, double solid_fraction, double slip) {
  const double phi = 1 - solid_fraction, d = medium.diameter;
  const double dense = 150 * medium.viscosity / (d * d * medium.slip_factor) * solid_fraction * solid_fraction / phi +
                       1.75 * medium.density / d * solid_fraction * slip;
  // 3/4 C_d Phi (1 - Phi) rho |u - u_p| Phi^-2.65/D with C_d = 24/Re (1 + 0.15 Re^0.687) to Re = 1000, 0.44 beyond, at
  // the Reynolds number of the superficial velocity.
  const double reynolds = phi * grain_reynolds(medium, slip), weighted = solid_fraction * power_of(phi, -2.65);
  const double slow = 18 * medium.viscosity / (d * d * medium.slip_factor) * weighted * schiller_naumann(reynolds);
  const double fast = 0.75 * 0.44 * medium.density / d * phi * weighted * slip;
  const double dilute = reynolds < 1000 ? slow : fast;
  return phi < 0.8 ? dense : dilute;
}

/// beta by name of the law, kg/(m^3 s).
TALUS_INLINE double drag_coefficient(DragLaw law, const DragMedium& medium, double solid_fraction, double slip) {
  return law == DragLaw::ergun_wen_yu ? ergun_wen_yu(medium, solid_fraction, slip)
                                      : schiller_naumann_umekage_yuu(medium, solid_fraction, slip);
}

/// Whether a law was fitted to pressure drops of beds, for model A, where the grains bear a share of the pressure too.
constexpr bool is_of_pressure_drops(DragLaw law) {
  return law == DragLaw::ergun_wen_yu;
}

/// beta where drag is the only force of the air on the grains (model B), so that a bed has the same pressure drop.
/// \param beta of such a law, kg/(m^3 s). Source: Gidaspow 1994, ch. 2
constexpr double drag_alone(double beta, double void_fraction) {
  return beta / void_fraction;
}

/// Effect of drag with a constant coefficient on the air over a time dt that need not be short compared with the
/// relaxation time T = rho Phi/beta of the slip. The exact solution of rho Phi du/dt = -beta (u - u_p) + rho Phi f is
/// u(dt) = u_p + decay (u(0) - u_p) + mean dt f.
struct SlipDecay {
  double decay;  ///< exp(-dt/T)
  double mean;   ///< of the decay over dt: (1 - exp(-dt/T)) T/dt
};
/// \param steps dt/T >= 0
TALUS_INLINE SlipDecay slip_decay(double steps) {
  // 1 - exp(-steps) is inaccurate for small steps; mean_of_short_decay() holds only for those.
  const bool is_short = steps < 0.5;
  const double mean_of_short = mean_of_short_decay(is_short ? steps : 0), decay_of_long = exp_of_negative(steps);
  const double decay = is_short ? 1 - steps * mean_of_short : decay_of_long;
  return {decay, is_short ? mean_of_short : (1 - decay_of_long) / (is_short ? 1 : steps)};
}

/// Velocity of the air after dt with drag alone, u_p + decay (u - u_p), m/s.
/// \param momentum rho Phi u, kg/(m^2 s); \param per_mass 1/(rho Phi), m^3/kg; \param grain_velocity u_p, m/s
constexpr double velocity_after_drag(double decay, double momentum, double per_mass, double grain_velocity) {
  return decay * momentum * per_mass + (1 - decay) * grain_velocity;
}

/// Momentum that drag removes from the air in dt, N s/m^3.
/// \param mass rho Phi, kg/m^3; \param slip u - u_p at the start, m/s; \param gained dt f, the velocity that the other
/// forces would add without drag, m/s
constexpr double drag_impulse(double decay, double mean, double mass, double slip, double gained) {
  return mass * (slip * (1 - decay) + (1 - mean) * gained);
}

}  // namespace talus::coupling

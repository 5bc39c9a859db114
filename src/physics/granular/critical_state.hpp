// SPDX-License-Identifier: Apache-2.0
/// A critical state with hysteresis: grains that dilate or compact as they are sheared, until their packing no longer
/// changes, and that are stronger at rest than in flow.
///
///     state       phi_s, the packing at which the grains, arranged as they are, just touch; c, static contacts, 0 to 1
///     elastic     p = 3 K e_v, e_v = ln(phi/phi_s)/3;   ds/dt = 2G (-D_dev + D^p) + W s - s W
///     yield       |s| <= 2^(1/2) M p,  M = max(0, mu(I) + beta + Delta_mu c),  returned along s at constant p
///     friction    mu(I) = mu_s + (mu_2 - mu_s)/(1 + I_0/I),   I = gamma' d (rho_p/p)^(1/2),   gamma' = 2^(1/2) |D_dev|
///     dilatancy   d ln phi_s = -beta dgamma,  beta = k (phi_s - phi_c(I)),   phi_c(I) = phi_c - Delta min(I, 0.3)
///     contacts    dc/dt = (1 - c)/T - (c/gamma_0) dgamma/dt
///     apart       p = 0 and s = 0 where phi < phi_s:  phi_s follows phi down to phi_min,  c = 0
///
/// with D the rate of deformation, d the grains' diameter, s the deviator of the stress, positive in compression, and
/// dgamma = 2^(1/2) |D^p| dt the shear strain beyond yield. 2^(1/2) M p is the friction coefficient M in simple shear.
///
/// Work: of the power of shearing, |s| |D^p| = M p dgamma/dt, the pressure takes back beta p dgamma/dt for the volume
/// that opens; (mu(I) + Delta_mu c) p dgamma/dt >= 0 is left and turns into heat (-beta p dgamma/dt >= 0 where M would
/// be negative). Healing and coming apart change no stored energy.
///
/// Limits: at fixed I and p, 1/phi_s relaxes exponentially with gamma, that is, phi_s is logistic, at the rate k phi_c;
/// the stress ratio passes mu(I) + beta and ends at mu(I). At fixed phi sheared for long, p = K ln(phi/phi_c(I)), or 0.
/// With k = Delta = Delta_mu = 0 and mu_2 = mu_s it is elastic and perfectly plastic.
///
/// Sources. Dilatancy and the part of it in the friction: Roux & Radjai, Physics of Dry Granular Media (Kluwer, 1998),
/// 229; k = 4 as Pailha & Pouliquen, J. Fluid Mech. 633, 115 (2009), fitted for glass beads. mu(I): Jop, Forterre &
/// Pouliquen, Nature 441, 727 (2006), glass beads. phi_c: Chialvo, Sun & Sundaresan, Phys. Rev. E 85, 021305 (2012), at
/// a friction of 0.5 between beads. Fall of the packing with I, linear: da Cruz et al., Phys. Rev. E 72, 021309 (2005);
/// Pouliquen et al., J. Stat. Mech. P07020 (2006), 0.2 to 0.3. Strength that ages and is lost by slip: the law of
/// ageing of Dieterich and Ruina (Ruina, J. Geophys. Res. 88, 10359, 1983), with a strain in place of a length; slopes
/// of glass beads start some 2 to 5 degrees above where they stop (Forterre & Pouliquen, Annu. Rev. Fluid Mech. 40, 1,
/// 2008). Range: dry beads, I up to 0.3. completed: Delta_mu, T, gamma_0 and phi_min are choices.
#pragma once

#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/parameter.hpp"
#include "physics/granular/material_point.hpp"
#include "physics/granular/rotation.hpp"

namespace talus::granular {

class CriticalState {
 public:
  static constexpr std::string_view name = "critical-state";
  static constexpr std::string_view text =
      "elastic up to a friction that depends on rate and packing, with a strength at rest that flow takes away";
  static constexpr bool bears_tension = false;

  struct Parameters {
    double bulk_modulus = 4.9e6;      ///< K, Pa: (lambda + 2G/3) of Eqs 1-3 of Yuu & Umekage at zero strain
    double shear_modulus = 2.94e6;    ///< G, Pa: the same
    double friction = 0.38;           ///< mu_s
    double fast_friction = 0.64;      ///< mu_2
    double inertial_number = 0.279;   ///< I_0
    double reference_packing = 0.6;   ///< phi_s of a new point
    double critical_packing = 0.585;  ///< phi_c
    double loosest_packing = 0.55;    ///< phi_min
    double loosening = 0.25;          ///< Delta
    double dilatancy = 4;             ///< k
    double strength_at_rest = 0.08;   ///< Delta_mu
    double healing_time = 10e-3;      ///< T, s
    double breaking_strain = 0.05;    ///< gamma_0
  };
  template <class Visit, class P>
  static void for_each_parameter(Visit&& visit, P& p) {
    visit(Parameter{"bulk_modulus", dimension::pressure, above(0),
                    "pressure over the logarithm of the packing over that at which the grains just touch"},
          p.bulk_modulus);
    visit(Parameter{"shear_modulus", dimension::pressure, above(0), "shear modulus below yield"}, p.shear_modulus);
    visit(Parameter{"friction", dimension::none, friction_coefficient(),
                    "mu_s, friction coefficient of slow flow at the critical packing, in simple shear"},
          p.friction);
    visit(Parameter{"fast_friction", dimension::none, friction_coefficient(),
                    "mu_2, which the friction tends to at large inertial numbers; equal to friction: no dependence on "
                    "the rate"},
          p.fast_friction);
    visit(Parameter{"inertial_number", dimension::none, above(0), "I_0, at which it is half way between the two"},
          p.inertial_number);
    visit(Parameter{"reference_packing", dimension::none, between(0.1, 0.74),
                    "packing at which the grains just touch at the start; denser, they bear pressure"},
          p.reference_packing);
    visit(Parameter{"critical_packing", dimension::none, between(0.1, 0.74),
                    "phi_c, packing that slow shear leads to from any other"},
          p.critical_packing);
    visit(Parameter{"loosest_packing", dimension::none, between(0.1, 0.74),
                    "phi_min, packing below which grains that came apart do not touch again: random loose packing"},
          p.loosest_packing);
    visit(Parameter{"loosening", dimension::none, at_least(0),
                    "Delta, fall of the critical packing with the inertial number, up to I = 0.3"},
          p.loosening);
    visit(Parameter{"dilatancy", dimension::none, at_least(0),
                    "k, growth of volume per shear strain over the excess of the packing beyond the critical one"},
          p.dilatancy);
    visit(Parameter{"strength_at_rest", dimension::none, at_least(0),
                    "Delta_mu, friction that grains at rest have beyond that in flow; 0: no hysteresis"},
          p.strength_at_rest);
    auto healing = only_if({"strength_at_rest", "is 0", "above 0", p.strength_at_rest > 0}, visit);
    healing(Parameter{"healing_time", dimension::time, above(0), "T, in which grains at rest regain that strength"},
            p.healing_time);
    healing(Parameter{"breaking_strain", dimension::none, above(0), "gamma_0, shear strain by which they lose it"},
            p.breaking_strain);
  }
  /// Contradictions between keys that are each valid by themselves.
  static std::vector<Problem> check(const Parameters& parameters);

  /// \param grain_density rho_p, kg/m^3; \param grain_diameter d, m, of the inertial number
  explicit CriticalState(const Parameters& parameters, double grain_density = 2500, double grain_diameter = 200e-6);

  template <class Number>
  struct History {
    Number expansion = 0.0;  ///< reference packing over phi_s, less 1
    Number contacts = 0.0;   ///< c
  };
  template <class Visit, class H>
  static constexpr void for_each_slot(Visit&& visit, H& history) {
    visit(HistorySlot{"expansion", "1"}, history.expansion);
    visit(HistorySlot{"contacts", "1"}, history.contacts);
  }

  template <class Number>
  MaterialPoint<CriticalState, Number> update(const MaterialPoint<CriticalState, Number>& old,
                                              const Tensor3<Number>& velocity_gradient, const Number& density,
                                              double time_step) const {
    using std::log;
    using std::sqrt;
    const SymmetricTensor3<Number> rate = deviator(symmetric_part(velocity_gradient));
    // Volumes of a grain's share of space, in units of that at the reference packing: now, and just touching.
    const Number volume = reference_density_ / density;
    const auto touch = volume < 1.0 + old.history.expansion;
    const Number apart = minimum(volume, Number(largest_volume_));
    const Number touching = select(touch, 1.0 + old.history.expansion, maximum(1.0 + old.history.expansion, apart));
    const Number pressure = select(touch, parameters_.bulk_modulus * log(touching / volume), Number(0.0));

    const Number inertial = grain_inertia_ * norm(rate) / sqrt(maximum(pressure, Number(tiny)));
    const Number critical_volume =
        parameters_.reference_packing /
        (parameters_.critical_packing - parameters_.loosening * minimum(inertial, Number(largest_inertial_number)));
    const Number dilatancy =
        (parameters_.dilatancy * parameters_.reference_packing) * (1.0 / touching - 1.0 / critical_volume);
    const Number friction =
        parameters_.friction +
        (parameters_.fast_friction - parameters_.friction) * (inertial / (inertial + parameters_.inertial_number)) +
        dilatancy + parameters_.strength_at_rest * old.history.contacts;

    const SymmetricTensor3<Number> trial =
        transformed(deviator(old.stress), rotation_of_step(velocity_gradient, time_step)) -
        (2 * parameters_.shear_modulus * time_step) * rate;
    const Number size = norm(trial);
    const Number most = (sqrt2 * maximum(friction, Number(0.0))) * pressure;
    const Number slip = (1 / (sqrt2 * parameters_.shear_modulus)) * maximum(size - most, Number(0.0));

    MaterialPoint<CriticalState, Number> point;
    point.stress = isotropic(pressure) + (minimum(size, most) / maximum(size, Number(tiny))) * trial;
    // d(1/phi_s)/dgamma = k (1 - phi_c/phi_s), implicit: it cannot pass the critical packing.
    const Number dilation = (parameters_.dilatancy * parameters_.reference_packing) * slip;
    point.history.expansion = select(touch, (touching + dilation) / (1.0 + dilation / critical_volume), touching) - 1.0;
    const double healing = time_step / parameters_.healing_time;
    point.history.contacts =
        select(touch, (old.history.contacts + healing) / (1.0 + healing + (1 / parameters_.breaking_strain) * slip),
               Number(0.0));
    return point;
  }

  /// c = ((K + 4G/3)/rho_b)^(1/2), m/s.
  double sound_speed(double density) const;
  /// Any dry beads, up to that inertial number.
  LawRange range() const { return {.largest_inertial_number = largest_inertial_number}; }
  const Parameters& parameters() const { return parameters_; }

 private:
  static constexpr double sqrt2 = 1.4142135623730951;
  static constexpr double tiny = 1e-30;
  static constexpr double largest_inertial_number = 0.3;  // to which the packing is known to fall in proportion

  Parameters parameters_;
  double reference_density_;  // kg/m^3
  double largest_volume_;     // at phi_min
  double grain_inertia_;      // (2 rho_p)^(1/2) d: I over |D_dev| p^(-1/2)
};

static_assert(ConstitutiveLaw<CriticalState>);

}  // namespace talus::granular

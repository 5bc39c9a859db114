// SPDX-License-Identifier: Apache-2.0
/// A critical state with hysteresis: grains that dilate or compact as they are sheared, until their packing no longer
/// changes, and that are stronger at rest than in flow; on request they stick together.
///
///     state       phi_s, the packing at which the grains, arranged as they are, just touch; c, static contacts, 0 to 1
///                 a, the tensile strength of the grains together
///     elastic     p = 3 K e_v, e_v = ln(phi/phi_s)/3;   ds/dt = 2G (-D_dev + D^p) + W s - s W
///     yield       |s| <= 2^(1/2) M p,  M = max(0, beta, mu(I) + b beta + r),  returned along s at constant p
///     at rest     r = Delta_mu c,  or max(0, Delta_mu c - max(0, b beta)) if it does not add to b beta
///     friction    mu(I) = mu_s + (mu_2 - mu_s)/(1 + I_0/I),   I = gamma' d (rho_p/p)^(1/2),   gamma' = 2^(1/2) |D_dev|
///     dilatancy   d ln phi_s = -beta dgamma,  beta = k (phi_s - phi_c(I)),   phi_c(I) = phi_c - Delta min(I, 0.3)
///     contacts    dc/dt = (1 - c)/T - (c/gamma_0) dgamma/dt
///     apart       p = 0 and s = 0 where phi < phi_s:  phi_s follows phi down to phi_min,  c = 0
///     cohesion    p + a in place of p in yield and I;  a >= a_0 + kappa p where p > 0;
///                 da/dgamma = (a_0 + kappa p - a)/gamma_c,  -a/gamma_c where p <= 0;  apart where p < -a:  a = 0
///
/// with D the rate of deformation, d the grains' diameter, s the deviator of the stress, positive in compression, and
/// dgamma = 2^(1/2) |D^p| dt the shear strain beyond yield. 2^(1/2) M p is the friction coefficient M in simple shear.
/// Cohesion moves the cone's apex to -a: cohesion M a in simple shear. A load strengthens; shear breaks bonds, which
/// form again under the load that there is, and under tension not at all; a crack takes all. Off unless a_0 or kappa is
/// given: to the bit. Grains that are pulled at do not compact by shear, which would be work for nothing.
///
/// Work: of the power of shearing, |s| |D^p| = M p dgamma/dt, the pressure takes back beta p dgamma/dt for the volume
/// that opens; (M - beta) p dgamma/dt >= 0 is left and turns into heat, (mu(I) + r) p dgamma/dt with b = 1.
/// Ageing and coming apart change no stored energy.
///
/// Limits: at fixed I and p, 1/phi_s relaxes exponentially with gamma, that is, phi_s is logistic, at the rate k phi_c;
/// the stress ratio passes mu(I) + b beta and ends at mu(I). At fixed phi sheared for long, p = K ln(phi/phi_c(I)), or
/// 0. With k = Delta = Delta_mu = 0 and mu_2 = mu_s it is elastic and perfectly plastic.
///
/// Sources. Dilatancy and the part of it in the friction: Roux & Radjai, Physics of Dry Granular Media (Kluwer, 1998),
/// 229; k = 4 as Pailha & Pouliquen, J. Fluid Mech. 633, 115 (2009), fitted for glass beads; k = 8 to 10 and b = 0.5 of
/// discrete elements: validation/bead-shear. mu(I): Jop, Forterre & Pouliquen, Nature 441, 727 (2006), glass beads.
/// phi_c: Chialvo, Sun & Sundaresan, Phys. Rev. E 85, 021305 (2012), at a friction of 0.5 between beads. Fall of the
/// packing with I, linear: da Cruz et al., Phys. Rev. E 72, 021309 (2005); Pouliquen et al., J. Stat. Mech. P07020
/// (2006), 0.2 to 0.3. Strength that ages and is lost by slip: the law of ageing of Dieterich and Ruina (Ruina, J.
/// Geophys. Res. 88, 10359, 1983), with a strain in place of a length; slopes of glass beads start some 2 to 5 degrees
/// above where they stop (Forterre & Pouliquen, Annu. Rev. Fluid Mech. 40, 1, 2008). Range: dry beads, I up to 0.3.
/// completed: Delta_mu, T, gamma_0 and phi_min are choices.
/// Cohesion: strength in proportion to consolidation, Jenike, Storage and Flow of Solids, Bulletin 123 (Utah, 1964);
/// p + a in I, Berger, Azema, Douce & Radjai, EPL 112, 64004 (2015). completed: how shear and cracks take it away.
#pragma once

#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/parameter.hpp"
#include "physics/granular/critical_state_point.hpp"
#include "physics/granular/material_point.hpp"

namespace talus::granular {

class CriticalState {
 public:
  static constexpr std::string_view name = "critical-state";
  static constexpr std::string_view text =
      "elastic up to a friction that depends on rate and packing, with a strength at rest that flow takes away";

  using Parameters = CriticalStateParameters;
  static constexpr bool bears_tension(const Parameters& p) { return p.has_cohesion(); }
  template <class Visit, class P>
  static void for_each_parameter(Visit&& visit, P& p) {
    visit(Parameter{"bulk_modulus", dimension::pressure, above(0),
                    "pressure over the logarithm of the packing over that at which the grains just touch; left out: a "
                    "thousand times the weight of the bed over its area (talus law and a bed without weight: 4.9 MPa)"},
          p.bulk_modulus);
    visit(
        Parameter{
            "shear_modulus", dimension::pressure, above(0),
            "shear modulus below yield; left out: 0.6 times bulk_modulus, of a material of EN 1991-4 so that its bed "
            "at rest has K = 1 - sin phi_i"},
        p.shear_modulus);
    visit(Parameter{"static_friction", dimension::none, friction_coefficient(),
                    "mu_s, friction coefficient of slow flow at the critical packing, in simple shear"},
          p.static_friction);
    visit(
        Parameter{
            "dynamic_friction", dimension::none, friction_coefficient(),
            "mu_2, which the friction tends to at large inertial numbers; equal to static_friction: no dependence on "
            "the rate"},
        p.dynamic_friction);
    visit(Parameter{"inertial_number", dimension::none, above(0), "I_0, at which it is half way between the two"},
          p.inertial_number);
    visit(Parameter{"reference_packing", dimension::none, between(0.1, 0.74),
                    "packing at which the grains just touch at the start; denser, they bear pressure; left out: "
                    "bed.packing (talus law and a bed looser than random_loose_packing: 0.6)"},
          p.reference_packing);
    visit(Parameter{"critical_packing", dimension::none, between(0.1, 0.74),
                    "phi_c, packing that slow shear leads to from any other"},
          p.critical_packing);
    visit(Parameter{"random_loose_packing", dimension::none, between(0.1, 0.74),
                    "phi_min, packing below which grains that came apart do not touch again: random loose packing"},
          p.random_loose_packing);
    visit(Parameter{"packing_slope", dimension::none, at_least(0),
                    "Delta, fall of the critical packing with the inertial number, up to I = 0.3"},
          p.packing_slope);
    visit(Parameter{"dilatancy", dimension::none, at_least(0),
                    "k, growth of volume per shear strain over the excess of the packing beyond the critical one"},
          p.dilatancy);
    visit(Parameter{"dilatant_friction", dimension::none, between(0, 1),
                    "b, friction beyond that of the critical packing over the growth of volume per shear strain"},
          p.dilatant_friction);
    visit(Parameter{"ageing_strength", dimension::none, at_least(0),
                    "Delta_mu, friction that grains at rest have beyond that in flow; 0: no hysteresis"},
          p.ageing_strength);
    auto ageing = only_if({"ageing_strength", "is 0", "above 0", p.ageing_strength > 0}, visit);
    ageing(Parameter{"ageing_adds",
                     {},
                     {},
                     "whether Delta_mu adds to the friction that a packing beyond the critical one gives, b beta, or "
                     "counts only as far as it is more, as layers and heaps of beads have it"},
           p.ageing_adds);
    ageing(Parameter{"ageing_time", dimension::time, above(0), "T, in which grains at rest regain that strength"},
           p.ageing_time);
    ageing(Parameter{"ageing_strain", dimension::none, above(0), "gamma_0, shear strain by which they lose it"},
           p.ageing_strain);
    visit(Parameter{"tensile_strength", dimension::pressure, at_least(0),
                    "a_0, mean tension that grains bear which touch, whatever load they have borne; their cohesion in "
                    "simple shear is static_friction times it; 0: none"},
          p.tensile_strength);
    visit(Parameter{"consolidation_strength", dimension::none, between(0, 1),
                    "kappa, tensile strength that a load adds over its mean pressure; 0: none"},
          p.consolidation_strength);
    auto consolidates = only_if({"consolidation_strength", "is 0", "above 0", p.consolidation_strength > 0}, visit);
    consolidates(Parameter{"consolidation", dimension::pressure, at_least(0),
                           "p_c, largest mean pressure that the grains have borne before the start"},
                 p.consolidation);
    auto cohesive =
        only_if({"tensile_strength", "and consolidation_strength are 0", "one above 0", p.has_cohesion()}, visit);
    cohesive(Parameter{"cohesion_strain", dimension::none, above(0),
                       "gamma_c, shear strain in which bonds break: what is left is the strength that the load of the "
                       "moment gives, under tension none"},
             p.cohesion_strain);
  }
  /// Contradictions between keys that are each valid by themselves.
  static std::vector<Problem> check(const Parameters& parameters);

  /// \param grain_density rho_p, kg/m^3; \param grain_diameter d, m, of the inertial number
  explicit CriticalState(const Parameters& parameters, double grain_density = 2500, double grain_diameter = 200e-6);

  template <class Number>
  struct History {
    Number expansion = 0.0;      ///< reference packing over phi_s, less 1
    Number contacts = 0.0;       ///< c
    Number strengthening = 0.0;  ///< a less that at the start, Pa
  };
  template <class Visit, class H>
  static constexpr void for_each_slot(Visit&& visit, H& history) {
    visit(HistorySlot{"expansion", "1"}, history.expansion);
    visit(HistorySlot{"contacts", "1"}, history.contacts);
    visit(HistorySlot{"strengthening", "Pa", 0, 0, true}, history.strengthening);
  }

  template <class Number>
  MaterialPoint<CriticalState, Number> update(const MaterialPoint<CriticalState, Number>& old,
                                              const Tensor3<Number>& velocity_gradient, const Number& density,
                                              double time_step) const {
    const CriticalStatePoint<Number> point =
        updated(coefficients_, {old.stress, old.history.expansion, old.history.contacts, old.history.strengthening},
                velocity_gradient, density, time_step);
    return {point.stress, {point.expansion, point.contacts, point.strengthening}};
  }
  const CriticalStateCoefficients& coefficients() const { return coefficients_; }
  /// Whether the law with these parameters reads and writes a slot of the history.
  bool uses_slot(std::size_t slot) const { return slot < 2 || parameters_.has_cohesion(); }

  /// c = ((K + 4G/3)/rho_b)^(1/2), m/s.
  double sound_speed(double density) const;
  /// Any dry beads, up to that inertial number.
  LawRange range() const { return {.max_inertial_number = CriticalStateCoefficients::max_inertial_number}; }
  const Parameters& parameters() const { return parameters_; }

 private:
  Parameters parameters_;
  CriticalStateCoefficients coefficients_;
};

static_assert(ConstitutiveLaw<CriticalState>);

}  // namespace talus::granular

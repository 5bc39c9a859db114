// SPDX-License-Identifier: Apache-2.0
/// The arithmetic of the law critical_state.hpp, without its keys: what loops in vectors, compiled once for each
/// instruction set, need of it.
#pragma once

#include <cmath>

#include "base/elementary.hpp"
#include "base/tensor.hpp"
#include "physics/granular/kinematics.hpp"

namespace talus::granular {

struct CriticalStateParameters {
  double bulk_modulus = 4.9e6;         ///< K, Pa: (lambda + 2G/3) of Eqs 1-3 of Yuu & Umekage at zero strain
  double shear_modulus = 2.94e6;       ///< G, Pa: the same
  double static_friction = 0.38;       ///< mu_s
  double dynamic_friction = 0.64;      ///< mu_2
  double inertial_number = 0.279;      ///< I_0
  double reference_packing = 0.6;      ///< phi_s of a new point
  double critical_packing = 0.585;     ///< phi_c
  double random_loose_packing = 0.55;  ///< phi_min
  double packing_slope = 0.25;         ///< Delta
  double dilatancy = 4;                ///< k
  double dilatant_friction = 1;        ///< b, up to 1
  double ageing_strength = 0.08;       ///< Delta_mu
  bool ageing_adds = true;             ///< to b beta, or counts where it is more
  double ageing_time = 10e-3;          ///< T, s
  double ageing_strain = 0.05;         ///< gamma_0
  double tensile_strength = 0;         ///< a_0, Pa
  double consolidation_strength = 0;   ///< kappa
  double consolidation = 0;            ///< p_c of a new point, Pa
  double cohesion_strain = 0.1;        ///< gamma_c

  constexpr bool has_cohesion() const { return tensile_strength > 0 || consolidation_strength > 0; }
  /// a_0 + kappa p_c, the tensile strength of grains that a pressure has consolidated, both Pa.
  template <class Number>
  constexpr Number consolidated(const Number& pressure) const {
    return tensile_strength + consolidation_strength * pressure;
  }
  constexpr double strength_at_start() const { return consolidated(consolidation); }
};

/// The parameters, with what follows from them and the grains.
struct CriticalStateCoefficients {
  static constexpr double sqrt2 = 1.4142135623730951;
  static constexpr double tiny = 1e-30;
  static constexpr double max_inertial_number = 0.3;  // to which the packing is known to fall in proportion
  static constexpr double max_strength = 0.1;         // over the bulk modulus: expansions of a series

  CriticalStateParameters parameters;
  double reference_density = 0;  ///< kg/m^3
  double max_volume = 0;         ///< at phi_min
  double grain_inertia = 0;      ///< (2 rho_p)^(1/2) d: I over |D_dev| p^(-1/2)
};

/// MaterialPoint of the law.
template <class Number>
struct CriticalStatePoint {
  SymmetricTensor3<Number> stress;  ///< Pa
  Number expansion, contacts;       ///< CriticalState::History
  Number strengthening;             ///< the same; zero and left so without cohesion
};

/// The point after a time step (ConstitutiveLaw).
template <class Number>
CriticalStatePoint<Number> updated(const CriticalStateCoefficients& c, const CriticalStatePoint<Number>& old,
                                   const Tensor3<Number>& velocity_gradient, const Number& density, double time_step) {
  const CriticalStateParameters& p = c.parameters;
  using std::sqrt;
  const SymmetricTensor3<Number> rate = deviator(symmetric_part(velocity_gradient));
  // Volumes of a grain's share of space, in units of that at the reference packing: now, and just touching.
  const Number volume = c.reference_density / density;
  const bool has_cohesion = p.has_cohesion();
  Number strength = 0.0, parting = 1.0 + old.expansion;  // a; the volume at which grains part
  if (has_cohesion) {
    strength = p.strength_at_start() + old.strengthening;
    const Number x = (1 / p.bulk_modulus) * strength;
    parting = parting * (1.0 + x * (1.0 + 0.5 * x));  // exp(x), from below: p >= -a
  }
  const auto touch = volume < parting;
  const Number apart = minimum(volume, Number(c.max_volume));
  const Number touching = select(touch, 1.0 + old.expansion, maximum(1.0 + old.expansion, apart));
  const Number pressure = select(touch, p.bulk_modulus * log_near_one(touching / volume), Number(0.0));

  Number bearing = pressure;  // what presses the grains together, the load and their own attraction
  Number borne = 0.0;         // the strength that the load gives
  if (has_cohesion) {
    borne = select(pressure > Number(0.0), p.consolidated(pressure), Number(0.0));
    strength = select(touch, maximum(strength, borne), Number(0.0));
    bearing = pressure + strength;
  }
  const Number inertial = c.grain_inertia * norm(rate) / sqrt(maximum(bearing, Number(c.tiny)));
  const Number critical_volume =
      p.reference_packing / (p.critical_packing - p.packing_slope * minimum(inertial, Number(c.max_inertial_number)));
  const Number dilatancy = (p.dilatancy * p.reference_packing) * (1.0 / touching - 1.0 / critical_volume);
  const Number flowing = p.static_friction +
                         (p.dynamic_friction - p.static_friction) * (inertial / (inertial + p.inertial_number)) +
                         p.dilatant_friction * dilatancy;
  Number friction = flowing + p.ageing_strength * old.contacts;
  if (!p.ageing_adds) {
    const Number packed = maximum(p.dilatant_friction * dilatancy, Number(0.0));
    friction = flowing + maximum(p.ageing_strength * old.contacts - packed, Number(0.0));
  }

  const Tensor3<Number> turn = rotation_of_step(velocity_gradient, time_step);
  const SymmetricTensor3<Number> trial =
      transformed(deviator(old.stress), turn) - (2 * p.shear_modulus * time_step) * rate;
  const Number size = norm(trial);
  // At least beta, which the pressure takes back: no heat is drawn from grains far denser than the critical packing.
  const Number most = (c.sqrt2 * maximum(maximum(friction, dilatancy), Number(0.0))) * bearing;
  const Number slip = (1 / (c.sqrt2 * p.shear_modulus)) * maximum(size - most, Number(0.0));

  CriticalStatePoint<Number> point;
  point.stress = isotropic(pressure) + (minimum(size, most) / maximum(size, Number(c.tiny))) * trial;
  // d(1/phi_s)/dgamma = k (1 - phi_c/phi_s), implicit: it cannot pass the critical packing.
  Number dilation = (p.dilatancy * p.reference_packing) * slip;
  // Grains that are pulled at do not compact: the tension would do work.
  if (has_cohesion) dilation = select(pressure < Number(0.0) && touching > critical_volume, Number(0.0), dilation);
  const Number dilated = (touching + dilation) / (1.0 + dilation / critical_volume);
  point.expansion = select(touch, dilated, touching) - 1.0;
  const double ageing = time_step / p.ageing_time;
  point.strengthening = 0.0;
  if (has_cohesion) {
    const Number share = (1 / p.cohesion_strain) * slip;
    point.strengthening = (strength + share * borne) / (1.0 + share) - p.strength_at_start();
  }
  point.contacts = select(touch, (old.contacts + ageing) / (1.0 + ageing + (1 / p.ageing_strain) * slip), Number(0.0));
  return point;
}

}  // namespace talus::granular

// SPDX-License-Identifier: Apache-2.0
/// Linear elasticity with a friction limit: Drucker-Prager plasticity without dilatancy, in rate form.
///
///     elastic:  ds/dt = 2G (-D_dev) + W s - s W,   p = 3 K e_v  or  dp/dt = -K tr D
///     yield:    |s| <= sqrt(2) mu(kappa) p,  returned at constant p;  no stress where p would be negative
///
/// with s the deviator of the stress, positive in compression, e_v the volumetric strain by the density
/// (equation_of_state, contact_memory), K = lambda + 2G/3. sqrt(2) mu p is the friction coefficient mu in simple shear.
/// kappa sums the shear strain beyond the yield point of the moment, in one direction all of it; the grains harden as
/// the fits do, mu(kappa) = A4(kappa) kappa/sqrt(2), or mu is a constant. Moduli of Eqs 1-3 at zero strain: lambda =
/// alpha A2(0), 2G = alpha (A1(0) - A2(0)), 2.9 and 5.9 MPa at alpha = 9.8. Source: Bui, Fukagawa, Sako & Ohno, Int. J.
/// Numer. Anal. Mech. Geomech. 32, 1537 (2008), with zero dilatancy; data of Yuu & Umekage 2011, Appendix B. Range:
/// slow, dense flow of 200 um glass beads with A4; with a constant mu of anything without cohesion. deviates: Bui et
/// al. let the pressure follow the rate alone; tied to the density it cannot drift from the packing.
///
/// The rate is Jaumann's. The convected rate of the strain (kinematics.hpp) would stretch the stress with the
/// grains, which has no meaning for a stress; over the elastic range, |s|/2G < 2e-4, the two differ by less than that.
/// The rotation of a step is one to round-off, so pressure and |s| of a turning block stay.
#pragma once

#include "physics/granular/contact_memory.hpp"
#include "physics/granular/equation_of_state.hpp"
#include "physics/granular/fitted_table.hpp"
#include "physics/granular/kinematics.hpp"
#include "physics/granular/law_readings.hpp"
#include "physics/granular/material_point.hpp"

namespace talus::granular {

class DruckerPrager {
 public:
  static constexpr std::string_view name = "drucker-prager";
  static constexpr std::string_view text = "elastic up to a friction, constant or hardening as the fits do";

  struct Parameters {
    double friction = 0;  ///< mu, constant; 0: from A4
    Fits fits = {};
    Contact contact = {};
  };
  static constexpr bool bears_tension(const Parameters&) { return false; }
  template <class Visit, class P>
  static void for_each_parameter(Visit&& visit, P& p) {
    visit(Parameter{"friction", dimension::none, friction_coefficient(),
                    "friction coefficient in simple shear, the tangent of the angle at which the grains yield; 0: "
                    "hardening with A4"},
          p.friction);
    for_each_fit_parameter(visit, p.fits);
    auto hardening = only_if({"friction", "is given", "= 0", p.friction == 0}, visit);
    visit_max_deviator(hardening, p.fits, within_fits());
    for_each_contact_parameter(visit, p.contact);
  }

  /// \param grain_density rho_p, kg/m^3
  /// \throws std::invalid_argument if the largest deviator lies beyond the range of the fits
  explicit DruckerPrager(const Parameters& parameters, double grain_density = 2500);

  template <class Number>
  struct History {
    Number yield_deviator = 0.0;  ///< kappa
    Number dilation = 0.0;        ///< of the grains at which they touch (contact_memory.hpp)
  };
  template <class Visit, class H>
  static constexpr void for_each_slot(Visit&& visit, H& history) {
    visit(HistorySlot{"yield_deviator", "1"}, history.yield_deviator);
    visit(HistorySlot{"dilation", "1"}, history.dilation);
  }

  template <class Number>
  MaterialPoint<DruckerPrager, Number> update(const MaterialPoint<DruckerPrager, Number>& old,
                                              const Tensor3<Number>& velocity_gradient, const Number& density,
                                              double time_step) const {
    const SymmetricTensor3<Number> increment = time_step * symmetric_part(velocity_gradient);
    const Number packing = inverse_grain_density_ * density;
    const Number packed = volumetric_strain(packing, parameters_.contact.reference_packing);
    const Number dilation = memory_.dilation(old.history.dilation, packed, velocity_gradient, time_step);
    Number pressure = maximum(parameters_.contact.volume == Volume::strain
                                  ? (1.0 / 3.0) * trace(old.stress) - bulk_ * trace(increment)
                                  : (3.0 * bulk_) * (packed + dilation),
                              Number(0.0));
    // By the density there is no pressure below the reference packing, and so none that the gate could take away.
    if (parameters_.contact.volume != Volume::density ||
        parameters_.contact.gate_packing > parameters_.contact.reference_packing)
      pressure = pressure * contact_gate(packing, parameters_.contact.gate_packing,
                                         static_cast<int>(parameters_.contact.gate_power));

    const SymmetricTensor3<Number> shear =
        transformed(deviator(old.stress), rotation_of_step(velocity_gradient, time_step)) -
        two_g_ * deviator(increment);
    const Number size = norm(shear);
    const Number excess = maximum(size - friction_ratio(old.history.yield_deviator) * pressure, Number(0.0));
    MaterialPoint<DruckerPrager, Number> point;
    point.history.dilation = dilation;
    point.history.yield_deviator =
        minimum(old.history.yield_deviator + inverse_two_g_ * excess, Number(parameters_.fits.max_deviator));
    const Number most = friction_ratio(point.history.yield_deviator) * pressure;
    point.stress = isotropic(pressure) + (minimum(size, most) / maximum(size, Number(1e-30))) * shear;
    return point;
  }

  /// c = ((lambda + 2G)/rho_b)^(1/2), m/s.
  double sound_speed(double density) const;
  /// With a constant friction any grains without cohesion.
  LawRange range() const { return {.grain_diameter = parameters_.friction > 0 ? 0 : fitted_diameter}; }
  const Parameters& parameters() const { return parameters_; }

 private:
  /// |s|/p at yield.
  template <class Number>
  Number friction_ratio(const Number& yield_deviator) const {
    if (parameters_.friction > 0) return Number(1.4142135623730951 * parameters_.friction);
    return yield_deviator * shear_(yield_deviator);
  }

  Parameters parameters_;
  ContactMemory memory_;
  ShearTable shear_;
  double two_g_;  // Pa
  double inverse_two_g_;
  double inverse_grain_density_;  // m^3/kg
  double bulk_;                   // K, Pa
};

}  // namespace talus::granular

// SPDX-License-Identifier: Apache-2.0
/// An example of a law (docs/how-to/my-law.md): elastic grains with friction and cohesion.
///
///     elastic:  dp/dt = -K tr D,   ds/dt = -2G D_dev, in axes that turn with the material
///     yield:    |s| <= sqrt(2) (c + mu p),  returned at constant p;  p >= 0
///
/// with p the pressure and s the deviator of the stress, positive in compression. In simple shear grains without
/// pressure hold the shear stress c. Source: Drucker & Prager, Q. Appl. Math. 10, 157 (1952), without dilatancy.
/// Range: slow flow; no tension, so that a lump breaks where it is pulled.
#pragma once

#include <cmath>

#include "base/tensor.hpp"
#include "physics/granular/kinematics.hpp"
#include "physics/granular/material_point.hpp"

namespace talus::granular {

class CohesiveGrains {
 public:
  static constexpr std::string_view name = "cohesive-grains";
  static constexpr std::string_view text = "elastic up to cohesion and friction";

  struct Parameters {
    double bulk_modulus = 4.9e6;    ///< K, Pa
    double shear_modulus = 2.94e6;  ///< G, Pa
    double friction = 0.5;          ///< mu
    double cohesion = 100;          ///< c, Pa
  };
  static constexpr bool bears_tension(const Parameters&) { return false; }
  template <class Visit, class P>
  static void for_each_parameter(Visit&& visit, P& p) {
    visit(Parameter{"bulk_modulus", dimension::pressure, above(0), "bulk modulus"}, p.bulk_modulus);
    visit(Parameter{"shear_modulus", dimension::pressure, above(0), "shear modulus"}, p.shear_modulus);
    visit(Parameter{"friction", dimension::none, between(0, 2), "friction coefficient in simple shear"}, p.friction);
    visit(Parameter{"cohesion", dimension::pressure, at_least(0), "shear stress that grains hold without pressure"},
          p.cohesion);
  }

  explicit CohesiveGrains(const Parameters& parameters, double /*grain_density*/ = 0) : p_(parameters) {}

  template <class Number = double>
  struct History {};  // what the law remembers besides the stress: nothing
  template <class Visit, class H>
  static void for_each_slot(Visit&&, H&) {}

  template <class Number>
  MaterialPoint<CohesiveGrains, Number> update(const MaterialPoint<CohesiveGrains, Number>& old,
                                               const Tensor3<Number>& velocity_gradient, const Number& /*density*/,
                                               double time_step) const {
    const SymmetricTensor3<Number> increment = time_step * symmetric_part(velocity_gradient);
    const SymmetricTensor3<Number> turned = transformed(old.stress, rotation_of_step(velocity_gradient, time_step));
    const Number pressure = maximum((1.0 / 3.0) * trace(turned) - p_.bulk_modulus * trace(increment), Number(0.0));
    const SymmetricTensor3<Number> shear = deviator(turned) - (2 * p_.shear_modulus) * deviator(increment);
    const Number most = std::sqrt(2.0) * (p_.cohesion + p_.friction * pressure);
    const Number size = norm(shear);
    MaterialPoint<CohesiveGrains, Number> point;
    point.stress = isotropic(pressure) + (minimum(size, most) / maximum(size, Number(1e-30))) * shear;
    return point;
  }

  /// Speed of pressure waves, m/s. \param density of the bed, kg/m^3
  double sound_speed(double density) const {
    return std::sqrt((p_.bulk_modulus + 4.0 / 3.0 * p_.shear_modulus) / density);
  }
  LawRange range() const { return {}; }

 private:
  Parameters p_;
};

static_assert(ConstitutiveLaw<CohesiveGrains>);

}  // namespace talus::granular

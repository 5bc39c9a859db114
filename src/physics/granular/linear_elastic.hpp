// SPDX-License-Identifier: Apache-2.0
/// Hooke's law in rate form: no friction, no yield, tension as well as compression. For verification, where answers are
/// known: waves, hydrostatic beds, turning bodies.
#pragma once

#include <cmath>

#include "base/tensor.hpp"
#include "physics/granular/kinematics.hpp"
#include "physics/granular/material_point.hpp"

namespace talus::granular {

/// d tau/dt = -lambda tr(D) I - 2 G D in axes that turn with the material; compression positive.
class LinearElastic {
 public:
  static constexpr std::string_view name = "linear-elastic";
  static constexpr std::string_view text = "Hooke's law, with tensile strength (for verification)";

  struct Parameters {
    double lambda = 2.94e6;         ///< Pa
    double shear_modulus = 2.94e6;  ///< Pa
  };
  static constexpr bool bears_tension(const Parameters&) { return true; }
  template <class Visit, class P>
  static void for_each_parameter(Visit&& visit, P& p) {
    visit(Parameter{"lambda", dimension::pressure, above(0), "Lame's first constant"}, p.lambda);
    visit(Parameter{"shear_modulus", dimension::pressure, above(0), "shear modulus"}, p.shear_modulus);
  }

  explicit LinearElastic(const Parameters& parameters, double /*grain_density*/ = 0)
      : lambda_(parameters.lambda), shear_modulus_(parameters.shear_modulus) {}

  template <class Number = double>
  struct History {};

  template <class Visit, class H>
  static void for_each_slot(Visit&&, H&) {}

  template <class Number>
  MaterialPoint<LinearElastic, Number> update(const MaterialPoint<LinearElastic, Number>& old,
                                              const Tensor3<Number>& velocity_gradient, const Number& /*density*/,
                                              double time_step) const {
    const SymmetricTensor3<Number> rate = symmetric_part(velocity_gradient);
    const Tensor3<Number> rotation = rotation_of_step(velocity_gradient, time_step);
    return {transformed(old.stress, rotation) - (2 * shear_modulus_ * time_step) * rate -
                isotropic<Number>(lambda_ * time_step * trace(rate)),
            {}};
  }

  LawRange range() const { return {}; }

  /// Speed of pressure waves, m/s.
  double sound_speed(double density) const { return std::sqrt((lambda_ + 2 * shear_modulus_) / density); }

 private:
  double lambda_, shear_modulus_;
};

static_assert(ConstitutiveLaw<LinearElastic>);

}  // namespace talus::granular

// SPDX-License-Identifier: Apache-2.0
/// Hooke's law in rate form: no friction, no yield, tension as well as compression. For verification, where answers are
/// known: waves, hydrostatic beds, turning bodies.
#pragma once

#include <cmath>

#include "base/tensor.hpp"
#include "physics/granular/material_point.hpp"
#include "physics/granular/rotation.hpp"

namespace talus::granular {

/// d tau/dt = -lambda tr(D) I - 2 G D in axes that turn with the material; compression positive.
class LinearElastic {
 public:
  /// \param lambda, shear_modulus Lame's constants lambda and G, Pa, > 0
  LinearElastic(double lambda, double shear_modulus) : lambda_(lambda), shear_modulus_(shear_modulus) {}

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

  /// Speed of pressure waves, m/s.
  double sound_speed(double density) const { return std::sqrt((lambda_ + 2 * shear_modulus_) / density); }

 private:
  double lambda_, shear_modulus_;
};

static_assert(ConstitutiveLaw<LinearElastic>);

}  // namespace talus::granular

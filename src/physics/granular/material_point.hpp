// SPDX-License-Identifier: Apache-2.0
/// What every constitutive law of the grains has in common: a law is an object of coefficients and tables, and
///
///     new point = law.update(old point, velocity gradient, density, time step)
///
/// is a pure function. It is applied from the state at the start of a step, again at each stage, so that no stage
/// toggles a loading branch. Which law is decided outside the loop over the particles; laws are templates over the
/// number type.
///
/// Signs (Yuu & Umekage 2011, Eq. 17): stress is positive in compression, and so is the strain of every law. The
/// velocity gradient is as in mechanics, L_ij = du_i/dx_j: trace L < 0 compresses.
#pragma once

#include <concepts>
#include <limits>
#include <string_view>

#include "base/parameter.hpp"
#include "base/tensor.hpp"

namespace talus::granular {

/// A history variable of a law: a column of the state.
struct HistorySlot {
  const char* name;  ///< snake_case, unique within the law
  const char* unit;  ///< SI; "1" for numbers
  /// Of a tensor's component, its two axes (0, 1, 2): in a mirror across one of two different axes it changes sign.
  int axis = 0, other_axis = 0;
  bool in_snapshots = false;  ///< a user reads it, not the law alone
};

/// A material point. A new one is all zeros: no stress, no history.
template <class Law, class Number = double>
struct MaterialPoint {
  SymmetricTensor3<Number> stress;                 ///< Pa, strain-rate independent part, compression positive
  typename Law::template History<Number> history;  ///< named by Law::for_each_slot(visit, history)
};

/// The range of validity of a law. Outside of it `talus check` and the validity report warn.
struct LawRange {
  double grain_diameter = 0;                                      ///< of the grains that it is a fit to, m; 0: of any
  double max_pressure = std::numeric_limits<double>::infinity();  ///< Pa
  double max_inertial_number = std::numeric_limits<double>::infinity();
};

/// What a law has to offer. `density` is the bulk density at the end of the time step, kg/m^3; the velocity gradient,
/// 1/s, is that of the middle of the step or as near to it as the integrator has it; the time step is in s.
///
/// A law brings its name, its parameters and its keys, which are those of the table [law.NAME]; a `check(parameters)`
/// for contradictions between them, if there can be any. Registered in the list of law.hpp it is a choice of law.name.
template <class Law>
concept ConstitutiveLaw = requires(const Law law, const MaterialPoint<Law>& old, MaterialPoint<Law>& point,
                                   const Tensor3<>& velocity_gradient, double density, double time_step,
                                   typename Law::Parameters& parameters) {
  { Law::name } -> std::convertible_to<std::string_view>;
  { Law::text } -> std::convertible_to<std::string_view>;               // what it is, in a few words
  Law::for_each_parameter([](const Parameter&, auto&) {}, parameters);  // every key, once, without its table
  Law(parameters, density);                                  // density of the grains rho_p, kg/m^3; D_p may follow
  { Law::bears_tension(parameters) } -> std::same_as<bool>;  // a free surface is no loose place then (begin_densities)
  { law.range() } -> std::same_as<LawRange>;
  point = law.update(old, velocity_gradient, density, time_step);
  Law::for_each_slot([](HistorySlot, double&) {}, point.history);
  // Upper bound of the speed of pressure waves at that density, m/s, over the law's own table.
  density = law.sound_speed(density);
};

/// Calls visit(slot, component) for the six components of a tensor that a law remembers.
/// \param names of the slots, in the order of the components
template <class Visit, class Tensor>
constexpr void for_each_tensor_slot(Visit&& visit, const char* const (&names)[6], const char* unit, Tensor& tensor) {
  visit(HistorySlot{names[0], unit, 0, 0}, tensor.xx);
  visit(HistorySlot{names[1], unit, 1, 1}, tensor.yy);
  visit(HistorySlot{names[2], unit, 2, 2}, tensor.zz);
  visit(HistorySlot{names[3], unit, 0, 1}, tensor.xy);
  visit(HistorySlot{names[4], unit, 1, 2}, tensor.yz);
  visit(HistorySlot{names[5], unit, 2, 0}, tensor.zx);
}

}  // namespace talus::granular

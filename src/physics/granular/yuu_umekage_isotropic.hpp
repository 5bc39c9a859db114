// SPDX-License-Identifier: Apache-2.0
/// Yuu & Umekage's constitutive equations in isotropic form: the same fitted functions, the same answer in any axes.
///
///     loading:  tau = p I + A4(|e_dev|) p e_dev,   p = alpha f(rho_b) (A1 + 2 A2)(sqrt(3) e_v) e_v,   p = 0 if e_v < 0
///
/// with e = -Ea, e_v = tr(e)/3. The friction in simple shear is A4(|e_dev|) |e_dev|/sqrt(2).
/// Source: Yuu & Umekage 2011, Eqs 1-6 and 8, section 2.1.
/// Range: slow, dense flow of 200 um glass beads near a packing of 0.6, |e| <= 0.035.
/// deviates: Eqs 1-6 are component formulas; turned by 45 degrees a strain has another shear stress under them, an
/// eighth to eight times as large. Here A1 and A2 are taken at the volumetric strain and A4 at the deviator; with the
/// total |e| the stiffness would fall by more than ten times in a shear zone. The pressure does not fall as the
/// compression grows (fitted_table.hpp). The deviator is held at `max_deviator`, by default the peak of A4 a.
///
/// Close packing. The fits level off at 5 to 8 kPa; a stream that strikes the floor would be packed past 0.9. Grains at
/// random are not packed denser than 0.64; from there on the pressure rises along its initial stiffness again (choice).
///
/// Unloading, which the paper omits ("similar to the initial elastic region"). The pressure falls along the line of the
/// initial stiffness times k_u, rises along it again and never passes the loading curve. So does the stress ratio
/// tau_dev/p, in any direction; its yield point is that of the largest deviator so far. The next increment decides
/// again, so noise does not throw a point off its line. A closed cycle of the pressure, or of the shear strain under
/// constant pressure, only loses energy; shear at one pressure and back at another may gain some, as with every
/// stiffness that goes with the pressure. Where the curve of A4 is steeper than the line (near 1e-4, k_u < 2.2) shear
/// loads along the line, up to 11 % below the curve.
///
/// Reset, the paper's rule: while the main strain falls the shear stress drops along its line, whatever the shear; at
/// the end of the line, and as long as the main strain falls, the deviator starts from zero.
#pragma once

#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "physics/granular/contact_memory.hpp"
#include "physics/granular/equation_of_state.hpp"
#include "physics/granular/fitted_table.hpp"
#include "physics/granular/kinematics.hpp"
#include "physics/granular/law_readings.hpp"
#include "physics/granular/material_point.hpp"

namespace talus::granular {

class YuuUmekageIsotropic {
 public:
  static constexpr std::string_view name = "yuu-umekage";
  static constexpr std::string_view text = "Yuu and Umekage's in isotropic form, the same in any axes";

  struct Parameters {
    Fits fits = {};
    Contact contact = {};
    double close_packing = 0.64;  ///< beyond which the pressure rises along its initial stiffness again
    Unloading unloading = Unloading::all;
    UnloadingRule rule = {};
  };
  static constexpr bool bears_tension(const Parameters&) { return false; }
  template <class Visit, class P>
  static void for_each_parameter(Visit&& visit, P& p) {
    for_each_fit_parameter(visit, p.fits);
    visit_max_deviator(visit, p.fits, within_fits());
    for_each_contact_parameter(visit, p.contact);
    visit(Parameter{"close_packing", dimension::none, between(0.1, 1),
                    "random close packing, beyond which the pressure rises with its initial stiffness again; 1: never"},
          p.close_packing);
    visit(
        Parameter{
            "unloading",
            {},
            {},
            "stresses that decrease with the initial stiffness times unloading_stiffness when the strain decreases, "
            "and increase along the same line up to the yield point; the others return along the loading curve"},
        p.unloading);
    visit(
        Parameter{
            "reset",
            {},
            {},
            "what is reset at the end of an unloading process: nothing, the deviator of the strain, or all the strain"},
        p.rule.reset);
    Condition line = unless("unloading", p.unloading, Unloading::none);
    line.holds = line.holds || p.rule.reset != Reset::never;  // a reset drops the shear stress along the line too
    auto falling = only_if(line, visit);
    falling(Parameter{"unloading_stiffness", dimension::none, at_least(1), "k_u, over the initial stiffness"},
            p.rule.unloading_stiffness);
    auto resetting = only_if(unless("reset", p.rule.reset, Reset::never), visit);
    for_each_smoothing_parameter(resetting, p.rule);
  }
  /// Contradictions between keys that are each valid by themselves.
  static std::vector<Problem> check(const Parameters& parameters);

  /// \param grain_density rho_p, kg/m^3
  /// \throws std::invalid_argument if the largest deviator lies beyond the range of the fits
  explicit YuuUmekageIsotropic(const Parameters& parameters, double grain_density = 2500);

  template <class Number>
  struct History {
    /// Volume: what the pressure is taken at. Deviator: of the strain since the last reset; with unloading of the shear
    /// stress along its line, tau_dev/(p k_u A4(0)): the strain that would give this stress elastically.
    SymmetricTensor3<Number> strain;
    Number unloading = 0.0;       ///< 1 while the pressure is below its loading curve, else 0
    Number yield_deviator = 0.0;  ///< |e_dev| at the yield point of the shear stress
    Number main_rate = 0.0;       ///< 1/s, smoothed rate of the main strain; 0 without resets
    Number dilation = 0.0;        ///< of the grains at which they touch (contact_memory.hpp)
  };
  template <class Visit, class H>
  static constexpr void for_each_slot(Visit&& visit, H& history) {
    for_each_tensor_slot(visit, {"strain_xx", "strain_yy", "strain_zz", "strain_xy", "strain_yz", "strain_zx"}, "1",
                         history.strain);
    visit(HistorySlot{"unloading", "1"}, history.unloading);
    visit(HistorySlot{"yield_deviator", "1"}, history.yield_deviator);
    visit(HistorySlot{"main_rate", "1/s"}, history.main_rate);
    visit(HistorySlot{"dilation", "1"}, history.dilation);
  }

  template <class Number>
  MaterialPoint<YuuUmekageIsotropic, Number> update(const MaterialPoint<YuuUmekageIsotropic, Number>& old,
                                                    const Tensor3<Number>& velocity_gradient, const Number& density,
                                                    double time_step) const {
    MaterialPoint<YuuUmekageIsotropic, Number> point;
    const SymmetricTensor3<Number> strain = transported_strain(old.history.strain, velocity_gradient, time_step);
    const Number packing = density * (1.0 / grain_density_);
    const Number packed = volumetric_strain(density, parameters_.contact.reference_packing * grain_density_);
    point.history.dilation = memory_.dilation(old.history.dilation, packed, velocity_gradient, time_step);
    Volumetric<Number> volume = volumetric(
        old, packing, packed,
        parameters_.contact.volume == Volume::strain ? (1.0 / 3.0) * trace(strain) : packed + point.history.dilation);
    SymmetricTensor3<Number> sheared = deviator(strain);
    if (parameters_.rule.reset != Reset::never) {
      point.history.main_rate =
          smoothed_main_rate(old.history.main_rate, velocity_gradient, time_step, parameters_.rule.smoothing_time);
      const SymmetricTensor3<Number> only_turned =
          transformed(deviator(old.history.strain), rotation_of_step(velocity_gradient, time_step));
      sheared = select_tensor(point.history.main_rate < Number(0.0), only_turned, sheared);
    }
    Sheared<Number> shear = unloads_shear() ? along_line(sheared, old.history.yield_deviator) : along_curve(sheared);
    if (parameters_.rule.reset != Reset::never) reset(point.history.main_rate, time_step, volume, shear);
    point.stress = isotropic(volume.pressure) + (volume.pressure * shear.ratio) * shear.deviator;
    point.history.strain = isotropic(volume.strain) + shear.deviator;
    point.history.unloading = volume.unloading;
    point.history.yield_deviator = shear.yield_deviator;
    return point;
  }

  /// c = (M/rho_b)^(1/2), m/s, with M the largest slope of the vertical stress against the vertical strain in uniaxial
  /// compression, times k_u if a stress unloads along its line. An upper bound for every state.
  double sound_speed(double density) const;
  /// Largest pressure of the loading curve at f = 1, Pa.
  double max_pressure() const { return parameters_.fits.scale * pressure_(max_fitted_strain) / sqrt3; }
  LawRange range() const {
    return {.grain_diameter = fitted_diameter, .max_pressure = max_fitted_pressure(parameters_.fits)};
  }
  const Parameters& parameters() const { return parameters_; }

 private:
  static constexpr double sqrt3 = 1.7320508075688772;
  static constexpr double tiny = 1e-30;

  template <class Number>
  struct Volumetric {
    Number strain;    ///< e_v
    Number pressure;  ///< Pa
    Number unloading;
  };
  template <class Number>
  struct Sheared {
    SymmetricTensor3<Number> deviator;  ///< of the strain
    Number ratio;                       ///< tau_dev = ratio p deviator
    Number yield_deviator;
  };

  bool unloads_pressure() const {
    return parameters_.unloading == Unloading::pressure || parameters_.unloading == Unloading::all;
  }
  bool unloads_shear() const {
    return parameters_.unloading == Unloading::shear || parameters_.unloading == Unloading::all;
  }
  /// \param packed ln(rho_b/rho_ref)/3; \param volume e_v
  template <class Number>
  Volumetric<Number> volumetric(const MaterialPoint<YuuUmekageIsotropic, Number>& old, const Number& packing,
                                const Number& packed, const Number& volume) const {
    const Number stiffness =
        parameters_.fits.scale * density_factor(packing) *
        contact_gate(packing, parameters_.contact.gate_packing, static_cast<int>(parameters_.contact.gate_power));
    const Number beyond = maximum(packed - close_volume_, Number(0.0));
    const Number loading =
        stiffness * ((1.0 / sqrt3) * pressure_(sqrt3 * maximum(volume, Number(0.0))) + initial_pressure_ * beyond);
    if (!unloads_pressure()) return {volume, loading, Number(0.0)};
    const Number compression = volume - (1.0 / 3.0) * trace(old.history.strain);
    const Number line = (1.0 / 3.0) * trace(old.stress) +
                        (parameters_.rule.unloading_stiffness * initial_pressure_) * stiffness * compression;
    // Below the curve, or leaving it, the pressure is on the line; compressed further on the curve it stays there.
    const auto on_line = old.history.unloading > Number(0.5) || compression < Number(0.0);
    const Number pressure = select(on_line, minimum(loading, maximum(line, Number(0.0))), loading);
    return {volume, pressure, select(pressure < loading, Number(1.0), Number(0.0))};
  }

  template <class Number>
  Sheared<Number> along_curve(const SymmetricTensor3<Number>& strain) const {
    const Number size = norm(strain);
    const Number held = minimum(size, Number(parameters_.fits.max_deviator));
    return {(held / maximum(size, Number(tiny))) * strain, shear_(held), Number(0.0)};
  }

  template <class Number>
  Sheared<Number> along_line(const SymmetricTensor3<Number>& strain, const Number& old_yield) const {
    const Number size = norm(strain);
    const Number yield_size = inverse_line_ratio_ * (old_yield * shear_(old_yield));
    const Number excess = maximum(size - yield_size, Number(0.0));
    const Number yield = minimum(old_yield + excess, Number(parameters_.fits.max_deviator));
    const Number held = minimum(size, inverse_line_ratio_ * (yield * shear_(yield)));
    return {(held / maximum(size, Number(tiny))) * strain, Number(line_ratio_), yield};
  }

  /// The paper's rule, while the main strain falls.
  template <class Number>
  void reset(const Number& main_rate, double time_step, Volumetric<Number>& volume, Sheared<Number>& shear) const {
    const auto falls = main_rate < Number(0.0);
    const Number drop = line_ratio_ * time_step * maximum(-1.0 * main_rate, Number(0.0));
    const Number left = maximum(1.0 - drop / maximum(shear.ratio * norm(shear.deviator), Number(tiny)), Number(0.0));
    shear.deviator = left * shear.deviator;
    shear.yield_deviator = select(falls && left < Number(tiny), Number(0.0), shear.yield_deviator);
    if (!unloads_shear()) shear.ratio = shear_(norm(shear.deviator));
    if (parameters_.rule.reset == Reset::strain)
      volume.strain = select(falls && volume.pressure < Number(tiny), Number(0.0), volume.strain);
  }

  Parameters parameters_;
  ContactMemory memory_;
  PressureTable pressure_;
  ShearTable shear_;
  double close_volume_;      // e_v at close packing
  double initial_pressure_;  // A1 + 2 A2 at 0, Pa
  double line_ratio_;        // k_u A4(0): slope of the unloading line of the stress ratio
  double inverse_line_ratio_;
  double grain_density_;  // kg/m^3
  double steepest_;       // M at f = 1, Pa
};

}  // namespace talus::granular

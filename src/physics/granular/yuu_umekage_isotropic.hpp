// SPDX-License-Identifier: Apache-2.0
/// Yuu & Umekage's constitutive equations in isotropic form: the same fitted functions, the same answer in any axes.
///
///     loading:  tau = p I + A4(|e_dev|) p e_dev,   p = alpha f(rho_b) (A1 + 2 A2)(sqrt(3) e_v) e_v,   p = 0 if e_v < 0
///
/// with e = -Ea, e_v = tr(e)/3. The friction in simple shear is A4(|e_dev|) |e_dev|/sqrt(2).
/// Source: Yuu & Umekage 2011, Eqs 1-6 and 8, section 2.1.
/// deviates: Eqs 1-6 are component formulas, and a state turned by 45 degrees has another shear stress under them, by
/// 0.5 to 12 times. Here A1 and A2 are taken at the volumetric strain and A4 at the deviator; with the total |e| the
/// stiffness would fall by more than ten times in a shear zone. The pressure does not fall as the compression grows
/// (fitted_table.hpp). The deviator is held at `largest_deviator`: beyond the peak of A4 a there is nothing but
/// rounding.
///
/// Unloading, which the paper omits ("similar to the initial elastic region"), without a branch: the pressure follows
/// the line of the initial stiffness times k_u and never passes the loading curve; so does the stress ratio tau_dev/p,
/// whose yield point is that of the largest deviator so far. Nothing toggles, and a closed cycle of one of them only
/// loses energy. Reset, the paper's rule: while the main strain falls the shear stress drops along its line, and at its
/// end the deviator starts anew from zero.
#pragma once

#include "physics/granular/almansi_strain.hpp"
#include "physics/granular/equation_of_state.hpp"
#include "physics/granular/fitted_table.hpp"
#include "physics/granular/law_options.hpp"
#include "physics/granular/material_point.hpp"

namespace talus::granular {

class YuuUmekageIsotropic {
 public:
  YuuUmekageIsotropic(const YuuUmekageOptions& options, const FittedFunctions& functions);

  template <class Number>
  struct History {
    /// Volume: what the pressure is taken at. Deviator: of the strain since the last reset; with unloading of the shear
    /// stress along its line, tau_dev/(p k_u A4(0)): the strain that would give this stress elastically.
    SymmetricTensor3<Number> strain;
    Number yield_deviator = 0.0;  ///< |e_dev| at the yield point of the shear stress
    Number main_rate = 0.0;       ///< 1/s, smoothed rate of the main strain; 0 without resets
  };
  template <class Visit, class H>
  static constexpr void for_each_slot(Visit&& visit, H& history) {
    for_each_tensor_slot(visit, {"strain_xx", "strain_yy", "strain_zz", "strain_xy", "strain_yz", "strain_zx"}, "1",
                         history.strain);
    visit(HistorySlot{"yield_deviator", "1"}, history.yield_deviator);
    visit(HistorySlot{"main_rate", "1/s"}, history.main_rate);
  }

  template <class Number>
  MaterialPoint<YuuUmekageIsotropic, Number> update(const MaterialPoint<YuuUmekageIsotropic, Number>& old,
                                                    const Tensor3<Number>& velocity_gradient, const Number& density,
                                                    double time_step) const {
    const SymmetricTensor3<Number> strain = transported_strain(old.history.strain, velocity_gradient, time_step);
    const Number volume = options_.volume == Volume::density
                              ? volumetric_strain(density, options_.reference_packing * options_.grain_density)
                              : (1.0 / 3.0) * trace(strain);
    const Number pressure = pressure_at(old, volume, density);
    const Number main_rate = options_.reset == Reset::never
                                 ? Number(0.0)
                                 : smoothed_main_rate(old.history.main_rate, options_.main_strain, velocity_gradient,
                                                      time_step, options_.smoothing_time);
    const Sheared<Number> sheared =
        unloads_shear() ? along_line(deviator(strain), old.history.yield_deviator) : along_curve(deviator(strain));
    return reset(pressure, volume, sheared, main_rate, time_step);
  }

  /// c = (M/rho_b)^(1/2), m/s, with M the largest slope of the vertical stress against the vertical strain in uniaxial
  /// compression, times k_u if a stress unloads along its line. An upper bound for every state.
  double sound_speed(double density) const;
  /// Largest pressure of the loading curve at f = 1, Pa.
  double largest_pressure() const { return options_.scale * pressure_(largest_fitted_strain) / sqrt3; }
  const YuuUmekageOptions& options() const { return options_; }

 private:
  static constexpr double sqrt3 = 1.7320508075688772;
  static constexpr double tiny = 1e-30;

  /// The deviator of the strain, the stress ratio tau_dev/p over it, and the deviator at the yield point.
  template <class Number>
  struct Sheared {
    SymmetricTensor3<Number> deviator;
    Number ratio;
    Number yield_deviator;
  };

  bool unloads_pressure() const {
    return options_.unloading == Unloading::pressure || options_.unloading == Unloading::all;
  }
  bool unloads_shear() const { return options_.unloading == Unloading::shear || options_.unloading == Unloading::all; }
  /// Slope of the unloading line of the stress ratio.
  double line_ratio() const { return options_.unloading_stiffness * initial_shear_; }

  template <class Number>
  Number pressure_at(const MaterialPoint<YuuUmekageIsotropic, Number>& old, const Number& volume,
                     const Number& density) const {
    const Number packing = density * (1.0 / options_.grain_density);
    const Number stiffness =
        options_.scale * density_factor(packing) * contact_gate(packing, options_.gate_packing, options_.gate_power);
    const Number loading = stiffness * (1.0 / sqrt3) * pressure_(sqrt3 * maximum(volume, Number(0.0)));
    if (!unloads_pressure()) return loading;
    const Number compression = volume - (1.0 / 3.0) * trace(old.history.strain);
    const Number line =
        (1.0 / 3.0) * trace(old.stress) + (options_.unloading_stiffness * initial_pressure_) * stiffness * compression;
    return minimum(loading, maximum(line, Number(0.0)));
  }

  /// A4(a) within the range and beyond.
  template <class Number>
  Number shear_at(const Number& a) const {
    return shear_(a) * beyond_range(a);
  }

  template <class Number>
  Sheared<Number> along_curve(const SymmetricTensor3<Number>& strain) const {
    const Number size = norm(strain);
    const Number held = minimum(size, Number(options_.largest_deviator));
    return {(held / maximum(size, Number(tiny))) * strain, shear_at(held), held};
  }

  template <class Number>
  Sheared<Number> along_line(const SymmetricTensor3<Number>& strain, const Number& old_yield) const {
    const Number size = norm(strain);
    const Number yield_size = old_yield * shear_at(old_yield) * (1.0 / line_ratio());
    const Number excess = maximum(size - yield_size, Number(0.0));
    const Number yield = minimum(old_yield + excess, Number(options_.largest_deviator));
    const Number held = minimum(size, yield * shear_at(yield) * (1.0 / line_ratio()));
    return {(held / maximum(size, Number(tiny))) * strain, line_ratio(), yield};
  }

  template <class Number>
  MaterialPoint<YuuUmekageIsotropic, Number> reset(const Number& pressure, const Number& volume,
                                                   Sheared<Number> sheared, const Number& main_rate,
                                                   double time_step) const {
    MaterialPoint<YuuUmekageIsotropic, Number> point;
    Number kept_volume = volume;
    if (options_.reset != Reset::never) {
      const Number size = norm(sheared.deviator);
      const Number drop = line_ratio() * time_step * maximum(-1.0 * main_rate, Number(0.0));
      const Number left = maximum(1.0 - drop / maximum(sheared.ratio * size, Number(tiny)), Number(0.0));
      sheared.deviator = left * sheared.deviator;
      const auto unloading = main_rate < Number(0.0);
      const auto ended = unloading && left < Number(tiny);
      sheared.yield_deviator = select(ended, Number(0.0), sheared.yield_deviator);
      if (!unloads_shear()) sheared.ratio = shear_at(norm(sheared.deviator));
      if (options_.reset == Reset::strain)
        kept_volume = select(unloading && pressure < Number(tiny), Number(0.0), volume);
    }
    point.stress = isotropic(pressure) + (pressure * sheared.ratio) * sheared.deviator;
    point.history.strain = isotropic(kept_volume) + sheared.deviator;
    point.history.yield_deviator = unloads_shear() ? sheared.yield_deviator : Number(0.0);
    point.history.main_rate = main_rate;
    return point;
  }

  YuuUmekageOptions options_;
  PressureTable pressure_;
  ShearTable shear_;
  double initial_pressure_;  // A1 + 2 A2 at 0, Pa
  double initial_shear_;     // A4 at 0
  double steepest_;          // M at f = 1, Pa
};

}  // namespace talus::granular

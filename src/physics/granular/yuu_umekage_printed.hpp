// SPDX-License-Identifier: Apache-2.0
/// Yuu & Umekage's constitutive equations as printed, component by component:
///
///     tau_xx = f alpha [A1 e_xx + A2 (e_yy + e_zz) + A3 (|e_xy| + |e_xz|)],  yy and zz likewise         (1)-(3)
///     tau_xy = A4 e_xy tau,  yz and zx likewise,  tau = max(0, tau_xx + tau_yy + tau_zz)/3              (4)-(8)
///
/// with A1 to A4 at a = |e|, and no stress at all where tau = 0. The answer depends on the axes.
/// Source: Yuu & Umekage 2011, Eqs 1-8, Appendix B; the unloading from section 2.1 in words.
/// Range: slow, dense flow of 200 um glass beads near a packing of 0.6, |e| <= 0.035.
/// deviates: e = -Ea (kinematics.hpp). |e_xy| + |e_xz| for the printed e_xy + e_xz, which breaks the mirror
/// symmetry (option). max(0, .) for the printed |.|, which would let shear strength grow in dilation. A5 = A6 = 0.
///
/// Unloading. When the smoothed increment of the main strain turns negative an unloading process begins: stress falls
/// by Eqs 1-6 with A1 to A4 at zero strain, times k_u, of the strain's increments; shear stresses fall in proportion to
/// tau as well. When the main strain grows again stress rises the same way, until the main strain is back where the
/// process began: the yield point, from which Eqs 1-8 hold again. Neither passes Eqs 1-8, nor the largest friction.
/// When tau or the normal stress in the main direction has fallen to zero the process ends, without stress, and by the
/// paper's rule the strain starts from zero.
/// deviates: the paper omits these equations, which are "similar to the initial elastic region".
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

class YuuUmekagePrinted {
 public:
  static constexpr std::string_view name = "yuu-umekage-printed";
  static constexpr std::string_view text = "Yuu and Umekage's component formulas as printed";

  struct Parameters {
    Fits fits = {};
    Contact contact = {};
    Strain strain = Strain::rate;
    ShearSum shear_sum = ShearSum::absolute;
    PrintedUnloading unloading = PrintedUnloading::all;
    UnloadingRule rule = {};
  };
  static constexpr bool bears_tension(const Parameters&) { return false; }
  template <class Visit, class P>
  static void for_each_parameter(Visit&& visit, P& p) {
    for_each_fit_parameter(visit, p.fits);
    visit_max_deviator(visit, p.fits, above(0));
    for_each_contact_parameter(visit, p.contact);
    visit(
        Parameter{"strain", {}, {}, "the strain by its rate, or from displacements since the last reset (Appendix A)"},
        p.strain);
    visit(
        Parameter{
            "shear_sum", {}, {}, "how shear strains enter the normal stresses, |e_xy| + |e_xz| or with their signs"},
        p.shear_sum);
    visit(
        Parameter{
            "unloading",
            {},
            {},
            "whether stress decreases with the initial stiffness times unloading_stiffness when the main strain "
            "decreases, and increases along the same line up to the yield point, or returns along the loading curve"},
        p.unloading);
    auto falling = only_if(where("unloading", p.unloading, PrintedUnloading::all), visit);
    falling(Parameter{"unloading_stiffness", dimension::none, at_least(1), "k_u, over the initial stiffness"},
            p.rule.unloading_stiffness);
    falling(
        Parameter{
            "reset",
            {},
            {},
            "what is reset at the end of an unloading process: nothing, the deviator of the strain, or all the strain"},
        p.rule.reset);
    for_each_smoothing_parameter(falling, p.rule);
  }
  /// Contradictions between keys that are each valid by themselves.
  static std::vector<Problem> check(const Parameters& parameters);

  /// \param grain_density rho_p, kg/m^3
  explicit YuuUmekagePrinted(const Parameters& parameters, double grain_density = 2500);

  template <class Number>
  struct History {
    SymmetricTensor3<Number> strain;  ///< since the last reset
    Number main_rate = 0.0;           ///< 1/s, smoothed rate of the main strain
    Number yield_strain = 0.0;        ///< main strain at the yield point, while unloading
    Number unloading = 0.0;           ///< 1 while unloading or reloading, else 0
    Number resets = 0.0;              ///< resets so far: at each the point's X_i := x_i
    Number dilation = 0.0;            ///< of the grains at which they touch (contact_memory.hpp)
  };
  template <class Visit, class H>
  static constexpr void for_each_slot(Visit&& visit, H& history) {
    for_each_tensor_slot(visit, {"strain_xx", "strain_yy", "strain_zz", "strain_xy", "strain_yz", "strain_zx"}, "1",
                         history.strain);
    visit(HistorySlot{"main_rate", "1/s"}, history.main_rate);
    visit(HistorySlot{"yield_strain", "1"}, history.yield_strain);
    visit(HistorySlot{"unloading", "1"}, history.unloading);
    visit(HistorySlot{"resets", "1"}, history.resets);
    visit(HistorySlot{"dilation", "1"}, history.dilation);
  }

  /// With the strain by its rate.
  template <class Number>
  MaterialPoint<YuuUmekagePrinted, Number> update(const MaterialPoint<YuuUmekagePrinted, Number>& old,
                                                  const Tensor3<Number>& velocity_gradient, const Number& density,
                                                  double time_step) const {
    return update_at_strain(old, transported_strain(old.history.strain, velocity_gradient, time_step),
                            velocity_gradient, density, time_step);
  }

  /// Whether update_at_strain is what the options ask for.
  bool by_displacements() const { return parameters_.strain == Strain::displacements; }
  /// With the strain from displacements since the last reset (half_spheres.hpp); when `resets` grows X_i := x_i.
  /// \param measured_strain almansi_strain of the displacement gradient
  template <class Number>
  MaterialPoint<YuuUmekagePrinted, Number> update_at_strain(const MaterialPoint<YuuUmekagePrinted, Number>& old,
                                                            const SymmetricTensor3<Number>& measured_strain,
                                                            const Tensor3<Number>& velocity_gradient,
                                                            const Number& density, double time_step) const {
    MaterialPoint<YuuUmekagePrinted, Number> point;
    const Number packed = volumetric_strain(inverse_grain_density_ * density, parameters_.contact.reference_packing);
    point.history.dilation = memory_.dilation(old.history.dilation, packed, velocity_gradient, time_step);
    const SymmetricTensor3<Number> strain = restrained(measured_strain, packed + point.history.dilation);
    const Number scale = density_scale(density);
    point.stress = loading_stress(strain, scale);
    point.history.strain = strain;
    point.history.resets = old.history.resets;
    if (parameters_.unloading == PrintedUnloading::none) return point;

    point.history.main_rate =
        smoothed_main_rate(old.history.main_rate, velocity_gradient, time_step, parameters_.rule.smoothing_time);
    const auto was_unloading = old.history.unloading > Number(0.5);
    const Number yield_strain = select(was_unloading, old.history.yield_strain, old.history.strain.zz);
    const auto unloading = (was_unloading || point.history.main_rate < Number(0.0)) && strain.zz < yield_strain;
    point.stress = select_tensor(unloading, line_stress(old, strain, point.stress, scale), point.stress);

    const auto ended = unloading && minimum(trace(point.stress), point.stress.zz) < Number(tiny);
    point.stress = select_tensor(ended, SymmetricTensor3<Number>{}, point.stress);
    point.history.unloading = select(unloading, Number(1.0), Number(0.0));
    if (parameters_.rule.reset != Reset::never) {
      point.history.unloading = select(ended, Number(0.0), point.history.unloading);
      const SymmetricTensor3<Number> left = parameters_.rule.reset == Reset::strain
                                                ? SymmetricTensor3<Number>{}
                                                : isotropic<Number>((1.0 / 3.0) * trace(strain));
      point.history.strain = select_tensor(ended, left, strain);
      point.history.resets = old.history.resets + select(ended, Number(1.0), Number(0.0));
    }
    point.history.yield_strain = point.history.unloading * yield_strain;
    return point;
  }

  /// Eqs 1-8 at a strain. \param scale alpha f(rho_b) and the gate; \returns Pa
  template <class Number>
  SymmetricTensor3<Number> loading_stress(const SymmetricTensor3<Number>& strain, const Number& scale) const {
    const Number a = norm(strain);
    Number A[4];
    table_.evaluate(a, A);
    for (Number& function : A) function = beyond_range(a) * function;
    const SymmetricTensor3<Number> normal = scale * normal_stresses(A[0], A[1], A[2], strain, shear_sums(strain));
    return with_shear(normal, A[3] * strain);
  }

  /// c = (M/rho_b)^(1/2), m/s, with M the largest slope of the stress against the strain in uniaxial compression, times
  /// k_u if stress unloads along its line.
  double sound_speed(double density) const;
  LawRange range() const {
    return {.grain_diameter = fitted_diameter, .max_pressure = max_fitted_pressure(parameters_.fits)};
  }
  const Parameters& parameters() const { return parameters_; }

 private:
  static constexpr double tiny = 1e-30;

  template <class Number>
  struct Sums {
    Number x, y, z;
  };

  template <class Number>
  Number density_scale(const Number& density) const {
    const Number packing = inverse_grain_density_ * density;
    return parameters_.fits.scale * density_factor(packing) *
           contact_gate(packing, parameters_.contact.gate_packing, static_cast<int>(parameters_.contact.gate_power));
  }

  /// The strain with its volume by the density, and its deviator held, as the options say.
  template <class Number>
  SymmetricTensor3<Number> restrained(const SymmetricTensor3<Number>& strain, const Number& by_density) const {
    const Number volume = parameters_.contact.volume == Volume::strain ? (1.0 / 3.0) * trace(strain) : by_density;
    const SymmetricTensor3<Number> shear = deviator(strain);
    const Number size = norm(shear);
    return isotropic(volume) +
           (minimum(size, Number(parameters_.fits.max_deviator)) / maximum(size, Number(tiny))) * shear;
  }

  template <class Number>
  Sums<Number> shear_sums(const SymmetricTensor3<Number>& e) const {
    if (parameters_.shear_sum == ShearSum::with_signs) return {e.xy + e.zx, e.xy + e.yz, e.zx + e.yz};
    const Number xy = maximum(e.xy, -1.0 * e.xy), yz = maximum(e.yz, -1.0 * e.yz), zx = maximum(e.zx, -1.0 * e.zx);
    return {xy + zx, xy + yz, zx + yz};
  }

  /// Brackets of Eqs 1-3.
  template <class Number>
  static SymmetricTensor3<Number> normal_stresses(const Number& A1, const Number& A2, const Number& A3,
                                                  const SymmetricTensor3<Number>& e, const Sums<Number>& sums) {
    return {A1 * e.xx + A2 * (e.yy + e.zz) + A3 * sums.x,
            A1 * e.yy + A2 * (e.zz + e.xx) + A3 * sums.y,
            A1 * e.zz + A2 * (e.xx + e.yy) + A3 * sums.z,
            0.0,
            0.0,
            0.0};
  }

  /// Eqs 4-8: shear stresses tau times `ratio`; nothing where tau is not positive.
  template <class Number>
  static SymmetricTensor3<Number> with_shear(const SymmetricTensor3<Number>& normal,
                                             const SymmetricTensor3<Number>& ratio) {
    const Number tau = (1.0 / 3.0) * trace(normal);
    return select_tensor(
        tau > Number(0.0),
        SymmetricTensor3<Number>{normal.xx, normal.yy, normal.zz, tau * ratio.xy, tau * ratio.yz, tau * ratio.zx},
        SymmetricTensor3<Number>{});
  }

  /// Stress along the line of the initial stiffness times k_u, from the stress before.
  template <class Number>
  SymmetricTensor3<Number> line_stress(const MaterialPoint<YuuUmekagePrinted, Number>& old,
                                       const SymmetricTensor3<Number>& strain, const SymmetricTensor3<Number>& loading,
                                       const Number& scale) const {
    const SymmetricTensor3<Number> increment = strain - old.history.strain;
    const Sums<Number> now = shear_sums(strain), before = shear_sums(old.history.strain);
    const Number stiffness = parameters_.rule.unloading_stiffness * scale;
    SymmetricTensor3<Number> normal =
        old.stress + stiffness * normal_stresses(Number(initial_[0]), Number(initial_[1]), Number(initial_[2]),
                                                 increment,
                                                 Sums<Number>{now.x - before.x, now.y - before.y, now.z - before.z});
    // Not beyond the loading stress, nor into tension.
    const Number tau = maximum(trace(normal), Number(0.0)), most = maximum(trace(loading), Number(0.0));
    normal = (minimum(tau, most) / maximum(tau, Number(tiny))) * normal;

    const Number old_tau = maximum((1.0 / 3.0) * trace(old.stress), Number(tiny));
    SymmetricTensor3<Number> ratio =
        (1.0 / old_tau) * old.stress + (parameters_.rule.unloading_stiffness * initial_[3]) * increment;
    ratio.xx = ratio.yy = ratio.zz = 0.0;
    const Number size = norm(ratio);
    return with_shear(normal, (minimum(size, Number(max_ratio_)) / maximum(size, Number(tiny))) * ratio);
  }

  Parameters parameters_;
  ContactMemory memory_;
  ComponentTable table_;
  double initial_[4];             // A1 to A4 at 0
  double max_ratio_;              // of |shear stresses| to tau: the largest A4 a within the range
  double steepest_;               // M at f = 1, Pa
  double grain_density_;          // kg/m^3
  double inverse_grain_density_;  // m^3/kg
};

}  // namespace talus::granular

// SPDX-License-Identifier: Apache-2.0
/// The readings of the fitted constitutive laws that a case chooses among, with their names in case files.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/parameter.hpp"
#include "base/tensor.hpp"

namespace talus::granular {

/// What the volumetric strain is measured by.
enum class Volume {
  density,  ///< ln(rho_b/rho_ref)/3: tied to the packing, cannot drift from it
  contact,  ///< ln(rho_b/rho_touch)/3, from the density at which the grains last touched (contact_memory.hpp)
  strain    ///< the trace of the strain since the last reset, as in the paper
};

/// What the strain of the printed components follows from.
enum class Strain {
  rate,          ///< de/dt = -D - e L - L^T e (kinematics.hpp)
  displacements  ///< Eqs 9-12 from x - X, with X the position at the last reset: the paper's own route
};

/// Which stresses fall along the initial stiffness times k_u when the strain falls, and rise again along the same line
/// to the yield point; the others go back along the loading curve.
enum class Unloading { none, pressure, shear, all };

/// The printed components unload together.
enum class PrintedUnloading { none, all };

/// What is forgotten at the end of an unloading process: nothing, the deviator of the strain, or all of it (the paper
/// sets X_i := x_i).
enum class Reset { never, deviator, strain };

/// How shear strains enter the normal stresses of Eqs 1-3.
enum class ShearSum {
  absolute,   ///< |e_xy| + |e_xz|: keeps the mirror symmetry
  with_signs  ///< e_xy + e_xz, as printed
};

/// What both forms of the law `yuu-umekage` do while the strain falls.
struct UnloadingRule {
  double unloading_stiffness = 1.5;  ///< k_u
  Reset reset = Reset::never;
  double smoothing_time = 2e-4;  ///< s, over which the rate of the vertical strain is averaged
};

template <class Visit, class R>
void for_each_smoothing_parameter(Visit&& visit, R& rule) {
  visit(
      Parameter{"smoothing_time", dimension::time, at_least(0),
                "time over which the rate of the vertical strain, whose decrease is an unloading process, is averaged "
                "before its sign is evaluated"},
      rule.smoothing_time);
}

/// That a volumetric strain which is to be forgotten is one.
inline std::vector<Problem> check_reset(Reset reset, Volume volume) {
  if (reset != Reset::strain || volume == Volume::strain) return {};
  return {{.key = "reset",
           .what = "a volumetric strain measured by the density cannot be reset",
           .allowed = "\"never\" or \"deviator\", or volume = \"strain\""}};
}

/// The rate of the vertical strain, whose fall is an unloading process, averaged over the past: r' = (-D_zz - r)/T,
/// implicit in time. The paper: "normal strain component in the main direction that is vertical".
/// \param old_rate 1/s; \param smoothing_time T, s, >= 0
template <class Number>
Number smoothed_main_rate(const Number& old_rate, const Tensor3<Number>& velocity_gradient, double time_step,
                          double smoothing_time) {
  const Number rate = -1.0 * velocity_gradient.zz;
  return old_rate + (time_step / (time_step + smoothing_time)) * (rate - old_rate);
}

}  // namespace talus::granular

namespace talus {
template <>
inline constexpr auto choices<granular::Volume> = std::to_array<std::string_view>({"density", "contact", "strain"});
template <>
inline constexpr auto choices<granular::Strain> = std::to_array<std::string_view>({"rate", "displacements"});
template <>
inline constexpr auto choices<granular::Unloading> = std::to_array<std::string_view>({"none", "pressure", "shear",
                                                                                      "all"});
template <>
inline constexpr auto choices<granular::PrintedUnloading> = std::to_array<std::string_view>({"none", "all"});
template <>
inline constexpr auto choices<granular::Reset> = std::to_array<std::string_view>({"never", "deviator", "strain"});
template <>
inline constexpr auto choices<granular::ShearSum> = std::to_array<std::string_view>({"absolute", "signed"});
}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/law.hpp"

namespace talus::granular {

std::vector<Problem> check(const LawParameters& p) {
  std::vector<Problem> problems;
  const bool holds_deviator =
      p.name == LawName::drucker_prager || (p.name == LawName::yuu_umekage && p.form == Form::isotropic);
  if (holds_deviator && p.largest_deviator > largest_fitted_strain)
    problems.push_back({.key = "law.largest_deviator",
                        .what = "the fitted functions end at 0.035",
                        .allowed = "at most 0.035; with law.form = \"printed\" any"});
  if (p.strain == Strain::displacements && (p.name != LawName::yuu_umekage || p.form != Form::printed))
    problems.push_back({.key = "law.strain",
                        .what = "only the printed components take the strain from displacements",
                        .allowed = "\"rate\", or law.form = \"printed\""});
  if (p.name != LawName::yuu_umekage) return problems;
  if (p.reset == Reset::strain && p.volume != Volume::strain)
    problems.push_back({.key = "law.reset",
                        .what = "a volumetric strain measured by the density cannot be reset",
                        .allowed = "\"never\" or \"deviator\", or law.volume = \"strain\""});
  if (p.form == Form::printed && p.unloading != Unloading::none && p.unloading != Unloading::all)
    problems.push_back({.key = "law.unloading",
                        .what = "the printed components unload together",
                        .allowed = "\"none\" or \"all\", or law.form = \"isotropic\""});
  if (p.form == Form::printed && p.unloading == Unloading::none && p.reset != Reset::never)
    problems.push_back({.key = "law.reset",
                        .what = "without unloading there is no end of it at which the strain could be reset",
                        .allowed = "\"never\", or law.unloading = \"all\""});
  return problems;
}

AnyLaw make_law(const LawParameters& p, double grain_density) {
  const FittedFunctions& functions = p.tables == Tables::printed ? printed_2011 : repaired_2011;
  if (p.name == LawName::linear_elastic) return LinearElastic(p.lambda, p.shear_modulus);
  if (p.name == LawName::drucker_prager)
    return DruckerPrager({.scale = p.scale,
                          .grain_density = grain_density,
                          .reference_packing = p.reference_packing,
                          .volume = p.volume,
                          .compaction = p.compaction,
                          .friction = p.friction,
                          .largest_deviator = p.largest_deviator,
                          .gate_packing = p.gate_packing,
                          .gate_power = static_cast<int>(p.gate_power)},
                         functions);
  const YuuUmekageOptions options{.scale = p.scale,
                                  .grain_density = grain_density,
                                  .reference_packing = p.reference_packing,
                                  .strain = p.strain,
                                  .volume = p.volume,
                                  .compaction = p.compaction,
                                  .unloading = p.unloading,
                                  .unloading_stiffness = p.unloading_stiffness,
                                  .reset = p.reset,
                                  .main_strain = p.main_strain,
                                  .smoothing_time = p.smoothing_time,
                                  .close_packing = p.close_packing,
                                  .largest_deviator = p.largest_deviator,
                                  .shear_sum = p.shear_sum,
                                  .gate_packing = p.gate_packing,
                                  .gate_power = static_cast<int>(p.gate_power)};
  if (p.form == Form::isotropic) return YuuUmekageIsotropic(options, functions);
  return YuuUmekagePrinted(options, functions);
}

CollisionOptions collision_options(const LawParameters& p, double diameter, double gravity) {
  const bool none = p.collisions == Collisions::none;
  return {.diameter = diameter,
          .gravity = gravity,
          .normal = none ? 0 : p.collision_normal,
          .shear = none ? 0 : p.collision_shear,
          .diagonal_factor = p.collision_diagonal,
          .isotropic = p.collisions == Collisions::isotropic};
}

}  // namespace talus::granular

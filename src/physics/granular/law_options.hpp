// SPDX-License-Identifier: Apache-2.0
/// The table [law] of a case: which constitutive law, and every reading and coefficient of it. A model with grains
/// embeds LawParameters and visits this list within its own.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/error.hpp"
#include "base/parameter.hpp"
#include "physics/granular/law_readings.hpp"

namespace talus::granular {

enum class LawName { yuu_umekage, drucker_prager, linear_elastic };
enum class Form { isotropic, printed };
enum class Tables { repaired, printed };
enum class Collisions { printed, isotropic, none };

/// The table [law] of a case.
struct LawParameters {
  LawName name = LawName::yuu_umekage;
  Form form = Form::isotropic;
  Tables tables = Tables::repaired;
  double scale = 9.80;
  double reference_packing = 0.6;
  Strain strain = Strain::rate;
  Volume volume = Volume::density;
  double compaction = 3;
  double close_packing = 0.64;
  double largest_deviator = 0.014;
  Unloading unloading = Unloading::all;
  double unloading_stiffness = 1.5;
  Reset reset = Reset::never;
  MainStrain main_strain = MainStrain::z;
  double smoothing_time = 2e-4;
  ShearSum shear_sum = ShearSum::absolute;
  double gate_packing = 0.5;
  std::int64_t gate_power = 96;
  double friction = 0;
  Collisions collisions = Collisions::printed;
  double collision_normal = 1.67;
  double collision_shear = 0.0175;
  double collision_diagonal = 1;
  double lambda = 2.94e6;
  double shear_modulus = 2.94e6;
};

/// Every key, once.
template <class Visit, class P>
void for_each_parameter(Visit&& visit, P& p) requires std::same_as<std::remove_const_t<P>, LawParameters> {
  visit(Parameter{"law.name", {}, {}, "constitutive law of the grains"}, p.name);
  visit(Parameter{"law.form",
                  {},
                  {},
                  "yuu-umekage: the isotropic form, the same in any axes, or the component formulas as printed"},
        p.form);
  visit(
      Parameter{"law.tables",
                {},
                {},
                "fitted functions A1 to A4: with coefficients that round to the printed ones and join, or as printed"},
      p.tables);
  visit(Parameter{"law.scale", dimension::none, above(0),
                  "alpha: rho_b g h_m over 130 Pa, the stress at the bottom of the bed over that of the fits"},
        p.scale);
  visit(Parameter{"law.reference_packing", dimension::none, between(0.1, 0.74),
                  "packing at which grains at rest just touch; denser, they bear pressure"},
        p.reference_packing);
  visit(Parameter{"law.strain",
                  {},
                  {},
                  "printed form: the strain by its rate, or from displacements since the last reset (Appendix A)"},
        p.strain);
  visit(
      Parameter{
          "law.volume",
          {},
          {},
          "what the volumetric strain is measured by: the density over that of the reference packing, the density "
          "over that at which the grains last touched, or the strain since the last reset"},
      p.volume);
  visit(Parameter{"law.compaction", dimension::none, at_least(0),
                  "volume by contact: how fast shear packs grains again that came apart, per unit of shear strain"},
        p.compaction);
  visit(
      Parameter{
          "law.close_packing", dimension::none, between(0.1, 1),
          "isotropic form: packing beyond which grains cannot give way any more, random close packing: from there "
          "on the pressure rises along its initial stiffness again; 1: never"},
      p.close_packing);
  visit(Parameter{"law.largest_deviator", dimension::none, above(0),
                  "|e_dev| beyond which shear no longer hardens or softens the grains"},
        p.largest_deviator);
  visit(Parameter{"law.unloading",
                  {},
                  {},
                  "stresses that fall along the initial stiffness times law.unloading_stiffness when the strain falls, "
                  "and rise along the same line to the yield point; the others go back along the loading curve"},
        p.unloading);
  visit(Parameter{"law.unloading_stiffness", dimension::none, at_least(1), "k_u, over the initial stiffness"},
        p.unloading_stiffness);
  visit(Parameter{"law.reset",
                  {},
                  {},
                  "what is forgotten at the end of an unloading process: nothing, the deviator of the strain, or all "
                  "the strain"},
        p.reset);
  visit(Parameter{"law.main_strain", {}, {}, "the strain whose fall is an unloading process; volume: tr(e)/3"},
        p.main_strain);
  visit(Parameter{"law.smoothing_time", dimension::time, at_least(0),
                  "time over which the rate of the main strain is averaged before its sign counts"},
        p.smoothing_time);
  visit(Parameter{"law.shear_sum",
                  {},
                  {},
                  "printed form: how shear strains enter the normal stresses, |e_xy| + |e_xz| or with their signs"},
        p.shear_sum);
  visit(Parameter{"law.gate_packing", dimension::none, between(0, 0.74),
                  "packing below which grains lose contact and stress vanishes by a power of the packing"},
        p.gate_packing);
  visit(Parameter{"law.gate_power", dimension::none, between(0, 1e6), "that power; 96 in the paper"}, p.gate_power);
  visit(Parameter{"law.friction", dimension::none, at_least(0),
                  "drucker-prager: friction coefficient in simple shear; 0: hardening with A4"},
        p.friction);
  visit(Parameter{"law.collisions",
                  {},
                  {},
                  "stress by collisions, Eqs 13 and 14: component by component as printed, in isotropic form, or none"},
        p.collisions);
  visit(Parameter{"law.collision_normal", dimension::none, at_least(0), "B1 of Eq. 13"}, p.collision_normal);
  visit(Parameter{"law.collision_shear", dimension::none, at_least(0), "B2 of Eq. 14"}, p.collision_shear);
  visit(Parameter{"law.collision_diagonal", dimension::none, above(0),
                  "gamma_ii over du_i/dx_i in Eq. 13, printed components: 1, or 2 as for i != j"},
        p.collision_diagonal);
  visit(Parameter{"law.lambda", dimension::pressure, above(0), "linear-elastic: Lame's first constant"}, p.lambda);
  visit(Parameter{"law.shear_modulus", dimension::pressure, above(0), "linear-elastic: shear modulus"},
        p.shear_modulus);
}

/// Contradictions between keys that are each valid by themselves; empty if there are none.
std::vector<Problem> check(const LawParameters& parameters);

}  // namespace talus::granular

namespace talus {
template <>
inline constexpr auto choices<granular::LawName> = std::to_array<std::string_view>({"yuu-umekage", "drucker-prager",
                                                                                    "linear-elastic"});
template <>
inline constexpr auto choices<granular::Form> = std::to_array<std::string_view>({"isotropic", "printed"});
template <>
inline constexpr auto choices<granular::Tables> = std::to_array<std::string_view>({"repaired", "printed"});
template <>
inline constexpr auto choices<granular::Collisions> = std::to_array<std::string_view>({"printed", "isotropic", "none"});
template <>
inline constexpr auto choices<granular::Strain> = std::to_array<std::string_view>({"rate", "displacements"});
template <>
inline constexpr auto choices<granular::Volume> = std::to_array<std::string_view>({"density", "contact", "strain"});
template <>
inline constexpr auto choices<granular::Unloading> = std::to_array<std::string_view>({"none", "pressure", "shear",
                                                                                      "all"});
template <>
inline constexpr auto choices<granular::Reset> = std::to_array<std::string_view>({"never", "deviator", "strain"});
template <>
inline constexpr auto choices<granular::MainStrain> = std::to_array<std::string_view>({"x", "y", "z", "volume"});
template <>
inline constexpr auto choices<granular::ShearSum> = std::to_array<std::string_view>({"absolute", "signed"});
}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
/// The materials that a case may name: their files stand in the program. A file has a table for each key of a case that
/// it fills in, with `value`, and `range` and `source` of it, of a friction also `test` and the `angle` that it gave;
/// [walls.NAME] of each wall that its friction is known of, with its adhesion, if any, which talus hopper-design takes;
/// [pressure] with the range in which all of it holds; [en1991.NAME] of what EN 1991-4 says of the solid;
/// [lateral_pressure_ratio], K of a bed at rest, where it was measured. A case may also name a file of its own, which
/// talus calibrate writes: the same without the last two.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "io/case_file.hpp"
#include "io/parameter_value.hpp"
#include "models/continuum/setup/layout.hpp"
#include "physics/granular/en1991.hpp"
#include "physics/granular/friction_angle.hpp"

namespace talus {
template <>
inline constexpr auto choices<granular::FrictionTest> = std::to_array<std::string_view>({"shear plane", "plane strain",
                                                                                         "triaxial compression"});
}  // namespace talus

namespace talus::app {

/// A line of a file, as it is written.
struct MaterialLine {
  std::string key;    ///< of a case, or "walls.steel", "en1991.ratio" or "pressure"
  std::string value;  ///< empty: there is a range alone
  std::string range;  ///< "2450 kg/m3 to 2600 kg/m3"; empty: none is said
  std::string source;
  std::string test;   ///< of a friction: which (choices<FrictionTest>); empty: not said
  std::string angle;  ///< of a friction: what that test gave, "30 deg"
};

/// What a file says. \throws std::logic_error if it is not among the program's
const CaseFile& file_of(continuum::GrainMaterial material);
std::string title_of(continuum::GrainMaterial material);
std::vector<MaterialLine> lines_of(continuum::GrainMaterial material);
/// "30.0 degrees on the plane of a shear tester, 35.2 in plane strain, 25.4 in triaxial compression".
std::string angles_of_friction(double friction);

/// The means and factors of EN 1991-4, Table E.1; nothing if the code does not list the material.
std::optional<granular::en1991::Solid> solid_of_code(continuum::GrainMaterial material);

/// Values that follow from other keys.
struct FilledIn {
  std::map<std::string, std::string, std::less<>> keys;  ///< and what each follows from: "material", "bed", "method"
  /// Walls of which the material does not know how its grains rub on them; what is wrong with a file of its own.
  std::vector<Problem> problems;
};

/// Makes the values of the case's material the defaults of its keys. \param file the case
FilledIn fill_in_material(const CaseFile& file, continuum::Parameters& defaults);

/// The values alone, of any list of parameters with keys of a case: what of them the material has.
template <class P>
FilledIn fill_in_values(const CaseFile& file, P& parameters);

/// What the case sets beyond the range that its material has for that key, but for the grains' diameter. \param
/// parameters as read
std::vector<continuum::ValueBeyond> values_beyond_material(const CaseFile& file, continuum::Parameters parameters);

/// What is wrong with a material's file: for what a case that names it would be refused.
std::vector<Problem> problems_of_material(const std::string& path);

/// The case without grains.material, if that is a file, and without what its walls are made of: fill_in_material() has
/// made values of other keys of these, and none of the program's materials is meant.
CaseFile without_own_material(const CaseFile& file);

/// Pa; discharge, surfaces and heaps are then as for stiff grains (docs/design/time-steps.md): a thousand
/// times, for a design 250 times, for a draft 62.5 times the weight over its area of as deep a bed as the grains at the
/// start and those that come in can make, and so much that what falls from where it begins to the lowest position has a
/// Mach number of 0.1 at most. \param end of the run, s
double bulk_modulus_for(const continuum::Layout& layout, double end);

/// The largest speed of a free fall from where grains begin to the lowest position that they can reach, m/s.
double speed_of_fall(const continuum::Layout& layout);
/// The same down to another height. \param low m
double speed_of_fall(const continuum::Layout& layout, double low);

/// The shear modulus G over the bulk modulus B. Of a material that EN 1991-4 lists so that a bed which has settled
/// without strain to the sides has K = 1 - sin phi_i: below yield K = (1 - 2G/3B)/(1 + 4G/3B). Of one whose K was
/// measured by that; of others 0.6, as in the paper's law at zero strain. Source: Jaky, J. Soc. Hung. Eng. Archit. 78,
/// 355 (1944); in a model bin of soybeans Atewologun, Riskowski & Muehling; the code's own K is 1.1 times as much.
double shear_over_bulk(std::optional<continuum::GrainMaterial> material);

/// What the law critical-state takes from the bed, where the case gives none. The moduli: bulk_modulus_for(). The
/// packing at which the grains just touch: the bed's, so that it bears no pressure before its weight, unless so loose
/// that they do not touch. \param parameters as read \param end of the run, s
void set_from_bed(const CaseFile& file, const continuum::Layout& layout, double end, continuum::Parameters& parameters,
                  FilledIn& filled);
/// The Courant number by the method, and the skin of lists by the levels, where the case gives none.
void set_integration(const CaseFile& file, continuum::Parameters& parameters, FilledIn& filled);

// ------------------------------------------------------------------------------------------------------------------

/// The material that the case names; nothing if it names none of the program's.
std::optional<continuum::GrainMaterial> material_of(const CaseFile& file);

/// The file of the material that a case names; nothing if it names none. \param problems gets what is wrong with a file
/// of its own
std::optional<CaseFile> material_file(const CaseFile& file, std::vector<Problem>& problems);

/// Whether the file of a material has a value for a key, and which; one that will not do is a problem.
std::optional<ParameterValue> value_in(const CaseFile& material, const std::string& key, const Parameter& parameter,
                                       const ValueType& type, std::vector<Problem>& problems);

/// Reads the values that the file of a material has.
struct MaterialValues {
  const CaseFile& material;
  FilledIn filled = {};

  template <class T>
  void operator()(const Parameter& parameter, T& member) {
    const auto value = value_in(material, parameter.key + ".value", parameter, value_type<T>(), filled.problems);
    if (!value) return;
    from_value(*value, member);
    filled.keys.emplace(parameter.key, "material");
  }
};

template <class P>
FilledIn fill_in_values(const CaseFile& file, P& parameters) {
  FilledIn nothing;
  const auto material = material_file(file, nothing.problems);
  if (!material) return nothing;
  MaterialValues values{*material};
  for_each_parameter(values, parameters);
  return std::move(values.filled);
}

}  // namespace talus::app

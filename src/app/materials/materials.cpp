// SPDX-License-Identifier: Apache-2.0
#include "app/materials/materials.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "app/case/model_case.hpp"
#include "io/parameter_value.hpp"
#include "models/continuum/population.hpp"
#include "models/continuum/setup/time_scale.hpp"
#include "physics/granular/critical_state.hpp"

namespace talus::app {

namespace {

using continuum::GrainMaterial;
using continuum::WallMaterial;

constexpr std::pair<std::string_view, std::string_view> files[] = {
#include "material_files.inc"  // made by the build from materials/
};

constexpr std::string_view material_key = "grains.material";
constexpr double moduli_over_weight[] = {62.5, 250, 1000};  // by Accuracy
constexpr double max_mach_number_of_fall = 0.1;

/// \throws std::logic_error if a file of the program's holds no such value
template <class T>
std::optional<T> read(const CaseFile& material, const std::string& key, const Parameter& parameter,
                      std::vector<Problem>* of_own = nullptr) {
  std::vector<Problem> problems;
  const auto value = value_in(material, key, parameter, value_type<T>(), of_own ? *of_own : problems);
  if (!problems.empty()) throw std::logic_error(to_string(problems[0]));
  if (!value) return std::nullopt;
  T member{};
  from_value(*value, member);
  return member;
}

/// Of a wall; nothing if the material does not know it.
std::optional<double> friction_on(const CaseFile& material, WallMaterial wall, std::vector<Problem>& problems) {
  const std::string key = fmt::format("walls.{}.value", choice_name(wall));
  return read<double>(material, key, Parameter{key, dimension::none, friction_coefficient()}, &problems);
}

std::string known_walls(const CaseFile& material) {
  std::vector<std::string_view> names;
  for (const std::string_view wall : choices<WallMaterial>)
    if (material.contains(fmt::format("walls.{}.value", wall))) names.push_back(wall);
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

continuum::MaterialRange range_of(const CaseFile& material, std::vector<Problem>& problems) {
  continuum::MaterialRange range{.name = std::filesystem::path(material.name()).stem().string()};
  const auto pair = [&](const char* key, Dimension unit) -> std::optional<std::vector<double>> {
    const auto ends = read<std::vector<double>>(material, key, Parameter{key, unit}, &problems);
    if (!ends || (ends->size() == 2 && ends->at(0) <= ends->at(1))) return ends;
    const CaseEntry& entry = *material.find(key);
    problems.push_back({.where = entry.where,
                        .line = entry.line,
                        .key = key,
                        .what = "is no range",
                        .allowed = "its two ends, the smaller first"});
    return std::nullopt;
  };
  if (const auto d = pair("grains.diameter.range", dimension::length))
    range.min_diameter = d->at(0), range.max_diameter = d->at(1);
  if (const auto p = pair("pressure.range", dimension::pressure)) range.max_pressure = p->at(1);
  return range;
}

/// What a case says of its material, if that is a file.
const std::string* own_material(const CaseFile& file) {
  const CaseEntry* entry = file.find(material_key);
  const auto* name = entry ? std::get_if<std::string>(&entry->value.value) : nullptr;
  return name && name->ends_with(".toml") ? name : nullptr;
}

/// Tables of a file that are neither a key of a case nor say where it holds.
std::vector<Problem> unknown_tables(const CaseFile& material, const FilledIn& filled) {
  std::vector<Problem> problems;
  for (const CaseEntry& entry : material.entries()) {
    const std::string table(table_of(entry.key));
    const bool told = std::any_of(filled.problems.begin(), filled.problems.end(),
                                  [&](const Problem& problem) { return problem.key == entry.key; });
    if (told || last_part(entry.key) != "value" || filled.keys.contains(table) || lies_in(table, "walls")) continue;
    problems.push_back({.where = entry.where,
                        .line = entry.line,
                        .key = table,
                        .what = "is no key of a case, nor a wall",
                        .allowed = "keys of docs/case-reference-continuum.md; walls.steel and others; pressure"});
  }
  return problems;
}

std::string plain(const CaseValue& value) {
  if (const auto* text = std::get_if<std::string>(&value.value)) return *text;
  if (const auto* pair = std::get_if<std::vector<CaseValue>>(&value.value))
    return fmt::format("{} to {}", plain(pair->at(0)), plain(pair->at(1)));
  return as_written(value);
}

}  // namespace

const CaseFile& file_of(GrainMaterial material) {
  static const std::map<std::string_view, CaseFile> all = [] {
    std::map<std::string_view, CaseFile> read_files;
    for (const auto& [name, text] : files)
      read_files.emplace(name, CaseFile::from_text(text, fmt::format("materials/{}.toml", name)));
    return read_files;
  }();
  const auto found = all.find(choice_name(material));
  if (found == all.end()) throw std::logic_error(fmt::format("materials/{}.toml is not there", choice_name(material)));
  return found->second;
}

std::optional<GrainMaterial> material_of(const CaseFile& file) {
  return choice_in<GrainMaterial>(file, material_key);
}

std::optional<CaseFile> material_file(const CaseFile& file, std::vector<Problem>& problems) {
  if (const auto of_program = material_of(file)) return file_of(*of_program);
  const std::string* own = own_material(file);
  std::optional<CaseFile> material;
  if (!own) return material;
  read_input(std::string(material_key), problems, [&] { material = CaseFile::read(input_path(file, *own).string()); });
  return material;
}

CaseFile without_own_material(const CaseFile& file) {
  if (!own_material(file)) return file;
  CaseFile without = file.without(material_key).without("walls.material");
  for (std::size_t n = 0; n < file.tables("vessel"); ++n)
    without = without.without(continuum::vessel_key(n, "material"));
  return without;
}

std::optional<ParameterValue> value_in(const CaseFile& material, const std::string& key, const Parameter& parameter,
                                       const ValueType& type, std::vector<Problem>& problems) {
  const CaseEntry* entry = material.find(key);
  if (!entry) return std::nullopt;
  ValueFault fault;
  auto value = convert_value(*entry, parameter, type, fault);
  if (!value)
    problems.push_back({.where = entry->where,
                        .line = entry->line,
                        .key = key,
                        .what = fault.what,
                        .allowed = allowed_text(parameter, type),
                        .nearest = fault.nearest});
  return value;
}

std::string title_of(GrainMaterial material) {
  return plain(file_of(material).find("title")->value);
}

std::vector<MaterialLine> lines_of(GrainMaterial material) {
  const CaseFile& file = file_of(material);
  std::vector<MaterialLine> lines;
  const auto text = [&](const std::string& key) {
    const CaseEntry* entry = file.find(key);
    return entry ? plain(entry->value) : std::string();
  };
  for (const CaseEntry& entry : file.entries()) {
    MaterialLine line{.key = entry.key, .value = {}, .range = {}, .source = {}, .test = {}, .angle = {}};
    line.value = text(entry.key + ".value"), line.range = text(entry.key + ".range");
    line.source = text(entry.key + ".source");
    line.test = text(entry.key + ".test"), line.angle = text(entry.key + ".angle");
    if (!line.value.empty() || !line.range.empty()) lines.push_back(std::move(line));
  }
  return lines;
}

std::string angles_of_friction(double friction) {
  const auto degrees = [&](granular::FrictionTest test) {
    const double angle = granular::angle_of_friction(test, friction) * 180 / std::numbers::pi;
    return std::isfinite(angle) ? fmt::format("{:.1f}", angle) : "none";
  };
  return fmt::format("{} degrees on the plane of a shear tester, {} in plane strain, {} in triaxial compression",
                     degrees(granular::FrictionTest::shear_plane), degrees(granular::FrictionTest::plane_strain),
                     degrees(granular::FrictionTest::triaxial_compression));
}

std::optional<granular::en1991::Solid> solid_of_code(GrainMaterial material) {
  const CaseFile& file = file_of(material);
  if (!file.find("en1991.ratio")) return std::nullopt;
  granular::en1991::Solid solid;
  const auto set = [&](const char* name, double& number, Dimension unit) {
    const std::string key = fmt::format("en1991.{}.value", name);
    number = read<double>(file, key, Parameter{key, unit}).value();
  };
  set("repose", solid.repose, dimension::angle);
  set("internal", solid.internal, dimension::angle);
  set("internal_factor", solid.internal_factor, dimension::none);
  set("ratio", solid.ratio, dimension::none);
  set("ratio_factor", solid.ratio_factor, dimension::none);
  set("friction_factor", solid.friction_factor, dimension::none);
  set("patch", solid.patch, dimension::none);
  const Parameter weight{"en1991.unit_weight.range", Dimension{-2, 1, -2, 0}};
  solid.max_weight = read<std::vector<double>>(file, weight.key, weight).value().at(1);
  return solid;
}

FilledIn fill_in_material(const CaseFile& file, continuum::Parameters& defaults) {
  FilledIn filled = fill_in_values(file, defaults);
  std::vector<Problem> told;  // by fill_in_values()
  const auto found = material_file(file, told);
  if (!found) return filled;
  const CaseFile& material = *found;
  if (own_material(file))
    for (Problem& problem : unknown_tables(material, filled)) filled.problems.push_back(std::move(problem));
  defaults.grains.range = range_of(material, filled.problems);
  const auto rub = [&](const std::string& key, const std::string& friction_key, auto& friction) {
    const auto wall = choice_in<WallMaterial>(file, key);
    if (!wall || file.contains(friction_key)) return;
    const std::size_t before = filled.problems.size();
    if (const auto coefficient = friction_on(material, *wall, filled.problems)) {
      friction = *coefficient;
      filled.keys.emplace(friction_key, "material");
    } else if (filled.problems.size() == before) {
      filled.problems.push_back(
          {.where = file.find(key)->where,
           .line = file.find(key)->line,
           .key = key,
           .what = fmt::format("no friction of {} on {} is known", defaults.grains.range.name, choice_name(*wall)),
           .allowed = fmt::format("{}; or {}", known_walls(material), friction_key)});
    }
  };
  rub("walls.material", "walls.coefficient", defaults.walls.coefficient);
  for (std::size_t n = 0; n < defaults.vessel.size(); ++n)
    rub(continuum::vessel_key(n, "material"), continuum::vessel_key(n, "friction"), defaults.vessel[n].friction);
  return filled;
}

namespace {

/// Compares the values of a case with the ranges that the file of its material has.
struct BeyondRange {
  const CaseFile& file;
  const CaseFile& material;
  std::vector<continuum::ValueBeyond> beyond = {};

  template <class T>
  void operator()(const Parameter& parameter, T& member) {
    if constexpr (std::is_same_v<T, double>) {
      const CaseEntry* const given = file.find(parameter.key);
      if (!given || parameter.key == "grains.diameter") return;
      const std::string key = parameter.key + ".range";
      std::vector<Problem> of_range;  // a range that is none says nothing
      const auto ends = read<std::vector<double>>(material, key, Parameter{key, parameter.dimension}, &of_range);
      if (!ends || ends->size() != 2 || (member >= ends->at(0) && member <= ends->at(1))) return;
      beyond.push_back({parameter.key, plain(given->value), plain(material.find(key)->value)});
    }
  }
};

}  // namespace

std::vector<continuum::ValueBeyond> values_beyond_material(const CaseFile& file, continuum::Parameters parameters) {
  std::vector<Problem> told;  // by fill_in_material()
  const auto material = material_file(file, told);
  if (!material) return {};
  BeyondRange range{file, *material};
  for_each_parameter(range, parameters);
  return std::move(range.beyond);
}

std::vector<Problem> problems_of_material(const std::string& path) {
  const CaseFile file = CaseFile::from_text(fmt::format("[grains]\nmaterial = {}\n", talus::quoted(path)), "");
  continuum::Parameters parameters;
  std::vector<Problem> problems = fill_in_material(file, parameters).problems;
  const auto material = material_file(file, problems);
  if (!material) return problems;
  for (const WallMaterial wall :
       {WallMaterial::steel, WallMaterial::acrylic, WallMaterial::glass, WallMaterial::concrete})
    friction_on(*material, wall, problems);
  auto& law = parameters.law.of<granular::CriticalState>();
  if (parameters.bed.packing >= law.random_loose_packing) law.reference_packing = parameters.bed.packing;
  for (Problem& problem : granular::check(parameters.law)) problems.push_back(std::move(problem));
  return problems;
}

namespace {

/// The depth that the bed and what comes in until the end of the run can have, m.
double depth_that_may_be_reached(const continuum::Layout& layout, double end) {
  const continuum::Parameters& p = layout.given;
  const double depth = layout.depth,
               mass = continuum::mass_to_come(p, end, continuum::time_scales_of(p).settling_limit);
  if (!(mass > 0)) return depth;
  double low = 0, high = 0, area = p.box.width * p.box.depth;
  if (!p.vessel.empty()) {
    const auto [from, to] = continuum::bounds_of_vessel(p);
    area = std::min(area, (to.x - from.x) * (to.y - from.y));
    low = std::max(low, from.z);
  }
  for (const continuum::Inlet& inlet : p.inlets) high = std::max(high, inlet.centre[2]);
  const double before = layout.has_no_bed() ? 0 : depth;
  return std::max(before, std::min(high - low, before + mass / (p.bed.packing * p.grains.density * area)));
}

}  // namespace

double speed_of_fall(const continuum::Layout& layout) {
  const continuum::Parameters& p = layout.given;
  const double low = p.box.floor == FaceKind::open && !p.vessel.empty() ? continuum::bounds_of_vessel(p).low.z : 0;
  return speed_of_fall(layout, std::max(low, p.removal.below.value_or(low)));
}

double speed_of_fall(const continuum::Layout& layout, double low) {
  const continuum::Parameters& p = layout.given;
  const auto speed = [&](double from, double to, const std::array<double, 3>& v) {
    return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + 2 * p.gravity.acceleration * std::max(0.0, from - to));
  };
  double largest = 0;
  if (!layout.has_no_bed()) {
    const std::array<double, 3> velocity = p.bed.velocity.value_or(std::array<double, 3>{});
    largest = speed(layout.outlet ? layout.outlet->height : layout.bottom, low, velocity);
    const std::vector<continuum::Extent> heights = continuum::heights_of_beds(p);
    for (std::size_t n = 1; n < heights.size(); ++n)
      largest = std::max(largest, speed(heights[n].low, heights[n - 1].high, velocity));
  }
  for (const continuum::Inlet& inlet : p.inlets)
    largest = std::max(largest, speed(inlet.centre[2], low, inlet.velocity));
  return largest;
}

double shear_over_bulk(std::optional<GrainMaterial> material) {
  if (!material) return 0.6;
  const std::string key = "lateral_pressure_ratio.value";
  std::optional<double> ratio = read<double>(file_of(*material), key, Parameter{key, dimension::none});
  if (const auto solid = solid_of_code(*material)) ratio = 1 - std::sin(solid->internal);
  return ratio ? 1.5 * (1 - *ratio) / (1 + 2 * *ratio) : 0.6;
}

double bulk_modulus_for(const continuum::Layout& layout, double end) {
  const continuum::Parameters& p = layout.given;
  const double density = p.bed.packing * p.grains.density, speed = speed_of_fall(layout) / max_mach_number_of_fall;
  const double shear = shear_over_bulk(p.grains.material);
  const double stiff =
      moduli_over_weight[static_cast<std::size_t>(p.accuracy.value_or(continuum::Accuracy::reference))];
  return std::max(stiff * (density * p.gravity.acceleration * depth_that_may_be_reached(layout, end)),
                  density * speed * speed / (1 + 4.0 / 3 * shear));
}

void set_from_bed(const CaseFile& file, const continuum::Layout& layout, double end, continuum::Parameters& p,
                  FilledIn& filled) {
  if (!p.law.is<granular::CriticalState>()) return;
  auto& law = p.law.of<granular::CriticalState>();
  const auto set = [&](const char* key, double& number, double value) {
    if (file.contains(key) || !(value > 0)) return;
    number = value;
    filled.keys.insert_or_assign(key, "bed");
  };
  set("law.critical-state.bulk_modulus", law.bulk_modulus, bulk_modulus_for(layout, end));
  if (p.bed.packing >= law.random_loose_packing)
    set("law.critical-state.reference_packing", law.reference_packing, p.bed.packing);
  set("law.critical-state.shear_modulus", law.shear_modulus, shear_over_bulk(p.grains.material) * law.bulk_modulus);
}

void set_integration(const CaseFile& file, continuum::Parameters& p, FilledIn& filled) {
  const auto set = [&](const char* key, double& number, double value, const char* origin) {
    if (file.contains(key)) return;
    number = value;
    filled.keys.emplace(key, origin);
  };
  set("integration.courant", p.integration.courant, continuum::default_courant(p.integration.method), "method");
  if (p.levels.count > 0) set("integration.skin", p.integration.skin, continuum::skin_of_levels, "levels");
}

}  // namespace talus::app

// SPDX-License-Identifier: Apache-2.0
#include "app/law/law_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/materials/materials.hpp"
#include "io/csv_table.hpp"
#include "io/parameter_reader.hpp"
#include "models/continuum/setup/choices.hpp"

namespace talus::app {

namespace {

/// \throws InputError if the file has no law of grains, so that a default one would answer in its place
void check_has_law(const CaseFile& file) {
  const CaseEntry* const model = file.find("model");
  const auto* const name = model ? std::get_if<std::string>(&model->value.value) : nullptr;
  const auto is_of_law = [](const CaseEntry& entry) { return lies_in(entry.key, "law"); };
  const bool has_law = std::any_of(file.entries().begin(), file.entries().end(), is_of_law);
  if (name ? *name == "continuum" : has_law || file.contains("grains.material")) return;
  throw InputError({{.where = file.name(),
                     .line = model ? model->line : 0,
                     .key = model ? "model" : "",
                     .what = name ? fmt::format("{} has no law of grains", *name) : "holds no law",
                     .allowed = "a case of the model continuum; a table [law]; grains.material"}});
}

}  // namespace

LawCase read_law_case(const CaseFile& file) {
  check_has_law(file);
  static constexpr std::array<std::string_view, 10> concerned{"law",
                                                              "collisions",
                                                              "path",
                                                              "grains.material",
                                                              "grains.density",
                                                              "grains.diameter",
                                                              "walls.material",
                                                              "walls.coefficient",
                                                              "walls.adhesion",
                                                              "gravity.acceleration"};
  const CaseFile part = without_own_material(file.contains("model") ? file.part(concerned) : file);
  LawCase parameters;
  fill_in_values(file, parameters);
  continuum::Parameters whole;  // a wall's friction, and what is wrong with a file, are those of the whole case
  const FilledIn filled = fill_in_material(file, whole);
  parameters.grains.range = whole.grains.range;
  if (filled.keys.contains("walls.coefficient")) parameters.walls.coefficient = whole.walls.coefficient;
  std::string title;
  ParameterReader reader(part, continuum::renamed_keys);
  reader(Parameter{.key = "title", .text = "one line"}, title);
  for_each_parameter(reader, parameters);
  reader.check(filled.problems);
  reader.check(parameters, [](const LawCase& read) {
    std::vector<Problem> problems = granular::check(read.law);
    if (read.walls.material && !read.walls.coefficient)
      problems.push_back({.key = "walls.material",
                          .what = "no friction follows from it",
                          .allowed = "a grains.material that knows it, or walls.coefficient"});
    return problems;
  });
  auto& critical = parameters.law.of<granular::CriticalState>();
  if (part.contains("law.critical-state.bulk_modulus") && !part.contains("law.critical-state.shear_modulus"))
    critical.shear_modulus = shear_over_bulk(material_of(file)) * critical.bulk_modulus;
  reader.finish();
  return parameters;
}

std::vector<granular::PathStretch> read_path(const std::filesystem::path& path) {
  static constexpr Dimension rate{0, 0, -1, 0};
  static constexpr KnownColumn known[] = {{"duration", dimension::time},
                                          {"gradient_xx", rate},
                                          {"gradient_xy", rate},
                                          {"gradient_xz", rate},
                                          {"gradient_yx", rate},
                                          {"gradient_yy", rate},
                                          {"gradient_yz", rate},
                                          {"gradient_zx", rate},
                                          {"gradient_zy", rate},
                                          {"gradient_zz", rate},
                                          {"stress_xx", dimension::pressure},
                                          {"stress_yy", dimension::pressure},
                                          {"stress_zz", dimension::pressure},
                                          {"stress_xz", dimension::pressure}};
  static constexpr std::string_view required[] = {"duration"};
  const CsvTable table = read_csv_table(path, {.known = known,
                                               .required = required,
                                               .known_only = true,
                                               .header = "duration [s], gradient_xz [1/s], gradient_zz [1/s], ..."});
  std::vector<granular::PathStretch> stretches(table.lines.size());
  std::vector<Problem> problems;
  if (stretches.empty())
    problems.push_back({.where = path.string(), .what = "holds no stretch", .allowed = "a line for each"});
  const auto value = [&](std::string_view name, std::size_t row) {
    const CsvColumn* const column = table.find(name);
    return column ? column->values[row] : 0.0;
  };
  for (std::size_t row = 0; row < stretches.size(); ++row) {
    Tensor3<>& l = stretches[row].velocity_gradient;
    double* const component[] = {&l.xx, &l.xy, &l.xz, &l.yx, &l.yy, &l.yz, &l.zx, &l.zy, &l.zz};
    for (std::size_t k = 0; k < 9; ++k) *component[k] = value(known[k + 1].name, row);
    for (std::size_t k = 0; k < 4; ++k)
      if (table.find(known[k + 10].name)) stretches[row].stress[k] = value(known[k + 10].name, row);
    stretches[row].duration = value("duration", row);
    if (stretches[row].duration < 0)
      problems.push_back({.where = path.string(),
                          .line = table.lines[row],
                          .key = "duration",
                          .what = fmt::format("{} s is negative", stretches[row].duration),
                          .allowed = "at least 0 s"});
  }
  for (const auto& [stress, gradient] : {std::pair{"stress_xx", "gradient_xx"},
                                         {"stress_yy", "gradient_yy"},
                                         {"stress_zz", "gradient_zz"},
                                         {"stress_xz", "gradient_xz"}})
    if (table.find(stress) && table.find(gradient))
      problems.push_back({.where = path.string(),
                          .line = 1,
                          .key = gradient,
                          .what = fmt::format("follows from {}", stress),
                          .allowed = "one of the two columns"});
  if (!problems.empty()) throw InputError(problems);
  return stretches;
}

granular::PathOptions path_options(const LawCase& parameters, std::size_t stretches) {
  const auto& path = parameters.path;
  constexpr std::size_t rows = 600;
  const double at_touch = with_chosen_law(parameters.law, []<class Law>(const typename Law::Parameters& own) {
    if constexpr (requires { own.contact; }) return own.contact.reference_packing;
    if constexpr (requires { own.reference_packing; }) return own.reference_packing;
    return granular::Contact{}.reference_packing;
  });
  return {.density = path.packing.value_or(at_touch) * parameters.grains.density,
          .max_increment = path.max_increment,
          .points = path.points > 0 ? static_cast<int>(path.points)
                                    : static_cast<int>((rows + stretches - 1) / std::max<std::size_t>(stretches, 1))};
}

}  // namespace talus::app

// SPDX-License-Identifier: Apache-2.0
/// talus schema: what a case may say, as JSON Schema for editors or as a page for people. talus materials: what it may
/// name as its grains, with the values, their ranges and their sources.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "analysis/measure.hpp"
#include "app/commands.hpp"
#include "app/materials/materials.hpp"
#include "app/models/models.hpp"
#include "app/usage/tree.hpp"
#include "base/text.hpp"
#include "io/parameter_writer.hpp"

namespace talus::app {

namespace {

std::string page_head(const std::string& model) {
  constexpr std::size_t width = 100;
  const std::string text = fmt::format(
      "Every key of a case of the model `{0}`. This page is the output of `talus schema {0} --markdown`; the texts are "
      "defined with the parameters in `src/models/{1}/parameters.hpp`. Quantities are strings with a unit (`\"5 "
      "mm\"`), of any unit of their dimension: m, in, ft; g, t, lb; s, min, h, d; rad, deg, rev, rpm; N, lbf, Pa, bar, "
      "psi, psf, J, W, Hz; L, cc, P, cP; with the prefixes n, u, m, c, k, M, G of SI units, products (`Pa s`), "
      "quotients (`t/h`) and "
      "powers (`m/s2`). The unit below is that of the default and of the output of `talus check`.",
      model, model == "continuum" ? "continuum/setup" : model);
  return fmt::format("# Case reference: {}\n\n{}\n", model, wrapped(text, width, 0, 0));
}

/// One row per measure.
std::string table_of(const std::vector<MeasureText>& measures) {
  std::string table = "| name | unit | definition |\n|---|---|---|\n";
  for (const MeasureText& m : measures) {
    std::string text(m.text);
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
    table += fmt::format("| `{}` | {} | {} |\n", m.name, m.unit, text);
  }
  return table;
}

std::string page_of_quantities() {
  std::string page =
      "# Quantities\n\nThe numbers that describe a run: in its `summary.json`, in `analysis/snapshots.csv`, and in "
      "the\nrows of `validation/*/reference.toml`. Units are SI, angles in degrees; `1` marks a number. A\nsummary "
      "lists those that apply to the case. The time window is that of a row; in a summary it is the\nwhole run, its "
      "end, or what the definition says. Quantities that only one study needs are measured\nby its "
      "`validation/STUDY/measures.py`; `python3 -m talus.measures --table validation/STUDY` lists\nthem. This page is "
      "the output of `talus schema --quantities`; the texts are in the lists\n`src/analysis/hopper_measures.cpp` and "
      "`src/analysis/avalanche_measures.cpp`.\n";
  const auto add = [&page](const char* title, const char* symbols, const std::vector<MeasureText>& measures) {
    page += fmt::format("\n## {}\n\n{}\n\n{}", title, symbols, table_of(measures));
  };
  add("Grains in a vessel: continuum", symbols_of_hopper_measures, texts_of_hopper_measures());
  add("Avalanches and falling clouds: cloud", symbols_of_avalanche_measures, texts_of_avalanche_measures());
  return page;
}

using continuum::GrainMaterial;

ExitStatus list_materials() {
  for (std::size_t n = 0; n < choices<GrainMaterial>.size(); ++n)
    print("{:12}  {}\n", choices<GrainMaterial>[n], title_of(static_cast<GrainMaterial>(n)));
  return ExitStatus::done;
}

ExitStatus print_material(GrainMaterial material) {
  print("{}: {}\n", choice_name(material), title_of(material));
  for (const MaterialLine& line : lines_of(material)) {
    print("\n{}{}{}\n", line.key, line.value.empty() ? "" : " = " + line.value,
          line.range.empty() ? "" : fmt::format("  ({})", line.range));
    if (!line.source.empty()) print("  {}\n", wrapped(line.source, terminal_width(), 2, 2));
    if (line.test.empty()) continue;
    const std::string measured = line.angle.empty() ? "" : fmt::format(", {}", line.angle);
    print("  {}\n", wrapped(fmt::format("test: {}{}; as an angle {}", line.test, measured,
                                        angles_of_friction(parse_quantity(line.value)->value)),
                            terminal_width(), 2, 2));
  }
  return ExitStatus::done;
}

}  // namespace

void add_schema_command(CLI::App& app, Action& action) {
  struct Options {
    std::string model = "cloud";
    bool page = false, quantities = false, commands = false;
  };
  auto options = std::make_shared<Options>();
  std::vector<std::string> names;
  for (const ModelEntry& entry : models()) names.emplace_back(entry.name);
  CLI::App* command = app.add_subcommand("schema", "print the JSON Schema of a model's cases");
  command->add_option("MODEL", options->model, "model")->check(CLI::IsMember(names))->capture_default_str();
  command->add_flag("--markdown", options->page, "print the reference page instead");
  command->add_flag("--quantities", options->quantities, "print the page of all quantities of all models instead");
  command->add_flag("--commands", options->commands, "print the commands and their options as JSON instead");
  command->callback([&app, options, &action] {
    action = [&app, options] {
      if (options->commands) {
        fmt::print("{}", usage_json(usage_of(app)));
        return ExitStatus::done;
      }
      if (options->quantities) {
        fmt::print("{}", page_of_quantities());
        return ExitStatus::done;
      }
      const ParameterList list = std::find_if(models().begin(), models().end(), [&](const ModelEntry& entry) {
                                   return entry.name == options->model;
                                 })->parameters();
      if (options->page)
        fmt::print("{}\n{}", page_head(options->model), reference_page(list));
      else
        fmt::print("{}", json_schema(list, "Talus case, model " + options->model));
      return ExitStatus::done;
    };
  });
}

void add_materials_command(CLI::App& app, Action& action) {
  auto name = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(
      "materials", "list the materials that a case may name, or the values of one and their sources");
  const std::vector<std::string> names(choices<GrainMaterial>.begin(), choices<GrainMaterial>.end());
  command->add_option("MATERIAL", *name, "material; none: list all")->check(CLI::IsMember(names));
  command->callback([name, &action] {
    action = [name] {
      for (std::size_t n = 0; n < choices<GrainMaterial>.size(); ++n)
        if (choices<GrainMaterial>[n] == *name) return print_material(static_cast<GrainMaterial>(n));
      return list_materials();
    };
  });
}

}  // namespace talus::app

// SPDX-License-Identifier: Apache-2.0
/// talus materials: what a case may name as its grains, with the values, their ranges and their sources.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.hpp"
#include "app/materials/materials.hpp"
#include "base/text.hpp"

namespace talus::app {

namespace {

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

// SPDX-License-Identifier: Apache-2.0
/// talus schema: what a case may say, as JSON Schema for editors or as a page for people.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "app/commands.hpp"
#include "app/prepared_case.hpp"
#include "base/terminal.hpp"
#include "io/parameter_schema.hpp"

namespace talus::app {

namespace {

std::string page_head(const std::string& model) {
  constexpr std::size_t width = 100;
  const std::string text = fmt::format(
      "Every key of a case of the model `{0}`. This page is the output of `talus schema {0} --markdown`; the texts "
      "stand beside the parameters in `src/models/{0}/parameters.hpp`. Quantities are strings with a unit (`\"5 "
      "mm\"`), "
      "of any unit of their dimension; the unit below is that of the default and of the output of `talus check`.",
      model);
  return fmt::format("# Case reference: {}\n\n{}\n", model, wrapped(text, width, 0, 0));
}

}  // namespace

void add_schema_command(CLI::App& app, Action& action) {
  struct Options {
    std::string model = "cloud";
    bool page = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("schema", "print the JSON Schema of a model's cases");
  command->add_option("MODEL", options->model, "model")
      ->check(CLI::IsMember(std::vector<std::string>(model_names.begin(), model_names.end())))
      ->capture_default_str();
  command->add_flag("--markdown", options->page, "print the reference page instead");
  command->callback([options, &action] {
    action = [options] {
      const ParameterList list = parameters_of(options->model);
      if (options->page)
        fmt::print("{}\n{}", page_head(options->model), reference_page(list));
      else
        fmt::print("{}", json_schema(list, "Talus case, model " + options->model));
      return ExitStatus::done;
    };
  });
}

}  // namespace talus::app

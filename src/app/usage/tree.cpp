// SPDX-License-Identifier: Apache-2.0
#include "app/usage/tree.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

namespace talus::app {

namespace {

/// CLI11 writes the choices of IsMember into the name of the type: "TEXT:{here,slurm}".
std::vector<std::string> choices_of(const std::string& type) {
  const std::size_t begin = type.find('{'), end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos || end < begin) return {};
  return CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',');
}

UsageOption described(const CLI::Option& option) {
  UsageOption described{.text = option.get_description(), .is_place = option.get_positional()};
  if (described.is_place) {
    described.names.push_back(option.get_name(true));
  } else {
    for (const std::string& name : option.get_lnames()) described.names.push_back("--" + name);
    for (const std::string& name : option.get_snames()) described.names.push_back("-" + name);
  }
  described.is_required = option.get_required();
  const bool takes_value = option.get_items_expected_max() > 0 && option.get_expected_max() > 0;
  if (takes_value) {
    const std::string type = option.get_type_name();
    described.choices = choices_of(type);
    described.value = type.substr(0, std::min({type.find(':'), type.find(' '), type.size()}));
    if (described.value.empty()) described.value = "VALUE";
    described.standard = option.get_default_str();
  }
  described.takes_several = takes_value && option.get_items_expected_max() > 1;
  described.takes_folder = described.names.front() == "DIR";
  return described;
}

void describe(const CLI::App& app, const std::string& name, std::vector<UsageCommand>& all) {
  UsageCommand command{.name = name, .text = app.get_description(), .footer = app.get_footer()};
  for (const CLI::Option* option : app.get_options()) command.options.push_back(described(*option));
  const auto below = app.get_subcommands([](const CLI::App* sub) { return !sub->get_group().empty(); });
  for (const CLI::App* sub : below) command.commands.push_back(sub->get_name());
  all.push_back(std::move(command));
  for (const CLI::App* sub : below) describe(*sub, name.empty() ? sub->get_name() : name + " " + sub->get_name(), all);
}

}  // namespace

std::vector<UsageCommand> usage_of(const CLI::App& app) {
  std::vector<UsageCommand> all;
  describe(app, "", all);
  return all;
}

std::string usage_json(const std::vector<UsageCommand>& usage) {
  nlohmann::ordered_json json;
  for (const UsageCommand& command : usage) {
    auto& entry = json[command.name];
    entry = {{"text", command.text}, {"commands", command.commands}, {"options", nlohmann::ordered_json::array()}};
    for (const UsageOption& option : command.options)
      entry["options"].push_back({{"names", option.names},
                                  {"text", option.text},
                                  {"value", option.value},
                                  {"choices", option.choices},
                                  {"place", option.is_place},
                                  {"required", option.is_required},
                                  {"several", option.takes_several}});
  }
  return json.dump(2) + "\n";
}

}  // namespace talus::app

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "app/usage/tree.hpp"

namespace talus::app {

namespace {

using Words = std::vector<std::string>;

Words option_names(const UsageCommand& command) {
  Words names;
  for (const UsageOption& option : command.options)
    if (!option.is_place) names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

bool takes_folders(const UsageCommand& command) {
  return std::any_of(command.options.begin(), command.options.end(),
                     [](const UsageOption& option) { return option.takes_folder; });
}

/// Between single quotes of a shell.
std::string quoted(std::string text) {
  for (std::size_t at = 0; (at = text.find('\'', at)) != std::string::npos; at += 4) text.replace(at, 1, "'\\''");
  return '\'' + text + '\'';
}

/// The first sentence: what a list of options has room for.
std::string brief(const std::string& text) {
  return text.substr(0, std::min(text.find("; "), text.find(": ")));
}

/// The command that the words before the cursor name, in the variable `command`.
std::string bash(const std::vector<UsageCommand>& usage) {
  Words all;
  for (const UsageCommand& command : usage)
    if (!command.name.empty()) all.push_back(quoted(command.name));
  std::string text = fmt::format(
      "# bash completion of talus, written by talus completion bash\n"
      "_talus() {{\n"
      "  local current=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} command= word known candidate\n"
      "  COMPREPLY=()\n"
      "  for word in \"${{COMP_WORDS[@]:1:COMP_CWORD-1}}\"; do\n"
      "    candidate=${{command:+$command }}$word\n"
      "    for known in {}; do\n"
      "      if [[ $candidate == \"$known\" ]]; then command=$candidate; fi\n"
      "    done\n"
      "  done\n"
      "  case $command in\n",
      fmt::join(all, " "));
  for (const UsageCommand& command : usage) {
    text += fmt::format("    {})\n      case $before in\n", quoted(command.name));
    for (const UsageOption& option : command.options) {
      if (option.is_place || option.value.empty()) continue;
      const std::string reply = option.choices.empty()
                                    ? "compopt -o default"
                                    : fmt::format("COMPREPLY=($(compgen -W {} -- \"$current\"))",
                                                  quoted(fmt::format("{}", fmt::join(option.choices, " "))));
      text += fmt::format("        {}) {}; return ;;\n", fmt::join(option.names, "|"), reply);
    }
    Words words = option_names(command);
    text += fmt::format(
        "      esac\n"
        "      if [[ $current == -* ]]; then COMPREPLY=($(compgen -W {} -- \"$current\")); return; fi\n",
        quoted(fmt::format("{}", fmt::join(words, " "))));
    Words places = command.commands;
    for (const UsageOption& option : command.options)
      if (option.is_place) places.insert(places.end(), option.choices.begin(), option.choices.end());
    if (!places.empty())
      text += fmt::format("      COMPREPLY=($(compgen -W {} -- \"$current\")) ;;\n",
                          quoted(fmt::format("{}", fmt::join(places, " "))));
    else
      text += fmt::format("      compopt -o {} ;;\n", takes_folders(command) ? "dirnames" : "default");
  }
  return text + "  esac\n}\ncomplete -F _talus talus\n";
}

/// The part of a zsh specification that says what a value may be.
std::string zsh_value(const UsageOption& option) {
  if (option.value.empty()) return "";
  if (!option.choices.empty()) return fmt::format(":{}:({})", option.value, fmt::join(option.choices, " "));
  return fmt::format(":{}:{}", option.value, option.takes_folder ? "_files -/" : "_files");
}

std::string zsh_text(const std::string& text) {
  std::string plain;
  for (const char c : brief(text)) plain += c == '[' || c == ']' || c == ':' ? ' ' : c;
  return plain;
}

std::string zsh(const std::vector<UsageCommand>& usage) {
  std::string text = "#compdef talus\n# zsh completion of talus, written by talus completion zsh\n";
  for (const UsageCommand& command : usage) {
    std::string function = "_talus_" + command.name;
    std::replace(function.begin(), function.end(), ' ', '_');
    text += fmt::format("{}() {{\n  local state\n  local -a commands\n  _arguments -C", function);
    for (const UsageOption& option : command.options) {
      if (option.is_place) {
        text += " \\\n    " + quoted("*" + (option.value.empty() ? ":VALUE:_files" : zsh_value(option)));
        continue;
      }
      for (const std::string& name : option.names)
        text += " \\\n    " + quoted(fmt::format("*{}[{}]{}", name, zsh_text(option.text), zsh_value(option)));
    }
    if (!command.commands.empty()) {
      text += " \\\n    '1: :->command' '*:: :->rest'\n  case $state in\n    command)\n      commands=(";
      for (const std::string& name : command.commands) {
        const std::string full = command.name.empty() ? name : command.name + " " + name;
        const auto found = std::find_if(usage.begin(), usage.end(), [&](const auto& c) { return c.name == full; });
        text += "\n        " + quoted(name + ":" + zsh_text(found->text));
      }
      text += fmt::format(")\n      _describe command commands ;;\n    rest) {}_$words[1] ;;\n  esac",
                          command.name.empty() ? "_talus" : function);
    }
    text += "\n}\n";
  }
  // The program's own function is _talus_ above; it is what completion begins with.
  return text +
         "_talus() { _talus_ \"$@\" }\nif [[ $funcstack[1] == _talus ]]; then _talus_ \"$@\"; else compdef _talus "
         "talus; fi\n";
}

std::string fish(const std::vector<UsageCommand>& usage) {
  std::string text = "# fish completion of talus, written by talus completion fish\n";
  for (const UsageCommand& command : usage) {
    std::string words = command.name, condition;
    if (command.name.empty()) {
      condition = "__fish_use_subcommand";
    } else {
      condition = "__fish_seen_subcommand_from " + words.substr(0, words.find(' '));
      if (words.find(' ') != std::string::npos)
        condition += "; and __fish_seen_subcommand_from " + words.substr(words.find(' ') + 1);
    }
    for (const std::string& name : command.commands) {
      const std::string full = command.name.empty() ? name : command.name + " " + name;
      const auto found = std::find_if(usage.begin(), usage.end(), [&](const auto& c) { return c.name == full; });
      text +=
          fmt::format("complete -c talus -f -n {} -a {} -d {}\n", quoted(condition), name, quoted(brief(found->text)));
    }
    for (const UsageOption& option : command.options) {
      if (option.is_place) continue;
      text += fmt::format("complete -c talus -n {}", quoted(condition));
      for (const std::string& name : option.names)
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      if (!option.value.empty()) text += " -r";
      if (!option.choices.empty())
        text += fmt::format(" -f -a {}", quoted(fmt::format("{}", fmt::join(option.choices, " "))));
      text += fmt::format(" -d {}\n", quoted(brief(option.text)));
    }
  }
  return text;
}

}  // namespace

std::string completion_for(const std::string& shell, const std::vector<UsageCommand>& usage) {
  return shell == "bash" ? bash(usage) : shell == "zsh" ? zsh(usage) : fish(usage);
}

}  // namespace talus::app

// SPDX-License-Identifier: Apache-2.0
/// talus completion and talus man: what is made of the command line's own description.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/commands.hpp"
#include "app/usage/tree.hpp"
#include "base/terminal.hpp"

namespace talus::app {

void add_completion_command(CLI::App& app, Action& action) {
  auto shell = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("completion", "print a script that completes commands and options in a shell");
  command->add_option("SHELL", *shell, "which shell")->required()->check(CLI::IsMember({"bash", "zsh", "fish"}));
  command->footer(
      "  bash  source <(talus completion bash)\n"
      "  zsh   talus completion zsh > FOLDER/_talus, a folder of fpath\n"
      "  fish  talus completion fish > ~/.config/fish/completions/talus.fish");
  command->callback([&app, shell, &action] {
    action = [&app, shell] {
      print("{}", completion_for(*shell, usage_of(app)));
      return ExitStatus::done;
    };
  });
}

void add_man_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("man", "print the man page");
  command->footer("  talus man > talus.1 && man -l talus.1");
  command->callback([&app, &action] {
    action = [&app] {
      print("{}", man_page(usage_of(app)));
      return ExitStatus::done;
    };
  });
}

}  // namespace talus::app

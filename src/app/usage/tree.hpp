// SPDX-License-Identifier: Apache-2.0
/// The commands and their options as CLI11 knows them, for whatever is made of all of them: completion, man page.
#pragma once

#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): the library has named it
class App;
}

namespace talus::app {

struct UsageOption {
  std::vector<std::string> names = {};    ///< "--out", "-o"; of a place on the command line its name, "DIR"
  std::string text = {};                  ///< description
  std::string value = {};                 ///< what it takes, "FILE"; empty: a flag
  std::string standard = {};              ///< if not given; empty: none
  std::vector<std::string> choices = {};  ///< if only these are allowed
  bool is_place = false, is_required = false;
  bool takes_folder = false, takes_several = false;
};

struct UsageCommand {
  std::string name = {};  ///< "new hopper"; of the program empty
  std::string text = {}, footer = {};
  std::vector<UsageOption> options = {};
  std::vector<std::string> commands = {};  ///< names of those below it
};

/// The program first, then every command, those below a command after it.
std::vector<UsageCommand> usage_of(const CLI::App& app);

/// An object per command, by its name: text, commands, options (names, text, value, choices, place, required).
std::string usage_json(const std::vector<UsageCommand>& usage);

/// Scripts that complete commands, options, choices and file names. \param shell bash, zsh or fish
std::string completion_for(const std::string& shell, const std::vector<UsageCommand>& usage);

/// The man page talus(1), in the macros of man(7).
std::string man_page(const std::vector<UsageCommand>& usage);

}  // namespace talus::app

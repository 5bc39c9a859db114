// SPDX-License-Identifier: Apache-2.0
/// The commands. Each adds itself to the command line; what it does runs after parsing and gives the exit status.
#pragma once

#include <functional>

#include "base/error.hpp"

namespace CLI {
class App;
}

namespace talus::app {

/// Set by the command that was chosen.
using Action = std::function<ExitStatus()>;

void add_run_command(CLI::App& app, Action& action);
void add_check_command(CLI::App& app, Action& action);
void add_ensemble_command(CLI::App& app, Action& action);
void add_compare_command(CLI::App& app, Action& action);
void add_analyze_command(CLI::App& app, Action& action);
void add_law_command(CLI::App& app, Action& action);
void add_reproduce_command(CLI::App& app, Action& action);
void add_report_command(CLI::App& app, Action& action);
void add_picture_command(CLI::App& app, Action& action);
void add_movie_command(CLI::App& app, Action& action);
void add_new_command(CLI::App& app, Action& action);
void add_materials_command(CLI::App& app, Action& action);
void add_schema_command(CLI::App& app, Action& action);
void add_answer_command(CLI::App& app, Action& action);
/// Of all commands that have been added when it runs.
void add_completion_command(CLI::App& app, Action& action);
void add_man_command(CLI::App& app, Action& action);

}  // namespace talus::app

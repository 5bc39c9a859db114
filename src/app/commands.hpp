// SPDX-License-Identifier: Apache-2.0
/// The commands, and the options that several have. Each command adds itself to the command line; what it does runs
/// after parsing and gives the exit status.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/unit.hpp"
#include "io/case_file.hpp"
#include "ranks/ranks.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming)
class App;
class Option;
}  // namespace CLI

namespace talus::app {

/// Set by the command that was chosen.
using Action = std::function<ExitStatus()>;

/// \param ranks the processes that run a case together; they outlive the action
void add_run_command(CLI::App& app, Action& action, const Ranks& ranks);
void add_check_command(CLI::App& app, Action& action);
void add_ensemble_command(CLI::App& app, Action& action);
void add_compare_command(CLI::App& app, Action& action);
void add_analyze_command(CLI::App& app, Action& action);
void add_law_command(CLI::App& app, Action& action);
void add_shear_cell_command(CLI::App& app, Action& action);
void add_calibrate_command(CLI::App& app, Action& action);
void add_hopper_design_command(CLI::App& app, Action& action);

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

/// What every command that takes a case takes: the file, --set.
struct CaseOptions {
  std::string path;
  std::vector<std::string> settings;

  void add_to(CLI::App& command);
  /// \throws FileError, InputError as CaseFile
  CaseFile read() const;
};

/// Numbers above 0 of a list "a,b,c" in a dimension. Adds what is wrong with it to the problems. \param allowed in
/// words
std::vector<double> numbers_of(const std::string& option, const std::string& text, const Dimension& unit, double below,
                               const std::string& allowed, std::vector<Problem>& problems);

/// Where the results of a case go without --out: results/NAME of the case.
std::filesystem::path default_results(const std::string& case_path);

/// The file to write. \throws InputError if none was given, it is a folder, or its ending is none of those allowed;
/// FileError if its folder is not there
std::filesystem::path read_out(const std::string& text, const std::vector<std::string>& endings);

/// Adds --out DIR; none given leaves `out` empty, an empty one is an error.
void add_out_option(CLI::App& command, std::string& out, const std::string& text);

/// Adds --threads N with the number of processors as default.
void add_threads_option(CLI::App& command, int& threads);

/// Adds --launch here or slurm, which is returned, and --slurm OPTION for sbatch.
CLI::Option* add_launch_options(CLI::App& command, std::string& launch, std::vector<std::string>& of_sbatch,
                                const std::string& text);

/// What a command was given, checked: --NAME, --NAME=VALUE, positional values after "--".
std::vector<std::string> words_of(const CLI::App& command);

}  // namespace talus::app

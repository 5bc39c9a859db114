// SPDX-License-Identifier: Apache-2.0
#include "app/program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include "app/commands.hpp"
#include "base/error.hpp"
#include "base/system.hpp"
#include "base/text.hpp"

namespace {

/// What is wrong with the command's name, if anything. The first word must be one, whatever options stand around it:
/// `talus plto --help` is a slip, not a question. So must the second of a command that has commands of its own.
std::optional<talus::Problem> check_command(const CLI::App& app, std::vector<std::string_view> arguments,
                                            const std::string& where = "talus") {
  const auto word = std::find_if(arguments.begin(), arguments.end(),
                                 [](std::string_view argument) { return !argument.starts_with('-'); });
  const bool none = word == arguments.end();
  if (none && !arguments.empty()) return std::nullopt;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({}))
    if (!command->get_group().empty() || command->check_name(none ? "" : std::string(*word)))  // not the hidden one
      names.push_back(command->get_name());
  if (names.empty()) return std::nullopt;
  if (!none && std::find(names.begin(), names.end(), *word) != names.end()) {
    const CLI::App& chosen = *app.get_subcommand(std::string(*word));
    const std::string command = where + " " + chosen.get_name();
    arguments.erase(word);
    return check_command(chosen, std::move(arguments), command);
  }
  const std::vector<std::string_view> commands(names.begin(), names.end());
  return talus::Problem{.where = where,
                        .what = none ? "no command" : fmt::format("there is no command '{}'", *word),
                        .allowed = fmt::format("{}; {} --help says more", fmt::join(names, ", "), where),
                        .nearest = none ? std::string() : std::string(talus::nearest(*word, commands))};
}

/// What the command line's parser says, help or fault.
int answer(const CLI::App& app, const CLI::ParseError& error) {
  std::ostringstream out, fault;
  const int status = app.exit(error, out, fault);
  talus::print("{}", out.str());
  talus::print_error("{}", fault.str());
  return static_cast<int>(status == 0 ? talus::ExitStatus::done : talus::ExitStatus::bad_input);
}

}  // namespace

int talus::app::run_command_line(int argc, char** argv, const Ranks& ranks) {
  using talus::ExitStatus;
  CLI::App app("Talus simulates granular material and the air around it.", "talus");
  app.set_version_flag("--version", fmt::format("talus {} ({})", talus::program_version(), talus::program_revision()));
  app.require_subcommand(1);
  app.footer(
      "Exit status: 0 done, 1 comparison not met or no Python for it, 2 bad case or usage, 3 numerical failure, 4 file "
      "trouble,\n"
      "130 interrupted (after a checkpoint).\n\n"
      "First steps:\n"
      "  talus check cases/niiya2020-circle.toml          what the case says, in SI, and what the run will take\n"
      "  talus run cases/niiya2020-circle.toml            the run; its folder is results/niiya2020-circle");
  talus::app::Action action;
  talus::app::add_new_command(app, action);
  talus::app::add_run_command(app, action, ranks);
  talus::app::add_check_command(app, action);
  talus::app::add_ensemble_command(app, action);
  talus::app::add_compare_command(app, action);
  talus::app::add_analyze_command(app, action);
  talus::app::add_law_command(app, action);
  talus::app::add_shear_cell_command(app, action);
  talus::app::add_calibrate_command(app, action);
  talus::app::add_hopper_design_command(app, action);
  talus::app::add_reproduce_command(app, action);
  talus::app::add_report_command(app, action);
  talus::app::add_picture_command(app, action);
  talus::app::add_movie_command(app, action);
  talus::app::add_materials_command(app, action);
  talus::app::add_schema_command(app, action);
  talus::app::add_answer_command(app, action);
  talus::app::add_completion_command(app, action);
  talus::app::add_man_command(app, action);

  const auto say = [&](const std::string& line) {
    if (ranks.is_first()) talus::print_error("{}\n", line);
  };
  const auto fail = [&](ExitStatus status, const std::string& message) {
    say("talus: " + message);
    return static_cast<int>(status);
  };
  try {
    if (const auto problem = check_command(app, {argv + 1, argv + argc})) {
      say(talus::to_string(*problem));
      return static_cast<int>(ExitStatus::bad_input);
    }
    app.parse(argc, argv);
    const bool follows = app.get_subcommands().front()->get_name() == "run";
    return static_cast<int>(ranks.is_first() || follows ? action() : ExitStatus::done);
  } catch (const CLI::ParseError& error) {
    return ranks.is_first() ? answer(app, error) : 0;
  } catch (const talus::InputError& error) {
    for (const talus::Problem& problem : error.problems()) say(talus::to_string(problem));
    const std::size_t count = error.problems().size();
    return fail(ExitStatus::bad_input, fmt::format("{} problem{} in the input", count, count == 1 ? "" : "s"));
  } catch (const talus::NumericalError& error) {
    return fail(ExitStatus::numerical, error.what());
  } catch (const talus::FileError& error) {
    return fail(ExitStatus::files, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(ExitStatus::files, error.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitStatus::numerical, "out of memory");
  } catch (const std::exception& error) {
    return fail(ExitStatus::numerical, fmt::format("internal error, please report it: {}", error.what()));
  }
}

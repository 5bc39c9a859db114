// SPDX-License-Identifier: Apache-2.0
/// The program `talus`: parses the command line, runs one command, and turns errors into messages and exit statuses.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <new>

#include "app/commands.hpp"
#include "base/error.hpp"
#include "base/version.hpp"

int main(int argc, char** argv) {
  using talus::ExitStatus;
  CLI::App app("Talus simulates granular material and the air around it.", "talus");
  app.set_version_flag("--version", fmt::format("talus {} ({})", talus::program_version(), talus::program_revision()));
  app.require_subcommand(1);
  app.footer(
      "Exit status: 0 done, 1 comparison not met, 2 bad case or usage, 3 numerical failure, 4 file trouble,\n"
      "130 interrupted (after a checkpoint).\n\n"
      "First steps:\n"
      "  talus check cases/niiya2020-circle.toml          what the case says, in SI, and what the run will take\n"
      "  talus run cases/niiya2020-circle.toml            the run; its folder is results/niiya2020-circle");
  talus::app::Action action;
  talus::app::add_run_command(app, action);
  talus::app::add_check_command(app, action);
  talus::app::add_ensemble_command(app, action);
  talus::app::add_compare_command(app, action);
  talus::app::add_analyze_command(app, action);
  talus::app::add_law_command(app, action);
  talus::app::add_reproduce_command(app, action);
  talus::app::add_schema_command(app, action);

  auto fail = [](ExitStatus status, const std::string& message) {
    fmt::print(stderr, "talus: {}\n", message);
    return static_cast<int>(status);
  };
  try {
    app.parse(argc, argv);
    return static_cast<int>(action());
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitStatus::bad_input);
  } catch (const talus::InputError& error) {
    for (const talus::Problem& problem : error.problems()) fmt::print(stderr, "{}\n", talus::to_string(problem));
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

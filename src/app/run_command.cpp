// SPDX-License-Identifier: Apache-2.0
/// talus run: a case to a folder of results.
#include <fmt/format.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/case_options.hpp"
#include "app/commands.hpp"
#include "app/models/models.hpp"
#include "app/runs/run_case.hpp"

namespace talus::app {

namespace {

struct RunOptions {
  CaseOptions case_options;
  RunRequest request;
  std::string out;
  bool resume = false, overwrite = false;
};

ExitStatus run(const RunOptions& options) {
  CaseFile file = options.case_options.read();
  RunRequest request = options.request;
  request.folder = options.out.empty()
                       ? std::filesystem::path("results") / std::filesystem::path(options.case_options.path).stem()
                       : std::filesystem::path(options.out);
  request.existing = options.resume ? Existing::resume : options.overwrite ? Existing::overwrite : Existing::refuse;
  if (options.resume) keep_snapshot_interval(file, request.folder);
  const PreparedCase prepared = prepare_case(file);
  check_memory(prepared, file);
  return run_case(prepared, request);
}

}  // namespace

void add_run_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand("run", "run a case");
  options->case_options.add_to(*command);
  add_out_option(*command, options->out, "folder of the results; results/NAME of the case if not given");
  add_threads_option(*command, options->request.threads);
  auto* resume = command->add_flag("--resume", options->resume, "go on with the run in the folder");
  command->add_flag("--overwrite", options->overwrite, "replace the run in the folder")->excludes(resume);
  command->add_flag("--dry-run", options->request.dry_run, "read and check the case, build its start, write nothing");
  command
      ->add_option("--walltime", options->request.walltime,
                   "leave with a checkpoint after so many seconds of wall time")
      ->check(CLI::PositiveNumber);
  command->footer(
      "The folder holds manifest.json, series.csv, snapshots/*.vtkhdf (ParaView), checkpoints, analysis/, pictures/,\n"
      "summary.json and log.txt. Ctrl-C, SIGTERM, a file `stop` in the folder and --walltime end the run with a\n"
      "checkpoint (exit status 130); --resume goes on with the same bits.");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace talus::app

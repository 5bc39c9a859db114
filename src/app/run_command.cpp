// SPDX-License-Identifier: Apache-2.0
/// talus run: a case to a folder of results.
#include <fmt/format.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/commands.hpp"
#include "app/models/models.hpp"
#include "app/project/project.hpp"
#include "app/runs/refinement.hpp"
#include "app/runs/run_case.hpp"
#include "base/text.hpp"
#include "io/parameter_reader.hpp"
#include "io/run_folder.hpp"
#include "numerics/run_record.hpp"
#include "ranks/ranks.hpp"
#include "run/led_model.hpp"
#include "run/progress.hpp"

namespace talus::app {

namespace {

struct RunOptions {
  CaseOptions case_options;
  RunRequest request;
  std::string out, launch;
  std::vector<std::string> of_sbatch;
  int nodes = 1;
  bool resume = false, overwrite = false, refine = false, threads_given = false;
};

void print_warnings(const PreparedCase& prepared) {
  for (const Warning& warning : warnings_of(prepared.regime))
    print("! {}\n", wrapped(warning.text, terminal_width(), 2, 2));
}

std::filesystem::path folder_of_finer(const RunRequest& coarse) {
  return std::filesystem::path(coarse.folder) += "-refined";
}

/// The same case with a finer spacing in the folder beside, and what both say of none.
ExitStatus run_finer(const PreparedCase& prepared, const RunRequest& coarse) {
  RunRequest request = coarse;
  request.folder = folder_of_finer(coarse);
  print("Now with the spacing divided by {}: {}\n", refinement, request.folder.string());
  if (request.existing == Existing::resume && !std::filesystem::exists(RunFolder(request.folder).manifest()))
    request.existing = Existing::refuse;
  if (const ExitStatus status = run_case(prepared, request); status != ExitStatus::done || request.dry_run)
    return status;
  const std::vector<RefinedQuantity> quantities = extrapolated(
      read_summary(RunFolder(coarse.folder).summary()), read_summary(RunFolder(request.folder).summary()), refinement);
  write_refinement(coarse.folder / "analysis" / "refinement.json", quantities);
  print("{}", table_of(quantities));
  return ExitStatus::done;
}

/// The case, which every process reads. \throws what reading it throws; if only others cannot, FileError
PreparedCase prepare_together(const RunOptions& options, const RunRequest& request, const Ranks& ranks) {
  std::optional<PreparedCase> prepared;
  std::exception_ptr error;
  std::string told;
  try {
    const CaseFile file = options.case_options.read();
    prepared = options.resume ? prepare_to_resume(file, request.folder) : prepare_case(file);
    check_ranks(*prepared, file, ranks.size());
  } catch (const std::exception& fault) {
    error = std::current_exception();
    told = fmt::format("process {}: {}\n", ranks.rank(), fault.what());
  }
  told = ranks.gather(told);
  if (error) std::rethrow_exception(error);
  if (!told.empty()) throw FileError(options.case_options.path, "not every process could read the case: " + told);
  const std::string sets = ranks.gather(prepared->instruction_set + ' ');
  std::string same;
  for (int r = 0; r < ranks.size(); ++r) same += prepared->instruction_set + ' ';
  if (sets != same)
    throw InputError({{.where = options.case_options.path,
                       .key = "integration.instruction_set",
                       .what = "the processors of the processes differ: " + sets,
                       .allowed = "one that all of them have"}});
  return std::move(*prepared);
}

/// On several processes: the first one runs the case, the others follow.
ExitStatus run_together(const RunOptions& options, RunRequest request, const Ranks& ranks) {
  if (options.refine)
    throw InputError(
        {{.where = "--refine", .what = "on one process only", .allowed = "two runs, one after the other"}});
  PreparedCase prepared = prepare_together(options, request, ranks);
  if (!options.threads_given) request.threads = std::max(1, request.threads / ranks.on_this_machine());
  if (ranks.is_first()) {
    print_warnings(prepared);
    if (request.dry_run) return run_case(prepared, request);
    run::Followers followers(ranks);
    prepared.make_model = [part = prepared.make_part, &ranks, &followers](ThreadTeam& team) {
      return run::led_model(part(team, ranks), followers);
    };
    return run_case(prepared, request);
  }
  if (request.dry_run) return ExitStatus::done;
  try {
    ThreadTeam team(request.threads);
    const auto model = prepared.make_part(team, ranks);
    run::follow(*model, team, ranks);
  } catch (const NumericalError&) {  // of all processes
    throw;
  } catch (const std::exception& error) {
    print_error("talus: process {}: {}\n", ranks.rank(), error.what());
    ranks.abort(static_cast<int>(ExitStatus::numerical));
  }
  return ExitStatus::done;
}

/// The case is checked here, so that no job waits for a case that cannot run.
ExitStatus launch(const CaseOptions& options, int nodes, const std::vector<std::string>& words) {
  const CaseFile file = options.read();
  const PreparedCase prepared = prepare_case(file);
  if (nodes > 1) check_ranks(prepared, file, nodes);
  return become_package("launch", words);
}

ExitStatus run(const RunOptions& options, const Ranks& ranks) {
  RunRequest request = options.request;
  request.folder =
      options.out.empty() ? default_results(options.case_options.path) : std::filesystem::path(options.out);
  request.existing = options.resume ? Existing::resume : options.overwrite ? Existing::overwrite : Existing::refuse;
  if (!ranks.is_alone()) return run_together(options, request, ranks);
  const CaseFile file = options.case_options.read();
  const PreparedCase prepared = [&] {
    const run::Waiting waiting("reading and checking the case");
    return options.resume ? prepare_to_resume(file, request.folder) : prepare_case(file);
  }();
  check_memory(prepared, file);
  print_warnings(prepared);
  if (!options.refine) return run_case(prepared, request);
  const CaseFile finer = refined_case(file);
  const PreparedCase prepared_finer =
      options.resume ? prepare_to_resume(finer, folder_of_finer(request)) : prepare_case(finer);
  check_memory(prepared_finer, finer);
  const ExitStatus status = run_case(prepared, request);
  return status == ExitStatus::done ? run_finer(prepared_finer, request) : status;
}

}  // namespace

void add_run_command(CLI::App& app, Action& action, const Ranks& ranks) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand("run", "run a case");
  options->case_options.add_to(*command);
  add_out_option(*command, options->out, "folder of the results; results/NAME of the case if not given");
  add_threads_option(*command, options->request.threads);
  auto* resume = command->add_flag("--resume", options->resume, "go on with the run in the folder");
  auto* overwrite =
      command->add_flag("--overwrite", options->overwrite, "replace the run in the folder")->excludes(resume);
  auto* dry_run = command->add_flag("--dry-run", options->request.dry_run,
                                    "read and check the case, build its start, write nothing");
  auto* refine =
      command->add_flag("--refine", options->refine,
                        "run it again with bed.spacing divided by 1.5, in the folder DIR-refined, and extrapolate");
  command
      ->add_option("--walltime", options->request.walltime,
                   "leave with a checkpoint after so many seconds of wall time")
      ->check(CLI::PositiveNumber);
  auto* launched = add_launch_options(*command, options->launch, options->of_sbatch,
                                      "where it runs: here, or slurm: as a job, one process a node")
                       ->excludes(overwrite)
                       ->excludes(dry_run)
                       ->excludes(refine);
  command->add_option("--nodes", options->nodes, "of the job")
      ->check(CLI::Range(1, 100000))
      ->default_str("1")
      ->needs(launched);
  command->footer(
      "The folder holds manifest.json, series.csv, snapshots/*.vtkhdf (ParaView), checkpoints, analysis/, pictures/,\n"
      "summary.json and log.txt. Ctrl-C, SIGTERM, a file `stop` in the folder and --walltime end the run with a\n"
      "checkpoint (exit status 130); --resume goes on bitwise identically.");
  command->callback([options, command, &action, &ranks] {
    options->threads_given = command->count("--threads") > 0;
    action = [options, command, &ranks] {
      return options->launch == "slurm" ? launch(options->case_options, options->nodes, words_of(*command))
                                        : run(*options, ranks);
    };
  });
}

}  // namespace talus::app

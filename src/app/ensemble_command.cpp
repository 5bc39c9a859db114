// SPDX-License-Identifier: Apache-2.0
/// talus ensemble: many members of a case, over seeds and varied keys.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <thread>

#include "app/commands.hpp"
#include "app/comparison/python.hpp"
#include "app/ensemble/plan.hpp"
#include "app/ensemble/report_entries.hpp"
#include "app/ensemble/schedule.hpp"
#include "app/ensemble/slurm.hpp"
#include "app/ensemble/statistics.hpp"
#include "app/ensemble/sweep.hpp"
#include "app/models/models.hpp"
#include "app/report/report.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "io/file_list.hpp"
#include "io/report_page.hpp"
#include "run/interrupt.hpp"
#include "run/jobs.hpp"

namespace talus::app {

namespace {

struct Options {
  CaseOptions case_options;
  EnsembleRequest request;
  std::string out, launch = "here";
  std::vector<std::string> plot, slurm;
  bool gather = false, jobs_given = false;
};

/// Of what is done.
std::vector<std::filesystem::path> draw_results(const EnsemblePlan& plan, const Options& options) {
  const EnsembleRequest& request = options.request;
  std::vector<std::string> names;
  for (const EnsembleGroup& group : plan.groups) {
    claim_pictures(group, request.folder / group.name);
    names.push_back(group.name);
  }
  claim_file(request.folder / "sweep.png");
  return draw_charts({"ensemble", request.folder.string(), fmt::format("{}", fmt::join(names, ",")),
                      fmt::format("{}", fmt::join(options.plot, ","))},
                     request.folder);
}

/// Tables, pictures and report of what is done; returns the picture to look at first.
std::vector<std::filesystem::path> write_results(const EnsemblePlan& plan, const Options& options) {
  const EnsembleRequest& request = options.request;
  std::vector<SweptGroup> groups;
  std::vector<std::string> quantities;
  for (const EnsembleGroup& group : plan.groups) {
    write_group(group, request.folder / group.name);
    groups.push_back({&group, quantity_spreads(group)});
  }
  for (const QuantitySpread* quantity : all_quantities(groups)) quantities.push_back(quantity->name);
  check_quantities(options.plot, quantities);
  if (has_report_page()) {
    ReadRuns runs;
    write_report({.title = request.folder.stem().string(), .runs = entries_of(plan.groups), .comparisons = {}},
                 request.folder / "report.html", runs);
  }
  print("{}", sweep_text(groups));
  if (!request.vary.empty()) write_sweep(groups, request.folder);
  return plan.pictures ? draw_results(plan, options) : std::vector<std::filesystem::path>();
}

/// The command that makes write_results() of the same ensemble, from wherever the jobs run.
std::vector<std::string> gathering(const Options& options) {
  const EnsembleRequest& request = options.request;
  std::vector<std::string> words = {
      run::own_program(),      "ensemble", request.case_path, "--out",
      request.folder.string(), "--gather", "--members",       fmt::format("{}", request.members)};
  const auto add = [&](const char* option, const std::vector<std::string>& values) {
    for (const std::string& value : values) words.insert(words.end(), {option, value});
  };
  add("--set", request.settings);
  add("--vary", request.vary);
  add("--plot", options.plot);
  return words;
}

/// Refuses what no member can have before any of them runs; what a case of its model does not have after all is told
/// when they are drawn. \throws InputError
void check_plot(const EnsemblePlan& plan, const Options& options) {
  if (options.plot.empty()) return;
  CaseFile file = CaseFile::read(options.request.case_path);
  for (const std::string& setting : options.request.settings) file.set(setting);
  const ModelEntry& model = model_of(file);
  if (!model.measures) return;
  std::vector<std::string> known{"steps"};
  for (const MeasureText& measure : model.measures()) known.emplace_back(measure.name);
  for (const EnsembleGroup& group : plan.groups)  // members of another version of Talus
    for (const QuantitySpread& spread : quantity_spreads(group)) known.push_back(spread.name);
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  check_quantities(options.plot, known);
}

/// \throws InputError
void check_gathered(const EnsembleRequest& request) {
  std::error_code none;
  if (!std::filesystem::is_directory(request.folder, none) || std::filesystem::is_empty(request.folder, none))
    throw InputError({{.where = request.folder.string(),
                       .what = "holds no ensemble: there is nothing to gather",
                       .allowed = "--gather with the --out of the ensemble that ran, or without --gather to run it"}});
}

ExitStatus launch(const std::vector<ScheduledRun>& runs, const Options& options) {
  SlurmRequest slurm{.folder = options.request.folder,
                     .members = {},
                     .gather = gathering(options),
                     .at_once = options.jobs_given ? std::optional(options.request.jobs) : std::nullopt,
                     .options = options.slurm};
  for (const ScheduledRun& run : runs)
    if (!is_done(run.member)) slurm.members.push_back(run);
  if (slurm.members.empty()) {
    print("All {} runs are done already; --gather makes the tables.\n", runs.size());
    return ExitStatus::done;
  }
  const std::filesystem::path submit = write_slurm(slurm);
  if (const auto said = submit_slurm(submit))
    print("Submitted {} runs: {}\n", slurm.members.size(), *said);
  else
    print("There is no sbatch here. Where there is: bash {}\n", submit.string());
  print("Results: {}\n", options.request.folder.string());
  return ExitStatus::done;
}

ExitStatus ensemble(const Options& options) {
  run::catch_signals();
  const EnsembleRequest& request = options.request;
  if (options.launch == "slurm") check_slurm(options.slurm, request.folder);
  if (options.gather) check_gathered(request);
  const EnsemblePlan plan = plan_ensemble(request);
  check_plot(plan, options);
  std::vector<ScheduledRun> runs;
  for (const EnsembleGroup& group : plan.groups)
    for (const EnsembleMember& member : group.members) runs.push_back({request.case_path, member});
  begin_output(request.folder, request.resume ? Existing::resume : Existing::refuse, "--resume", has_begun(runs));
  if (options.launch == "slurm") return launch(runs, options);

  const ScheduleResult result = options.gather ? gather_members(runs) : run_members(runs, request.jobs);
  const std::vector<std::filesystem::path> pictures = write_results(plan, options);
  for (const FailedRun& failed : result.failed)
    print("{}: {}: {}\n", failed.status ? fmt::format("Failed (exit status {})", *failed.status) : "Not done",
          failed.folder.string(), failed.reason);
  print("{} of {} runs done. Results: {}\n", result.found_done + result.done, runs.size(), request.folder.string());
  if (!pictures.empty()) print("Picture: {}\n", pictures.front().string());
  if (result.interrupted) return ExitStatus::interrupted;
  return result.failed.empty() ? ExitStatus::done : ExitStatus::numerical;
}

}  // namespace

void add_ensemble_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("ensemble", "run many members of a case: seeds and varied keys");
  options->case_options.add_to(*command);
  command
      ->add_option("--members", options->request.members,
                   "members of each group; member k has the case's seed + k; one where nothing is random")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_option("--vary", options->request.vary, "one group for each value; several --vary: all combinations")
      ->type_name("KEY=V1,V2,...")
      ->allow_extra_args(false);
  options->request.jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  auto* jobs = command
                   ->add_option("--jobs", options->request.jobs,
                                "runs at a time, each on one thread; the results do not depend on it")
                   ->check(CLI::Range(1, 1024))
                   ->capture_default_str();
  add_out_option(*command, options->out, "folder of the results; results/NAME-ensemble if not given");
  auto* resume = command->add_flag("--resume", options->request.resume, "go on with the ensemble in the folder");
  command->add_option("--plot", options->plot, "quantities that sweep.png shows; those that differ if not given")
      ->delimiter(',')
      ->type_name("NAME,...");
  auto* launch = command
                     ->add_option("--launch", options->launch,
                                  "where the members run: here, or slurm: as an array job, gathered by another")
                     ->check(CLI::IsMember({"here", "slurm"}))
                     ->capture_default_str();
  command->add_option("--slurm", options->slurm, "an option of sbatch: --slurm=--time=2:00:00; may be repeated")
      ->type_name("OPTION")
      ->allow_extra_args(false)
      ->needs(launch);
  command->add_flag("--gather", options->gather, "run nothing: tables and pictures of the members that are done")
      ->excludes(resume)
      ->excludes(launch);
  command->footer(
      "Each member is an ordinary run's folder, FOLDER/GROUP/seed_0001. Beside them: members.csv, quantities.csv "
      "(mean\n"
      "and standard deviation), bands_*.csv and pictures; with --vary, FOLDER/sweep.csv and sweep.json: the varied "
      "keys\n"
      "against every quantity, and sweep.png. A killed ensemble goes on with --resume. Exit status 3 if a member "
      "failed; those that "
      "did\n"
      "are listed.");
  command->callback([options, jobs, &action] {
    options->jobs_given = jobs->count() > 0;
    action = [options] {
      EnsembleRequest& request = options->request;
      request.case_path = options->case_options.path;
      request.settings = options->case_options.settings;
      request.resume = request.resume || options->gather;
      const std::string name = std::filesystem::path(request.case_path).stem().string() + "-ensemble";
      request.folder =
          options->out.empty() ? std::filesystem::path("results") / name : std::filesystem::path(options->out);
      return ensemble(*options);
    };
  });
}

}  // namespace talus::app

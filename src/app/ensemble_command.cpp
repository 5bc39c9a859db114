// SPDX-License-Identifier: Apache-2.0
/// talus ensemble: many members of a case, over seeds and varied keys.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <thread>

#include "app/case_options.hpp"
#include "app/commands.hpp"
#include "app/ensemble/plan.hpp"
#include "app/ensemble/report_entries.hpp"
#include "app/ensemble/schedule.hpp"
#include "app/ensemble/statistics.hpp"
#include "app/ensemble/sweep.hpp"
#include "app/report/report.hpp"
#include "base/terminal.hpp"
#include "io/file_list.hpp"
#include "io/report/page.hpp"
#include "run/interrupt.hpp"

namespace talus::app {

namespace {

ExitStatus ensemble(const EnsembleRequest& request) {
  run::catch_signals();
  const EnsemblePlan plan = plan_ensemble(request);
  std::vector<ScheduledRun> runs;
  for (const EnsembleGroup& group : plan.groups)
    for (const EnsembleMember& member : group.members) runs.push_back({request.case_path, member});
  begin_output(request.folder, request.resume ? Existing::resume : Existing::refuse, "--resume", has_begun(runs));

  const ScheduleResult result = run_members(runs, request.jobs);
  std::vector<std::filesystem::path> pictures;
  std::vector<SweptGroup> groups;
  for (const EnsembleGroup& group : plan.groups) {
    const auto drawn = write_group(group, request.folder / group.name);
    pictures.insert(pictures.end(), drawn.begin(), drawn.end());
    groups.push_back({&group, quantity_spreads(group)});
  }
  if (has_report_page())
    write_report({.title = request.folder.stem().string(), .runs = entries_of(plan.groups), .comparisons = {}},
                 request.folder / "report.html");
  print("{}", sweep_text(groups));
  if (!request.vary.empty()) write_sweep(groups, request.folder);
  for (const FailedRun& failed : result.failed)
    print("Failed (exit status {}): {}: {}\n", failed.status, failed.folder.string(), failed.reason);
  print("{} of {} runs done. Results: {}\n", result.found_done + result.done, runs.size(), request.folder.string());
  if (!pictures.empty()) print("Picture: {}\n", pictures.front().string());
  if (result.interrupted) return ExitStatus::interrupted;
  return result.failed.empty() ? ExitStatus::done : ExitStatus::numerical;
}

}  // namespace

void add_ensemble_command(CLI::App& app, Action& action) {
  struct Options {
    CaseOptions case_options;
    EnsembleRequest request;
    std::string out;
  };
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
  command
      ->add_option("--jobs", options->request.jobs,
                   "runs at a time, each on one thread; the results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  add_out_option(*command, options->out, "folder of the results; results/NAME-ensemble if not given");
  command->add_flag("--resume", options->request.resume, "go on with the ensemble in the folder");
  command->footer(
      "Each member is an ordinary run's folder, FOLDER/GROUP/seed_0001. Beside them: members.csv, quantities.csv "
      "(mean\n"
      "and standard deviation), bands_*.csv and pictures; with --vary, FOLDER/sweep.csv and sweep.json: the varied "
      "keys\n"
      "against every quantity. A killed ensemble goes on with --resume. Exit status 3 if a member failed; those that "
      "did\n"
      "are listed.");
  command->callback([options, &action] {
    action = [options] {
      EnsembleRequest request = options->request;
      request.case_path = options->case_options.path;
      request.settings = options->case_options.settings;
      const std::string name = std::filesystem::path(request.case_path).stem().string() + "-ensemble";
      request.folder =
          options->out.empty() ? std::filesystem::path("results") / name : std::filesystem::path(options->out);
      return ensemble(request);
    };
  });
}

}  // namespace talus::app

// SPDX-License-Identifier: Apache-2.0
/// Commands that are modules of the package python/talus: ensemble, compare, reproduce. Here are their options, for
/// help, completion and man page; the module gets them checked.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.hpp"
#include "app/project/project.hpp"

namespace talus::app {

namespace {

/// What options are bound to; no one reads it: the words are of the options.
struct Options {
  CaseOptions case_options;
  std::string text, out;
  std::vector<std::string> texts;
  int number = 0;
  bool flag = false;
};

CLI::App* add_command(CLI::App& app, Action& action, const std::shared_ptr<Options>& options, const std::string& name,
                      const std::string& text, const std::string& footer) {
  CLI::App* command = app.add_subcommand(name, text);
  command->footer(footer);
  command->callback([command, options, &action] {
    action = [command, words = words_of(*command)] { return become_package(command->get_name(), words); };
  });
  return command;
}

CLI::Option* add_jobs_option(CLI::App& command, Options& options) {
  return command
      .add_option("--jobs", options.number, "runs at a time, each on one thread; the results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->default_str("processors");
}

}  // namespace

void add_ensemble_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = add_command(
      app, action, options, "ensemble", "run many members of a case: seeds and varied keys",
      "Each member is an ordinary run's folder, FOLDER/GROUP/seed_0001. Beside them: members.csv, quantities.csv "
      "(mean\n"
      "and standard deviation), bands_*.csv and pictures; with --vary, FOLDER/sweep.csv and sweep.json: the varied "
      "keys\n"
      "against every quantity, and sweep.png. A killed ensemble goes on with --resume. Exit status 3 if a member "
      "failed; those that did\n"
      "are listed.");
  options->case_options.add_to(*command);
  command
      ->add_option("--members", options->number,
                   "members of each group; member k has the case's seed + k; one where nothing is random")
      ->check(CLI::Range(1, 1000000))
      ->default_str("20");
  command->add_option("--vary", options->texts, "one group for each value; several --vary: all combinations")
      ->type_name("KEY=V1,V2,...")
      ->allow_extra_args(false);
  add_jobs_option(*command, *options);
  add_out_option(*command, options->out, "folder of the results; results/NAME-ensemble if not given");
  auto* resume = command->add_flag("--resume", options->flag, "go on with the ensemble in the folder");
  command->add_option("--plot", options->texts, "quantities that sweep.png shows; those that differ if not given")
      ->delimiter(',')
      ->type_name("NAME,...");
  auto* launch = command
                     ->add_option("--launch", options->text,
                                  "where the members run: here, or slurm: as an array job, gathered by another")
                     ->check(CLI::IsMember({"here", "slurm"}))
                     ->default_str("here");
  command->add_option("--slurm", options->texts, "an option of sbatch: --slurm=--time=2:00:00; may be repeated")
      ->type_name("OPTION")
      ->allow_extra_args(false)
      ->needs(launch);
  command->add_flag("--gather", options->flag, "run nothing: tables and pictures of the members that are done")
      ->excludes(resume)
      ->excludes(launch);
}

void add_compare_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = add_command(
      app, action, options, "compare", "compare runs with a reference, or two runs with each other",
      "Against a reference: every row printed, computed, met or not; exit status 1 if one is not met. Two runs: their\n"
      "quantities side by side, and their series in one picture with --picture. Nothing is written unless asked for.");
  command->add_option("DIR", options->text, "folder of a run, an ensemble or a reproduction")->required();
  command->add_option("OTHER", options->text, "REFERENCE.toml, or the folder of another run")->required();
  command->add_option("--json", options->text, "also write the rows, and which runs they are of, to this file");
  command->add_option("--picture", options->text, "two runs: also draw their series over each other into this PNG");
}

void add_reproduce_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      add_command(app, action, options, "reproduce", "all runs of a paper, and every number it prints beside ours",
                  "Exit status 1 if a row of the paper is not met.");
  command
      ->add_option(
          "STUDY", options->text,
          "niiya2020 or yuu2011, a paper; yuu2011/laws, the constitutive laws side by side; dem-hopper, the hopper "
          "beside beads")
      ->required()
      ->check(CLI::IsMember({"niiya2020", "yuu2011", "yuu2011/laws", "dem-hopper"}));
  command->add_flag("--quick", options->flag, "a small part of it: the [quick] of the study's reference.toml");
  command->add_option("--members", options->number, "members of each case and radius; the paper's if not given")
      ->check(CLI::Range(1, 100000));
  command->add_option("--variant", options->texts,
                      "only these of the reference's variants (radii); may stand several times");
  add_jobs_option(*command, *options);
  add_out_option(*command, options->out, "folder; results/STUDY, or results/STUDY-quick");
  command->add_flag("--resume", options->flag, "go on with what is in the folder");
}

}  // namespace talus::app

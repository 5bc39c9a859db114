// SPDX-License-Identifier: Apache-2.0
/// talus reproduce: a paper's runs and numbers.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <thread>

#include "app/commands.hpp"
#include "app/reproduction/study.hpp"

namespace talus::app {

void add_reproduce_command(CLI::App& app, Action& action) {
  struct Options {
    StudyRequest request;
    std::string out;
  };
  auto options = std::make_shared<Options>();
  options->request.jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  CLI::App* command = app.add_subcommand("reproduce", "all runs of a paper, and every number it prints beside ours");
  command
      ->add_option(
          "STUDY", options->request.study,
          "niiya2020 or yuu2011, a paper; yuu2011/laws, the constitutive laws side by side; dem-hopper, the hopper "
          "beside beads")
      ->required()
      ->check(CLI::IsMember(std::vector<std::string>(std::begin(study_names), std::end(study_names))));
  command->add_flag("--quick", options->request.quick, "a small part of it: the [quick] of the study's reference.toml");
  command
      ->add_option("--members", options->request.members, "members of each case and radius; the paper's if not given")
      ->check(CLI::Range(1, 100000));
  command->add_option("--variant", options->request.variants,
                      "only these of the reference's variants (radii); may stand several times");
  command
      ->add_option("--jobs", options->request.jobs,
                   "runs at a time, each on one thread; the results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  add_out_option(*command, options->out, "folder; results/STUDY, or results/STUDY-quick");
  command->add_flag("--resume", options->request.resume, "go on with what is in the folder");
  command->footer("Exit status 1 if a row of the paper is not met.");
  command->callback([options, &action] {
    action = [options] {
      StudyRequest request = options->request;
      request.folder = options->out.empty()
                           ? std::filesystem::path("results") / (request.study + (request.quick ? "-quick" : ""))
                           : std::filesystem::path(options->out);
      return reproduce(request);
    };
  });
}

}  // namespace talus::app

// SPDX-License-Identifier: Apache-2.0
/// talus compare: runs against a reference, or against each other.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "app/commands.hpp"
#include "app/comparison/evaluation.hpp"
#include "app/comparison/overlay.hpp"
#include "app/comparison/project.hpp"
#include "app/models/models.hpp"
#include "base/text.hpp"
#include "io/file.hpp"

namespace talus::app {

namespace {

struct CompareOptions {
  std::string folder, other, json, picture;
};

ExitStatus compare_with_reference(const CompareOptions& options) {
  const Reference reference = read_reference(found_file(options.other));
  const std::vector<FoundEnsemble> found = find_ensembles(options.folder, reference);
  ReadRuns runs(ReadRuns::many_times);
  const std::vector<EvaluatedRow> rows = evaluate(reference, found, read_studied_runs(found, runs));
  print("{}\n{}{}\n", reference.source, to_text(rows), counts_text(rows));
  if (!options.json.empty()) write_atomically(options.json, to_json(reference, rows, found, options.folder));
  return count(rows, Verdict::not_met) ? ExitStatus::not_met : ExitStatus::done;
}

}  // namespace

void add_compare_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* command = app.add_subcommand("compare", "compare runs with a reference, or two runs with each other");
  command->add_option("DIR", options->folder, "folder of a run, an ensemble or a reproduction")->required();
  command->add_option("OTHER", options->other, "REFERENCE.toml, or the folder of another run")->required();
  command->add_option("--json", options->json, "also write the rows, and which runs they are of, to this file");
  command->add_option("--picture", options->picture, "two runs: also draw their series over each other into this PNG");
  command->footer(
      "Against a reference: every row printed, computed, met or not; exit status 1 if one is not met. Two runs: their\n"
      "quantities side by side, and their series in one picture with --picture. Nothing is written unless asked for.");
  command->callback([options, &action] {
    action = [options] {
      if (std::filesystem::is_directory(options->other))
        return compare_runs(options->folder, options->other, options->picture);
      return compare_with_reference(*options);
    };
  });
}

}  // namespace talus::app

// SPDX-License-Identifier: Apache-2.0
/// talus compare: runs against a reference, or against each other.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "app/commands.hpp"
#include "app/comparison/evaluation.hpp"
#include "app/comparison/overlay.hpp"
#include "io/atomic_file.hpp"

namespace talus::app {

namespace {

ExitStatus compare_with_reference(const std::string& folder, const std::string& path, const std::string& json) {
  const Reference reference = read_reference(path);
  const std::vector<EvaluatedRow> rows = evaluate(reference, *read_studied_runs(folder, reference));
  fmt::print("{}\n", reference.source);
  fmt::print("{}", to_text(rows));
  if (!json.empty()) write_atomically(json, to_json(reference, rows));
  fmt::print("{} met, {} not met, {} reported, {} not evaluated\n", count(rows, Verdict::met),
             count(rows, Verdict::not_met), count(rows, Verdict::reported), count(rows, Verdict::not_evaluated));
  return count(rows, Verdict::not_met) ? ExitStatus::not_met : ExitStatus::done;
}

}  // namespace

void add_compare_command(CLI::App& app, Action& action) {
  struct Options {
    std::string folder, other, json, picture = "compare.png";
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("compare", "compare runs with a reference, or two runs with each other");
  command->add_option("DIR", options->folder, "folder of a run, an ensemble or a reproduction")->required();
  command->add_option("OTHER", options->other, "REFERENCE.toml, or the folder of another run")->required();
  command->add_option("--json", options->json, "also write the rows to this file");
  command->add_option("--picture", options->picture, "two runs: draw their series over each other into this PNG")
      ->capture_default_str();
  command->footer(
      "Against a reference: every row printed, computed, met or not; exit status 1 if one is not met. Two runs: their\n"
      "quantities side by side and their series in one picture.");
  command->callback([options, &action] {
    action = [options] {
      if (std::filesystem::is_directory(options->other))
        return compare_runs(options->folder, options->other, options->picture);
      return compare_with_reference(options->folder, options->other, options->json);
    };
  });
}

}  // namespace talus::app

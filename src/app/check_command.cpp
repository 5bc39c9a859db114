// SPDX-License-Identifier: Apache-2.0
/// talus check: what a case says, resolved to SI with every default, and what its run will take.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "app/case_options.hpp"
#include "app/commands.hpp"
#include "app/prepared_case.hpp"
#include "base/terminal.hpp"
#include "io/parameter_writer.hpp"
#include "run/progress.hpp"

namespace talus::app {

namespace {

ExitStatus check(const CaseOptions& options, int threads) {
  const CaseFile file = options.read();
  const PreparedCase prepared = prepare_case(file);

  say("{}: valid. In SI, with every default:\n\n", options.path);
  const std::vector<ResolvedLine> table = resolved_table(prepared.parameters, file);
  std::size_t key = 0, value = 0;
  for (const ResolvedLine& line : table) {
    key = std::max(key, line.key.size());
    value = std::max(value, line.value.size() + 1 + line.unit.size());
  }
  for (const ResolvedLine& line : table)
    say("  {:{}}  {:{}}  {:8} {}\n", line.key, key, line.value + " " + line.unit, value, line.origin, line.text);

  say("\nScales and groups:\n");
  for (const NamedValue& group : prepared.groups)
    say("  {:{}}  {:.6g}{}\n", group.name, key, group.value, group.unit == "1" ? "" : " " + group.unit);

  const Forecast f = prepared.forecast();
  say("\nForecast (measured on this machine now, one thread, and divided by {} threads):\n", threads);
  say("  {:{}}  {:.0f}\n", "steps", key, f.steps);
  say("  {:{}}  {:.0f} at {:.3g} ms\n", "evaluations", key, f.evaluations, 1e3 * f.seconds_per_evaluation);
  say("  {:{}}  {}\n", "time", key, run::format_seconds(f.evaluations * f.seconds_per_evaluation / threads));
  say("  {:{}}  {:.0f} MB\n", "memory", key, f.memory_bytes / 1e6);
  say("  {:{}}  {:.1f} MB\n", "disk", key, f.disk_bytes / 1e6);
  return ExitStatus::done;
}

}  // namespace

void add_check_command(CLI::App& app, Action& action) {
  struct Options {
    CaseOptions case_options;
    int threads = 1;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("check", "check a case: all problems at once, or the resolved case and a forecast");
  options->case_options.add_to(*command);
  add_threads_option(*command, options->threads);
  command->callback(
      [options, &action] { action = [options] { return check(options->case_options, options->threads); }; });
}

}  // namespace talus::app

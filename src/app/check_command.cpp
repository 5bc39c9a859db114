// SPDX-License-Identifier: Apache-2.0
/// talus check: what a case says, resolved to SI with every default, and what its run will take.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "app/case_options.hpp"
#include "app/commands.hpp"
#include "app/prepared_case.hpp"
#include "io/parameter_writer.hpp"
#include "numerics/warning.hpp"
#include "run/progress.hpp"

namespace talus::app {

namespace {

ExitStatus check(const CaseOptions& options, int threads) {
  const CaseFile file = options.read();
  const PreparedCase prepared = prepare_case(file);

  fmt::print("{}: valid. In SI, with every default:\n\n", options.path);
  const std::vector<ResolvedLine> table = resolved_table(prepared.parameters, file);
  std::size_t key = 0, value = 0;
  for (const ResolvedLine& line : table) {
    key = std::max(key, line.key.size());
    value = std::max(value, line.value.size() + 1 + line.unit.size());
  }
  for (const ResolvedLine& line : table)
    fmt::print("  {:{}}  {:{}}  {:8} {}\n", line.key, key, line.value + " " + line.unit, value, line.origin, line.text);

  fmt::print("\nScales and groups:\n");
  for (const NamedValue& group : prepared.groups)
    fmt::print("  {:{}}  {:.6g}{}\n", group.name, key, group.value, group.unit == "1" ? "" : " " + group.unit);

  if (const std::vector<Warning> warnings = warnings_of(prepared.regime); !warnings.empty()) {
    fmt::print("\nWarnings: the case leaves what its laws and the method assume:\n");
    for (const Warning& warning : warnings) fmt::print("  ! {}\n", warning.text);
  }

  const Forecast f = prepared.forecast();
  fmt::print("\nForecast (measured on this machine now, one thread, and divided by {} threads):\n", threads);
  fmt::print("  {:{}}  {:.0f}\n", "steps", key, f.steps);
  fmt::print("  {:{}}  {:.0f} at {:.3g} ms\n", "evaluations", key, f.evaluations, 1e3 * f.seconds_per_evaluation);
  fmt::print("  {:{}}  {}\n", "time", key, run::format_seconds(f.evaluations * f.seconds_per_evaluation / threads));
  fmt::print("  {:{}}  {:.0f} MB\n", "memory", key, f.memory_bytes / 1e6);
  fmt::print("  {:{}}  {:.1f} MB\n", "disk", key, f.disk_bytes / 1e6);
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

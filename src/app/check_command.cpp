// SPDX-License-Identifier: Apache-2.0
/// talus check: what a case says, resolved to SI with every default, and what its run will take.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/case_options.hpp"
#include "app/commands.hpp"
#include "app/models/models.hpp"
#include "app/runs/check_folder.hpp"
#include "base/memory.hpp"
#include "base/terminal.hpp"
#include "io/parameter_writer.hpp"
#include "numerics/warning.hpp"
#include "run/progress.hpp"

namespace talus::app {

namespace {

constexpr double month = 30 * 86400.0;
constexpr std::size_t widest_value = 16;  // longer ones exceed their column

/// To two digits: "3800".
std::string count_text(double count) {
  if (!(count >= 100 && count < 1e9)) return fmt::format("{:.2g}", count);
  const double unit = std::pow(10, std::floor(std::log10(count)) - 1);
  return fmt::format("{:.0f}", std::round(count / unit) * unit);
}

void print_case(const PreparedCase& prepared, const CaseFile& file, std::size_t& key) {
  std::vector<ResolvedLine> table = resolved_table(prepared.parameters, file);
  for (ResolvedLine& line : table)
    if (line.origin == "default" && prepared.filled_in.contains(line.key)) line.origin = "material";
  std::size_t value = 0;
  for (const ResolvedLine& line : table) {
    key = std::max(key, line.key.size());
    value = std::max(value, line.value.size() + 1 + line.unit.size());
  }
  value = std::min(value, widest_value);
  for (const ResolvedLine& line : table) {
    const std::string head =
        fmt::format("  {:{}}  {:{}}  {:8} ", line.key, key, line.value + " " + line.unit, value, line.origin);
    const std::size_t indent = 4 + key + value + 2 + 9;
    const std::size_t width = std::max(terminal_width(), indent + 24);
    print("{}{}\n", head, wrapped(line.text, width, indent, head.size()));
  }
}

void print_forecast(const PreparedCase& prepared, int threads, std::size_t key) {
  const Forecast& f = prepared.forecast;
  ThreadTeam team(threads);
  const double each = prepared.measure_evaluation(team);
  print("\nForecast (from counts; the speed measured on this machine now, {} thread{}):\n", threads,
        threads == 1 ? "" : "s");
  double seconds = 0, most_seconds = 0;
  for (const Forecast::Phase& phase : f.phases) {
    const double least = phase.evaluations * each, most = least * phase.most;
    seconds += least, most_seconds += most;
    if (phase.most > 1) {
      print("  {:{}}  {} to {} steps of {:.3g} ms: {} to {}\n", phase.name, key, count_text(phase.steps),
            count_text(phase.most * phase.steps), 1e3 * each, run::format_seconds(least), run::format_seconds(most));
      print("  {:{}}  (without settle.damping_time, when a bed comes to rest is not known)\n", "", key);
      continue;
    }
    const std::string evaluations =
        phase.evaluations == phase.steps ? "" : fmt::format(", {} evaluations", count_text(phase.evaluations));
    print("  {:{}}  about {} steps{} of {:.3g} ms: {}\n", phase.name, key, count_text(phase.steps), evaluations,
          1e3 * each, run::format_seconds(least));
  }
  print("  {:{}}  {}{}\n", "time", key, run::format_seconds(seconds),
        most_seconds > seconds ? " to " + run::format_seconds(most_seconds) : "");
  const std::optional<double> available = available_memory();
  print("  {:{}}  {:.0f} MB{}\n", "memory", key, f.memory_bytes / 1e6,
        available ? fmt::format(", of {:.0f} MB free now", *available / 1e6) : "");
  print("  {:{}}  {:.1f} MB\n", "disk", key, f.disk_bytes / 1e6);
  if (seconds > month) print("! Such a run takes more than a month: fewer particles, or an earlier run.end.\n");
}

ExitStatus check(const CaseOptions& options, int threads) {
  if (std::filesystem::is_directory(options.path)) return check_folder(options.path);
  const CaseFile file = options.read();
  const PreparedCase prepared = prepare_case(file);
  check_memory(prepared, file);

  print("{}: valid. In SI, with every default:\n\n", options.path);
  std::size_t key = 0;
  print_case(prepared, file, key);
  print("\nScales and groups:\n");
  for (const NamedValue& group : prepared.groups)
    print("  {:{}}  {:.6g}{}\n", group.name, key, group.value, group.unit == "1" ? "" : " " + group.unit);
  if (const std::vector<Warning> warnings = warnings_of(prepared.regime); !warnings.empty()) {
    print("\nWarnings: the case leaves what its laws and the method assume:\n");
    for (const Warning& warning : warnings) print("  ! {}\n", wrapped(warning.text, terminal_width(), 4, 4));
  }
  if (!prepared.remarks.empty()) {
    print("\nMended in the files of the case:\n");
    for (const std::string& remark : prepared.remarks) print("    {}\n", wrapped(remark, terminal_width(), 4, 4));
  }
  print_forecast(prepared, threads, key);
  return ExitStatus::done;
}

}  // namespace

void add_check_command(CLI::App& app, Action& action) {
  struct Options {
    CaseOptions case_options;
    int threads = 1;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "check", "check a case: all problems at once, or the resolved case and a forecast; or the files of a run");
  options->case_options.add_to(*command);
  add_threads_option(*command, options->threads);
  command->footer(
      "In place of CASE the folder of a run, or one that holds runs: compares their series and snapshots with the\n"
      "checksums that were written with them; exit status 4 if one has changed.");
  command->callback(
      [options, &action] { action = [options] { return check(options->case_options, options->threads); }; });
}

}  // namespace talus::app

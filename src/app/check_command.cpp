// SPDX-License-Identifier: Apache-2.0
/// talus check: what a case says, what follows from it, and what its run will take; with --all every key in SI.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/commands.hpp"
#include "app/models/models.hpp"
#include "app/runs/run_case.hpp"
#include "base/system.hpp"
#include "base/text.hpp"
#include "io/parameter_value.hpp"
#include "io/parameter_writer.hpp"
#include "models/continuum/setup/choices.hpp"
#include "numerics/run_record.hpp"
#include "run/progress.hpp"

namespace talus::app {

namespace {

constexpr double hour = 3600;
constexpr std::size_t max_value_width = 16;  // longer ones exceed their column

/// Seconds of an evaluation by what it depends on, and threads: cases that differ in nothing else are measured once.
using Measured = std::map<std::pair<std::string, int>, std::optional<double>>;

/// What the sections of the output are about.
struct Subject {
  const CaseOptions& options;
  const CaseFile& file;
  const PreparedCase& prepared;
  int threads, ranks;
  std::size_t key;  ///< columns of the longest key, or name
  Measured& measured;
};

/// To two digits: "3800".
std::string count_text(double count) {
  if (!(count >= 100 && count < 1e9)) return fmt::format("{:.2g}", count);
  const double unit = std::pow(10, std::floor(std::log10(count)) - 1);
  return fmt::format("{:.0f}", std::round(count / unit) * unit);
}

/// Items after a name, separated by commas, in as many lines as they take; none is broken.
void print_items(const std::string& name, std::size_t column, const std::vector<std::string>& items) {
  const std::size_t indent = column + 4;
  std::string line = fmt::format("  {:{}}  ", name, column);
  for (std::size_t n = 0; n < items.size(); ++n) {
    const std::string item = items[n] + (n + 1 < items.size() ? "," : "");
    if (n > 0 && line.size() + 1 + item.size() <= terminal_width()) {
      line += " " + item;
      continue;
    }
    if (n > 0) print("{}\n", std::exchange(line, std::string(indent, ' ')));
    line += wrapped(item, terminal_width(), indent, indent);
  }
  print("{}\n", line);
}

/// "32.5 mm" for a value that is written "32.5 mm" in quotes.
std::string plain(const CaseValue& value) {
  if (const auto* text = std::get_if<std::string>(&value.value)) return *text;
  if (const auto* list = std::get_if<std::vector<CaseValue>>(&value.value)) {
    std::vector<std::string> texts;
    std::transform(list->begin(), list->end(), std::back_inserter(texts), plain);
    return fmt::format("[{}]", fmt::join(texts, ", "));
  }
  return as_written(value);
}

/// A line for each table, with the values as they were written.
void print_given(const Subject& s) {
  std::vector<std::pair<std::string, std::vector<std::string>>> tables;
  std::size_t column = 0;
  for (const CaseEntry& entry : s.file.entries()) {
    if (std::holds_alternative<CaseTable>(entry.value.value)) continue;
    const bool at_top = table_of(entry.key).empty();
    const std::string table(at_top ? "case" : table_of(entry.key));
    auto at = std::find_if(tables.begin(), tables.end(), [&](const auto& t) { return t.first == table; });
    if (at == tables.end()) at = tables.insert(at_top ? tables.begin() : tables.end(), {table, {}});
    at->second.push_back(fmt::format("{} {}", last_part(entry.key), plain(entry.value)));
    column = std::max(column, table.size());
  }
  print("\nGiven:\n");
  for (const auto& [table, items] : tables) print_items(table, column, items);
}

std::vector<ResolvedLine> key_lines_of(const Subject& s) {
  std::vector<ResolvedLine> table = resolved_table(s.prepared.parameters, s.file);
  for (ResolvedLine& line : table) {
    const auto followed = s.prepared.filled_in.find(line.key);
    if (line.origin == "default" && followed != s.prepared.filled_in.end()) line.origin = followed->second;
  }
  return table;
}

void print_every_key(const Subject& s) {
  print("\nIn SI, with every default:\n");
  const std::vector<ResolvedLine> table = key_lines_of(s);
  std::size_t value = 0;
  for (const ResolvedLine& line : table) value = std::max(value, line.value.size() + 1 + line.unit.size());
  value = std::min(value, max_value_width);
  for (const ResolvedLine& line : table) {
    const std::string head =
        fmt::format("  {:{}}  {:{}}  {:8} ", line.key, s.key, line.value + " " + line.unit, value, line.origin);
    const std::size_t indent = 4 + s.key + value + 2 + 9;
    const std::size_t width = std::max(terminal_width(), indent + 24);
    print("{}{}\n", head, wrapped(line.text, width, indent, head.size()));
  }
}

/// Keys whose values follow from others, by what they follow from.
void print_filled_in(const Subject& s) {
  std::map<std::string, std::vector<std::string>> by_origin;
  for (const ResolvedLine& line : key_lines_of(s))
    if (line.origin != "default" && line.origin != "given" && line.origin != "option")
      by_origin[line.origin].push_back(
          fmt::format("{} {}{}{}", line.key, line.value, line.unit.empty() ? "" : " ", line.unit));
  for (const auto& [origin, items] : by_origin) print_items("from the " + origin, s.key, items);
}

void print_groups(const Subject& s) {
  for (const NamedValue& group : s.prepared.groups)
    print("  {:{}}  {:.6g}{}\n", group.name, s.key, group.value, group.unit == "1" ? "" : " " + group.unit);
  for (const std::string& remark : s.prepared.remarks) print("  {}\n", wrapped(remark, terminal_width(), 2, 2));
}

void print_following(const Subject& s) {
  print("\nFollows:\n");
  print_groups(s);
  print_filled_in(s);
}

void print_scales(const Subject& s) {
  print("\nScales and groups:\n");
  print_groups(s);
}

void print_warnings(const Subject& s) {
  const std::vector<Warning> warnings = warnings_before_run(s.prepared, default_results(s.options.path));
  if (warnings.empty()) return;
  print("\nWarnings: outside the validated range\n");
  for (const Warning& warning : warnings) print("  ! {}\n", wrapped(warning.text, terminal_width(), 4, 4));
}

/// Seconds of a run, at least, with an evaluation of so many.
double seconds_of(const Forecast& forecast, double evaluation) {
  double seconds = 0;
  for (const Forecast::Phase& phase : forecast.phases) seconds += phase.evaluations * evaluation;
  return seconds;
}

/// The digest of what the cost of an evaluation depends on; of the end too where inlets fill an empty vessel.
std::string evaluation_of(const PreparedCase& prepared) {
  std::vector<std::string_view> excluded{"accuracy", "title", "output"};
  const auto is_of_inlet = [](const DescribedParameter& item) { return item.parameter.key.starts_with("inlet"); };
  if (std::none_of(prepared.parameters.begin(), prepared.parameters.end(), is_of_inlet)) excluded.push_back("run");
  return fingerprint(prepared.parameters, excluded);
}

/// Seconds of an evaluation; nothing if those that were tried end in numerical trouble, whose text is kept.
std::optional<double> measured_evaluation(const PreparedCase& prepared, int threads, Measured& measured,
                                          std::string* trouble = nullptr) {
  const auto [found, is_new] = measured.try_emplace({evaluation_of(prepared), threads});
  if (!is_new) return found->second;
  ThreadTeam team(threads);
  try {
    found->second = prepared.measure_evaluation(team);
  } catch (const NumericalError& error) {
    if (trouble) *trouble = error.what();
  }
  return found->second;
}

/// Nothing where steps that were tried fail.
std::optional<double> measured_seconds(const PreparedCase& prepared, int threads, Measured& measured) {
  const std::optional<double> each = measured_evaluation(prepared, threads, measured);
  return each ? std::optional(seconds_of(prepared.forecast, *each)) : std::nullopt;
}

std::string measured_time(const PreparedCase& prepared, int threads, Measured& measured) {
  const std::optional<double> seconds = measured_seconds(prepared, threads, measured);
  return seconds ? run::format_seconds(*seconds) : "not known, its first steps fail";
}

/// The case with the first of the alternatives that makes it valid, and has no warning that it has not without.
std::optional<std::pair<std::vector<std::string>, PreparedCase>> with_first_of(
    const std::vector<std::vector<std::string>>& alternatives, const Subject& s) {
  const std::vector<Warning> known = warnings_of(s.prepared.regime);
  const auto is_new = [&](const Warning& warning) {
    return std::none_of(known.begin(), known.end(), [&](const Warning& other) { return other.id == warning.id; });
  };
  for (const std::vector<std::string>& settings : alternatives) {
    CaseFile file = s.file;
    for (const std::string& setting : settings) file.set(setting);
    try {
      PreparedCase prepared = prepare_case(file);
      const std::vector<Warning> warnings = warnings_of(prepared.regime);
      if (std::none_of(warnings.begin(), warnings.end(), is_new)) return std::pair{settings, std::move(prepared)};
    } catch (const InputError&) {  // NOLINT(bugprone-empty-catch): a change that the case does not allow is none
    }
  }
  return std::nullopt;
}

/// The case by each accuracy: how long it takes, and what that sets.
void print_accuracies(const Subject& s) {
  print("  {:{}}  sets what the case leaves out:\n", "accuracy", s.key);
  for (const std::string_view name : choices<continuum::Accuracy>) try {
      CaseFile file = s.file;
      file.set(fmt::format("accuracy={}", name));
      const PreparedCase prepared = prepare_case(file);
      std::vector<std::string> keys;
      for (const ResolvedLine& line : resolved_table(prepared.parameters, file))
        if (const auto set = prepared.filled_in.find(line.key);
            set != prepared.filled_in.end() && (set->second == "accuracy" || line.key.ends_with(".bulk_modulus")))
          keys.push_back(fmt::format("{} {} {}", line.key, line.value, line.unit));
      const std::string time = measured_time(prepared, s.threads, s.measured);
      print("    {}\n", wrapped(fmt::format("{:{}}{}: {}", name, s.key, time, fmt::join(keys, ", ")), terminal_width(),
                                s.key + 4, 4));
    } catch (const InputError&) {  // NOLINT(bugprone-empty-catch): such as one that needs bed.spacing
    }
}

/// What would shorten the run, each with its forecast, alone; what by its forecast does not is left out.
void print_shortenings(const Subject& s, double seconds) {
  print("! This run would take {}. Options:\n", run::format_seconds(seconds));
  const auto option = [](const std::string& change, const std::string& time, const std::string& text) {
    print("    {}\n      {}: {}\n", change, time, text);
  };
  std::vector<Shortening> all = s.prepared.shortenings ? s.prepared.shortenings() : std::vector<Shortening>();
  all.push_back({.alternatives = {{fmt::format("run.end={:.4g} s", 0.5 * s.prepared.run.end)}},
                 .text = "half of the simulated time"});
  for (const Shortening& shortening : all)
    if (const auto found = with_first_of(shortening.alternatives, s)) {
      std::string change;
      for (const std::string& setting : found->first)
        change += fmt::format("{}--set {}", change.empty() ? "" : " \\\n    ",
                              setting.find(' ') == std::string::npos ? setting : fmt::format("\"{}\"", setting));
      const std::optional<double> shorter = measured_seconds(found->second, s.threads, s.measured);
      if (shorter && *shorter < seconds) option(change, run::format_seconds(*shorter), shortening.text);
    }
  if (const int all_processors = processors(); all_processors > s.threads)
    option(fmt::format("--threads {}", all_processors), measured_time(s.prepared, all_processors, s.measured),
           "all processors of this machine");
}

void print_forecast(const Subject& s) {
  const Forecast& f = s.prepared.forecast;
  std::string trouble;
  const std::optional<double> measured = measured_evaluation(s.prepared, s.threads, s.measured, &trouble);
  if (!measured) {
    print("\n! No forecast: the first steps of this case fail.\n  {}\n", wrapped(trouble, terminal_width(), 2, 2));
    return;
  }
  const double each = *measured;
  print("\nForecast (from counts and the processor time of a step; {} thread{} without other programs):\n", s.threads,
        s.threads == 1 ? "" : "s");
  double max_seconds = 0;
  for (const Forecast::Phase& phase : f.phases) {
    const double least = phase.evaluations * each, most = least * phase.most;
    max_seconds += most;
    if (phase.most > 1) {
      print("  {:{}}  {} to {} steps of {:.3g} ms: {} to {}\n", phase.name, s.key, count_text(phase.steps),
            count_text(phase.most * phase.steps), 1e3 * each, run::format_seconds(least), run::format_seconds(most));
      print("  {:{}}  (without settle.damping_time, when a bed comes to rest is not known)\n", "", s.key);
      continue;
    }
    std::string note;
    if (phase.present < 1)
      note = fmt::format(", mean fill {:.0f} %", 100 * phase.present);
    else if (phase.present > 1)
      note = fmt::format(", in the mean {:.2g} times the particles of the start", phase.present);
    else if (phase.evaluations != phase.steps)
      note = fmt::format(", {} evaluations", count_text(phase.evaluations));
    print("  {:{}}  about {} steps of {:.3g} ms{}: {}\n", phase.name, s.key, count_text(phase.steps), 1e3 * each, note,
          run::format_seconds(least));
  }
  const double seconds = seconds_of(f, each);
  print("  {:{}}  {}{}\n", "time", s.key, run::format_seconds(seconds),
        max_seconds > seconds ? " to " + run::format_seconds(max_seconds) : "");
  const std::optional<double> available = available_memory();
  print("  {:{}}  {:.0f} MB{}\n", "memory", s.key, f.memory_bytes / 1e6,
        available ? fmt::format(", of {:.0f} MB free now", *available / 1e6) : "");
  print("  {:{}}  {:.1f} MB\n", "disk", s.key, f.disk_bytes / 1e6);
  if (s.file.contains("accuracy") || (seconds > hour && s.prepared.shortenings)) print_accuracies(s);
  if (seconds > hour) print_shortenings(s, seconds);
}

void print_start(const Subject& s) {
  if (!s.prepared.start) return;
  print("\nAt the start:\n");
  for (const auto& [name, text] : s.prepared.start())
    print("  {:{}}  {}\n", name, s.key, wrapped(text, terminal_width(), s.key + 4, s.key + 4));
}

void print_on_ranks(const Subject& s) {
  if (s.ranks == 1) return;
  const std::optional<double> each = measured_evaluation(s.prepared, s.threads, s.measured);
  if (!each) return;
  ThreadTeam team(s.threads);
  print("\nOn {} processes (modelled from the speed measured on this machine now, {} thread{} each):\n", s.ranks,
        s.threads, s.threads == 1 ? "" : "s");
  for (const auto& [name, text] : s.prepared.on_ranks(team, *each, s.ranks))
    print("  {:{}}  {}\n", name, s.key, wrapped(text, terminal_width(), s.key + 4, s.key + 4));
}

using Section = void (*)(const Subject&);
constexpr Section in_short[] = {print_given,    print_following, print_start,
                                print_warnings, print_forecast,  print_on_ranks};
constexpr Section in_full[] = {print_every_key, print_scales,   print_start,
                               print_warnings,  print_forecast, print_on_ranks};

/// \param picture of walls and bed at the start, none if empty
ExitStatus check(const CaseOptions& options, int threads, int ranks, bool all, const std::string& picture) {
  if (std::filesystem::is_directory(options.path)) return check_folder(options.path);
  const CaseFile file = options.read();
  const PreparedCase prepared = prepare_case(file);
  ranks > 1 ? check_ranks(prepared, file, ranks) : check_memory(prepared, file);
  const std::filesystem::path drawn = picture.empty() ? std::filesystem::path() : read_out(picture, {".png"});
  if (!picture.empty() && !prepared.draw_start)
    throw InputError({{.where = "--picture " + picture,
                       .what = fmt::format("the model {} has no bed", prepared.model),
                       .allowed = "a case of the model continuum"}});

  Measured measured;
  Subject subject{options, file, prepared, threads, ranks, std::string_view("from the material").size(), measured};
  for (const NamedValue& group : prepared.groups) subject.key = std::max(subject.key, group.name.size());
  if (all)
    for (const DescribedParameter& item : prepared.parameters.that_hold())
      subject.key = std::max(subject.key, item.parameter.key.size());
  print("{}: valid{}\n", options.path, all ? "." : ". Every key in SI, with the defaults: --all");
  for (const Section section : all ? std::span<const Section>(in_full) : std::span<const Section>(in_short))
    section(subject);
  if (!picture.empty()) {
    prepared.draw_start(drawn);
    print("Picture: {}\n", picture);
  }
  return ExitStatus::done;
}

}  // namespace

void add_check_command(CLI::App& app, Action& action) {
  struct Options {
    CaseOptions case_options;
    int threads = 1, ranks = 1;
    bool all = false;
    std::string picture;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "check", "check a case: all problems at once, or what follows from it and a forecast; or the files of a run");
  options->case_options.add_to(*command);
  add_threads_option(*command, options->threads);
  command->add_option("--ranks", options->ranks, "also what the run takes on so many processes, modelled")
      ->check(CLI::Range(1, 1000000))
      ->default_str("1");
  command->add_flag("--all", options->all, "every key in SI, with its default, where it is from and what it means");
  command->add_option("--picture", options->picture, "PNG file for sections of walls and bed at the start")
      ->type_name("FILE.png");
  command->footer(
      "What was given, what follows from it (bed, particles, step, outlet), warnings, and a forecast; of more than an\n"
      "hour with what would shorten it.\n"
      "In place of CASE the folder of a run, or one that holds runs: compares their series and snapshots with the\n"
      "checksums that were written with them; exit status 4 if one has changed.");
  command->callback([options, &action] {
    action = [options] {
      return check(options->case_options, options->threads, options->ranks, options->all, options->picture);
    };
  });
}

}  // namespace talus::app

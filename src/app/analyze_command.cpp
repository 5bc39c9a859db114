// SPDX-License-Identifier: Apache-2.0
/// talus analyze: what the analysis makes of one set of points, whoever made it; or a run's analysis once more.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "app/commands.hpp"
#include "app/models/models.hpp"
#include "app/points/measures.hpp"
#include "app/report/report.hpp"
#include "base/text.hpp"
#include "base/unit.hpp"
#include "io/case_file.hpp"
#include "io/points_csv.hpp"
#include "io/report_page.hpp"
#include "io/run_folder.hpp"
#include "io/run_json.hpp"
#include "io/vtkhdf.hpp"
#include "run/progress.hpp"

namespace talus::app {

namespace {

struct AnalyzeOptions {
  std::string file, measure, radius, column;
  int bins = 20;
  bool json = false;
};

const MeasureEntry* find_measure(const std::string& name, std::vector<Problem>& problems) {
  std::vector<std::string_view> names;
  for (const MeasureEntry& entry : measures) {
    if (entry.name == name) return &entry;
    names.push_back(entry.name);
  }
  problems.push_back({.where = name.empty() ? "--as" : "--as " + name,
                      .what = name.empty() ? "missing: a file of points can be looked at in many ways" : "is not known",
                      .allowed = fmt::format("{}", fmt::join(names, ", ")),
                      .nearest = std::string(nearest(name, names))});
  return nullptr;
}

std::optional<double> read_radius(const std::string& text, std::vector<Problem>& problems) {
  if (text.empty()) return std::nullopt;
  std::string why;
  const auto radius = parse_quantity(text, &why);
  if (radius && radius->dimension == dimension::length && radius->value > 0) return radius->value;
  problems.push_back({.where = "--radius " + text,
                      .what = !radius                                  ? why
                              : radius->dimension != dimension::length ? "is not a length (unit missing?)"
                                                                       : "is not above 0",
                      .allowed = "a length, above 0 mm, such as \"5 mm\""});
  return std::nullopt;
}

ExitStatus analyze_file(const AnalyzeOptions& options) {
  std::vector<Problem> problems;
  const MeasureEntry* measure = find_measure(options.measure, problems);
  const std::optional<double> radius = read_radius(options.radius, problems);
  const bool csv = std::filesystem::path(options.file).extension() == ".csv";
  PointSet points;
  try {
    points = csv ? read_points_csv(options.file) : read_points(options.file);
  } catch (const InputError& error) {
    problems.insert(problems.end(), error.problems().begin(), error.problems().end());
  }
  if (!problems.empty()) throw InputError(problems);

  const Measured measured = measure->of(PointsToMeasure(options.file, points.view(), radius), options.column,
                                        static_cast<std::size_t>(options.bins));
  print("{}", options.json ? to_json(measured, options.file, measure->name) : to_text(measured));
  return ExitStatus::done;
}

/// The quantities of the analysis replace the quantities of the summary; what the run itself measured stays.
ExitStatus analyze_run_folder(const AnalyzeOptions& options) {
  if (!options.measure.empty() || !options.radius.empty() || !options.column.empty())
    throw InputError({{.where = options.file,
                       .what = "is a run's folder; its case says what is measured",
                       .allowed = "a snapshot's file with --as, --radius, --column; a folder without them"}});
  const RunFolder folder(options.file);
  const Manifest manifest = read_manifest(folder.manifest());
  Summary summary = read_summary(folder.summary());
  const CaseFile resolved = CaseFile::from_text(manifest.case_text, folder.manifest().string());
  const ModelEntry& model = model_of(resolved);
  ReadRuns runs;
  auto waiting = std::make_unique<run::Waiting>("analysing the run, drawing pictures, writing the report");
  const std::vector<NamedValue> quantities = model.analyse(resolved, folder.path(), runs);
  if (model.answers) summary.answers = model.answers(resolved, folder.path(), quantities, runs);
  if (model.draw) model.draw(resolved, folder.path(), runs);
  std::erase_if(summary.quantities, [&](const NamedValue& old) {
    return std::any_of(quantities.begin(), quantities.end(), [&](const auto& q) { return q.name == old.name; });
  });
  summary.quantities.insert(summary.quantities.begin(), quantities.begin(), quantities.end());
  write_summary(folder.summary(), summary);
  if (has_report_page() && std::filesystem::exists(folder.report())) write_run_report(folder.path(), runs);
  waiting.reset();
  const Measured measured{.quantities = quantities, .columns = {}, .rows = {}};
  print("{}", options.json ? to_json(measured, options.file, "run") : to_text(measured));
  return ExitStatus::done;
}

}  // namespace

void add_analyze_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<AnalyzeOptions>();
  CLI::App* command = app.add_subcommand("analyze", "measure a file of points, or a run's folder once more");
  command->add_option("FILE", options->file, "points as CSV or VTKHDF, or the folder of a run")->required();
  std::string footer = "--as is one of\n";
  for (const MeasureEntry& entry : measures) footer += fmt::format("  {:14} {}\n", entry.name, entry.text);
  command->add_option("--as", options->measure, "what is measured; see below");
  command->add_option("--radius", options->radius, "mean radius a, such as \"5 mm\"; that of the points if not given");
  command->add_option("--column", options->column, "histogram, layers: of this column; a vector's component is NAME_x");
  command->add_option("--bins", options->bins, "histogram, layers: how many")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_flag("--json", options->json, "print JSON");
  command->footer(footer +
                  "x points down the slope, y to its left, z away from it; of a heap z is up. Of a run's folder, "
                  "analysis/, pictures/ and\n"
                  "the quantities of summary.json are computed again from its snapshots and its series.");
  command->callback([options, &action] {
    action = [options] {
      return std::filesystem::is_directory(options->file) ? analyze_run_folder(*options) : analyze_file(*options);
    };
  });
}

}  // namespace talus::app

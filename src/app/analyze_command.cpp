// SPDX-License-Identifier: Apache-2.0
/// What is made of a run again: talus analyze, a run's analysis, or that of one set of points, whoever made it; talus
/// report, runs as one page for a browser.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/models/models.hpp"
#include "app/project/project.hpp"
#include "app/report/report.hpp"
#include "app/runs/run_case.hpp"
#include "base/text.hpp"
#include "io/case_file.hpp"
#include "io/report_page.hpp"
#include "io/run_folder.hpp"
#include "io/run_json.hpp"
#include "run/progress.hpp"

namespace talus::app {

namespace {

struct AnalyzeOptions {
  std::string file, measure, radius, column;
  int bins = 20;  ///< the package reads it, and what else is of a file of points
  bool json = false;
};

/// As text, or as {"file", "as", "quantities": {name: {"value", "unit"}}, "table": []}; what is not finite is null.
void print_quantities(const AnalyzeOptions& options, const std::vector<NamedValue>& quantities) {
  if (!options.json) {
    for (const NamedValue& q : quantities)
      print("{:32} {:.6g}{}\n", q.name, q.value, q.unit == "1" ? "" : " " + q.unit);
    return;
  }
  nlohmann::ordered_json json{{"file", options.file}, {"as", "run"}};
  json["quantities"] = nlohmann::ordered_json::object();
  for (const NamedValue& q : quantities) json["quantities"][q.name] = {{"value", q.value}, {"unit", q.unit}};
  json["table"] = nlohmann::ordered_json::array();
  print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

/// The quantities of the analysis replace the quantities of the summary; what the run itself measured stays.
ExitStatus analyze_run_folder(const AnalyzeOptions& options) {
  if (!options.measure.empty() || !options.radius.empty() || !options.column.empty())
    throw InputError({{.where = options.file,
                       .what = "is a run's folder; its case says what is measured",
                       .allowed = "a snapshot's file with --as, --radius, --column; a folder without them"}});
  const RunFolder folder(options.file);
  check_files_of_run(folder);
  const std::unique_ptr<OpenedRun> run = open_run(folder.path());
  Summary summary = read_summary(folder.summary());
  auto waiting = std::make_unique<run::Waiting>("analysing the run, drawing pictures, writing the report");
  const std::vector<NamedValue> quantities = run->analyse();
  summary.answers = run->answers(quantities);
  run->draw();
  std::erase_if(summary.quantities, [&](const NamedValue& old) {
    return std::any_of(quantities.begin(), quantities.end(), [&](const auto& q) { return q.name == old.name; });
  });
  summary.quantities.insert(summary.quantities.begin(), quantities.begin(), quantities.end());
  write_summary(folder.summary(), summary);
  if (has_report_page() && std::filesystem::exists(folder.report())) write_run_report(*run);
  waiting.reset();
  print_quantities(options, quantities);
  return ExitStatus::done;
}

struct ReportOptions {
  std::vector<std::string> folders;
  std::string out;
  ReportLimits limits;
};

ExitStatus report(const ReportOptions& options) {
  if (!has_report_page()) throw FileError("talus report", without_report_page());
  ReportRequest request{.title = {}, .runs = {}, .comparisons = {}, .limits = options.limits};
  for (const std::string& folder : options.folders) {
    ReportRequest of_folder = gathered(folder);
    std::move(of_folder.runs.begin(), of_folder.runs.end(), std::back_inserter(request.runs));
    std::move(of_folder.comparisons.begin(), of_folder.comparisons.end(), std::back_inserter(request.comparisons));
  }
  std::vector<std::string> names;
  for (const ReportEntry& entry : request.runs) {
    check_files_of_run(RunFolder(entry.folder));
    names.push_back(entry.name);
  }
  const bool one = options.folders.size() == 1;
  request.title = request.runs.size() == 1 && request.runs.front().members == 1
                      ? title_of_run(request.runs.front().folder)
                      : fmt::format("{}", fmt::join(names, ", "));
  const std::filesystem::path path = !options.out.empty() ? std::filesystem::path(options.out)
                                     : one ? options.folders.front() / std::filesystem::path("report.html")
                                           : std::filesystem::path("report.html");
  {
    const run::Waiting waiting("writing the report");
    write_report(request, path);
  }
  print("Report: {} ({:.1f} MB)\n", path.string(), static_cast<double>(std::filesystem::file_size(path)) / 1e6);
  return ExitStatus::done;
}

}  // namespace

void add_analyze_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<AnalyzeOptions>();
  CLI::App* command = app.add_subcommand("analyze", "measure a file of points, or a run's folder once more");
  command->add_option("FILE", options->file, "points as CSV or VTKHDF, or the folder of a run")->required();
  command->add_option("--as", options->measure, "what is measured; see below");
  command->add_option("--radius", options->radius, "mean radius a, such as \"5 mm\"; that of the points if not given");
  command->add_option("--column", options->column, "histogram, layers: of this column; a vector's component is NAME_x");
  command->add_option("--bins", options->bins, "histogram, layers: how many")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_flag("--json", options->json, "print JSON");
  command->footer(
      "--as is one of\n"
      "  heads          heads seen from above: grains, width, thickness, concavity of each\n"
      "  front          place of the foremost grain, and of the foremost below 2 a\n"
      "  frontal-angle  angle of the front against the slope, seen from the side\n"
      "  head-tail      thickness of head and rear, seen from the side; their velocities\n"
      "  neighbours     numbers of neighbours within 4 a, n and n' of Niiya et al. 2020, Eq. 11\n"
      "  repose         angle of repose: slopes of a heap longer than 20 a, seen along y\n"
      "  surface        height of the free surface, seen along y\n"
      "  packing        packing fraction at the points, and in layers; spheres of radius a\n"
      "  layers         means of a column in horizontal layers, from the lowest point up (--column, --bins)\n"
      "  histogram      moments, normality and histogram of a column (--column, --bins)\n"
      "x points down the slope, y to its left, z away from it; of a heap z is up. Of a run's folder, "
      "analysis/, pictures/ and\n"
      "the quantities of summary.json are computed again from its snapshots and its series.");
  command->callback([command, options, &action] {
    action = [options, words = words_of(*command)] {
      return std::filesystem::is_directory(options->file) ? analyze_run_folder(*options)
                                                          : become_package("analyze", words);
    };
  });
}

void add_report_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<ReportOptions>();
  CLI::App* command = app.add_subcommand("report", "runs and ensembles as one page for a browser");
  command->add_option("DIR", options->folders, "folder of a run, an ensemble or a reproduction")->required();
  command->add_option("--out", options->out, "the page; DIR/report.html of one folder, report.html here of several");
  command->add_option("--particles", options->limits.particles, "particles of a run at most; thinned beyond")
      ->check(CLI::Range(1, 10'000'000))
      ->capture_default_str();
  command->add_option("--frames", options->limits.frames, "snapshots of a run at most; thinned beyond")
      ->check(CLI::Range(2, 100'000))
      ->capture_default_str();
  command->footer(
      "The page needs neither network nor server. Several runs are seen side by side at the same time, their curves\n"
      "over each other. talus run writes the page of its run at the end (output.report = false: not).");
  command->callback([options, &action] { action = [options] { return report(*options); }; });
}

}  // namespace talus::app

// SPDX-License-Identifier: Apache-2.0
/// talus report: runs as one page for a browser.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <iterator>
#include <memory>

#include "app/commands.hpp"
#include "app/report/report.hpp"
#include "base/text.hpp"
#include "io/report_page.hpp"
#include "run/progress.hpp"

namespace talus::app {

namespace {

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
  for (const ReportEntry& entry : request.runs) names.push_back(entry.name);
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

// SPDX-License-Identifier: Apache-2.0
#include "app/reproduction/study.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/comparison/evaluation.hpp"
#include "app/comparison/studied_runs.hpp"
#include "app/ensemble/plan.hpp"
#include "app/ensemble/schedule.hpp"
#include "base/nearest.hpp"
#include "base/terminal.hpp"
#include "base/version.hpp"
#include "io/atomic_file.hpp"
#include "io/manifest.hpp"
#include "io/run_folder.hpp"
#include "io/summary.hpp"
#include "run/interrupt.hpp"
#include "run/jobs.hpp"
#include "run/progress.hpp"

namespace talus::app {

namespace {

/// The folder with cases/ and validation/: here, or where the program was built.
std::filesystem::path project_folder(const std::string& study) {
  const std::filesystem::path program = run::own_program();
  for (const auto& candidate : {std::filesystem::path("."), program.parent_path().parent_path(),
                                program.parent_path().parent_path() / "share" / "talus"})
    if (std::filesystem::exists(candidate / "validation" / study / "reference.toml")) return candidate;
  throw FileError("validation/" + study + "/reference.toml",
                  "is neither here nor beside the program's build folder; run the command in the project's folder");
}

std::string folder_of(const std::string& case_name, std::string variant) {
  variant.erase(std::remove(variant.begin(), variant.end(), ' '), variant.end());
  return case_name + "-" + variant;
}

bool is_one_of(const std::vector<std::string>& labels, const std::string& label) {
  return std::find(labels.begin(), labels.end(), label) != labels.end();
}

/// Which of a reference's variants a request asks for.
bool is_wanted(const Reference& reference, const StudyRequest& request, const std::string& variant) {
  if (!request.variants.empty()) return is_one_of(request.variants, variant);
  return !request.quick || is_one_of(reference.quick.variants, variant);
}

/// \throws InputError for labels that the study does not have
void check_variants(const Reference& reference, const StudyRequest& request) {
  std::vector<std::string> known;
  for (const ReferenceCase& c : reference.cases)
    for (const ReferenceCase::Variant& variant : c.variants)
      if (!is_one_of(known, variant.label)) known.push_back(variant.label);
  const std::vector<std::string_view> labels(known.begin(), known.end());
  std::vector<Problem> problems;
  for (const std::string& label : request.variants)
    if (!is_one_of(known, label))
      problems.push_back({.where = "--variant",
                          .what = "\"" + label + "\" is no variant of " + reference.study,
                          .allowed = fmt::format("{}", fmt::join(labels, ", ")),
                          .nearest = std::string(nearest(label, labels))});
  if (!problems.empty()) throw InputError(problems);
}

std::vector<ScheduledRun> all_runs(const Reference& reference, const StudyRequest& request,
                                   const std::filesystem::path& project, int members) {
  std::vector<ScheduledRun> runs;
  for (const ReferenceCase& c : reference.cases)
    for (const ReferenceCase::Variant& variant : c.variants) {
      if (!is_wanted(reference, request, variant.label)) continue;
      std::vector<std::string> settings;
      for (const auto& [key, value] : variant.settings) settings.push_back(key + "=" + value);
      if (request.quick)
        for (const auto& [key, value] : reference.quick.settings) settings.push_back(key + "=" + value);
      const EnsembleRequest ensemble{.case_path = (project / "cases" / c.file).string(),
                                     .settings = std::move(settings),
                                     .vary = {},
                                     .members = members,
                                     .folder = request.folder / folder_of(c.name, variant.label)};
      const EnsemblePlan plan = plan_ensemble(ensemble);
      for (EnsembleMember member : plan.groups.front().members) runs.push_back({ensemble.case_path, std::move(member)});
    }
  return runs;
}

double processor_seconds(const std::vector<ScheduledRun>& runs) {
  double seconds = 0;
  for (const ScheduledRun& run : runs)
    if (is_done(run.member))
      if (const Summary summary = read_summary(RunFolder(run.member.folder).summary()); summary.find("cpu_seconds"))
        seconds += summary.find("cpu_seconds")->value;
  return seconds;
}

/// The report: the table of all rows, what is not met and why (validation/STUDY/gaps.md, written by hand), the figures.
std::string report_text(const Reference& reference, const StudyRequest& request, const std::filesystem::path& project,
                        const std::vector<ScheduledRun>& runs, const std::vector<EvaluatedRow>& rows,
                        const std::vector<FailedRun>& failed, const std::string& counts,
                        const std::vector<FigureOfStudy>& figures) {
  std::string report = fmt::format(
      "# {}\n\n{}\n\nComputed by `talus reproduce {}{}` with Talus {} ({}): {} runs, {} of processor time on {}.\n"
      "Rows, estimators and criteria were written down before the first comparison: `validation/{}/reference.toml`.\n\n"
      "**{}**\n\n{}\n",
      reference.title, reference.source, reference.study, request.quick ? " --quick" : "", program_version(),
      program_revision(), runs.size(), run::format_seconds(processor_seconds(runs)),
      manifest_of_this_program().processor, reference.study, counts, to_markdown(rows));
  if (!failed.empty()) report += "## Runs that did not get through\n\n";
  for (const FailedRun& run : failed)
    report += fmt::format("- {} (exit status {}): {}\n", run.folder.lexically_relative(request.folder).string(),
                          run.status, run.reason);
  if (const auto gaps = project / "validation" / reference.study / "gaps.md"; std::filesystem::exists(gaps))
    report += read_whole_file(gaps) + "\n";
  for (const FigureOfStudy& figure : figures)
    report += fmt::format("## {}\n\n![{}](figures/{})\n\n{}\n\n", figure.title, figure.title,
                          figure.path.filename().string(), figure.caption);
  return report;
}

}  // namespace

ExitStatus reproduce(const StudyRequest& request) {
  run::catch_signals();
  const std::filesystem::path project = project_folder(request.study);
  const Reference reference =
      read_reference((project / "validation" / request.study / "reference.toml").lexically_normal().string());
  check_variants(reference, request);
  std::error_code none;
  if (!request.resume && std::filesystem::exists(request.folder) && !std::filesystem::is_empty(request.folder, none))
    throw InputError({{.where = request.folder.string(),
                       .what = "the folder is there and not empty",
                       .allowed = "--resume to go on with what is in it, or another --out"}});

  const int members = request.members ? request.members : request.quick ? reference.quick.members : reference.members;
  const std::vector<ScheduledRun> runs = all_runs(reference, request, project, members);
  say("{}\n{} runs ({} members of each case and radius), {} at a time, in {}\n", reference.source, runs.size(), members,
      request.jobs, request.folder.string());
  const ScheduleResult result = run_members(runs, request.jobs);
  for (const FailedRun& failed : result.failed)
    say("Failed (exit status {}): {}: {}\n", failed.status, failed.folder.string(), failed.reason);
  if (result.interrupted) {
    say("Interrupted; --resume goes on: {}\n", request.folder.string());
    return ExitStatus::interrupted;
  }

  const std::unique_ptr<StudiedRuns> studied = read_studied_runs(request.folder, reference);
  const std::vector<EvaluatedRow> rows = evaluate(reference, *studied);
  const std::string counts =
      fmt::format("{} met, {} not met, {} reported, {} not evaluated", count(rows, Verdict::met),
                  count(rows, Verdict::not_met), count(rows, Verdict::reported), count(rows, Verdict::not_evaluated));
  const std::string text = to_text(rows);
  write_atomically(request.folder / "comparison.txt", text + counts + "\n");
  write_atomically(request.folder / "comparison.json", to_json(reference, rows));

  const std::vector<FigureOfStudy> figures = studied->draw(request.folder / "figures");
  const std::filesystem::path report_path = request.folder / (reference.study + ".md");
  write_atomically(report_path, report_text(reference, request, project, runs, rows, result.failed, counts, figures));

  say("{}{}\nReport: {}\n", text, counts, report_path.string());
  if (!figures.empty()) say("Picture: {}\n", figures.front().path.string());
  if (!result.failed.empty()) return ExitStatus::numerical;
  return count(rows, Verdict::not_met) ? ExitStatus::not_met : ExitStatus::done;
}

}  // namespace talus::app

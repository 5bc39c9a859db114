// SPDX-License-Identifier: Apache-2.0
#include "app/reproduction/study.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/comparison/evaluation.hpp"
#include "app/comparison/project.hpp"
#include "app/comparison/python.hpp"
#include "app/ensemble/plan.hpp"
#include "app/ensemble/report_entries.hpp"
#include "app/ensemble/schedule.hpp"
#include "app/models/models.hpp"
#include "app/report/report.hpp"
#include "base/text.hpp"
#include "io/file.hpp"
#include "io/file_list.hpp"
#include "io/report_page.hpp"
#include "run/interrupt.hpp"
#include "run/jobs.hpp"

namespace talus::app {

namespace {

/// The folder with cases/ and validation/.
std::filesystem::path project_folder(const std::string& study) {
  if (const auto project = find_project(std::filesystem::path("validation") / study / "reference.toml"))
    return *project;
  throw FileError(
      "validation/" + study + "/reference.toml",
      "is neither here, nor where the program was built or installed; run the command in the project's folder");
}

std::string folder_of(const std::string& case_name, std::string variant) {
  variant.erase(std::remove(variant.begin(), variant.end(), ' '), variant.end());
  return case_name + "-" + variant;
}

bool is_one_of(const std::vector<std::string>& labels, const std::string& label) {
  return std::find(labels.begin(), labels.end(), label) != labels.end();
}

/// The variants of a reference that a request selects.
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

struct StudyRuns {
  std::vector<ScheduledRun> runs;
  std::vector<EnsembleGroup> groups;  ///< a case and variant each
};

StudyRuns all_runs(const Reference& reference, const StudyRequest& request, const std::filesystem::path& project,
                   int members) {
  StudyRuns all;
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
                                     .folder = request.folder / folder_of(c.name, variant.label),
                                     .resume = request.resume};
      EnsembleGroup group = plan_ensemble(ensemble).groups.front();
      group.name = c.name + ", " + variant.label;
      for (const EnsembleMember& member : group.members) all.runs.push_back({ensemble.case_path, member});
      all.groups.push_back(std::move(group));
    }
  return all;
}

/// The figures and the page, or a word on what they need. \returns false if the script failed
bool draw_page(const std::filesystem::path& project, const StudyRequest& request) {
  const std::filesystem::path script = project / "validation" / request.study / "figures.py";
  const std::optional<std::filesystem::path> python = find_python({"h5py", "matplotlib"});
  if (!python) {
    fmt::print(
        "No figures: they take python3 with h5py and matplotlib (Debian: python3-h5py, python3-matplotlib).\n"
        "Once those are there: python3 {} {}\n",
        script.string(), request.folder.string());
    return true;
  }
  // -B: nothing is left beside the script.
  const run::ProgramEnd end =
      run::run_program({python->string(), "-B", script.string(), request.folder.string()}, {}, run::signal_has_come);
  print("{}", end.output);
  if (end.status != 0) fmt::print(stderr, "talus: {} failed; it said:\n{}", script.string(), end.errors);
  return end.status == 0;
}

}  // namespace

ExitStatus reproduce(const StudyRequest& request) {
  run::catch_signals();
  const std::filesystem::path project = project_folder(request.study);
  const Reference reference =
      read_reference((project / "validation" / request.study / "reference.toml").lexically_normal().string());
  check_variants(reference, request);
  const int members = request.members ? request.members : request.quick ? reference.quick.members : reference.members;
  const auto [runs, groups] = all_runs(reference, request, project, members);
  begin_output(request.folder, request.resume ? Existing::resume : Existing::refuse, "--resume", has_begun(runs));
  print("{}\n{} runs ({} members of each case and radius), {} at a time, in {}\n", reference.source, runs.size(),
        members, request.jobs, request.folder.string());
  const ScheduleResult result = run_members(runs, request.jobs);
  for (const FailedRun& failed : result.failed)
    print("Failed (exit status {}): {}: {}\n", failed.status.value_or(-1), failed.folder.string(), failed.reason);
  if (result.interrupted) {
    print("Interrupted; --resume goes on: {}\n", request.folder.string());
    return ExitStatus::interrupted;
  }

  const std::vector<FoundEnsemble> found = find_ensembles(request.folder, reference);
  ReadRuns read;
  const std::vector<EvaluatedRow> rows =
      evaluate(reference, found, read_studied_runs(found, read), Faults::refuse, request.jobs);
  const std::string text = to_text(rows) + counts_text(rows) + "\n";
  write_atomically(request.folder / "comparison.txt", text);
  const std::string json = to_json(reference, rows, found, request.folder);
  write_atomically(request.folder / "comparison.json", json);
  print("{}", text);
  if (has_report_page())
    write_report({.title = reference.title, .runs = entries_of(groups), .comparisons = {json}},
                 request.folder / "report.html", read);

  if (!draw_page(project, request)) return ExitStatus::files;
  if (!result.failed.empty()) return ExitStatus::numerical;
  return count(rows, Verdict::not_met) ? ExitStatus::not_met : ExitStatus::done;
}

}  // namespace talus::app

// SPDX-License-Identifier: Apache-2.0
#include "app/ensemble/schedule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>

#include "app/runs/run_case.hpp"
#include "base/error.hpp"
#include "io/file_list.hpp"
#include "io/run_folder.hpp"
#include "io/run_json.hpp"
#include "run/interrupt.hpp"
#include "run/jobs.hpp"
#include "run/progress.hpp"

namespace talus::app {

namespace {

constexpr int interrupted_status = static_cast<int>(ExitStatus::interrupted);

run::Job job_of(const ScheduledRun& run, const std::filesystem::path& output) {
  run::Job job{.arguments = arguments_of(run), .output = output};
  if (std::filesystem::exists(run.member.folder)) job.arguments.push_back("--resume");
  return job;
}

/// The last line of what a program wrote, of its errors where there are any: errors and the rest come in either order.
std::string last_line(const std::filesystem::path& path) {
  constexpr std::string_view error = "talus: ";
  std::ifstream file(path);
  std::string line, last;
  while (std::getline(file, line))
    if (!line.empty() && (line.starts_with(error) || !last.starts_with(error))) last = line;
  return last;
}

}  // namespace

std::filesystem::path output_of(const EnsembleMember& member) {
  std::filesystem::path output = member.folder;
  output += ".out";
  return output;
}

std::vector<std::string> arguments_of(const ScheduledRun& run) {
  std::vector<std::string> arguments = {run::own_program(),
                                        "run",
                                        run.case_path,
                                        "--out",
                                        run.member.folder.string(),
                                        "--threads",
                                        "1",
                                        "--set",
                                        "output.pictures=false",
                                        "--set",
                                        "output.report=false"};
  for (const std::string& setting : run.member.settings) {
    arguments.push_back("--set");
    arguments.push_back(setting);
  }
  return arguments;
}

bool is_done(const EnsembleMember& member) {
  const RunFolder folder(member.folder);
  if (!std::filesystem::exists(folder.summary())) return false;
  if (read_summary(folder.summary()).status != "done") return false;
  const Manifest manifest = read_manifest(folder.manifest());
  if (manifest.fingerprint != member.fingerprint)
    throw InputError({{.where = folder.path().string(),
                       .what = "holds a run of another case",
                       .allowed = "the same case to resume, or another --out"}});
  if (end_of(manifest) > member.end)
    throw InputError({{.where = folder.path().string(),
                       .key = "run.end",
                       .what = fmt::format("{} s, before the end of the run there, {} s", member.end, end_of(manifest)),
                       .allowed = "the same end or a later one, or another --out"}});
  return end_of(manifest) == member.end;
}

bool has_begun(const std::vector<ScheduledRun>& runs) {
  return std::any_of(runs.begin(), runs.end(), [](const ScheduledRun& run) {
    return std::filesystem::exists(RunFolder(run.member.folder).manifest());
  });
}

ScheduleResult gather_members(const std::vector<ScheduledRun>& runs) {
  ScheduleResult result;
  for (const ScheduledRun& run : runs) {
    if (is_done(run.member)) {
      ++result.found_done;
      std::error_code ignored;
      std::filesystem::remove(output_of(run.member), ignored);
    } else {
      const std::string said = last_line(output_of(run.member));
      result.failed.push_back({run.member.folder, std::nullopt, said.empty() ? "has not ended" : said});
    }
  }
  return result;
}

ScheduleResult run_members(const std::vector<ScheduledRun>& runs, int jobs) {
  ScheduleResult result;
  std::vector<const ScheduledRun*> open;
  for (const ScheduledRun& run : runs) {
    if (is_done(run.member)) {
      ++result.found_done;
      std::error_code ignored;  // what it said, where a kill came before it was removed
      std::filesystem::remove(output_of(run.member), ignored);
    } else {
      open.push_back(&run);
    }
  }

  std::vector<run::Job> list;
  for (const ScheduledRun* run : open) {
    make_folder(run->member.folder.parent_path());
    list.push_back(job_of(*run, output_of(run->member)));
  }

  run::Progress progress(stderr);
  progress.begin({.start = 0, .end = static_cast<double>(list.size()), .recent = 1});
  std::size_t ended = 0;
  const bool complete = run::run_jobs(
      list, jobs,
      [&](const run::JobEnd& end) {
        ++ended;
        if (end.status == 0) {
          ++result.done;
          std::error_code ignored;
          std::filesystem::remove(list[end.job].output, ignored);
        } else if (end.status != interrupted_status) {
          result.failed.push_back({open[end.job]->member.folder, end.status, last_line(list[end.job].output)});
        }
      },
      [&] {
        progress.update(static_cast<double>(ended), [&] {
          return fmt::format("{} of {} runs done{}", result.found_done + result.done, runs.size(),
                             result.failed.empty() ? "" : fmt::format(", {} failed", result.failed.size()));
        });
      },
      [] { return run::signal_has_come(); });
  progress.finish();
  result.interrupted = !complete || result.found_done + result.done + result.failed.size() < runs.size();
  return result;
}

}  // namespace talus::app

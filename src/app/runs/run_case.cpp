// SPDX-License-Identifier: Apache-2.0
#include "app/runs/run_case.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <map>
#include <optional>
#include <utility>

#include "app/models/models.hpp"
#include "app/report/report.hpp"
#include "base/text.hpp"
#include "base/unit.hpp"
#include "io/checkpoint.hpp"
#include "io/file.hpp"
#include "io/file_list.hpp"
#include "io/parameter_reader.hpp"
#include "io/parameter_writer.hpp"
#include "io/report_page.hpp"
#include "io/run_json.hpp"
#include "io/series.hpp"
#include "numerics/run_record.hpp"
#include "run/interrupt.hpp"
#include "run/progress.hpp"

namespace talus::app {

namespace {

/// log.txt: what happened in a run, and when. A log that cannot be written does not end a run: the files of the numbers
/// report a full disk themselves.
class RunLog {
 public:
  /// \param append after the lines of the run that is resumed
  RunLog(const std::filesystem::path& path, bool append);

  /// Adds a line, with the local time before it.
  template <class... Values>
  void write(fmt::format_string<Values...> format, Values&&... values) {
    write_line(fmt::format(format, std::forward<Values>(values)...));
  }

 private:
  void write_line(const std::string& text);

  std::optional<Descriptor> file_;  // none: it could not be opened
};

RunLog::RunLog(const std::filesystem::path& path, bool append) {
  try {
    claim_file(path);
    file_.emplace(path.string(), O_WRONLY | O_CREAT | O_NOFOLLOW | (append ? O_APPEND : O_TRUNC));
  } catch (const FileError&) {
  }
}

void RunLog::write_line(const std::string& text) {
  if (!file_) return;
  try {
    file_->write(fmt::format("{:%Y-%m-%d %H:%M:%S}  {}\n", fmt::localtime(std::time(nullptr)), text));
  } catch (const FileError&) {
  }
}

// Not the choice of an instruction set counts but the set it resolves to: case_fingerprint.
constexpr std::array<std::string_view, 6> not_in_fingerprint{"run.end",
                                                             "title",
                                                             "output.pictures",
                                                             "output.report",
                                                             "output.checkpoint_interval",
                                                             "integration.instruction_set"};

double peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

void print_regime(const std::vector<RegimeLine>& regime, RunLog& log) {
  print("Regime at the end:\n");
  for (const RegimeLine& line : regime) {
    const std::string text =
        fmt::format("{} {} = {}: {}", line.warning ? "!" : " ", line.quantity, line.value, line.meaning);
    print("  {}\n", text);
    log.write("regime {}", text);
  }
}

void print_answers(const std::vector<Answer>& answers, RunLog& log) {
  if (answers.empty()) return;
  std::size_t question = 0, answer = 0;
  for (const Answer& line : answers) {
    question = std::max(question, line.question.size());
    answer = std::max(answer, line.answer.size());
  }
  print("Key results:\n");
  for (const Answer& line : answers) {
    std::string text = fmt::format("{:{}}  {:{}}", line.question, question, line.answer, answer);
    if (!line.by_hand.empty()) text += "  estimate: " + line.by_hand;
    text.erase(text.find_last_not_of(' ') + 1);
    print("    {}\n", text);
    log.write("result {}", text);
  }
}

/// The warnings of a validity report, for the summary.
std::vector<std::string> texts_of(const std::vector<RegimeLine>& regime) {
  std::vector<std::string> texts;
  for (const Warning& warning : warnings_of(regime)) texts.push_back(to_string(warning));
  return texts;
}

Manifest manifest_of(const PreparedCase& prepared, int threads) {
  Manifest manifest = manifest_of_this_program();
  manifest.case_text = resolved_case(prepared.parameters);
  manifest.fingerprint = case_fingerprint(prepared);
  manifest.seed = prepared.seed;
  manifest.instruction_set = prepared.instruction_set;
  manifest.threads = threads;
  return manifest;
}

/// The keys of a case that name files of points or triangles. \param values of the case by key, as text
std::string files_of(const std::map<std::string, std::string>& values) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : values)
    if (key.ends_with(".file") && !value.empty() && value != "\"\"") keys.push_back(key);
  return fmt::format("{}", fmt::join(keys, ", "));
}

/// Checks that the run in a folder can be continued with this case; reads only. \throws InputError with every key that
/// differs
void check_resumable(const PreparedCase& prepared, const RunFolder& folder, const Manifest& now) {
  if (!std::filesystem::exists(folder.manifest())) return;  // killed before it began
  const Manifest then = read_manifest(folder.manifest());
  std::vector<Problem> problems;
  auto differs = [&](const std::string& key, const std::string& what, const std::string& allowed) {
    problems.push_back({.where = folder.path().string(), .key = key, .what = what, .allowed = allowed});
  };
  auto old_values = resolved_values(then.case_text), values = resolved_values(now.case_text);
  for (const auto& [key, value] : old_values) values.try_emplace(key);
  for (const auto& [key, value] : values) {
    if (std::find(not_in_fingerprint.begin(), not_in_fingerprint.end(), key) != not_in_fingerprint.end()) continue;
    auto shown = [](const std::string& text) { return text.empty() ? "not given" : text; };
    if (value != old_values[key])
      differs(key, fmt::format("{} in the run there, {} now", shown(old_values[key]), shown(value)),
              "the same case to resume (only run.end may be later), or --overwrite");
  }
  if (const double end = end_of(then); prepared.run.end < end)
    differs("run.end", fmt::format("{} s, before the end of the run there, {} s", prepared.run.end, end),
            "the same end or a later one");
  if (then.instruction_set != now.instruction_set)
    differs(
        "integration.instruction_set",
        fmt::format("{} in the run there, {} now: the bits would differ", then.instruction_set, now.instruction_set),
        fmt::format("\"{}\"", then.instruction_set));
  if (problems.empty() && then.fingerprint != now.fingerprint && then.revision != now.revision)
    differs("case", fmt::format("begun by revision {} of the program, this is {}", then.revision, now.revision),
            "the same program, with the same files, to resume, or --overwrite");
  else if (problems.empty() && then.fingerprint != now.fingerprint)
    differs(files_of(values), "its points are not those that the run there began with", "the same points");
  if (!problems.empty()) throw InputError(problems);
}

ExitStatus run_in_folder(const PreparedCase& prepared, const RunRequest& request, const RunFolder& folder,
                         const Manifest& manifest, RunLog& log) {
  const bool resume = request.existing == Existing::resume;
  write_summary(
      folder.summary(),
      {.status = "running", .instruction_set = manifest.instruction_set, .warnings = texts_of(prepared.regime)});
  const CheckpointFiles checkpoints(folder.path());
  for (const std::string& damage : checkpoints.damages()) {
    log.write("passed over: {}", damage);
    print_error("talus: passed over: {}\n", damage);
  }

  for (const std::string& remark : prepared.remarks) log.write("{}", remark);
  for (const Warning& warning : warnings_before_run(prepared, folder.path())) {
    log.write("warning {}", to_string(warning));
    if (warning.id == "disk")
      print_error("talus: {}\n", warning.text);  // the others are in the validity report at the end
  }

  ThreadTeam team(request.threads);
  std::unique_ptr<run::AnyModel> model;
  {
    const run::Waiting waiting("laying the bed");
    model = prepared.make_model(team);
  }
  const run::LoopResult loop = run::run_loop(*model, team, folder.path(),
                                             {.end = prepared.run.end,
                                              .series_interval = prepared.run.series,
                                              .snapshot_interval = prepared.run.snapshots,
                                              .checkpoint_interval = prepared.run.checkpoint_interval,
                                              .walltime = request.walltime,
                                              .fingerprint = manifest.fingerprint,
                                              .resume = resume,
                                              .headline = prepared.headline,
                                              .log = [&log](const std::string& line) { log.write("{}", line); }},
                                             prepared.observers);

  Summary summary{.status = loop.interrupted ? "interrupted" : "done",
                  .wall_seconds = loop.wall_seconds,
                  .instruction_set = manifest.instruction_set};
  std::vector<std::filesystem::path> pictures;
  std::unique_ptr<OpenedRun> opened;
  if (!loop.interrupted) {
    {
      const run::Waiting waiting("analysing the run");
      opened = prepared.open(folder.path());
      summary.quantities = opened->analyse();
      summary.answers = opened->answers(summary.quantities);
    }
    if (prepared.run.pictures) {
      const run::Waiting waiting("drawing pictures");
      pictures = opened->draw();
    }
  }
  const std::vector<RegimeLine> regime = model->regime({read_series(folder.series()), summary.quantities});
  summary.warnings = texts_of(regime);
  summary.regime = regime;
  for (const NamedValue& value : {NamedValue{"wall_seconds", "s", loop.wall_seconds},
                                  {"cpu_seconds", "s", loop.cpu_seconds},
                                  {"peak_memory", "B", peak_memory_bytes()},
                                  {"threads", "1", static_cast<double>(request.threads)},
                                  {"steps", "1", static_cast<double>(loop.steps)}})
    summary.quantities.push_back(value);
  write_summary(folder.summary(), summary);

  if (const std::string sharing = model->sharing(); !sharing.empty()) log.write("{}", sharing);
  if (loop.interrupted) {
    log.write("interrupted by {} at t = {:.6g} s, step {}", loop.reason, model->time(), loop.steps);
    print("Interrupted by {} at t = {:.6g} s; --resume goes on from there: {}\n", loop.reason, model->time(),
          folder.path().string());
    return ExitStatus::interrupted;
  }
  if (!loop.ended.empty()) {
    log.write("ended at t = {:.6g} s: {}", model->time(), loop.ended);
    print("Ended at t = {:.6g} s: {}.\n", model->time(), loop.ended);
  }
  log.write("done: t = {:.6g} s, {} steps, {:.3f} s wall, {:.3f} s of processor", model->time(), loop.steps,
            loop.wall_seconds, loop.cpu_seconds);
  print_regime(regime, log);
  print_answers(summary.answers, log);
  if (prepared.run.report && has_report_page()) {
    const run::Waiting waiting("writing the report");
    write_run_report(*opened);
  } else if (prepared.run.report) {
    log.write("no report.html: {}", without_report_page());
    print("No report.html: this program was built without npm; talus report says what to install.\n");
  }
  print("Done: {} steps in {}.\nResults: {}\n", loop.steps, run::format_seconds(loop.wall_seconds),
        folder.path().string());
  if (!pictures.empty()) print("Picture: {}\n", pictures.front().string());
  return ExitStatus::done;
}

/// If even this cannot be written, the original error is the one to report.
void summarize_failure(const PreparedCase& prepared, const RunFolder& folder, const Manifest& manifest) {
  try {
    write_summary(
        folder.summary(),
        {.status = "failed", .instruction_set = manifest.instruction_set, .warnings = texts_of(prepared.regime)});
  } catch (const FileError&) {
  }
}

}  // namespace

std::string case_fingerprint(const PreparedCase& prepared) {
  std::string all = fingerprint(prepared.parameters, not_in_fingerprint) + "-" + prepared.instruction_set;
  return prepared.inputs.empty() ? all : all + "-" + prepared.inputs;
}

void check_ranks(const PreparedCase& prepared, const CaseFile& file, int ranks) {
  ParameterReader reader(file);
  if (!prepared.make_part)
    reader.check({{.key = "model",
                   .what = fmt::format("\"{}\" runs on one process only", prepared.model),
                   .allowed = "\"continuum\" or \"cloud\", or one process: talus run without mpirun or srun"}});
  else if (const auto& shared = prepared.shared; ranks > shared.count)
    reader.check({{.key = shared.key,
                   .what = fmt::format("makes {:.0f} {} for {} processes", shared.count, shared.name, ranks),
                   .allowed = fmt::format("at most as many processes as {}; {}", shared.name, shared.allowed)}});
  reader.throw_problems();
}

namespace {

bool leaves_out_snapshots(const CaseFile& file) {
  const CaseEntry* given = file.find("output.snapshots");
  if (!given) return true;
  const auto* text = std::get_if<std::string>(&given->value.value);
  const auto interval = text ? parse_quantity(*text) : std::nullopt;
  return interval && interval->value == 0;
}

}  // namespace

PreparedCase prepare_to_resume(CaseFile file, const std::filesystem::path& folder) {
  const std::filesystem::path manifest = RunFolder(folder).manifest();
  // Neither a link, which run_case() refuses, nor one that is not there.
  if (std::filesystem::symlink_status(manifest).type() != std::filesystem::file_type::regular)
    return prepare_case(file);
  const auto then = resolved_values(read_manifest(manifest).case_text);
  const auto keep = [&](const std::string& key) {
    const auto value = then.find(key);
    if (value != then.end()) file.set(key + "=" + value->second, manifest.string());
  };
  if (leaves_out_snapshots(file)) keep("output.snapshots");
  PreparedCase prepared = prepare_case(file);
  const auto now = resolved_values(resolved_case(prepared.parameters));
  bool differs = false;
  for (const auto& [key, origin] : prepared.filled_in) {
    if (origin != "bed") continue;
    const auto before = then.find(key), after = now.find(key);
    differs = differs || (before != then.end() && after != now.end() && before->second != after->second);
    keep(key);  // all of them: one that is given may leave out another
  }
  return differs ? prepare_case(file) : std::move(prepared);
}

double end_of(const Manifest& manifest) {
  const std::string text = resolved_values(manifest.case_text)["run.end"];
  const auto end = parse_quantity(std::string_view(text).substr(0, text.rfind('"')).substr(text.find('"') + 1));
  if (!end) throw FileError("manifest.json", "its case has no run.end");
  return end->value;
}

ExitStatus run_case(const PreparedCase& prepared, const RunRequest& request) {
  if (request.dry_run) {
    ThreadTeam team(request.threads);
    const auto model = prepared.make_model(team);
    model->begin(team);
    print("The case is valid and its start can be built: {} grains. Nothing was written.\n", model->snapshot().size());
    return ExitStatus::done;
  }
  run::catch_signals();
  const RunFolder folder = RunFolder::create(request.folder, request.existing);
  const Manifest manifest = manifest_of(prepared, request.threads);
  if (request.existing == Existing::resume) {
    const run::Waiting waiting("checking the files of the run");
    check_resumable(prepared, folder, manifest);
    check_resumable_files(folder);
  }
  write_manifest(folder.manifest(), manifest);  // before any other file: it marks the folder as a run's
  RunLog log(folder.log(), request.existing == Existing::resume);
  log.write("{} with {} threads, instruction set {}", request.existing == Existing::resume ? "resumed" : "begun",
            request.threads, prepared.instruction_set);
  try {
    return run_in_folder(prepared, request, folder, manifest, log);
  } catch (const NumericalError& error) {
    log.write("numerical failure: {}", error.what());
    summarize_failure(prepared, folder, manifest);
    throw;
  } catch (const FileError& error) {
    log.write("file trouble: {}", error.what());
    summarize_failure(prepared, folder, manifest);
    throw;
  }
}

}  // namespace talus::app

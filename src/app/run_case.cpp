// SPDX-License-Identifier: Apache-2.0
#include "app/run_case.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include <array>

#include "io/manifest.hpp"
#include "io/parameter_writer.hpp"
#include "io/summary.hpp"
#include "run/interrupt.hpp"
#include "run/progress.hpp"

namespace talus::app {

namespace {

constexpr std::array<std::string_view, 4> not_in_fingerprint{"run.end", "title", "output.pictures",
                                                             "output.checkpoint_interval"};

double peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

/// log.txt. A log that cannot be written must not end a run: the numbers' own files say so if the disk is full.
std::shared_ptr<spdlog::logger> open_log(const RunFolder& folder, bool append) {
  auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(folder.log().string(), !append);
  auto log = std::make_shared<spdlog::logger>("run", sink);
  log->set_pattern("%Y-%m-%d %H:%M:%S  %v");
  log->flush_on(spdlog::level::info);
  log->set_error_handler([](const std::string&) {});
  return log;
}

void print_regime(const std::vector<RegimeLine>& regime, spdlog::logger& log) {
  fmt::print("Regime at the end:\n");
  for (const RegimeLine& line : regime) {
    const std::string text =
        fmt::format("{} {} = {}: {}", line.warning ? "!" : " ", line.quantity, line.value, line.meaning);
    fmt::print("  {}\n", text);
    log.info("regime {}", text);
  }
}

ExitStatus run_in_folder(const PreparedCase& prepared, const RunRequest& request, const RunFolder& folder,
                         spdlog::logger& log) {
  Manifest manifest = manifest_of_this_program();
  manifest.case_text = resolved_case(prepared.parameters);
  manifest.fingerprint = case_fingerprint(prepared);
  manifest.seed = prepared.seed;
  manifest.instruction_set = prepared.instruction_set;
  manifest.threads = request.threads;
  const bool resume = request.existing == Existing::resume;
  if (!resume) write_manifest(folder.manifest(), manifest);
  std::filesystem::create_directories(folder.snapshots());
  std::error_code ignored;
  std::filesystem::remove(folder.stop(), ignored);  // of an earlier session

  std::unique_ptr<run::AnyModel> model = prepared.make_model();
  ThreadTeam team(request.threads);
  const run::LoopResult loop = run::run_loop(*model, team, folder.path(),
                                             {.end = prepared.run.end,
                                              .snapshot_interval = prepared.run.snapshots,
                                              .checkpoint_interval = prepared.run.checkpoint_interval,
                                              .walltime = request.walltime,
                                              .fingerprint = manifest.fingerprint,
                                              .resume = resume},
                                             prepared.observers);
  if (resume) write_manifest(folder.manifest(), manifest);

  Summary summary{
      .status = loop.interrupted ? "interrupted" : "done", .wall_seconds = loop.wall_seconds, .quantities = {}};
  std::vector<std::filesystem::path> pictures;
  if (!loop.interrupted) {
    summary.quantities = prepared.analyze(folder.path());
    if (prepared.run.pictures) pictures = prepared.draw(folder.path());
  }
  for (const NamedValue& value : {NamedValue{"wall_seconds", "s", loop.wall_seconds},
                                  {"cpu_seconds", "s", loop.cpu_seconds},
                                  {"peak_memory", "B", peak_memory_bytes()},
                                  {"threads", "1", static_cast<double>(request.threads)},
                                  {"steps", "1", static_cast<double>(loop.steps)}})
    summary.quantities.push_back(value);
  write_summary(folder.summary(), summary);

  if (loop.interrupted) {
    log.info("interrupted by {} at t = {:.6g} s, step {}", loop.reason, model->time(), loop.steps);
    fmt::print("Interrupted by {} at t = {:.6g} s; --resume goes on from there: {}\n", loop.reason, model->time(),
               folder.path().string());
    return ExitStatus::interrupted;
  }
  log.info("done: t = {:.6g} s, {} steps, {:.3f} s wall, {:.3f} s of processor", model->time(), loop.steps,
           loop.wall_seconds, loop.cpu_seconds);
  print_regime(model->regime(), log);
  fmt::print("Done: {} steps in {}.\nResults: {}\n", loop.steps, run::format_seconds(loop.wall_seconds),
             folder.path().string());
  if (!pictures.empty()) fmt::print("Picture: {}\n", pictures.front().string());
  return ExitStatus::done;
}

}  // namespace

std::string case_fingerprint(const PreparedCase& prepared) {
  return fingerprint(prepared.parameters, not_in_fingerprint);
}

ExitStatus run_case(const PreparedCase& prepared, const RunRequest& request) {
  if (request.dry_run) {
    ThreadTeam team(request.threads);
    const auto model = prepared.make_model();
    model->begin(team);
    fmt::print("The case is valid and its start can be built: {} grains. Nothing was written.\n",
               model->snapshot().size());
    return ExitStatus::done;
  }
  run::catch_signals();
  const RunFolder folder = RunFolder::create(request.folder, request.existing);
  const auto log = open_log(folder, request.existing == Existing::resume);
  log->info("{} with {} threads, instruction set {}", request.existing == Existing::resume ? "resumed" : "begun",
            request.threads, prepared.instruction_set);
  try {
    return run_in_folder(prepared, request, folder, *log);
  } catch (const NumericalError& error) {
    log->error("numerical failure: {}", error.what());
    write_summary(folder.summary(), {.status = "failed", .wall_seconds = 0, .quantities = {}});
    throw;
  } catch (const FileError& error) {
    log->error("file trouble: {}", error.what());
    throw;
  }
}

}  // namespace talus::app

// SPDX-License-Identifier: Apache-2.0
#include "run/loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "base/system.hpp"
#include "io/checkpoint.hpp"
#include "io/run_folder.hpp"
#include "io/series.hpp"
#include "run/interrupt.hpp"
#include "run/progress.hpp"
#include "run/snapshot_writer.hpp"

namespace talus::run {

namespace {

/// Detects a run whose steps have become so short that it would never end.
class StepGuard {
 public:
  static constexpr double max_fall = 100;         ///< longest step of the phase over one that is too short
  static constexpr std::uint64_t patience = 100;  ///< steps in a row: an impact may ask for some

  /// To be called for every step, of length `step`, s. \param begun whether the run's time origin had come when it
  /// began; steps before and after it are compared with their own
  /// \returns what is wrong, nothing if the run may continue
  std::optional<std::string> take(double step, bool begun);

  void save(CheckpointWriter& checkpoint) const;
  /// A checkpoint of a version without a guard leaves it as it is.
  void resume(const CheckpointReader& checkpoint);

 private:
  double max_step_ = 0;      ///< of the phase, s
  std::uint64_t short_ = 0;  ///< steps in a row that were too short
  std::uint64_t begun_ = 0;
};

std::optional<std::string> StepGuard::take(double step, bool begun) {
  if (begun != (begun_ != 0)) {
    max_step_ = 0;
    short_ = 0;
    begun_ = begun;
  }
  max_step_ = std::max(max_step_, step);
  short_ = max_fall * step < max_step_ ? short_ + 1 : 0;
  if (short_ < patience) return std::nullopt;
  return fmt::format("the time step has fallen from {:.3g} s to {:.3g} s, {} steps in a row: the run would not end",
                     max_step_, step, short_);
}

void StepGuard::save(CheckpointWriter& checkpoint) const {
  checkpoint.put("run/longest_step", max_step_, "s");
  checkpoint.put("run/short_steps", short_);
  checkpoint.put("run/origin_has_come", begun_);
}

void StepGuard::resume(const CheckpointReader& checkpoint) {
  if (!checkpoint.has("run/longest_step")) return;
  checkpoint.get("run/longest_step", max_step_);
  checkpoint.get("run/short_steps", short_);
  checkpoint.get("run/origin_has_come", begun_);
}

/// Wall and processor time of this session on top of those of earlier ones.
class RunTimes {
 public:
  void add(double wall, double cpu) { wall_ += wall, cpu_ += cpu; }
  double wall() const { return wall_ + std::chrono::duration<double>(Wall::now() - start_).count(); }
  double cpu() const { return cpu_ + processor_seconds() - cpu_start_; }

 private:
  using Wall = std::chrono::steady_clock;
  Wall::time_point start_ = Wall::now();
  double cpu_start_ = processor_seconds();
  double wall_ = 0, cpu_ = 0;
};

std::vector<NamedValue> row_of(const AnyModel& model, const std::vector<Observer>& observers) {
  std::vector<NamedValue> row = {{"time", "s", model.time()}, {"step", "1", static_cast<double>(model.step())}};
  for (NamedValue& value : model.totals()) row.push_back(std::move(value));
  for (const Observer& observer : observers)
    for (NamedValue& value : observer.observe([&](const auto& take) { model.visit(observer.columns, take); }))
      row.push_back(std::move(value));
  return row;
}

std::vector<SeriesColumn> columns_of(const std::vector<NamedValue>& row) {
  std::vector<SeriesColumn> columns;
  for (const NamedValue& value : row) columns.push_back({value.name, value.unit});
  return columns;
}

void append(SeriesWriter& series, const std::vector<NamedValue>& row) {
  std::vector<double> values;
  for (const NamedValue& value : row) values.push_back(value.value);
  series.append(values);
}

/// \throws NumericalError if the step has fallen too far
void check_step(StepGuard& guard, const AnyModel& model, double time_before, bool begun) {
  const auto fault = guard.take(model.time() - time_before, begun);
  if (!fault) return;
  NumericalError::Report report = model.step_limit();
  report.what = *fault;
  report.step = model.step();
  report.time = model.time();
  throw NumericalError(report);
}

/// The line of progress: where the run is, how fast, and its headline. Speeds are those since the line before.
class LiveLine {
 public:
  LiveLine(const AnyModel& model, const LoopOptions& options)
      : model_(model), options_(options), progress_(stderr, options.log) {
    begin_phase();
  }

  /// \param row the last that was made
  void update(const std::vector<NamedValue>& row) {
    if (std::isinf(model_.time_origin()) != settling_) begin_phase();
    progress_.update(now(), [&] { return text(row); });
  }
  void finish() { progress_.finish(); }

 private:
  using Clock = std::chrono::steady_clock;
  struct Mark {
    Clock::time_point clock;
    double step, time, value;
  };

  double now() const { return settling_ ? model_.time() : std::max(model_.time() - model_.time_origin(), 0.0); }

  void begin_phase() {
    settling_ = std::isinf(model_.time_origin());
    mark_.reset();
    if (settling_)
      progress_.begin(
          {.start = model_.time(), .end = model_.latest_origin(), .name = "settling", .after = options_.end});
    else
      progress_.begin({.start = now(), .end = options_.end});
  }

  std::string text(const std::vector<NamedValue>& row) {
    const auto found = std::find_if(row.begin(), row.end(),
                                    [&](const NamedValue& value) { return value.name == options_.headline.column; });
    const bool has_headline = !settling_ && found != row.end();
    const Mark here{Clock::now(), static_cast<double>(model_.step()), row.front().value,
                    has_headline ? found->value : 0};
    std::string line = settling_ ? fmt::format("t = {:.4g} s", model_.time())
                                 : fmt::format("t = {:.4g} s of {:.4g} s", now(), options_.end);
    line += fmt::format("  step {}", model_.step());
    const auto before = std::exchange(mark_, here);
    if (before && here.clock > before->clock)
      line += fmt::format("  {:.3g} steps/s", (here.step - before->step) /
                                                  std::chrono::duration<double>(here.clock - before->clock).count());
    if (!has_headline) return line;
    const Headline& headline = options_.headline;
    if (!headline.is_rate) return line + fmt::format("  {} {:.3g} {}", headline.name, here.value, found->unit);
    if (!before || !(here.time > before->time)) return line;
    return line + fmt::format("  {} {:.3g} {}/s", headline.name,
                              (here.value - before->value) / (here.time - before->time), found->unit);
  }

  const AnyModel& model_;
  const LoopOptions& options_;
  Progress progress_;
  bool settling_ = false;
  std::optional<Mark> mark_;
};

}  // namespace

LoopResult run_loop(AnyModel& model, ThreadTeam& team, const std::filesystem::path& folder, const LoopOptions& options,
                    const std::vector<Observer>& observers) {
  RunTimes clock;
  CheckpointFiles checkpoints(folder);
  StepGuard guard;
  SnapshotWriter snapshots(folder, options.snapshot_interval);
  double next_row_time = 0, time_of_row = 0;
  std::uint64_t rows = 0;  // but for the last of a run that has ended between two

  std::vector<NamedValue> row;  // the last
  auto add_row = [&](SeriesWriter& series) {
    row = row_of(model, observers);
    append(series, row);
    rows = series.position(), time_of_row = model.time();
    if (options.series_interval > 0)
      next_row_time = options.series_interval * (std::floor(model.time() / options.series_interval) + 1);
  };

  // The position of a run: at its start, or at the newest intact checkpoint.
  std::optional<CheckpointReader> checkpoint;
  if (options.resume) {
    const Waiting waiting("reading the checkpoint");
    checkpoint = checkpoints.load();
  }
  std::optional<SeriesWriter> series;
  if (checkpoint) {
    if (checkpoint->fingerprint() != options.fingerprint)
      throw InputError({{.where = checkpoint->path().string(),
                         .what = "this run was made with another case",
                         .allowed = "the same case to resume (only run.end may be later), or --overwrite"}});
    {
      const Waiting waiting("finding neighbours");
      model.resume(team, *checkpoint);
    }
    double wall = 0, cpu = 0;
    checkpoint->get("run/rows", rows);
    checkpoint->get("run/rows_to_keep", rows);  // those of earlier versions have none
    time_of_row = model.time();
    checkpoint->get("run/time_of_row", time_of_row);
    checkpoint->get("run/next_row_time", next_row_time);
    checkpoint->get("run/wall_seconds", wall);
    checkpoint->get("run/cpu_seconds", cpu);
    clock.add(wall, cpu);
    guard.resume(*checkpoint);
    row = row_of(model, observers);
    series = SeriesWriter::resume(folder / "series.csv", columns_of(row), rows);
    snapshots.resume(*checkpoint);
  } else {
    {
      const Waiting waiting("finding neighbours");
      model.begin(team);
    }
    const Waiting waiting("writing the first files");
    series.emplace(folder / "series.csv", columns_of(row_of(model, observers)));
    add_row(*series);
    snapshots.take(model);
  }

  auto save = [&] {
    series->sync();
    CheckpointWriter writer(options.fingerprint);
    model.save(writer);
    writer.put("run/rows", series->position());
    writer.put("run/rows_to_keep", rows);
    writer.put("run/time_of_row", time_of_row, "s");
    writer.put("run/sum_of_series", std::uint64_t{series->sum()});
    snapshots.save(writer);
    writer.put("run/next_row_time", next_row_time, "s");
    writer.put("run/wall_seconds", clock.wall());
    writer.put("run/cpu_seconds", clock.cpu());
    guard.save(writer);
    checkpoints.save(writer);
  };
  if (!checkpoint) save();

  Interrupt interrupt(folder / "stop", options.walltime
                                           ? std::optional(std::chrono::duration<double>(*options.walltime))
                                           : std::nullopt);
  LiveLine line(model, options);
  double last_checkpoint = clock.wall();
  LoopResult result;
  constexpr double slow_step = 1;          // s: the next one is named while it lasts
  double seconds_of_step = 2 * slow_step;  // of the last; the first builds what it needs
  while (!(model.time() >= model.time_origin() + options.end)) {
    if (const auto reason = interrupt.reason()) {
      result.interrupted = true;
      result.reason = *reason;
      break;
    }
    if (const auto ended = model.ended()) {
      result.ended = *ended;
      break;
    }
    const double time_before = model.time();
    const bool begun = !std::isinf(model.time_origin());
    {
      std::optional<Waiting> waiting;
      if (seconds_of_step > slow_step) waiting.emplace(fmt::format("step {}", model.step() + 1));
      const auto began = std::chrono::steady_clock::now();
      model.advance(team);
      seconds_of_step = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    }
    check_step(guard, model, time_before, begun);
    if (model.time() >= next_row_time) add_row(*series);
    if (snapshots.is_due(model.time())) snapshots.take(model);
    if (clock.wall() - last_checkpoint > options.checkpoint_interval) {
      save();
      last_checkpoint = clock.wall();
    }
    line.update(row);
  }
  line.finish();
  const Waiting waiting("writing the last files");
  if (!result.interrupted) {
    // A later end replaces both.
    if (time_of_row < model.time()) append(*series, row_of(model, observers));
    snapshots.take_last(model);
  }
  save();
  result.wall_seconds = clock.wall();
  result.cpu_seconds = clock.cpu();
  result.steps = model.step();
  return result;
}

}  // namespace talus::run

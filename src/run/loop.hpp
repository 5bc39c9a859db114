// SPDX-License-Identifier: Apache-2.0
/// The time loop of any model: steps, series, snapshots, checkpoints, and interruption.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/parallel.hpp"
#include "numerics/run_record.hpp"
#include "numerics/snapshot.hpp"
#include "run/any_model.hpp"

namespace talus::run {

/// Evaluates the particles; its values become columns of series.csv. The names never change.
struct Observer {
  std::vector<std::string> columns;  ///< that it asks for, positions among them
  std::function<std::vector<NamedValue>(const Pieces& pieces)> observe;
};

/// The value shown in the progress line.
struct Headline {
  std::string column = {};  ///< of series.csv; empty: none
  std::string name = {};    ///< "discharge"
  bool is_rate = false;     ///< its change in a second of simulated time is shown
};

struct LoopOptions {
  double end = 0;  ///< simulated time after the model's origin, s: the first step that reaches it is the last
  double series_interval = 0;           ///< simulated time between rows of series.csv, s; 0: a row per step
  double snapshot_interval = 0;         ///< simulated time between snapshots, s, > 0
  double checkpoint_interval = 30;      ///< wall time between checkpoints, s
  std::optional<double> walltime = {};  ///< wall time after which the run leaves with a checkpoint, s
  std::string fingerprint = {};         ///< of the case: a checkpoint of another case is refused
  bool resume = false;
  Headline headline = {};
  std::function<void(const std::string& line)> log = {};  ///< receives a line for each tenth of the run
};

struct LoopResult {
  bool interrupted = false;
  std::string reason;       ///< why, if interrupted
  std::string ended;        ///< why the run was over before its end; empty: it was not
  double wall_seconds = 0;  ///< of all sessions of this run together, without the start
  double cpu_seconds = 0;   ///< the same, of all threads
  std::uint64_t steps = 0;  ///< since the start of the run
};

/// Runs a model to the end, until nothing is left to compute, or until it is interrupted. Each snapshot is taken at the
/// end of the first step that reaches its time (no step is cut to an output time, so outputs do not change results);
/// the last step's state is the last snapshot. A checkpoint is written at the start, now and then, on interruption and
/// at the end. With `resume` it continues from the newest intact checkpoint, or starts from the beginning if there is
/// none; rows and snapshots written after that checkpoint are replaced. \param folder of the run, with a folder
/// `snapshots` \throws NumericalError, FileError; earlier checkpoints remain intact; NumericalError also if the step
/// has fallen by more than StepGuard allows \throws InputError if the checkpoint belongs to another case
LoopResult run_loop(AnyModel& model, ThreadTeam& team, const std::filesystem::path& folder, const LoopOptions& options,
                    const std::vector<Observer>& observers);

}  // namespace talus::run

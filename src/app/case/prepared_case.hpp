// SPDX-License-Identifier: Apache-2.0
/// A case that was read and found valid, joined to its model: what the commands work with.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/case/opened_run.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "io/parameter_value.hpp"
#include "numerics/run_record.hpp"
#include "ranks/ranks.hpp"
#include "run/any_model.hpp"
#include "run/loop.hpp"
#include "run/run_parameters.hpp"

namespace talus::app {

/// A change of the case that may shorten its run: the first of the alternatives that makes a valid case.
struct Shortening {
  std::vector<std::vector<std::string>> alternatives;  ///< settings, as --set takes them
  std::string text;                                    ///< what it costs
};

/// What a run will take, from counts alone.
struct Forecast {
  /// A part of the run: what settles before the gate opens, what flows after it.
  struct Phase {
    std::string name;
    double steps = 0;
    double evaluations = 0;  ///< of the costliest stage
    double most = 1;         ///< how many times as many at most, where a phase's end is not known beforehand
    double present = 1;      ///< share of the particles of the start that are there in the mean
  };
  std::vector<Phase> phases;
  double memory_bytes = 0;
  double disk_bytes = 0;
};

using Lines = std::vector<std::pair<std::string, std::string>>;

struct PreparedCase {
  std::string model;
  std::int64_t seed = 0;
  run::RunParameters run;
  ParameterList parameters;  ///< of the model and of the run, with the values they have
  std::map<std::string, std::string, std::less<>> filled_in;  ///< keys whose values follow from others, and from what
  std::string instruction_set;                                ///< that the choice resolves to on this machine
  std::vector<std::string> remarks;  ///< what was made of files and keys of the case, a line each
  std::string inputs;                ///< digest of what the files hold that the case names; empty if it names none

  /// Opens the folder of this case's run for analysis. \throws FileError
  std::function<std::unique_ptr<OpenedRun>(const std::filesystem::path& folder)> open;
  /// The initial state, ready for begin() or resume().
  std::function<std::unique_ptr<run::AnyModel>(ThreadTeam& team)> make_model;
  /// The part of the model that a process among several has. Null: it runs on one process only.
  std::function<std::unique_ptr<run::AnyModel>(ThreadTeam& team, const Ranks& ranks)> make_part;
  /// What several processes share: as many processes are the most.
  struct {
    double count = 0;
    std::string name, key;  ///< "particles"; the key that says how many
    std::string allowed;    ///< how many make several processes pay
  } shared;
  /// What the run takes on several processes, modelled: lines of a name and a text. \param step seconds on one
  std::function<Lines(ThreadTeam& team, double step, int ranks)> on_ranks;
  std::vector<run::Observer> observers;
  run::Headline headline;  ///< what the line of progress shows
  /// Dimensionless groups and scales, for `check` and the log.
  std::vector<NamedValue> groups;
  /// Whether the case keeps to what its laws assume: the lines of the validity report that are known before the run.
  std::vector<RegimeLine> regime;
  /// Where the particles lie at the start, for `check`: lines of a name and a text. None: there is nothing to say.
  std::function<Lines()> start;
  /// Draws walls and particles at the start as a PNG. None: of no such model.
  std::function<void(const std::filesystem::path& path)> draw_start;
  Forecast forecast;
  /// Seconds that an evaluation takes with as many processors as threads to themselves, measured on a small sample.
  std::function<double(ThreadTeam& team)> measure_evaluation;
  /// What would shorten the run. Null: nothing but what every run has.
  std::function<std::vector<Shortening>()> shortenings;
  /// What to change where memory_bytes is more than there is. \param available bytes
  std::function<Problem(double available)> too_large;
};

}  // namespace talus::app

// SPDX-License-Identifier: Apache-2.0
/// A case that was read and found valid, joined to its model: what the commands work with.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/parallel.hpp"
#include "io/case_file.hpp"
#include "io/parameter_value.hpp"
#include "numerics/named_value.hpp"
#include "run/any_model.hpp"
#include "run/loop.hpp"
#include "run/run_parameters.hpp"

namespace talus::app {

/// What a run will take, from counts alone.
struct Forecast {
  /// A part of the run: what settles before the gate opens, what flows after it.
  struct Phase {
    std::string name;
    double steps = 0;
    double evaluations = 0;  ///< of the costliest stage
  };
  std::vector<Phase> phases;
  double memory_bytes = 0;
  double disk_bytes = 0;
};

struct PreparedCase {
  std::string model;
  std::int64_t seed = 0;
  run::RunParameters run;
  ParameterList parameters;     ///< of the model and of the run, with the values they have
  ParameterList defaults;       ///< the same with the values they have where nothing is given
  std::string instruction_set;  ///< that the wish resolves to here
  std::string inputs;           ///< digest of what the files hold that the case names; empty if it names none

  /// The initial state, ready for begin() or resume().
  std::function<std::unique_ptr<run::AnyModel>()> make_model;
  std::vector<run::Observer> observers;
  run::Headline headline;  ///< what the line of progress shows
  /// Dimensionless groups and scales, for `check` and the log.
  std::vector<NamedValue> groups;
  /// Whether the case keeps to what its laws assume: the lines of the regime card that are known before the run.
  std::vector<RegimeLine> regime;
  Forecast forecast;
  /// Seconds that an evaluation takes, measured now on a small sample.
  std::function<double(ThreadTeam& team)> measure_evaluation;
  /// What to change where memory_bytes is more than there is. \param available bytes
  std::function<Problem(double available)> too_large;
  /// Analyses a run's folder: writes its tables and returns the quantities of its summary.
  std::function<std::vector<NamedValue>(const std::filesystem::path& folder)> analyze;
  /// Draws a run's pictures and returns their paths, the one to look at first first.
  std::function<std::vector<std::filesystem::path>(const std::filesystem::path& folder)> draw;
};

/// Reads a case: the model it names, then all parameters of model and run.
/// \throws InputError with every problem
PreparedCase prepare_case(const CaseFile& file);

/// \throws InputError if the run needs more memory than there is now, on this machine, with the line of the case that
/// asks for it
void check_memory(const PreparedCase& prepared, const CaseFile& file);

/// A problem if there is no such model.
std::vector<Problem> check_model(const std::string& model);

/// The parameters of a model and of a run of it, with their defaults: for the schema and the reference page.
ParameterList parameters_of(const std::string& model);

/// Analyses the run in a folder and draws its pictures once more, as PreparedCase does at the end of a run. \param
/// resolved the manifest's case \throws FileError, InputError
std::vector<NamedValue> analyze_run(const CaseFile& resolved, const std::filesystem::path& folder);

/// The models there are.
inline constexpr std::array<std::string_view, 3> model_names{"cloud", "continuum", "air"};

}  // namespace talus::app

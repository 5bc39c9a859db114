// SPDX-License-Identifier: Apache-2.0
/// The models there are, in one table: what the commands ask of a model. A model is added by a row.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "analysis/measure.hpp"
#include "app/case/prepared_case.hpp"
#include "io/case_file.hpp"
#include "io/parameter_value.hpp"
#include "numerics/run_record.hpp"

namespace talus::app {

struct ModelEntry {
  std::string_view name;  ///< of the key `model`
  /// Reads and checks a case. \throws InputError with every problem
  PreparedCase (*prepare)(const CaseFile& file);
  /// Opens the folder of a run for analysis. \param resolved the manifest's case \param snapshot_memory
  /// OpenedRun::one_by_one or many_times \throws FileError, InputError
  std::unique_ptr<OpenedRun> (*open)(const CaseFile& resolved, const std::filesystem::path& folder,
                                     std::size_t snapshot_memory);
  /// All parameters of a model and of a run of it, with their defaults: for the schema and the reference page.
  ParameterList (*parameters)();
  /// What a summary of its runs can list, where the case has it. Null: nothing that is known before a run.
  std::vector<MeasureText> (*measures)();
};

std::span<const ModelEntry> models();

/// The model that a case names. \throws InputError if it names none, or one that there is not, with the nearest
const ModelEntry& model_of(const CaseFile& file);

/// The run in a folder, as its manifest has it. \throws FileError, InputError
std::unique_ptr<OpenedRun> open_run(const std::filesystem::path& folder,
                                    std::size_t snapshot_memory = OpenedRun::one_by_one);

/// Reads a case: the model it names, then all parameters of model and run.
/// \throws InputError with every problem; where there is no such model, with that alone
PreparedCase prepare_case(const CaseFile& file);

/// \throws InputError if the run needs more memory than there is now, on this machine, with the line of the case that
/// asks for it
void check_memory(const PreparedCase& prepared, const CaseFile& file);

/// What `check` and the log of a run warn of beforehand: regime, and a disk with less room than the run's files take.
/// \param folder of the results, which need not be there yet
std::vector<Warning> warnings_before_run(const PreparedCase& prepared, const std::filesystem::path& folder);

// The symbols and words in the texts of measures (analysis/measure.hpp), as Markdown.

inline constexpr const char* symbols_of_hopper_measures =
    "T is `analysis.averaging_time`: 0.3 (D/g)^½ unless the case gives it, D in that the narrower side of\n"
    "the outlet, without one the height of the bed. t is the time from the opening of the gate, h the\n"
    "spacing of the particles at the start, M the mass of all particles, D and ρ_p diameter and density\n"
    "of the grains; x across, z up from the floor. The *hopper* is what is above the outlet (a slit in a\n"
    "plate, the gap of a wedge), the *bin* what is below it; without an outlet the box is a bin. Q is the\n"
    "mass that passes the outlet's plane per time, of particles smoothed along z by the kernel. *While it\n"
    "flows*: from when a tenth of the mass that passes the outlet in total has passed until half of it\n"
    "has, or half-way between the two; where nothing passes, half of the run. Packing is the kernel sum,\n"
    "including images behind the walls.";

inline constexpr const char* symbols_of_avalanche_measures =
    "a is the mean radius of the case, v_s the speed of one grain alone (Stokes); times are in a/v_s. x\n"
    "points down the slope, y to its left, z away from it.";

}  // namespace talus::app

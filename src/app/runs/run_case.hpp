// SPDX-License-Identifier: Apache-2.0
/// From a prepared case to a run's folder: loop, analysis, pictures, summary, validity report.
#pragma once

#include <filesystem>
#include <optional>

#include "app/case/prepared_case.hpp"
#include "base/error.hpp"
#include "io/case_file.hpp"
#include "io/run_folder.hpp"
#include "io/run_json.hpp"

namespace talus::app {

struct RunRequest {
  std::filesystem::path folder;
  Existing existing = Existing::refuse;
  int threads = 1;
  std::optional<double> walltime;  ///< s
  bool dry_run = false;
};

/// What makes a case the same case: all keys but those that do not change a run's results, what the files hold that it
/// names, and the instruction set that its choice resolves to. A run may be resumed with a later end.
std::string case_fingerprint(const PreparedCase& prepared);

/// \throws InputError for a case that so many processes cannot share
void check_ranks(const PreparedCase& prepared, const CaseFile& file, int ranks);

/// The case of a run that is to go on in the folder, to an end that may be another: what it leaves out that follows
/// from run.end, output.snapshots and what depends on all that comes in, keeps the values that it has there. \throws
/// InputError; FileError if there is a manifest that cannot be read
PreparedCase prepare_to_resume(CaseFile file, const std::filesystem::path& folder);

/// The end of the run that a manifest describes, s. \throws FileError if it says none
double end_of(const Manifest& manifest);

/// Runs a case and says on stdout where the results are.
/// \returns done or interrupted
/// \throws InputError if the folder may not be used, or if it is to be resumed with another case; nothing has been
/// written then
/// \throws NumericalError, FileError; also in log.txt and summary.json, as far as these can be written
ExitStatus run_case(const PreparedCase& prepared, const RunRequest& request);

/// Before a run goes on: says on stderr which snapshots are missing; they are left out from now on. A run without a
/// checkpoint, which starts again, is left as it is. Changes nothing.
/// \throws FileError if the series or a snapshot is not what was written, or if no checkpoint is whole
void check_resumable_files(const RunFolder& folder);

/// Before a run is measured or shown again. Snapshots may be missing.
/// \throws FileError if the series or a snapshot is not what was written, or if no checkpoint is whole
void check_files_of_run(const RunFolder& folder);

/// `talus check FOLDER`: compares the files of each run there, an ensemble's members too, with the checksums in its
/// checkpoint, and says what it found.
/// \returns done, or files if one has changed or is missing, or a checkpoint is damaged
/// \throws InputError if there is no run
ExitStatus check_folder(const std::filesystem::path& path);

}  // namespace talus::app

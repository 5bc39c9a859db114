// SPDX-License-Identifier: Apache-2.0
/// From a prepared case to a run's folder: loop, analysis, pictures, summary, card of regimes.
#pragma once

#include <filesystem>
#include <optional>

#include "app/prepared_case.hpp"
#include "base/error.hpp"
#include "io/run_folder.hpp"

namespace talus::app {

struct RunRequest {
  std::filesystem::path folder;
  Existing existing = Existing::refuse;
  int threads = 1;
  std::optional<double> walltime;  ///< s
  bool dry_run = false;
};

/// What makes a case the same case: all keys but those that do not change a run's bits. A run may be resumed with a
/// later end.
std::string case_fingerprint(const PreparedCase& prepared);

/// Runs a case and says on stdout where the results are.
/// \returns done or interrupted
/// \throws InputError, NumericalError, FileError; a numerical failure is also in log.txt and summary.json
ExitStatus run_case(const PreparedCase& prepared, const RunRequest& request);

}  // namespace talus::app

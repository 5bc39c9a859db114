// SPDX-License-Identifier: Apache-2.0
/// Whether the files of a run are what the run wrote.
#pragma once

#include <filesystem>

#include "base/error.hpp"
#include "io/run_folder.hpp"

namespace talus::app {

/// Before a run goes on: says on stderr which snapshots are missing; they are left out from now on. A run without a
/// checkpoint, which starts again, is left as it is. Changes nothing.
/// \throws FileError if the series or a snapshot is not what was written, or if no checkpoint is whole
void check_resumable_files(const RunFolder& folder);

/// `talus check FOLDER`: compares the files of each run there, an ensemble's members too, with the checksums in its
/// checkpoint, and says what it found.
/// \returns done, or files if one has changed or is missing, or a checkpoint is damaged
/// \throws InputError if there is no run
ExitStatus check_folder(const std::filesystem::path& path);

}  // namespace talus::app

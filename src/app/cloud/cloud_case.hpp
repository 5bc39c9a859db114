// SPDX-License-Identifier: Apache-2.0
/// The cloud model for the commands.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/case/prepared_case.hpp"
#include "app/cloud/cloud_analysis.hpp"
#include "io/case_file.hpp"

namespace talus::app {

/// \throws InputError with every problem of the case, of the file of points it names, and of their combination
PreparedCase prepare_cloud(const CaseFile& file);

/// As ModelEntry (models.hpp) has it. \param resolved the manifest's case, whose points need not be there any more
std::unique_ptr<OpenedRun> open_cloud_run(const CaseFile& resolved, const std::filesystem::path& folder,
                                          std::size_t snapshot_memory);

/// What a study needs to know of a run's case.
struct CloudStudy {
  std::string title;
  CloudFrame frame;
};
/// \param file a resolved case, as manifests hold it; \throws InputError
CloudStudy study_of(const CaseFile& file);

/// Draws snapshots into pictures/, grains of an avalanche coloured by their speed; returns the paths. \throws FileError
std::vector<std::filesystem::path> draw_cloud(const std::filesystem::path& run_folder, const CloudFrame& frame,
                                              const std::string& title);

}  // namespace talus::app

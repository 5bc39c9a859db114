// SPDX-License-Identifier: Apache-2.0
/// The cloud model for the commands.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/case/prepared_case.hpp"
#include "app/case/read_runs.hpp"
#include "app/case/scene.hpp"
#include "app/case/studied_run.hpp"
#include "app/cloud/cloud_analysis.hpp"
#include "io/case_file.hpp"

namespace talus::app {

/// \throws InputError with every problem of the case, of the file of points it names, and of their combination
PreparedCase prepare_cloud(const CaseFile& file);

/// As ModelEntry (models.hpp) has them. \param resolved the manifest's case, whose points need not be there any more
std::vector<NamedValue> analyse_cloud_run(const CaseFile& resolved, const std::filesystem::path& folder,
                                          ReadRuns& runs);
StudiedRun study_cloud_run(const CaseFile& resolved, const std::filesystem::path& folder, ReadRuns& runs);
/// The slope, if there is one.
Scene scene_of_cloud(const CaseFile& resolved);
std::vector<std::filesystem::path> draw_cloud_run(const CaseFile& resolved, const std::filesystem::path& folder,
                                                  ReadRuns& runs);

/// What a study needs to know of a run's case.
struct CloudStudy {
  std::string title;
  CloudFrame frame;
};
/// \param file a resolved case, as manifests hold it; \throws InputError
CloudStudy study_of(const CaseFile& file);

/// Draws snapshots into pictures/, of an avalanche with its heads marked; returns the paths.
/// \throws FileError
std::vector<std::filesystem::path> draw_cloud(const std::filesystem::path& run_folder, const CloudFrame& frame,
                                              const std::string& title);

}  // namespace talus::app

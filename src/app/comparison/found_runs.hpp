// SPDX-License-Identifier: Apache-2.0
/// The finished runs below a folder, whoever made them (`talus run`, `ensemble` or `reproduce`), sorted to the cases
/// and variants of a reference.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/comparison/reference.hpp"
#include "io/case_file.hpp"

namespace talus::app {

/// The runs of one variant of one case, in the order of their seeds.
struct FoundEnsemble {
  std::string case_name, variant;
  std::vector<std::filesystem::path> folders;
  std::vector<CaseFile> files;  ///< the resolved cases, in the same order
};

/// Sorts every finished run to the case whose `where` it satisfies, and there to the variant whose settings it has; of
/// several, to the one with the most entries. Runs of no case are passed over. \throws FileError
std::vector<FoundEnsemble> ensembles_of(const std::filesystem::path& folder, const Reference& reference);

/// The same. \throws FileError; \throws InputError if there is no run of any of the cases
std::vector<FoundEnsemble> find_ensembles(const std::filesystem::path& folder, const Reference& reference);

}  // namespace talus::app

// SPDX-License-Identifier: Apache-2.0
/// The reference of a study: what a paper prints, written down in validation/*/reference.toml with estimator, window
/// and criterion before anything is compared with it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "analysis/comparison.hpp"

namespace talus::app {

/// Keys of a case with their values as TOML.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// One of the paper's cases, and what each of its variants changes in it. The file may call the variants radii.
struct ReferenceCase {
  std::string name;
  std::string file = {};  ///< in cases/
  Settings where = {};    ///< what a run of this case has
  struct Variant {
    std::string label;       ///< "2.5 mm"
    Settings settings = {};  ///< what it changes in the file
    Settings told_by = {};   ///< those of them by which a run is known to be of this variant
  };
  std::vector<Variant> variants = {};
};

/// What `reproduce --quick` runs in place of everything.
struct QuickStudy {
  std::vector<std::string> variants;  ///< labels; empty: there is no quick study
  int members = 1;
  Settings settings;  ///< on top of the variants'
};

struct Reference {
  std::string path;
  std::string study = {}, title = {}, source = {};
  int members = 0;
  QuickStudy quick = {};
  std::vector<ReferenceCase> cases = {};
  std::vector<ComparisonRow> rows = {};
  std::filesystem::path measures = {};  ///< folder of the study's measures.py, empty if it has none

  /// \returns null if there is none
  const ReferenceCase* find_case(const std::string& name) const;
};

/// Rows of quantities that the program does not know are left to measures.py beside the file, or in the study's folder
/// in validation/, if there is one. \throws FileError if it cannot be read; \throws InputError with every problem
Reference read_reference(const std::string& path);

}  // namespace talus::app

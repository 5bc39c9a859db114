// SPDX-License-Identifier: Apache-2.0
/// The reference of a study: what a paper prints, written down in validation/*/reference.toml with estimator, window
/// and criterion before anything is compared with it.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "analysis/comparison.hpp"

namespace talus::app {

/// One of the paper's cases, and what each of its variants changes in it; where the radius of the grains is what varies
/// the file calls them radii.
struct ReferenceCase {
  std::string name;
  std::string file;                                        ///< in cases/
  std::vector<std::pair<std::string, std::string>> where;  ///< keys and values that a run of this case has
  struct Radius {
    std::string label;                  ///< "2.5 mm"
    std::vector<std::string> settings;  ///< as --set
  };
  std::vector<Radius> radii;
};

struct Reference {
  std::string path;
  std::string study, title, source;
  int members = 0;
  std::vector<ReferenceCase> cases;
  std::vector<ComparisonRow> rows;

  /// \returns null if there is none
  const ReferenceCase* find_case(const std::string& name) const;
};

/// \throws FileError if it cannot be read; \throws InputError with every problem
Reference read_reference(const std::string& path);

}  // namespace talus::app

// SPDX-License-Identifier: Apache-2.0
/// The runs of a reference, read, and what a study asks of them: the numbers of its rows, its figures.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/comparison/found_runs.hpp"
#include "app/comparison/reference.hpp"

namespace talus::app {

struct FigureOfStudy {
  std::filesystem::path path;
  std::string title;
  std::string
      caption;  ///< one line: each panel by its letter, how many members it is made of, what is left out and why
};

class StudiedRuns {
 public:
  virtual ~StudiedRuns() = default;

  /// A row's numbers: one a variant of the row, or one alone if it is made from several; nothing where the runs that it
  /// needs are not there.
  /// \throws std::logic_error if the row asks for what no such runs have
  virtual std::vector<std::optional<double>> values(const ComparisonRow& row) const = 0;

  /// Draws what the runs that are there allow, in the manner of the paper's figures.
  /// \param folder made if needed; \throws FileError
  virtual std::vector<FigureOfStudy> draw(const std::filesystem::path& folder) const = 0;
};

/// Reads the runs of a reference below a folder. \throws FileError; \throws InputError if there are none
std::unique_ptr<StudiedRuns> read_studied_runs(const std::filesystem::path& folder, const Reference& reference);

}  // namespace talus::app

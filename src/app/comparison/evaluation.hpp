// SPDX-License-Identifier: Apache-2.0
/// Evaluates a reference's rows on the runs below a folder, whoever made them: `talus run`, `ensemble` or `reproduce`.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/avalanche.hpp"
#include "app/comparison/reference.hpp"

namespace talus::app {

/// The runs of one case at one radius.
struct StudiedEnsemble {
  std::string case_name;
  std::string radius;
  double contact_weight_ratio = 0;
  std::vector<std::filesystem::path> folders;  ///< in the order of the seeds
  std::vector<AvalancheRun> runs;              ///< the same order
};

/// Finds every finished run below `folder` and sorts it to the case whose `where` it satisfies (of several, to the one
/// with the most entries) and to the radius of its particles.radius. Runs of no case are passed over.
/// \throws FileError; \throws InputError if there is no run of any of the cases
std::vector<StudiedEnsemble> find_ensembles(const std::filesystem::path& folder, const Reference& reference);

struct EvaluatedRow {
  const ComparisonRow* row = nullptr;
  std::vector<std::optional<double>> values;  ///< one a radius of the row; one alone for From::radii
  Verdict verdict = Verdict::not_evaluated;
};

/// \throws InputError if a row asks for what no such runs have
std::vector<EvaluatedRow> evaluate(const Reference& reference, const std::vector<StudiedEnsemble>& ensembles);

/// As lines for a terminal.
std::string to_text(const std::vector<EvaluatedRow>& rows);
/// As a Markdown table.
std::string to_markdown(const std::vector<EvaluatedRow>& rows);
/// As JSON: [{"id", "number", "quantity", "case", "printed", "criterion", "values": {radius: value}, "verdict", ...}].
std::string to_json(const Reference& reference, const std::vector<EvaluatedRow>& rows);

/// Numbers of the rows with a verdict.
std::size_t count(const std::vector<EvaluatedRow>& rows, Verdict verdict);

}  // namespace talus::app

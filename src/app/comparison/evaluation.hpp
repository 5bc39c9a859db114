// SPDX-License-Identifier: Apache-2.0
/// A reference's rows evaluated and judged, and the table of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/comparison/found_runs.hpp"
#include "app/comparison/reference.hpp"
#include "app/comparison/studied_runs.hpp"

namespace talus::app {

struct EvaluatedRow {
  const ComparisonRow* row = nullptr;
  std::vector<std::optional<double>> values;  ///< one per variant of the row; one alone for From::variants
  Verdict verdict = Verdict::not_evaluated;
  std::string missing = {};  ///< why there is no value: a measure failed, with Faults::note, or could not be evaluated
};

/// What to do with a row whose measure fails: one that no such runs have, or one that a short run has no data for.
enum class Faults { refuse, note };

/// Rows of the program's quantities, and those of the study's measures.py, which Python evaluates (study_measures.hpp).
/// \param found the runs' folders \param jobs processes of Python at a time
/// \throws InputError if a measure fails and faults are refused, or if there is no such quantity
std::vector<EvaluatedRow> evaluate(const Reference& reference, const std::vector<FoundEnsemble>& found,
                                   const StudiedRuns& runs, Faults faults = Faults::refuse, int jobs = 1);

/// As lines for a terminal; last why rows have no value.
std::string to_text(const std::vector<EvaluatedRow>& rows);
/// As JSON: {"study", "title", "source", "rows": [{"id", "number", "quantity", "case", "variants", "statistic",
/// "printed", "source", "criterion", "unit", "values": [...], "verdicts": [...], "verdict", "missing"}], "runs":
/// [{"case", "variant", "folders"}]}, values and the verdict on each in the order of the row's variants, the folders of
/// the members relative to `folder`. A value that was evaluated and has no meaning is null with the verdict "not met".
/// Of a row without any value although its runs are there, "missing" says why; else it is empty.
std::string to_json(const Reference& reference, const std::vector<EvaluatedRow>& rows,
                    const std::vector<FoundEnsemble>& found, const std::filesystem::path& folder);

/// Numbers of the rows with a verdict.
std::size_t count(const std::vector<EvaluatedRow>& rows, Verdict verdict);
/// "39 met, 6 not met, 11 reported, 0 not evaluated".
std::string counts_text(const std::vector<EvaluatedRow>& rows);

}  // namespace talus::app

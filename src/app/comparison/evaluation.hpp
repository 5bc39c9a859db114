// SPDX-License-Identifier: Apache-2.0
/// A reference's rows evaluated and judged, and the table of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/comparison/reference.hpp"
#include "app/comparison/studied_runs.hpp"

namespace talus::app {

struct EvaluatedRow {
  const ComparisonRow* row = nullptr;
  std::vector<std::optional<double>> values;  ///< one a variant of the row; one alone for From::variants
  Verdict verdict = Verdict::not_evaluated;
};

/// \throws InputError if a row asks for what no such runs have
std::vector<EvaluatedRow> evaluate(const Reference& reference, const StudiedRuns& runs);

/// As lines for a terminal.
std::string to_text(const std::vector<EvaluatedRow>& rows);
/// As a Markdown table: a line a row, or, if all rows are of the same many variants, a line a variant and a column a
/// row.
std::string to_markdown(const std::vector<EvaluatedRow>& rows);
/// As JSON: [{"id", "number", "quantity", "case", "printed", "criterion", "values": [...], "verdict", ...}], the values
/// in the order of the row's variants.
std::string to_json(const Reference& reference, const std::vector<EvaluatedRow>& rows);

/// Numbers of the rows with a verdict.
std::size_t count(const std::vector<EvaluatedRow>& rows, Verdict verdict);

}  // namespace talus::app

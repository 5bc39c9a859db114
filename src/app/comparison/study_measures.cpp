// SPDX-License-Identifier: Apache-2.0
#include "app/comparison/study_measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "analysis/measure.hpp"
#include "app/comparison/python.hpp"
#include "base/error.hpp"
#include "base/text.hpp"

namespace talus::app {

namespace {

using Json = nlohmann::json;
using Values = std::vector<std::optional<double>>;

constexpr const char* needed = "needs python3-numpy, python3-h5py, python3-talus";

/// How the numbers of a row are asked for: "each" member's, one of the "curves" of the members or of their "values", or
/// one of all variants "together".
std::string kind_of(const ComparisonRow& row) {
  switch (row.from) {
    case From::curves:
      return "curves";
    case From::values:
      return "values";
    case From::variants:
      if (!is_of_two(row.statistic)) return "together";
      break;
    case From::each:
    case From::parameters:
      break;
  }
  return "each";
}

Json time_of(double time) {
  return std::isinf(time) ? Json("inf") : Json(time);
}

Json question_of(const ComparisonRow& row, const std::vector<FoundEnsemble>& found, const std::vector<bool>& there) {
  Json groups = Json::array();
  for (std::size_t n = 0; n < row.variants.size(); ++n) {
    Json group = Json::array();
    for (const FoundEnsemble& e : found)
      if (there[n] && e.case_name == row.case_name && e.variant == row.variants[n])
        for (const std::filesystem::path& folder : e.folders) group.push_back(folder.string());
    if (row.from == From::parameters && group.size() > 1) group.erase(group.begin() + 1, group.end());
    groups.push_back(std::move(group));
  }
  return {{"quantity", row.quantity},
          {"unit", row.statistic == Statistic::ratio ? Json() : Json(row.unit)},
          {"of", kind_of(row)},
          {"window",
           {{"at", row.window.at ? time_of(*row.window.at) : Json()},
            {"from", row.window.from},
            {"to", time_of(row.window.to)}}},
          {"place", row.place},
          {"groups", std::move(groups)}};
}

/// A number that is not finite is a text.
std::optional<double> number_of(const Json& value) {
  if (value.is_null()) return std::nullopt;
  return value.is_string() ? std::strtod(value.get<std::string>().c_str(), nullptr) : value.get<double>();
}

void take_answer(const Json& answer, EvaluatedRow& evaluated) {
  RowNumbers numbers{.of_variants = {}, .may_be_missing = answer["may_be_missing"]};
  for (const Json& group : answer["values"]) {
    numbers.of_variants.emplace_back();
    for (const Json& value : group) numbers.of_variants.back().push_back(number_of(value));
  }
  evaluated.values = row_values(*evaluated.row, numbers);
  for (const Json& reason : answer["missing"])
    if (evaluated.missing.empty()) evaluated.missing = reason;
}

/// \throws InputError
void check_faults(const Reference& reference, const std::vector<const ComparisonRow*>& asked, const Json& answer) {
  std::vector<std::string> known = answer["names"];
  for (const MeasureText& measure : all_measures()) known.emplace_back(measure.name);
  const std::vector<std::string_view> names(known.begin(), known.end());
  std::vector<Problem> problems;
  for (const Json& fault : answer["faults"]) {
    const ComparisonRow& row = *asked.at(fault["question"].get<std::size_t>());
    Problem problem{.where = reference.path, .line = row.line, .key = fault["key"]};
    if (problem.key == "quantity") {
      problem.what = "there is no quantity \"" + row.quantity + "\"";
      problem.allowed = "a name of docs/quantities.md or " + (reference.measures / "measures.py").string();
      problem.nearest = nearest(row.quantity, names);
    } else {
      problem.what = fault["what"], problem.allowed = fault["allowed"];
    }
    problems.push_back(std::move(problem));
  }
  if (!problems.empty()) throw InputError(problems);
}

}  // namespace

void evaluate_by_study(const Reference& reference, const std::vector<FoundEnsemble>& found, const StudiedRuns& runs,
                       Faults faults, int jobs, std::vector<EvaluatedRow>& rows) {
  std::vector<EvaluatedRow*> open;
  std::vector<const ComparisonRow*> asked;
  Json questions = Json::array();
  for (EvaluatedRow& row : rows) {
    if (!row.row->of_study) continue;
    row.values.assign(row.row->from == From::variants ? 1 : row.row->variants.size(), std::nullopt);
    Json question = question_of(*row.row, found, runs.are_there(*row.row));
    const Json& groups = question["groups"];
    if (faults == Faults::note && std::all_of(groups.begin(), groups.end(), [](const Json& g) { return g.empty(); }))
      continue;
    open.push_back(&row);
    asked.push_back(row.row);
    questions.push_back(std::move(question));
  }
  if (open.empty()) return;
  const std::optional<std::filesystem::path> python = find_python({"numpy", "h5py"});
  if (!python) {
    for (EvaluatedRow* row : open) row->missing = needed;
    return;
  }
  const Json answer = Json::parse(
      said_by_package(*python, "talus.measures", {reference.measures.string(), "--jobs", fmt::format("{}", jobs)},
                      Json{{"questions", questions}}.dump(), reference.measures / "measures.py"));
  check_faults(reference, asked, answer);
  for (std::size_t n = 0; n < open.size(); ++n) take_answer(answer["answers"][n], *open[n]);
}

}  // namespace talus::app

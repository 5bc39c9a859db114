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
#include "base/nearest.hpp"

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
      if (row.statistic != Statistic::ratio && row.statistic != Statistic::difference) return "together";
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
  const std::string kind = kind_of(row);
  const bool all_there = std::all_of(there.begin(), there.end(), [](bool is) { return is; });
  Json groups = Json::array();
  for (std::size_t n = 0; n < row.variants.size(); ++n) {
    Json group = Json::array();
    const bool wanted = row.from == From::variants ? all_there : there[n];
    for (const FoundEnsemble& e : found)
      if (wanted && e.case_name == row.case_name && e.variant == row.variants[n])
        for (const std::filesystem::path& folder : e.folders) group.push_back(folder.string());
    if (row.from == From::parameters && group.size() > 1) group.erase(group.begin() + 1, group.end());
    if (row.from == From::each && row.statistic == Statistic::standard_deviation && group.size() < 2) group.clear();
    groups.push_back(std::move(group));
  }
  if (kind == "together" && !all_there) groups = Json::array();
  return {{"quantity", row.quantity},
          {"unit", row.statistic == Statistic::ratio ? Json() : Json(row.unit)},
          {"of", kind},
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

/// The number of a group; nothing where there are none, or one could not be evaluated.
std::optional<double> number_of_group(const ComparisonRow& row, Statistic statistic, const Json& values,
                                      bool may_be_missing) {
  std::vector<double> numbers;
  for (const Json& value : values) {
    const std::optional<double> number = number_of(value);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  if (numbers.empty()) return std::nullopt;
  if (kind_of(row) != "each" || row.from == From::parameters) return numbers.front();
  return evaluate_members(statistic, std::move(numbers), may_be_missing);
}

void take_answer(const Json& answer, EvaluatedRow& evaluated) {
  const ComparisonRow& row = *evaluated.row;
  const bool of_two = row.statistic == Statistic::ratio || row.statistic == Statistic::difference;
  Values values;
  for (const Json& group : answer["values"])
    values.push_back(number_of_group(row, of_two ? Statistic::mean : row.statistic, group, answer["may_be_missing"]));
  for (const Json& reason : answer["missing"])
    if (evaluated.missing.empty()) evaluated.missing = reason;
  if (row.from == From::variants && of_two) {
    std::vector<double> numbers;
    for (const std::optional<double>& value : values)
      if (value) numbers.push_back(*value);
    values = {numbers.size() == 2 ? std::optional(evaluate(row.statistic, numbers)) : std::nullopt};
  }
  evaluated.values = std::move(values);
  if (row.from == From::variants) evaluated.values.resize(1);
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

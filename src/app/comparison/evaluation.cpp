// SPDX-License-Identifier: Apache-2.0
#include "app/comparison/evaluation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>

#include "app/comparison/study_measures.hpp"
#include "base/error.hpp"

namespace talus::app {

namespace {

std::string number(double value) {
  if (std::isnan(value)) return "none";
  return std::abs(value) >= 1000 ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

std::string values_text(const EvaluatedRow& row) {
  std::string text;
  for (const auto& value : row.values) text += (text.empty() ? "" : ", ") + (value ? number(*value) : std::string("-"));
  return text;
}

std::string variants_text(const ComparisonRow& row) {
  std::string text;
  for (const std::string& variant : row.variants) text += (text.empty() ? "" : ", ") + variant;
  return text;
}

/// How the number of the members or variants is made where it is not plain; empty if it is.
std::string statistic_text(const ComparisonRow& row) {
  switch (row.statistic) {
    case Statistic::standard_deviation:
      return "standard deviation";
    case Statistic::ratio:
      return "ratio";
    case Statistic::difference:
      return "difference";
    case Statistic::mean:
    case Statistic::median:
      break;
  }
  return "";
}

bool has_value(const EvaluatedRow& row) {
  return std::any_of(row.values.begin(), row.values.end(), [](const auto& value) { return value.has_value(); });
}

/// Why a row has no value; empty if it has one, or if the runs that it is about are not there.
std::string missing_text(const EvaluatedRow& row, const std::vector<FoundEnsemble>& found) {
  if (has_value(row) || !row.missing.empty()) return row.missing;
  const bool runs_are_there =
      std::all_of(row.row->variants.begin(), row.row->variants.end(), [&](const std::string& variant) {
        return std::any_of(found.begin(), found.end(), [&](const FoundEnsemble& ensemble) {
          return ensemble.case_name == row.row->case_name && ensemble.variant == variant;
        });
      });
  return runs_are_there ? "the run ends before its time window does, or there are too few members" : "";
}

}  // namespace

std::vector<EvaluatedRow> evaluate(const Reference& reference, const std::vector<FoundEnsemble>& found,
                                   const StudiedRuns& runs, Faults faults, int jobs) {
  std::vector<EvaluatedRow> rows;
  for (const ComparisonRow& row : reference.rows) {
    EvaluatedRow evaluated{.row = &row, .values = {}, .verdict = Verdict::reported};
    if (!row.of_study) try {
        evaluated.values = row_values(row, runs.numbers(row));
      } catch (const std::logic_error& error) {
        if (faults == Faults::refuse)
          throw InputError({{.where = reference.path, .key = "row " + row.id, .what = error.what()}});
        evaluated.missing = error.what();
        evaluated.values.assign(row.from == From::variants ? 1 : row.variants.size(), std::nullopt);
      }
    rows.push_back(std::move(evaluated));
  }
  evaluate_by_study(reference, found, runs, faults, jobs, rows);
  for (EvaluatedRow& row : rows)
    if (row.row->criterion.kind != Criterion::Kind::reported)
      row.verdict = judge(row.row->criterion, std::span<const std::optional<double>>(row.values));
  return rows;
}

std::string to_text(const std::vector<EvaluatedRow>& rows) {
  std::string text = fmt::format("{:>3}  {:38} {:14} {:24} {:14} {}\n", "row", "quantity", "printed/met if", "computed",
                                 "verdict", "case");
  for (const EvaluatedRow& e : rows) {
    const std::string statistic = statistic_text(*e.row);
    text += fmt::format("{:>3}  {:38} {:14} {:24} {:14} {}\n", e.row->number,
                        e.row->quantity + (statistic.empty() ? "" : ", " + statistic), to_string(e.row->criterion),
                        values_text(e), to_string(e.verdict), e.row->case_name + " (" + variants_text(*e.row) + ")");
  }
  std::map<std::string, std::size_t> missing;
  for (const EvaluatedRow& e : rows)
    if (!e.missing.empty()) ++missing[e.missing];
  for (const auto& [reason, count] : missing)
    text += fmt::format("{} row{} not evaluated: {}\n", count, count == 1 ? "" : "s", reason);
  return text;
}

std::string to_json(const Reference& reference, const std::vector<EvaluatedRow>& rows,
                    const std::vector<FoundEnsemble>& found, const std::filesystem::path& folder) {
  nlohmann::ordered_json json;
  json["study"] = reference.study;
  json["title"] = reference.title;
  json["source"] = reference.source;
  for (const EvaluatedRow& e : rows) {
    nlohmann::ordered_json row;
    row["id"] = e.row->id;
    row["number"] = e.row->number;
    row["quantity"] = e.row->quantity;
    row["case"] = e.row->case_name;
    row["variants"] = e.row->variants;
    row["statistic"] = statistic_text(*e.row);
    row["printed"] = e.row->printed;
    row["source"] = e.row->source;
    row["criterion"] = to_string(e.row->criterion);
    row["unit"] = e.row->unit;
    row["values"] = row["verdicts"] = nlohmann::ordered_json::array();
    const bool judged = e.row->criterion.kind != Criterion::Kind::reported;
    for (const auto& value : e.values) {
      row["values"].push_back(value && std::isfinite(*value) ? nlohmann::ordered_json(*value) : nullptr);
      row["verdicts"].push_back(to_string(!value   ? Verdict::not_evaluated
                                          : judged ? judge(e.row->criterion, value)
                                                   : Verdict::reported));
    }
    row["verdict"] = to_string(e.verdict);
    row["missing"] = missing_text(e, found);
    json["rows"].push_back(std::move(row));
  }
  for (const FoundEnsemble& ensemble : found) {
    nlohmann::ordered_json runs{{"case", ensemble.case_name}, {"variant", ensemble.variant}};
    for (const std::filesystem::path& run : ensemble.folders)
      runs["folders"].push_back(run.lexically_proximate(folder).string());
    json["runs"].push_back(std::move(runs));
  }
  return json.dump(2) + "\n";
}

std::size_t count(const std::vector<EvaluatedRow>& rows, Verdict verdict) {
  return static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [&](const EvaluatedRow& row) { return row.verdict == verdict; }));
}

std::string counts_text(const std::vector<EvaluatedRow>& rows) {
  return fmt::format("{} met, {} not met, {} reported, {} not evaluated", count(rows, Verdict::met),
                     count(rows, Verdict::not_met), count(rows, Verdict::reported),
                     count(rows, Verdict::not_evaluated));
}

}  // namespace talus::app

// SPDX-License-Identifier: Apache-2.0
#include "app/comparison/evaluation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>

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

/// More variants than a line holds, and every row of the same ones.
bool is_side_by_side(const std::vector<EvaluatedRow>& rows) {
  constexpr std::size_t most_in_a_line = 4;
  return !rows.empty() && rows.front().row->variants.size() > most_in_a_line &&
         std::all_of(rows.begin(), rows.end(), [&](const EvaluatedRow& e) {
           return e.row->variants == rows.front().row->variants && e.values.size() == e.row->variants.size();
         });
}

/// A line a variant, a column a row, each value judged by itself.
std::string side_by_side(const std::vector<EvaluatedRow>& rows) {
  std::string names = "| |", lines = "|---|", criteria = "| met if |", printed = "| the paper |", text;
  for (const EvaluatedRow& e : rows) {
    names += fmt::format(" {}: `{}`, {} |", e.row->number, e.row->quantity, e.row->unit);
    lines += "---|";
    criteria += fmt::format(" {} |", to_string(e.row->criterion));
    printed += fmt::format(" {} |", e.row->printed);
  }
  const std::vector<std::string>& variants = rows.front().row->variants;
  for (std::size_t v = 0; v < variants.size(); ++v) {
    text += fmt::format("| {} |", variants[v]);
    for (const EvaluatedRow& e : rows) {
      const bool missed = e.row->criterion.kind != Criterion::Kind::reported &&
                          judge(e.row->criterion, e.values[v]) == Verdict::not_met;
      text += fmt::format(" {} |", !e.values[v] ? "-"
                                   : missed     ? "**" + number(*e.values[v]) + "**"
                                                : number(*e.values[v]));
    }
    text += "\n";
  }
  return fmt::format("{}\n{}\n{}\n{}\n{}\nIn bold: not met. -: the run did not get there.\n", names, lines, printed,
                     criteria, text);
}

}  // namespace

std::vector<EvaluatedRow> evaluate(const Reference& reference, const StudiedRuns& runs) {
  std::vector<EvaluatedRow> rows;
  for (const ComparisonRow& row : reference.rows) {
    EvaluatedRow evaluated{.row = &row, .values = {}, .verdict = Verdict::reported};
    try {
      evaluated.values = runs.values(row);
    } catch (const std::logic_error& error) {
      throw InputError({{.where = reference.path, .key = "row " + row.id, .what = error.what()}});
    }
    if (row.criterion.kind != Criterion::Kind::reported)
      evaluated.verdict = judge(row.criterion, std::span<const std::optional<double>>(evaluated.values));
    rows.push_back(std::move(evaluated));
  }
  return rows;
}

std::string to_text(const std::vector<EvaluatedRow>& rows) {
  std::string text = fmt::format("{:>3}  {:38} {:14} {:24} {:14} {}\n", "row", "quantity", "printed/met if", "computed",
                                 "verdict", "case");
  for (const EvaluatedRow& e : rows)
    text +=
        fmt::format("{:>3}  {:38} {:14} {:24} {:14} {}\n", e.row->number, e.row->quantity, to_string(e.row->criterion),
                    values_text(e), to_string(e.verdict), e.row->case_name + " (" + variants_text(*e.row) + ")");
  return text;
}

std::string to_markdown(const std::vector<EvaluatedRow>& rows) {
  if (is_side_by_side(rows)) return side_by_side(rows);
  std::string text = "| row | case | quantity | the paper | met if | computed | |\n|---|---|---|---|---|---|---|\n";
  for (const EvaluatedRow& e : rows) {
    text += fmt::format("| {} | {} ({}) | `{}`{} | {} ({}) | {} | {} | {} |\n", e.row->number, e.row->case_name,
                        variants_text(*e.row), e.row->quantity,
                        e.row->statistic == Statistic::standard_deviation ? " (standard deviation)" : "",
                        e.row->printed, e.row->source, to_string(e.row->criterion), values_text(e),
                        e.verdict == Verdict::met ? "**met**" : to_string(e.verdict));
  }
  return text;
}

std::string to_json(const Reference& reference, const std::vector<EvaluatedRow>& rows) {
  nlohmann::ordered_json json;
  json["study"] = reference.study;
  json["source"] = reference.source;
  for (const EvaluatedRow& e : rows) {
    nlohmann::ordered_json row;
    row["id"] = e.row->id;
    row["number"] = e.row->number;
    row["quantity"] = e.row->quantity;
    row["case"] = e.row->case_name;
    row["variants"] = e.row->variants;
    row["printed"] = e.row->printed;
    row["criterion"] = to_string(e.row->criterion);
    row["unit"] = e.row->unit;
    auto& values = row["values"] = nlohmann::ordered_json::array();
    for (const auto& value : e.values) {
      if (value && std::isfinite(*value))
        values.push_back(*value);
      else
        values.push_back(nullptr);
    }
    row["verdict"] = to_string(e.verdict);
    json["rows"].push_back(std::move(row));
  }
  return json.dump(2) + "\n";
}

std::size_t count(const std::vector<EvaluatedRow>& rows, Verdict verdict) {
  return static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [&](const EvaluatedRow& row) { return row.verdict == verdict; }));
}

}  // namespace talus::app

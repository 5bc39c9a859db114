// SPDX-License-Identifier: Apache-2.0
#include "app/comparison/evaluation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/avalanche_quantities.hpp"
#include "app/cloud/cloud_analysis.hpp"
#include "app/cloud/cloud_case.hpp"
#include "base/error.hpp"
#include "base/unit.hpp"
#include "io/case_file.hpp"
#include "io/manifest.hpp"
#include "io/run_folder.hpp"
#include "io/summary.hpp"

namespace talus::app {

namespace {

struct FoundRun {
  std::filesystem::path folder;
  CaseFile file;
  std::int64_t seed;
};

std::vector<FoundRun> find_runs(const std::filesystem::path& folder) {
  std::vector<FoundRun> runs;
  auto add = [&](const std::filesystem::path& path) {
    const RunFolder run(path);
    if (!std::filesystem::exists(run.manifest()) || !std::filesystem::exists(run.summary())) return;
    if (read_summary(run.summary()).status != "done") return;
    const Manifest manifest = read_manifest(run.manifest());
    runs.push_back({path, CaseFile::from_text(manifest.case_text, run.manifest().string()), manifest.seed});
  };
  add(folder);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_directory()) add(entry.path());
  std::sort(runs.begin(), runs.end(), [](const FoundRun& a, const FoundRun& b) {
    return a.seed != b.seed ? a.seed < b.seed : a.folder < b.folder;
  });
  return runs;
}

std::string text_of(const CaseFile& file, const std::string& key) {
  const CaseEntry* entry = file.find(key);
  const auto* text = entry ? std::get_if<std::string>(&entry->value.value) : nullptr;
  return text ? *text : std::string();
}

const ReferenceCase* case_of(const CaseFile& file, const Reference& reference) {
  const ReferenceCase* best = nullptr;
  for (const ReferenceCase& c : reference.cases) {
    const bool fits = std::all_of(c.where.begin(), c.where.end(),
                                  [&](const auto& key) { return text_of(file, key.first) == key.second; });
    if (fits && (!best || c.where.size() > best->where.size())) best = &c;
  }
  return best;
}

std::string radius_of(const CaseFile& file, const ReferenceCase& c) {
  const auto radius = parse_quantity(text_of(file, "particles.radius"));
  for (const ReferenceCase::Radius& candidate : c.radii)
    if (const auto value = parse_quantity(candidate.label);
        value && radius && std::abs(value->value - radius->value) <= 1e-9 * value->value)
      return candidate.label;
  return {};
}

std::string number(double value) {
  if (std::isnan(value)) return "none";
  return std::abs(value) >= 1000 ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

std::string values_text(const EvaluatedRow& row) {
  std::string text;
  for (const auto& value : row.values) text += (text.empty() ? "" : ", ") + (value ? number(*value) : std::string("-"));
  return text;
}

/// A row may ask for what its runs cannot give: a name that is none of an ensemble's, the mean of runs that differ in
/// their snapshots.
template <class Value>
std::optional<double> of_row(const Reference& reference, const ComparisonRow& row, Value&& value) {
  try {
    return value();
  } catch (const std::logic_error& error) {
    throw InputError({{.where = reference.path, .key = "row " + row.id, .what = error.what()}});
  }
}

}  // namespace

std::vector<StudiedEnsemble> find_ensembles(const std::filesystem::path& folder, const Reference& reference) {
  if (!std::filesystem::is_directory(folder)) throw FileError(folder.string(), "is no folder");
  std::vector<StudiedEnsemble> ensembles;
  for (const FoundRun& run : find_runs(folder)) {
    const ReferenceCase* c = case_of(run.file, reference);
    const std::string radius = c ? radius_of(run.file, *c) : std::string();
    if (radius.empty()) continue;
    auto found = std::find_if(ensembles.begin(), ensembles.end(),
                              [&](const StudiedEnsemble& e) { return e.case_name == c->name && e.radius == radius; });
    if (found == ensembles.end()) {
      ensembles.push_back({c->name, radius, 0, {}, {}});
      found = ensembles.end() - 1;
    }
    const CloudStudy study = study_of(run.file);
    found->contact_weight_ratio = study.contact_weight_ratio;
    found->folders.push_back(run.folder);
    found->runs.push_back(read_avalanche(run.folder, study.frame));
  }
  if (ensembles.empty())
    throw InputError({{.where = folder.string(),
                       .what = "holds no finished run of a case of " + reference.path,
                       .allowed = "the folder of a run, of an ensemble, or of reproduce"}});
  return ensembles;
}

std::vector<EvaluatedRow> evaluate(const Reference& reference, const std::vector<StudiedEnsemble>& ensembles) {
  std::vector<EvaluatedRow> rows;
  for (const ComparisonRow& row : reference.rows) {
    EvaluatedRow evaluated{.row = &row, .values = {}, .verdict = Verdict::not_evaluated};
    std::vector<std::vector<AvalancheRun>> of_radii;
    for (const std::string& radius : row.radius) {
      const auto found = std::find_if(ensembles.begin(), ensembles.end(), [&](const StudiedEnsemble& e) {
        return e.case_name == row.case_name && e.radius == radius;
      });
      const bool there = found != ensembles.end();
      if (row.from == From::radii) {
        if (there) of_radii.push_back(found->runs);
      } else if (row.from == From::parameters) {
        evaluated.values.push_back(there ? std::optional(found->contact_weight_ratio) : std::nullopt);
      } else {
        evaluated.values.push_back(there ? of_row(reference, row, [&] { return ensemble_quantity(row, found->runs); })
                                         : std::nullopt);
      }
    }
    if (row.from == From::radii)
      evaluated.values.push_back(of_row(reference, row, [&] { return radii_quantity(row, of_radii); }));
    evaluated.verdict = row.criterion.kind == Criterion::Kind::reported
                            ? Verdict::reported
                            : judge(row.criterion, std::span<const std::optional<double>>(evaluated.values));
    rows.push_back(std::move(evaluated));
  }
  return rows;
}

std::string to_text(const std::vector<EvaluatedRow>& rows) {
  std::string text = fmt::format("{:>3}  {:38} {:14} {:24} {:14} {}\n", "row", "quantity", "printed/met if", "computed",
                                 "verdict", "case");
  for (const EvaluatedRow& e : rows)
    text += fmt::format("{:>3}  {:38} {:14} {:24} {:14} {}\n", e.row->number, e.row->quantity,
                        to_string(e.row->criterion), values_text(e), to_string(e.verdict), e.row->case_name);
  return text;
}

std::string to_markdown(const std::vector<EvaluatedRow>& rows) {
  std::string text = "| row | case | quantity | the paper | met if | computed | |\n|---|---|---|---|---|---|---|\n";
  for (const EvaluatedRow& e : rows) {
    std::string radii;
    for (const std::string& radius : e.row->radius) radii += (radii.empty() ? "" : ", ") + radius;
    text += fmt::format(
        "| {} | {} ({}) | `{}`{} | {} ({}) | {} | {} | {} |\n", e.row->number, e.row->case_name, radii, e.row->quantity,
        e.row->statistic == Statistic::standard_deviation ? " (standard deviation)" : "", e.row->printed, e.row->source,
        to_string(e.row->criterion), values_text(e), e.verdict == Verdict::met ? "**met**" : to_string(e.verdict));
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
    row["radius"] = e.row->radius;
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

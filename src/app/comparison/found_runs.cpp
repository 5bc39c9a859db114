// SPDX-License-Identifier: Apache-2.0
#include "app/comparison/found_runs.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/unit.hpp"
#include "io/run_folder.hpp"
#include "io/run_json.hpp"

namespace talus::app {

namespace {

/// Between a value as it is written in a reference and in a resolved case: that prints 8 digits or more.
constexpr double rounding = 1e-6;

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

bool same(double a, double b) {
  return std::abs(a - b) <= rounding * std::max(std::abs(a), std::abs(b));
}

std::optional<double> as_number(const CaseValue& value) {
  if (const auto* number = std::get_if<double>(&value.value)) return *number;
  if (const auto* whole = std::get_if<std::int64_t>(&value.value)) return static_cast<double>(*whole);
  return std::nullopt;
}

bool same(const CaseValue& a, const CaseValue& b) {
  if (const auto x = as_number(a), y = as_number(b); x && y) return same(*x, *y);
  const auto *s = std::get_if<std::string>(&a.value), *t = std::get_if<std::string>(&b.value);
  if (s && t) {
    const auto x = parse_quantity(*s), y = parse_quantity(*t);
    return *s == *t || (x && y && same(x->value, y->value));
  }
  const auto *x = std::get_if<bool>(&a.value), *y = std::get_if<bool>(&b.value);
  return x && y && *x == *y;
}

bool has(const CaseFile& file, const Settings& settings) {
  return std::all_of(settings.begin(), settings.end(), [&](const auto& setting) {
    const CaseFile wanted = CaseFile::from_text(setting.first + " = " + setting.second, "");
    const CaseEntry *a = file.find(setting.first), *b = wanted.find(setting.first);
    return a && b && same(a->value, b->value);
  });
}

/// Of those whose settings the run has, the one with the most.
template <class Candidate>
const Candidate* best(const std::vector<Candidate>& candidates, const CaseFile& file, Settings Candidate::*settings) {
  const Candidate* best = nullptr;
  for (const Candidate& candidate : candidates)
    if (has(file, candidate.*settings) && (!best || (candidate.*settings).size() > (best->*settings).size()))
      best = &candidate;
  return best;
}

}  // namespace

std::vector<FoundEnsemble> ensembles_of(const std::filesystem::path& folder, const Reference& reference) {
  if (!std::filesystem::is_directory(folder)) throw FileError(folder.string(), "no such folder");
  std::vector<FoundEnsemble> ensembles;
  for (FoundRun& run : find_runs(folder)) {
    const ReferenceCase* c = best(reference.cases, run.file, &ReferenceCase::where);
    const auto* variant = c ? best(c->variants, run.file, &ReferenceCase::Variant::told_by) : nullptr;
    if (!variant) continue;
    auto found = std::find_if(ensembles.begin(), ensembles.end(), [&](const FoundEnsemble& e) {
      return e.case_name == c->name && e.variant == variant->label;
    });
    if (found == ensembles.end())
      found = ensembles.insert(ensembles.end(), FoundEnsemble{c->name, variant->label, {}, {}});
    found->folders.push_back(std::move(run.folder));
    found->files.push_back(std::move(run.file));
  }
  return ensembles;
}

std::vector<FoundEnsemble> find_ensembles(const std::filesystem::path& folder, const Reference& reference) {
  std::vector<FoundEnsemble> ensembles = ensembles_of(folder, reference);
  if (ensembles.empty())
    throw InputError({{.where = folder.string(),
                       .what = "holds no finished run of a case of " + reference.path,
                       .allowed = "the folder of a run, of an ensemble, or of reproduce"}});
  return ensembles;
}

}  // namespace talus::app

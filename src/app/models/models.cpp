// SPDX-License-Identifier: Apache-2.0
#include "app/models/models.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <utility>

#include "app/air/air_case.hpp"
#include "app/case/model_case.hpp"
#include "app/cloud/cloud_case.hpp"
#include "app/continuum/continuum_case.hpp"
#include "base/system.hpp"
#include "base/text.hpp"
#include "io/run_folder.hpp"
#include "io/run_json.hpp"
#include "models/air/model.hpp"
#include "models/cloud/parameters.hpp"

namespace talus::app {

namespace {

constexpr ModelEntry entries[] = {
    {.name = "cloud",
     .prepare = prepare_cloud,
     .open = open_cloud_run,
     .parameters = [] { return ModelCase<cloud::Parameters>().list(); },
     .measures = texts_of_avalanche_measures},
    {.name = "continuum",
     .prepare = prepare_continuum,
     .open = open_continuum_run,
     .parameters = continuum_parameters,
     .measures = texts_of_hopper_measures},
    {.name = "air",
     .prepare = prepare_air,
     .open = open_air_run,
     .parameters = [] { return ModelCase<air::ModelParameters>().list(); },
     .measures = nullptr},
};

}  // namespace

std::span<const ModelEntry> models() {
  return entries;
}

const ModelEntry& model_of(const CaseFile& file) {
  const CaseEntry* const given = file.find("model");
  const auto* const name = given ? std::get_if<std::string>(&given->value.value) : nullptr;
  std::vector<std::string_view> names;
  for (const ModelEntry& entry : entries) {
    if (name && *name == entry.name) return entry;
    names.push_back(entry.name);
  }
  std::vector<Problem> problems = file.problems();
  problems.push_back({.where = given ? given->where : file.name(),
                      .line = given ? given->line : 0,
                      .key = "model",
                      .what = !given ? "missing"
                              : name ? fmt::format("there is no model \"{}\"", *name)
                                     : "is not a model's name in quotes",
                      .allowed = fmt::format("{}", fmt::join(names, ", ")),
                      .nearest = name ? std::string(nearest(*name, names)) : std::string()});
  throw InputError(problems);
}

std::unique_ptr<OpenedRun> open_run(const std::filesystem::path& folder, std::size_t snapshot_memory) {
  const RunFolder run(folder);
  const CaseFile resolved = CaseFile::from_text(read_manifest(run.manifest()).case_text, run.manifest().string());
  return model_of(resolved).open(resolved, folder, snapshot_memory);
}

PreparedCase prepare_case(const CaseFile& file) {
  return model_of(file).prepare(file);
}

std::vector<Warning> warnings_before_run(const PreparedCase& prepared, const std::filesystem::path& folder) {
  std::vector<RegimeLine> lines = prepared.regime;
  const std::optional<double> free = available_disk(folder);
  if (free && prepared.forecast.disk_bytes > *free)
    lines.push_back({"disk", fmt::format("{:.4g} GB", prepared.forecast.disk_bytes / 1e9),
                     fmt::format("of the run's files, but {:.4g} GB are free for {}; fewer snapshots "
                                 "(output.snapshots) or rows (output.series), or another folder (--out)",
                                 *free / 1e9, folder.string()),
                     true});
  return warnings_of(lines);
}

void check_memory(const PreparedCase& prepared, const CaseFile& file) {
  const std::optional<double> available = available_memory();
  if (!available || prepared.forecast.memory_bytes <= *available) return;
  Problem problem = prepared.too_large(*available);
  problem.what += fmt::format(", which need {:.3g} GB of memory; {:.3g} GB are free here",
                              prepared.forecast.memory_bytes / 1e9, *available / 1e9);
  ParameterReader reader(file);
  reader.check({std::move(problem)});
  reader.throw_problems();
}

}  // namespace talus::app

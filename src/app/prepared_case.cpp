// SPDX-License-Identifier: Apache-2.0
#include "app/prepared_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "app/air/air_case.hpp"
#include "app/cloud/cloud_case.hpp"
#include "app/cloud/cloud_pictures.hpp"
#include "app/continuum/continuum_case.hpp"
#include "base/memory.hpp"
#include "base/nearest.hpp"
#include "io/parameter_reader.hpp"

namespace talus::app {

namespace {

std::string model_of(const CaseFile& file) {
  const CaseEntry* entry = file.find("model");
  const auto* name = entry ? std::get_if<std::string>(&entry->value.value) : nullptr;
  return name ? *name : "";
}

}  // namespace

// A case that names no model, or one that there is not, is read as one of a cloud all the same, so that the fault is
// reported together with the others.
PreparedCase prepare_case(const CaseFile& file) {
  const std::string model = model_of(file);
  return model == "air" ? prepare_air(file) : model == "continuum" ? prepare_continuum(file) : prepare_cloud(file);
}

void check_memory(const PreparedCase& prepared, const CaseFile& file) {
  const std::optional<double> available = available_memory();
  if (!available || prepared.forecast.memory_bytes <= *available) return;
  Problem problem = prepared.too_large(*available);
  problem.what += fmt::format(", which need {:.3g} GB of memory; {:.3g} GB are free here",
                              prepared.forecast.memory_bytes / 1e9, *available / 1e9);
  ParameterReader reader(file);
  reader.check({std::move(problem)});
  reader.raise();
}

std::vector<Problem> check_model(const std::string& model) {
  if (std::find(model_names.begin(), model_names.end(), model) != model_names.end()) return {};
  return {{.key = "model",
           .what = fmt::format("there is no model \"{}\"", model),
           .allowed = fmt::format("{}", fmt::join(model_names, ", ")),
           .nearest = std::string(nearest(model, model_names))}};
}

std::vector<NamedValue> analyze_run(const CaseFile& resolved, const std::filesystem::path& folder) {
  if (model_of(resolved) == "air") return analyze_air(folder);
  if (model_of(resolved) == "continuum") return analyze_continuum_run(resolved, folder);
  const CloudStudy study = study_of(resolved);
  std::vector<NamedValue> quantities = analyze_cloud(folder, study.frame);
  draw_cloud(folder, study.frame, study.title);
  return quantities;
}

ParameterList parameters_of(const std::string& model) {
  if (model == "cloud") return cloud_parameters();
  if (model == "continuum") return continuum_parameters();
  if (model == "air") return air_parameters();
  throw std::invalid_argument("no model " + model);
}

}  // namespace talus::app

// SPDX-License-Identifier: Apache-2.0
#include "app/prepared_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "app/cloud/cloud_case.hpp"
#include "app/cloud/cloud_pictures.hpp"
#include "base/nearest.hpp"

namespace talus::app {

// There is one model. A case that names none, or another, is read as one of its cases all the same, so that the fault
// is reported together with the others.
PreparedCase prepare_case(const CaseFile& file) {
  return prepare_cloud(file);
}

std::vector<Problem> check_model(const std::string& model) {
  if (std::find(model_names.begin(), model_names.end(), model) != model_names.end()) return {};
  return {{.key = "model",
           .what = fmt::format("there is no model \"{}\"", model),
           .allowed = fmt::format("{}", fmt::join(model_names, ", ")),
           .nearest = std::string(nearest(model, model_names))}};
}

std::vector<NamedValue> analyze_run(const CaseFile& resolved, const std::filesystem::path& folder) {
  const CloudStudy study = study_of(resolved);
  std::vector<NamedValue> quantities = analyze_cloud(folder, study.frame);
  draw_cloud(folder, study.frame, study.title);
  return quantities;
}

ParameterList parameters_of(const std::string& model) {
  if (model == "cloud") return cloud_parameters();
  throw std::invalid_argument("no model " + model);
}

}  // namespace talus::app

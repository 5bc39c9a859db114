// SPDX-License-Identifier: Apache-2.0
#include "app/prepared_case.hpp"

#include <stdexcept>

#include "app/cloud/cloud_case.hpp"
#include "io/parameter_reader.hpp"

namespace talus::app {

PreparedCase prepare_case(const CaseFile& file) {
  std::string model;
  read_parameter(file, {"model", {}, {}, "which model", true}, model);
  if (model == "cloud") return prepare_cloud(file);
  const CaseEntry* entry = file.find("model");
  throw InputError({{.where = entry->where,
                     .line = entry->line,
                     .key = "model",
                     .what = "there is no model \"" + model + "\"",
                     .allowed = "cloud"}});
}

ParameterList parameters_of(const std::string& model) {
  if (model == "cloud") return cloud_parameters();
  throw std::invalid_argument("no model " + model);
}

}  // namespace talus::app

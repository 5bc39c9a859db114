// SPDX-License-Identifier: Apache-2.0
/// Cases of any model: the parameters of the model and of the run, read and checked together.
#pragma once

#include <string>
#include <utility>

#include "app/case/prepared_case.hpp"
#include "io/parameter_reader.hpp"

namespace talus::app {

/// \tparam P parameters of a model, with for_each_parameter and check in its namespace
template <class P>
struct ModelCase {
  run::RunParameters run;
  P model;

  ParameterList list() const {
    ParameterList parameters;
    for_each_parameter(parameters, run);
    for_each_parameter(parameters, model);
    return parameters;
  }
};

/// \throws InputError with every problem of the case
template <class P>
ModelCase<P> read_case(ParameterReader& reader, P defaults = {}) {
  ModelCase<P> read{.run = {}, .model = std::move(defaults)};
  for_each_parameter(reader, read.run);
  for_each_parameter(reader, read.model);
  reader.check(read.model, [](const P& model) { return check(model); });
  reader.finish();
  if (read.run.snapshots == 0) read.run.snapshots = read.run.end / 20;
  return read;
}

/// The members of PreparedCase that are the same for every model.
template <class P>
PreparedCase prepared_case(std::string model, const ModelCase<P>& read) {
  PreparedCase prepared;
  prepared.model = std::move(model);
  prepared.run = read.run;
  prepared.parameters = read.list();
  return prepared;
}

}  // namespace talus::app

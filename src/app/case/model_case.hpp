// SPDX-License-Identifier: Apache-2.0
/// Cases of any model: the parameters of the model and of the run, read and checked together, and the files they name.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/case/prepared_case.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/system.hpp"
#include "io/case_file.hpp"
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

/// The path of a file that a case names: one that is not absolute starts at the folder of the case.
inline std::filesystem::path input_path(const CaseFile& file, const std::string& given) {
  const std::filesystem::path path = given;
  return path.is_absolute() ? path : std::filesystem::path(file.name()).parent_path() / path;
}

/// Calls read(), which reads a file that `key` names. That it cannot be opened or read is a problem of the case, as any
/// other value of a key that will not do: exit status 2, with the line of the key and the place in the file.
template <class Read>
void read_input(std::string key, std::vector<Problem>& problems, Read&& read) {
  try {
    std::forward<Read>(read)();
  } catch (const InputError& error) {
    for (Problem of_file : error.problems()) {
      Problem problem{
          .key = key, .allowed = std::exchange(of_file.allowed, {}), .nearest = std::exchange(of_file.nearest, {})};
      problem.what = to_string(of_file);
      problems.push_back(std::move(problem));
    }
  } catch (const FileError& error) {
    problems.push_back({.key = std::move(key),
                        .what = error.what(),
                        .allowed = "a file that can be read, its path from the folder of the case on"});
  }
}

/// Seconds of one call of `body` with a processor for each thread, the mean over as many as fit into `duration`, a
/// thousand at most, so that a small model does not come to its end; one before them, which fills caches and lists,
/// does not count. By processor time: other programs lengthen a call, hardly its share of the processors.
template <class Body>
double seconds_of(const ThreadTeam& team, double duration, Body&& body) {
  constexpr int max_calls = 1000;
  body();
  const auto clock = [threads = std::min(team.size(), processors())] { return processor_seconds() / threads; };
  const double start = clock();
  double elapsed = 0;
  int calls = 0;
  do {
    body();
    ++calls;
    elapsed = clock() - start;
  } while (elapsed < duration && calls < max_calls);
  return elapsed / calls;
}

}  // namespace talus::app

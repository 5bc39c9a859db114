// SPDX-License-Identifier: Apache-2.0
#include "app/ensemble/plan.hpp"

#include <fmt/format.h>

#include <cctype>

#include "app/prepared_case.hpp"
#include "app/run_case.hpp"
#include "base/error.hpp"
#include "io/parameter_writer.hpp"

namespace talus::app {

namespace {

struct Varied {
  std::string key;
  std::vector<std::string> values;
};

Varied read_vary(const std::string& text, std::vector<Problem>& problems) {
  const std::size_t equals = text.find('=');
  Varied varied{.key = text.substr(0, equals), .values = {}};
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
    problems.push_back({.where = "--vary " + text, .what = "no values", .allowed = "table.key=value1,value2,..."});
    return varied;
  }
  // Commas within brackets belong to an array.
  std::string value;
  int depth = 0;
  for (const char c : text.substr(equals + 1) + ",") {
    depth += (c == '[') - (c == ']');
    if (c == ',' && depth == 0) {
      varied.values.push_back(value);
      value.clear();
    } else {
      value += c;
    }
  }
  return varied;
}

std::string folder_name(const std::string& text) {
  std::string name;
  for (const char c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '=' || c == '-' || c == '_') name += c;
  return name;
}

}  // namespace

EnsemblePlan plan_ensemble(const EnsembleRequest& request) {
  std::vector<Problem> problems;
  std::vector<Varied> varied;
  for (const std::string& text : request.vary) varied.push_back(read_vary(text, problems));
  if (!problems.empty()) throw InputError(problems);

  // All combinations, the last key fastest.
  EnsemblePlan plan{.groups = {{.name = {}, .settings = {}, .members = {}}}};
  for (const Varied& key : varied) {
    std::vector<EnsembleGroup> groups;
    for (const EnsembleGroup& group : plan.groups)
      for (const std::string& value : key.values) {
        EnsembleGroup more = group;
        more.settings.push_back(key.key + "=" + value);
        more.name += (more.name.empty() ? "" : "_") + folder_name(key.key.substr(key.key.rfind('.') + 1) + "=" + value);
        groups.push_back(std::move(more));
      }
    plan.groups = std::move(groups);
  }

  for (EnsembleGroup& group : plan.groups) {
    if (group.name.empty()) group.name = "all";
    CaseFile file = CaseFile::read(request.case_path);
    for (const std::string& setting : request.settings) file.set(setting);
    for (const std::string& setting : group.settings) file.set(setting);
    const std::int64_t first_seed = prepare_case(file).seed;
    for (int k = 0; k < request.members; ++k) {
      EnsembleMember member{.seed = first_seed + k, .settings = request.settings, .folder = {}, .fingerprint = {}};
      member.settings.insert(member.settings.end(), group.settings.begin(), group.settings.end());
      member.settings.push_back(fmt::format("seed={}", member.seed));
      file.set(member.settings.back());
      member.fingerprint = case_fingerprint(prepare_case(file));
      member.folder = request.folder / group.name / fmt::format("seed_{:04}", member.seed);
      group.members.push_back(std::move(member));
    }
  }
  return plan;
}

}  // namespace talus::app

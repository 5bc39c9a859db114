// SPDX-License-Identifier: Apache-2.0
#include "app/ensemble/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "app/models/models.hpp"
#include "app/runs/run_case.hpp"
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
  if (varied.key == "seed")
    problems.push_back(
        {.where = "--vary " + text, .what = "each member has a seed of its own", .allowed = "--members"});
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

bool has_seed(const PreparedCase& prepared) {
  return std::any_of(prepared.parameters.begin(), prepared.parameters.end(), [](const DescribedParameter& item) {
    return item.parameter.key == "seed" && item.parameter.condition.holds;
  });
}

/// \returns output.pictures of the case
bool add_members(const EnsembleRequest& request, EnsembleGroup& group) {
  CaseFile file = CaseFile::read(request.case_path);
  for (const std::string& setting : request.settings) file.set(setting);
  for (const std::string& setting : group.settings) file.set(setting, "--vary");
  const PreparedCase first = prepare_case(file);
  check_memory(first, file);
  const bool random = has_seed(first);
  const std::int64_t first_seed = first.seed;
  for (int k = 0; k < (random ? request.members : 1); ++k) {
    EnsembleMember member{.seed = first_seed + k, .settings = request.settings, .folder = {}, .fingerprint = {}};
    member.settings.insert(member.settings.end(), group.settings.begin(), group.settings.end());
    if (random) {
      member.settings.push_back(fmt::format("seed={}", member.seed));
      file.set(member.settings.back());
    }
    member.folder = request.folder / group.name;
    if (random) member.folder /= fmt::format("seed_{:04}", member.seed);
    CaseFile case_of_member = file;
    if (request.resume) keep_snapshot_interval(case_of_member, member.folder);
    const PreparedCase prepared = prepare_case(case_of_member);
    member.fingerprint = case_fingerprint(prepared);
    member.end = prepared.run.end;
    group.members.push_back(std::move(member));
  }
  return first.run.pictures;
}

}  // namespace

EnsemblePlan plan_ensemble(const EnsembleRequest& request) {
  std::vector<Problem> problems;
  std::vector<Varied> varied;
  for (const std::string& text : request.vary) varied.push_back(read_vary(text, problems));
  std::erase_if(varied, [](const Varied& key) { return key.values.empty(); });

  // All combinations, the last key fastest.
  EnsemblePlan plan{.groups = {{.name = {}, .settings = {}, .members = {}}}, .pictures = true};
  for (const Varied& key : varied) {
    std::vector<EnsembleGroup> groups;
    for (const EnsembleGroup& group : plan.groups)
      for (const std::string& value : key.values) {
        EnsembleGroup more = group;
        more.settings.push_back(key.key + "=" + value);
        more.name += fmt::format("{}{}={}", more.name.empty() ? "" : "_", last_part(key.key), folder_name(value));
        groups.push_back(std::move(more));
      }
    plan.groups = std::move(groups);
  }

  std::set<std::string> names;
  for (EnsembleGroup& group : plan.groups) {
    if (group.name.empty()) group.name = "all";
    if (!names.insert(group.name).second)
      problems.push_back(
          {.where = "--vary", .what = "two groups would be " + group.name, .allowed = "each value once"});
    try {
      plan.pictures = add_members(request, group);
    } catch (const InputError& error) {  // the case's own faults come with every group: once is enough
      for (const Problem& problem : error.problems())
        if (std::none_of(problems.begin(), problems.end(),
                         [&](const Problem& known) { return to_string(known) == to_string(problem); }))
          problems.push_back(problem);
    }
  }
  if (!problems.empty()) throw InputError(problems);
  return plan;
}

}  // namespace talus::app

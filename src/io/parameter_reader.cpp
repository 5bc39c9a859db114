// SPDX-License-Identifier: Apache-2.0
#include "io/parameter_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "base/text.hpp"
#include "io/parameter_value.hpp"

namespace talus {

namespace {

/// Whether the words of a message name this key: whole, not as a part of a longer one.
bool names_key(std::string_view words, std::string_view key) {
  const auto in_key = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  for (std::size_t at = words.find(key); at != std::string_view::npos; at = words.find(key, at + 1)) {
    const std::size_t end = at + key.size();
    const bool begins = at == 0 || (!in_key(words[at - 1]) && words[at - 1] != '.');
    if (begins && (end == words.size() || !in_key(words[end]))) return true;
  }
  return false;
}

/// The key that an unknown one was probably meant to be. Its last part must be near; its table may be near, or quite
/// another one if the last part is nearer still.
std::string_view nearest_key(std::string_view word, const std::vector<std::string>& keys) {
  const std::string_view last = last_part(word), table = table_of(word);
  constexpr std::size_t other_table = 10;
  std::string_view best;
  std::size_t least = std::string_view::npos;
  for (const std::string& key : keys) {
    const auto key_typos = typos(last, last_part(key));
    if (!key_typos) continue;
    const auto table_typos = typos(table, table_of(key));
    if (!table_typos && *key_typos > last.size() / 4) continue;
    const std::size_t score = *key_typos + table_typos.value_or(other_table);
    if (score < least) best = key, least = score;
  }
  return best;
}

}  // namespace

ParameterReader::ParameterReader(const CaseFile& file, std::span<const RenamedKey> renamed)
    : file_(file), renamed_(renamed) {
  for (const Problem& problem : file.problems()) found_.push_back({problem, false, true});
}

std::optional<ParameterValue> ParameterReader::read(const Parameter& parameter, const ValueType& type) {
  keys_.emplace_back(parameter.key);
  const CaseEntry* entry = file_.find(parameter.key);
  if (const Condition& condition = parameter.condition; !condition.holds) {
    const CaseEntry* choice = file_.find(condition.key);
    const bool is_overridden = choice && choice->is_option && entry && !entry->is_option;
    if (entry && !is_overridden)
      check({{.key = parameter.key,
              .what = fmt::format("given, but {} {}", condition.key, condition.found),
              .allowed = fmt::format("{} {}", condition.key, condition.needed)}});
    return std::nullopt;
  }
  if (!entry) {
    if (parameter.required)
      found_.push_back(
          {{.where = file_.name(), .key = parameter.key, .what = "missing", .allowed = allowed_text(parameter, type)},
           true});
    return std::nullopt;
  }
  ValueFault fault;
  auto value = convert_value(*entry, parameter, type, fault);
  if (!value) add(*entry, fault.what, allowed_text(parameter, type), fault.nearest);
  return value;
}

void ParameterReader::check(std::vector<Problem> contradictions) {
  const std::size_t known = found_.size();
  for (Problem& problem : contradictions) {
    const bool follows =
        std::any_of(found_.begin(), found_.begin() + static_cast<std::ptrdiff_t>(known), [&](const Found& found) {
          const std::string& key = found.problem.key;
          return !key.empty() &&
                 (key == problem.key || names_key(problem.what, key) || names_key(problem.allowed, key));
        });
    if (follows) continue;
    const CaseEntry* entry = file_.find(problem.key);
    const bool elsewhere = !problem.where.empty();
    if (!elsewhere) problem.where = entry ? entry->where : file_.name(), problem.line = entry ? entry->line : 0;
    found_.push_back({std::move(problem), !entry && !elsewhere, entry && entry->is_option});
  }
}

bool ParameterReader::has_unread() const {
  return std::any_of(keys_.begin(), keys_.end(), [&](const std::string& key) { return is_unread(key); });
}

bool ParameterReader::is_unread(std::string_view key) const {
  return meant_.contains(key) ||
         std::any_of(found_.begin(), found_.end(), [&](const Found& found) { return found.problem.key == key; });
}

void ParameterReader::keep_common(std::vector<Problem>& problems, const std::vector<Problem>& others) {
  std::erase_if(problems, [&](const Problem& problem) {
    return std::none_of(others.begin(), others.end(), [&](const Problem& other) {
      return other.key == problem.key && other.what == problem.what && other.allowed == problem.allowed;
    });
  });
}

void ParameterReader::finish() {
  report_unknown_keys();
  std::erase_if(found_, [&](const Found& found) { return found.is_missing && meant_.contains(found.problem.key); });
  throw_problems();
}

void ParameterReader::throw_problems() const {
  if (found_.empty()) return;
  std::vector<Found> sorted = found_;
  const auto rank = [](const Found& found) { return found.is_option ? 2 : found.problem.line == 0 ? 1 : 0; };
  std::stable_sort(sorted.begin(), sorted.end(), [&](const Found& a, const Found& b) {
    return std::pair(rank(a), a.problem.line) < std::pair(rank(b), b.problem.line);
  });
  std::vector<Problem> problems;
  for (Found& found : sorted) problems.push_back(std::move(found.problem));
  throw InputError(std::move(problems));
}

void ParameterReader::add(const CaseEntry& entry, std::string what, std::string allowed, std::string nearest) {
  found_.push_back({{.where = entry.where,
                     .line = entry.line,
                     .key = entry.key,
                     .what = std::move(what),
                     .allowed = std::move(allowed),
                     .nearest = std::move(nearest)},
                    false,
                    entry.is_option});
}

bool ParameterReader::is_table(std::string_view key) const {
  return std::any_of(keys_.begin(), keys_.end(), [&](const std::string& known) { return lies_in(known, key); });
}

void ParameterReader::report_unknown_keys() {
  if (std::exchange(knows_unknown_keys_, true)) return;
  std::vector<std::string_view> closed;  // what lies in these is reported with them; an option is, for itself
  for (const CaseEntry& entry : file_.entries()) {
    const bool is_table_here = std::holds_alternative<CaseTable>(entry.value.value);
    const auto holds_it = [&](std::string_view table) { return lies_in(entry.key, table); };
    if (!entry.is_option && std::any_of(closed.begin(), closed.end(), holds_it)) continue;
    if (std::find(keys_.begin(), keys_.end(), entry.key) != keys_.end()) {
      closed.push_back(entry.key);
    } else if (is_table(entry.key)) {
      if (is_table_here) continue;
      add(entry, fmt::format("{} is not a table", as_written(entry.value)), fmt::format("a table: [{}]", entry.key));
      for (const std::string& key : keys_)
        if (lies_in(key, entry.key)) meant_.insert(key);
    } else if (is_table_here) {
      std::vector<const CaseEntry*> keys;
      for (const CaseEntry& other : file_.entries())
        if (lies_in(other.key, entry.key) && !std::holds_alternative<CaseTable>(other.value.value) && !other.is_option)
          keys.push_back(&other);
      if (keys.size() == 1 && !nearest_key(keys.front()->key, keys_).empty()) continue;  // the key itself is reported
      report_unknown_table(entry, keys);
      closed.push_back(entry.key);
    } else {
      report_unknown_key(entry);
    }
  }
}

void ParameterReader::report_unknown_table(const CaseEntry& table, const std::vector<const CaseEntry*>& keys) {
  std::vector<std::string_view> tables;
  for (const std::string& key : keys_)
    if (const auto name = table_of(key); !name.empty() && std::find(tables.begin(), tables.end(), name) == tables.end())
      tables.push_back(name);
  std::string_view best = nearest(table.key, tables);
  if (best.empty()) {  // the table that has most of these keys
    std::size_t most = keys.size() / 2;
    for (const std::string_view candidate : tables) {
      const auto has = [&](const CaseEntry* entry) {
        return std::find(keys_.begin(), keys_.end(), fmt::format("{}.{}", candidate, last_part(entry->key))) !=
               keys_.end();
      };
      const auto count = static_cast<std::size_t>(std::count_if(keys.begin(), keys.end(), has));
      if (count > most) best = candidate, most = count;
    }
  }
  for (const CaseEntry* entry : keys) meant_.insert(fmt::format("{}.{}", best, last_part(entry->key)));
  add(table, "unknown table", best.empty() ? fmt::format("[{}]", fmt::join(tables, "], [")) : std::string(),
      std::string(best));
}

bool ParameterReader::report_renamed_key(const CaseEntry& entry) {
  const auto found =
      std::find_if(renamed_.begin(), renamed_.end(), [&](const RenamedKey& key) { return key.old == entry.key; });
  if (found == renamed_.end()) return false;
  meant_.emplace(found->now);
  add(entry, "has another name now", std::string(found->now));
  return true;
}

void ParameterReader::report_unknown_key(const CaseEntry& entry) {
  if (report_renamed_key(entry)) return;
  std::string_view table = table_of(entry.key);
  const bool in_parameter = std::find(keys_.begin(), keys_.end(), table) != keys_.end();
  const std::string_view best = in_parameter ? table : nearest_key(entry.key, keys_);
  if (!is_table(table)) table = "";
  std::vector<std::string_view> known;  // the keys of its table, or at the top if there is no such table
  for (const std::string& key : keys_)
    if (best.empty() && table_of(key) == table) known.push_back(key);
  meant_.emplace(best);
  add(entry, "unknown key", fmt::format("{}", fmt::join(known, ", ")), std::string(best));
}

}  // namespace talus

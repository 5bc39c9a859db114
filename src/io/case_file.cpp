// SPDX-License-Identifier: Apache-2.0
#include "io/case_file.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "base/text.hpp"
#include "io/file.hpp"

namespace talus {

namespace {

constexpr std::size_t max_parts = 64;  // of a dotted key

bool is_bare(std::string_view part) {
  return !part.empty() && std::all_of(part.begin(), part.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-';
  });
}

std::string child(std::string_view table, std::string_view part) {
  const std::string name = is_bare(part) ? std::string(part) : fmt::format("\"{}\"", part);
  return table.empty() ? name : fmt::format("{}.{}", table, name);
}

CaseValue convert(const toml::node& node) {
  if (const auto* flag = node.as_boolean()) return {flag->get()};
  if (const auto* integer = node.as_integer()) return {integer->get()};
  if (const auto* number = node.as_floating_point()) return {number->get()};
  if (const auto* text = node.as_string()) return {text->get()};
  if (node.is_table()) return {CaseTable{}};
  if (const auto* array = node.as_array()) {
    std::vector<CaseValue> values;
    for (const toml::node& element : *array) values.push_back(convert(element));
    return {std::move(values)};
  }
  std::ostringstream date;
  node.visit([&](const auto& value) {
    if constexpr (toml::is_chronological<decltype(value)>) date << value.get();
  });
  return {CaseDate{date.str()}};
}

void flatten(const toml::table& table, std::string_view prefix, std::vector<CaseEntry>& entries) {
  for (const auto& [key, node] : table) {
    CaseEntry entry{.key = child(prefix, key.str()), .value = convert(node), .where = {}};
    entry.line = static_cast<int>(key.source().begin.line);
    const toml::array* array = node.as_array();
    const bool of_tables = array && !array->empty() && array->is_homogeneous<toml::table>();
    if (of_tables) entry.value = {CaseTable{}};
    entries.push_back(entry);
    if (const toml::table* inner = node.as_table()) flatten(*inner, entry.key, entries);
    for (std::size_t n = 0; of_tables && n < array->size(); ++n) {
      CaseEntry element{.key = fmt::format("{}.{}", entry.key, n + 1), .value = {CaseTable{}}, .where = {}};
      element.line = static_cast<int>((*array)[n].source().begin.line);
      entries.push_back(element);
      flatten(*(*array)[n].as_table(), element.key, entries);
    }
  }
}

std::string_view line_of(std::string_view text, std::size_t line) {
  for (; line > 1 && !text.empty(); --line) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  return text.substr(0, text.find('\n'));
}

/// Line of the first key of more parts than any case has, 0 if there is none. The parser, and the keys' full names,
/// take memory and stack for each of them. Quoted text and comments are passed over.
int line_of_deep_key(std::string_view text) {
  int line = 1;
  std::size_t dots = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      std::size_t end = i + 1;
      while (end < text.size() && text[end] != c && text[end] != '\n') end += c == '"' && text[end] == '\\' ? 2 : 1;
      i = end < text.size() && text[end] == c ? end : std::min(end, text.size()) - 1;
    } else if (c == '#') {
      i = std::min(text.find('\n', i), text.size()) - 1;
    } else if (c == '.') {
      if (++dots > max_parts) return line;
    } else if (c == '\n' || c == '=' || c == ',' || c == '[' || c == ']' || c == '{' || c == '}') {
      dots = 0;
      line += c == '\n';
    }
  }
  return 0;
}

/// Nothing if it is no TOML value.
std::optional<toml::table> parse_value(std::string_view value) {
  if (line_of_deep_key(value) > 0) return std::nullopt;
  try {
    toml::table table = toml::parse(fmt::format("value = {}\n", value));
    if (table.size() == 1) return table;
  } catch (const toml::parse_error&) {
  }
  return std::nullopt;
}

/// The slip that most syntax errors are: a quantity or a word without quotes.
std::string quotes_advice(std::string_view line) {
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos) return {};
  const std::string_view key = trimmed(line.substr(0, equals));
  std::string_view value = line.substr(equals + 1);
  value = trimmed(value.substr(0, value.find('#')));
  const bool begins_as_one = !value.empty() && (std::isalnum(static_cast<unsigned char>(value.front())) ||
                                                value.front() == '-' || value.front() == '+' || value.front() == '.');
  if (key.empty() || !begins_as_one || value.find_first_of("\"'=[]{},") != std::string_view::npos || parse_value(value))
    return {};
  return fmt::format("text and quantities in quotes: {} = \"{}\"", key, value);
}

[[noreturn]] void throw_syntax_error(const toml::parse_error& error, std::string_view text, const std::string& name) {
  std::string_view what = error.description();
  if (constexpr std::string_view prefix = "Error while parsing "; what.starts_with(prefix))
    what.remove_prefix(prefix.size());
  const toml::source_position position = error.source().begin;
  throw InputError({Problem{.where = name,
                            .line = static_cast<int>(position.line),
                            .column = static_cast<int>(position.column),
                            .key = {},
                            .what = fmt::format("not valid TOML: {}", what),
                            .allowed = quotes_advice(line_of(text, position.line))}});
}

bool is_dotted_key(std::string_view key) {
  while (true) {
    const std::size_t dot = key.find('.');
    if (!is_bare(key.substr(0, dot))) return false;
    if (dot == std::string_view::npos) return true;
    key.remove_prefix(dot + 1);
  }
}

}  // namespace

CaseFile CaseFile::read(const std::string& path) {
  return from_text(read_whole_file(path), path);
}

CaseFile CaseFile::from_text(std::string_view text, std::string name) {
  CaseFile file;
  file.name_ = std::move(name);
  if (const int line = line_of_deep_key(text); line > 0)
    throw InputError({{.where = file.name_,
                       .line = line,
                       .what = fmt::format("a key has more than {} parts", max_parts),
                       .allowed = "table.key"}});
  try {
    flatten(toml::parse(text), "", file.entries_);
  } catch (const toml::parse_error& error) {
    throw_syntax_error(error, text, file.name_);
  }
  for (CaseEntry& entry : file.entries_) entry.where = file.name_;
  std::stable_sort(file.entries_.begin(), file.entries_.end(),
                   [](const CaseEntry& a, const CaseEntry& b) { return a.line < b.line; });
  return file;
}

void CaseFile::set(std::string_view assignment, std::string_view option_name) {
  std::string option = fmt::format("{} {}", option_name, assignment);
  std::replace_if(
      option.begin(), option.end(), [](char c) { return std::iscntrl(static_cast<unsigned char>(c)); }, ' ');
  const std::size_t equals = assignment.find('=');
  const std::string_view key = trimmed(assignment.substr(0, equals));
  const bool deep = static_cast<std::size_t>(std::count(key.begin(), key.end(), '.')) > max_parts;
  if (equals == std::string_view::npos || deep || !is_dotted_key(key)) {
    const std::string what = equals == std::string_view::npos ? "has no '='" : fmt::format("'{}' is no key", key);
    problems_.push_back({.where = option, .key = {}, .what = what, .allowed = "table.key=value"});
    return;
  }
  const std::string raw(trimmed(assignment.substr(equals + 1)));

  std::vector<CaseEntry> given;
  const std::optional<toml::table> parsed = parse_value(raw);  // nothing: it is text
  const toml::node* node = parsed ? parsed->get("value") : nullptr;
  if (node && node->is_table())
    flatten(*node->as_table(), key, given);
  else
    given.push_back(
        {.key = std::string(key), .value = node ? convert(*node) : CaseValue{raw}, .where = {}, .raw = raw});
  for (CaseEntry& entry : given) {
    entry.where = option;
    entry.line = 0;
    entry.is_option = true;
    std::erase_if(entries_, [&](const CaseEntry& old) { return old.key == entry.key || lies_in(old.key, entry.key); });
    entries_.push_back(std::move(entry));
  }
}

CaseFile CaseFile::part(std::span<const std::string_view> keys) const {
  CaseFile part = *this;
  std::erase_if(part.entries_, [&](const CaseEntry& entry) {
    return std::none_of(keys.begin(), keys.end(),
                        [&](std::string_view key) { return entry.key == key || lies_in(entry.key, key); });
  });
  return part;
}

CaseFile CaseFile::without(std::string_view key) const {
  CaseFile rest = *this;
  std::erase_if(rest.entries_, [&](const CaseEntry& entry) { return entry.key == key; });
  return rest;
}

const CaseEntry* CaseFile::find(std::string_view key) const {
  const auto entry =
      std::find_if(entries_.begin(), entries_.end(), [&](const CaseEntry& candidate) { return candidate.key == key; });
  return entry == entries_.end() ? nullptr : &*entry;
}

std::size_t CaseFile::tables(std::string_view key) const {
  std::set<std::size_t> numbers;
  for (const CaseEntry& entry : entries_) {
    if (!lies_in(entry.key, key)) continue;
    const std::string_view rest = std::string_view(entry.key).substr(key.size() + 1);
    const std::string_view part = rest.substr(0, rest.find('.'));
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), number);
    if (error == std::errc() && end == part.data() + part.size() && part.front() != '0') numbers.insert(number);
  }
  std::size_t count = 0;
  while (numbers.contains(count + 1)) ++count;
  return count;
}

bool lies_in(std::string_view key, std::string_view table) {
  return table.empty() || (key.size() > table.size() && key.starts_with(table) && key[table.size()] == '.');
}

std::string_view table_of(std::string_view key) {
  const std::size_t dot = key.rfind('.');
  return dot == std::string_view::npos ? std::string_view{} : key.substr(0, dot);
}

std::string_view last_part(std::string_view key) {
  return key.substr(key.rfind('.') + 1);  // npos + 1 is 0
}

}  // namespace talus

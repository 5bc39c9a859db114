// SPDX-License-Identifier: Apache-2.0
#include "io/parameter_writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>

#include "base/terminal.hpp"
#include "base/unit.hpp"

namespace talus {

namespace {

/// A value for people: no quotes, the unit apart.
std::string plain_text(const DescribedParameter& item) {
  const std::string unit = unit_name(item.parameter.dimension);
  const auto number = [&](double value) {
    const std::string text = format_quantity(value, unit);
    return text.substr(0, text.find(' '));
  };
  if (std::holds_alternative<std::monostate>(item.value)) return "-";
  if (const auto* text = std::get_if<std::string>(&item.value)) return printable(*text);
  if (const auto* value = std::get_if<double>(&item.value)) return number(*value);
  if (const auto* values = std::get_if<std::vector<double>>(&item.value)) {
    std::vector<std::string> texts;
    std::transform(values->begin(), values->end(), std::back_inserter(texts), number);
    return fmt::format("[{}]", fmt::join(texts, ", "));
  }
  return toml_text(item.parameter, item.value);
}

bool is_excluded(std::string_view key, std::span<const std::string_view> excluded) {
  return std::any_of(excluded.begin(), excluded.end(),
                     [&](std::string_view other) { return key == other || lies_in(key, other); });
}

}  // namespace

std::string resolved_case(const ParameterList& all) {
  const ParameterList list = all.that_hold();
  std::string text;
  for (const std::string_view table : list.tables()) {  // the top-level keys first, as TOML requires
    if (!table.empty()) text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", table);
    for (const DescribedParameter& item : list) {
      if (table_of(item.parameter.key) != table) continue;
      const std::string_view name = last_part(item.parameter.key);
      if (std::holds_alternative<std::monostate>(item.value))
        text += fmt::format("# {} is not given\n", name);
      else
        text += fmt::format("{} = {}\n", name, toml_text(item.parameter, item.value));
    }
  }
  return text;
}

std::map<std::string, std::string> resolved_values(std::string_view resolved_case) {
  std::map<std::string, std::string> values;
  std::string table;
  while (!resolved_case.empty()) {
    const std::string_view line = resolved_case.substr(0, resolved_case.find('\n'));
    resolved_case.remove_prefix(std::min(line.size() + 1, resolved_case.size()));
    const std::size_t equals = line.find(" = ");
    if (line.starts_with('['))
      table = std::string(line.substr(1, line.size() - 2)) + ".";
    else if (!line.starts_with('#') && equals != std::string_view::npos)
      values[table + std::string(line.substr(0, equals))] = line.substr(equals + 3);
  }
  return values;
}

std::vector<ResolvedLine> resolved_table(const ParameterList& list, const CaseFile& file) {
  std::vector<ResolvedLine> lines;
  for (const DescribedParameter& item : list) {
    if (!item.parameter.condition.holds) continue;
    const CaseEntry* entry = file.find(item.parameter.key);
    lines.push_back({.key = item.parameter.key,
                     .value = plain_text(item),
                     .unit = unit_name(item.parameter.dimension),
                     .origin = !entry             ? "default"
                               : entry->is_option ? "option"
                                                  : "given",
                     .text = std::string(item.parameter.text)});
  }
  return lines;
}

std::string digest(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return fmt::format("{:016x}", hash);
}

std::string fingerprint(const ParameterList& list, std::span<const std::string_view> excluded) {
  std::vector<std::string> lines;
  for (const DescribedParameter& item : list)
    if (item.parameter.condition.holds && !is_excluded(item.parameter.key, excluded))
      lines.push_back(fmt::format("{} = {}\n", item.parameter.key, toml_text(item.parameter, item.value)));
  std::sort(lines.begin(), lines.end());
  return digest(fmt::format("{}", fmt::join(lines, "")));
}

}  // namespace talus

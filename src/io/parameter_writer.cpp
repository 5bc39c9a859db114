// SPDX-License-Identifier: Apache-2.0
#include "io/parameter_writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/text.hpp"
#include "base/unit.hpp"
#include "io/case_file.hpp"
#include "io/json.hpp"

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

namespace {

// A number, then something that can begin a unit. The look-ahead keeps "5e3" from being 5 of a unit "e3".
constexpr std::string_view quantity_pattern =
    R"(^\s*[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?(?![eE][-+]?[0-9])\s*(1\s*/|[A-Za-zµμ°/(]).*$)";

void add_bounds(Json& schema, const Range& range) {
  const auto bound = [&](const char* inclusive, const char* exclusive, double value, bool is_excluded) {
    if (!std::isfinite(value)) return;
    const char* name = is_excluded ? exclusive : inclusive;
    if (schema["type"] == "integer" && std::abs(value) <= 9e15 && value == std::floor(value))
      schema[name] = static_cast<std::int64_t>(value);
    else
      schema[name] = value;
  };
  bound("minimum", "exclusiveMinimum", range.min, range.min_excluded);
  bound("maximum", "exclusiveMaximum", range.max, range.max_excluded);
}

Json schema_of_one(const Parameter& parameter, const ValueType& type) {
  switch (type.kind) {
    case ValueType::Kind::number: {
      if (parameter.dimension != dimension::none) return {{"type", "string"}, {"pattern", quantity_pattern}};
      Json schema = {{"type", "number"}};
      add_bounds(schema, parameter.range);
      return schema;
    }
    case ValueType::Kind::integer: {
      Json schema = {{"type", "integer"}};
      add_bounds(schema, parameter.range);
      return schema;
    }
    case ValueType::Kind::flag:
      return {{"type", "boolean"}};
    case ValueType::Kind::text:
      return {{"type", "string"}};
    case ValueType::Kind::choice:
      return {{"type", "string"}, {"enum", type.choices}};
  }
  return {};
}

Json to_json(const Parameter& parameter, const ParameterValue& value) {
  const auto number = [&](double x) -> Json {
    if (parameter.dimension == dimension::none) return x;
    return format_quantity(x, unit_name(parameter.dimension));
  };
  if (const auto* values = std::get_if<std::vector<double>>(&value)) {
    Json array = Json::array();
    for (const double x : *values) array.push_back(number(x));
    return array;
  }
  if (const auto* x = std::get_if<double>(&value)) return number(*x);
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return *integer;
  if (const auto* flag = std::get_if<bool>(&value)) return *flag;
  return {};
}

Json schema_of(const DescribedParameter& item) {
  const auto& [parameter, type, value] = item;
  Json schema = schema_of_one(parameter, type);
  if (type.shape != ValueType::Shape::one) schema = {{"type", "array"}, {"items", schema}};
  if (type.shape == ValueType::Shape::three) schema["minItems"] = schema["maxItems"] = 3;
  schema["description"] = fmt::format("{}: {}", parameter.text, allowed_text(parameter, type));
  if (!parameter.required && !std::holds_alternative<std::monostate>(value))
    schema["default"] = to_json(parameter, value);
  return schema;
}

Json object() {
  return {{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
}

/// Whether it represents the tables of an array: "plates.1".
bool is_of_array(std::string_view table) {
  return !table_of(table).empty() && last_part(table) == "1";
}

/// The schema of a table, made with the tables around it where it is not there yet.
Json& schema_of_table(Json& schema, std::string_view table) {
  if (table.empty()) return schema;
  if (is_of_array(table)) {
    Json& array =
        schema_of_table(schema, table_of(table_of(table)))["properties"][std::string(last_part(table_of(table)))];
    if (array.is_null()) array = {{"type", "array"}, {"items", object()}};
    return array["items"];
  }
  Json& inner = schema_of_table(schema, table_of(table))["properties"][std::string(last_part(table))];
  if (inner.is_null()) inner = object();
  return inner;
}

void require(Json& root, std::string_view key) {
  Json& required = schema_of_table(root, table_of(key))["required"];
  const std::string name(last_part(key));
  if (std::find(required.begin(), required.end(), name) == required.end()) required.push_back(name);
  if (!table_of(key).empty() && !is_of_array(table_of(key)))
    require(root, table_of(key));  // a table with a required key is required
}

std::string in_cell(std::string_view text) {
  std::string result;
  for (const char c : text) result += c == '|' ? "\\|" : std::string(1, c);
  return result;
}

std::string allowed_cell(const DescribedParameter& item) {
  if (item.type.kind != ValueType::Kind::choice) return range_text(item.parameter);
  return fmt::format("`{}`", fmt::join(item.type.choices, "`, `"));
}

std::string default_cell(const DescribedParameter& item) {
  if (item.parameter.required) return "**required**";
  if (std::holds_alternative<std::monostate>(item.value)) return "none";
  return fmt::format("`{}`", toml_text(item.parameter, item.value));
}

std::string type_cell(const ValueType& type, const Parameter& parameter) {
  std::string text = type.kind == ValueType::Kind::choice ? "choice" : type_text(parameter, {.kind = type.kind});
  for (const std::string_view article : {"a ", "an "})
    if (text.starts_with(article)) text.erase(0, article.size());
  if (type.kind == ValueType::Kind::text) text = "text";
  if (type.shape == ValueType::Shape::three) text = "3 × " + text;
  if (type.shape == ValueType::Shape::any) text = "n × " + text;
  return text;
}

}  // namespace

std::string json_schema(const ParameterList& defaults, std::string_view title) {
  Json root = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  root.update(object());
  for (const DescribedParameter& item : defaults) {
    const std::string& key = item.parameter.key;
    schema_of_table(root, table_of(key))["properties"][std::string(last_part(key))] = schema_of(item);
    if (item.parameter.required) require(root, key);
  }
  return root.dump(2) + "\n";
}

std::string reference_page(const ParameterList& defaults) {
  std::string page;
  for (const std::string_view table : defaults.tables()) {
    const std::string head = table.empty()        ? "Top level"
                             : is_of_array(table) ? fmt::format("[[{}]]", table_of(table))
                                                  : fmt::format("[{}]", table);
    page += fmt::format("{}## {}\n\n", page.empty() ? "" : "\n", head);
    page += "| key | type | unit | allowed | default | meaning |\n|---|---|---|---|---|---|\n";
    for (const DescribedParameter& item : defaults)
      if (table_of(item.parameter.key) == table)
        page += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", last_part(item.parameter.key),
                            type_cell(item.type, item.parameter), unit_name(item.parameter.dimension),
                            in_cell(allowed_cell(item)), in_cell(default_cell(item)), in_cell(item.parameter.text));
  }
  return page;
}

}  // namespace talus

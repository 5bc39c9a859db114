// SPDX-License-Identifier: Apache-2.0
#include "app/comparison/reference.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <stdexcept>

#include "analysis/measure.hpp"
#include "app/comparison/project.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "base/unit.hpp"
#include "io/file.hpp"
#include "io/parameter_value.hpp"

namespace talus::app {

namespace {

/// Reads values of a table and remembers every problem.
class Reader {
 public:
  explicit Reader(std::string path) : path_(std::move(path)) {}

  void fault(const toml::node& node, const std::string& key, const std::string& what, const std::string& allowed = {},
             const std::string& nearest = {}) {
    problems_.push_back({.where = path_,
                         .line = static_cast<int>(node.source().begin.line),
                         .key = key,
                         .what = what,
                         .allowed = allowed,
                         .nearest = nearest});
  }

  template <class T>
  T get(const toml::table& table, const char* key, const char* allowed) {
    const toml::node* node = table.get(key);
    if (!node) {
      fault(table, key, "missing", allowed);
      return {};
    }
    if (const auto value = node->value<T>()) return *value;
    fault(*node, key, "is of another type", allowed);
    return {};
  }
  std::string text(const toml::table& table, const char* key) { return get<std::string>(table, key, "text"); }

  void throw_problems() const {
    if (!problems_.empty()) throw InputError(problems_);
  }

 private:
  std::string path_;
  std::vector<Problem> problems_;
};

std::string setting_text(const toml::node& value) {
  if (const auto text = value.value<std::string>()) return talus::quoted(*text);
  if (const auto flag = value.as_boolean()) return flag->get() ? "true" : "false";
  if (const auto whole = value.as_integer()) return std::to_string(whole->get());
  return number_text(value.value_or(std::numeric_limits<double>::quiet_NaN()));
}

Settings read_settings(const toml::table* table) {
  Settings settings;
  if (table)
    for (const auto& [key, value] : *table) settings.emplace_back(key.str(), setting_text(value));
  return settings;
}

ReferenceCase read_case(Reader& reader, const std::string& name, const toml::table& table) {
  ReferenceCase c{.name = name, .file = reader.text(table, "file"), .where = {}, .variants = {}};
  c.where = read_settings(table["where"].as_table());
  const toml::array* told_by = table["told_by"].as_array();
  const auto tells = [&](std::string_view key) {
    return !told_by || std::any_of(told_by->begin(), told_by->end(),
                                   [&](const toml::node& one) { return one.value<std::string_view>() == key; });
  };
  if (const toml::table* variants = table[table.contains("variant") ? "variant" : "radius"].as_table())
    for (const auto& [label, settings] : *variants) {
      ReferenceCase::Variant variant{.label = std::string(label.str()), .settings = {}, .told_by = {}};
      variant.settings = read_settings(settings.as_table());
      for (const auto& setting : variant.settings)
        if (tells(setting.first)) variant.told_by.push_back(setting);
      c.variants.push_back(std::move(variant));
    }
  return c;
}

QuickStudy read_quick(Reader& reader, const toml::table& file) {
  QuickStudy quick;
  const toml::table* table = file["quick"].as_table();
  if (!table) return quick;
  quick.members = static_cast<int>((*table)["members"].value_or(std::int64_t{1}));
  if (const toml::array* variants = (*table)["variants"].as_array())
    for (const toml::node& label : *variants) quick.variants.push_back(label.value_or(std::string()));
  if (quick.variants.empty()) reader.fault(*table, "quick", "has no variants", "labels of variants");
  quick.settings = read_settings((*table)["settings"].as_table());
  return quick;
}

Criterion read_criterion(Reader& reader, const toml::table& row) {
  using Kind = Criterion::Kind;
  const toml::table* table = row["criterion"].as_table();
  static constexpr const char* allowed = "between, value and within, above, below, sign or reported";
  if (!table) {
    reader.fault(row, "criterion", "missing", allowed);
    return {};
  }
  if (const toml::array* between = (*table)["between"].as_array(); between && between->size() == 2)
    return {Kind::between, between->get(0)->value_or(0.0), between->get(1)->value_or(0.0)};
  if (table->contains("value"))
    return {Kind::within, reader.get<double>(*table, "value", "a number"),
            reader.get<double>(*table, "within", "a number")};
  if (table->contains("above")) return {Kind::above, reader.get<double>(*table, "above", "a number"), 0};
  if (table->contains("below")) return {Kind::below, reader.get<double>(*table, "below", "a number"), 0};
  if (const auto sign = (*table)["sign"].value<std::string>()) {
    if (*sign == "+") return {Kind::positive, 0, 0};
    if (*sign == "-") return {Kind::negative, 0, 0};
  }
  if ((*table)["reported"].value_or(false)) return {Kind::reported, 0, 0};
  reader.fault(*table, "criterion", "is none that can be evaluated", allowed);
  return {};
}

Window read_window(Reader& reader, const toml::table& row) {
  const toml::table* table = row["window"].as_table();
  if (!table) return {};
  Window window;
  auto time = [&](const char* key) {
    const toml::node* node = table->get(key);
    if (node->value<std::string>() == "end") return Window::end_of_run;
    if (const auto value = node->value<double>()) return *value;
    reader.fault(*node, "window", "is not a time", "a number of a/v_s, or \"end\"");
    return 0.0;
  };
  if (table->contains("at")) window.at = time("at");
  if (table->contains("from")) window.from = time("from");
  if (table->contains("to")) window.to = time("to");
  return window;
}

Place read_place(Reader& reader, const toml::table& row) {
  Place place;
  if (const toml::table* table = row["place"].as_table())
    for (const auto& [key, value] : *table) {
      const auto text = value.value<std::string>();
      const auto length = text ? parse_quantity(*text) : std::nullopt;
      if (length && length->dimension == dimension::length)
        place.emplace(key.str(), length->value);
      else
        reader.fault(value, "place", std::string(key.str()) + " is not a length (unit missing?)",
                     "lengths, such as \"120 mm\"");
    }
  return place;
}

template <class Enumeration, std::size_t n>
Enumeration read_name(Reader& reader, const toml::table& row, const char* key,
                      const std::pair<const char*, Enumeration> (&names)[n]) {
  const std::string text = reader.text(row, key);
  std::string allowed;
  for (const auto& [name, value] : names) {
    if (text == name) return value;
    allowed += (allowed.empty() ? "" : ", ") + std::string(name);
  }
  reader.fault(*row.get(key), key, "\"" + text + "\" is not known", allowed);
  return names[0].second;
}

constexpr auto row_keys =
    std::to_array<std::string_view>({"id", "number", "quantity", "case", "radius", "variant", "needs_air", "estimator",
                                     "from", "statistic", "window", "place", "printed", "unit", "criterion", "source"});

ComparisonRow read_row(Reader& reader, const toml::table& table) {
  ComparisonRow row;
  for (const auto& [key, value] : table)
    if (std::find(row_keys.begin(), row_keys.end(), key.str()) == row_keys.end())
      reader.fault(value, std::string(key.str()), "unknown key", {}, std::string(nearest(key.str(), row_keys)));
  row.id = reader.text(table, "id");
  row.number = static_cast<int>(reader.get<std::int64_t>(table, "number", "a whole number"));
  row.quantity = reader.text(table, "quantity");
  row.case_name = reader.text(table, "case");
  if (const toml::array* variants = table[table.contains("variant") ? "variant" : "radius"].as_array())
    for (const toml::node& label : *variants) row.variants.push_back(label.value_or(std::string()));
  row.estimator = reader.text(table, "estimator");
  if (table.contains("from"))
    row.from = read_name<From>(reader, table, "from",
                               {{"each", From::each},
                                {"curves", From::curves},
                                {"values", From::values},
                                {"radii", From::variants},
                                {"variants", From::variants},
                                {"case", From::parameters}});
  if (table.contains("statistic"))
    row.statistic = read_name<Statistic>(reader, table, "statistic",
                                         {{"mean", Statistic::mean},
                                          {"median", Statistic::median},
                                          {"standard_deviation", Statistic::standard_deviation},
                                          {"ratio", Statistic::ratio},
                                          {"difference", Statistic::difference}});
  row.window = read_window(reader, table);
  row.place = read_place(reader, table);
  row.printed = table["printed"].value<std::string>().value_or(fmt::format("{}", table["printed"].value_or(0.0)));
  row.unit = reader.text(table, "unit");
  row.criterion = read_criterion(reader, table);
  row.source = reader.text(table, "source");
  return row;
}

/// The measure of a row and its unit; those of a study are checked by it.
void check_measure(Reader& reader, const toml::node& node, bool has_study_measures, ComparisonRow& row) {
  const std::optional<MeasureText> measure = find_measure(row.quantity);
  const bool of_several =
      row.from == From::curves || row.from == From::values || (row.from == From::variants && !is_of_two(row.statistic));
  if (of_several && !has_study_measures)
    reader.fault(node, "from", "takes several runs together, which only a study measures",
                 "a measures.py beside the file");
  row.of_study = has_study_measures && (!measure || of_several);
  if (row.of_study) return;
  if (!measure) {
    const std::vector<MeasureText> known = all_measures();
    std::vector<std::string_view> names;
    for (const MeasureText& text : known) names.push_back(text.name);
    reader.fault(node, "quantity", "there is no quantity \"" + row.quantity + "\"", "a name of docs/quantities.md",
                 std::string(nearest(row.quantity, names)));
    return;
  }
  const std::string_view unit = row.statistic == Statistic::ratio ? "1" : measure->unit;
  if (row.unit != unit) reader.fault(node, "unit", "is not that of " + row.quantity, std::string(unit));
  for (const auto& [length, value] : row.place)
    reader.fault(node, "place", row.quantity + " takes no " + length, "no place");
}

/// The folder of the study's measures.py: the reference's, or that of the study in validation/; empty if there is none.
std::filesystem::path measures_of(const std::filesystem::path& reference, const std::string& study) {
  static constexpr const char* name = "measures.py";
  const std::filesystem::path folder = reference.has_parent_path() ? reference.parent_path() : ".";
  if (std::filesystem::exists(folder / name)) return folder;
  const auto of_study = std::filesystem::path("validation") / std::filesystem::path(study).filename() / name;
  const auto project = find_project(of_study);
  return project ? (*project / of_study).parent_path() : std::filesystem::path();
}

}  // namespace

const ReferenceCase* Reference::find_case(const std::string& name) const {
  const auto found = std::find_if(cases.begin(), cases.end(), [&](const ReferenceCase& c) { return c.name == name; });
  return found == cases.end() ? nullptr : &*found;
}

Reference read_reference(const std::string& path) {
  toml::table file;
  try {
    file = toml::parse(read_whole_file(path), path);
  } catch (const toml::parse_error& error) {
    throw InputError({{.where = path,
                       .line = static_cast<int>(error.source().begin.line),
                       .column = static_cast<int>(error.source().begin.column),
                       .what = std::string(error.description())}});
  }
  Reader reader(path);
  Reference reference{.path = path,
                      .study = reader.text(file, "study"),
                      .title = reader.text(file, "title"),
                      .source = reader.text(file, "source"),
                      .members = static_cast<int>(file["members"].value_or(std::int64_t{1})),
                      .quick = read_quick(reader, file),
                      .cases = {},
                      .rows = {}};
  if (const toml::table* cases = file["case"].as_table())
    for (const auto& [name, table] : *cases)
      if (table.is_table()) reference.cases.push_back(read_case(reader, std::string(name.str()), *table.as_table()));
  reference.measures = measures_of(path, reference.study);
  std::set<std::string> ids;
  if (const toml::array* rows = file["row"].as_array())
    for (const toml::node& node : *rows) {
      if (!node.is_table()) continue;
      reference.rows.push_back(read_row(reader, *node.as_table()));
      ComparisonRow& row = reference.rows.back();
      if (!ids.insert(row.id).second) reader.fault(node, "id", "\"" + row.id + "\" stands twice");
      row.line = static_cast<int>(node.source().begin.line);
      check_measure(reader, node, !reference.measures.empty(), row);
      const ReferenceCase* c = reference.find_case(row.case_name);
      if (!c) reader.fault(node, "case", "there is no [case." + row.case_name + "]");
      for (const std::string& label : row.variants)
        if (c && std::none_of(c->variants.begin(), c->variants.end(),
                              [&](const auto& variant) { return variant.label == label; }))
          reader.fault(node, "variant", "[case." + row.case_name + "] has no variant \"" + label + "\"");
      if (row.variants.empty()) reader.fault(node, "variant", "missing", "labels of the case's variants");
    }
  if (reference.rows.empty()) reader.fault(file, "row", "there are no rows", "[[row]] tables");
  reader.throw_problems();
  return reference;
}

}  // namespace talus::app

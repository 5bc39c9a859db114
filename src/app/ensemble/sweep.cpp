// SPDX-License-Identifier: Apache-2.0
#include "app/ensemble/sweep.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/error.hpp"
#include "base/text.hpp"
#include "base/unit.hpp"
#include "io/file.hpp"

namespace talus::app {

namespace {

constexpr std::size_t line_width = 100;

/// In the unit of its dimension that Talus writes, without it.
std::string number_of(const Quantity& quantity) {
  const std::string text = format_quantity(quantity.value, unit_name(quantity.dimension));
  return text.substr(0, text.find(' '));
}

bool has_deviations(const std::vector<SweptGroup>& groups) {
  return std::any_of(groups.begin(), groups.end(), [](const SweptGroup& swept) {
    return std::any_of(swept.spreads.begin(), swept.spreads.end(),
                       [](const QuantitySpread& spread) { return spread.values.size() > 1; });
  });
}

/// Characters on a terminal: bytes of UTF-8 other than continuation bytes.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](const char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t columns) {
  return std::string(columns - std::min(columns, width(text)), ' ') + text;
}

/// A cell of a CSV file.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string name_with_unit(const std::string& name, const std::string& unit) {
  return fmt::format("{} [{}]", name, unit.empty() ? "1" : unit);
}

std::string csv_text(const std::vector<SweptGroup>& groups) {
  const auto quantities = all_quantities(groups);
  const bool deviations = has_deviations(groups);
  std::string text;
  for (const Setting& setting : settings_of(*groups.front().group))
    text +=
        quoted(setting.quantity ? name_with_unit(setting.key, unit_name(setting.quantity->dimension)) : setting.key) +
        ",";
  text += "members";
  for (const QuantitySpread* q : quantities) {
    text += "," + name_with_unit(q->name, q->unit);
    if (deviations) text += "," + name_with_unit(q->name + "_deviation", q->unit);
  }
  for (const SweptGroup& swept : groups) {
    text += "\n";
    for (const Setting& setting : settings_of(*swept.group))
      text += (setting.quantity ? number_of(*setting.quantity) : quoted(setting.text)) + ",";
    std::size_t members = 0;
    for (const QuantitySpread& spread : swept.spreads) members = std::max(members, spread.values.size());
    text += fmt::format("{}", members);
    for (const QuantitySpread* q : quantities) {
      const QuantitySpread* spread = find_quantity(swept, q->name);
      text += fmt::format(",{}", spread ? spread->mean : std::nan(""));
      if (deviations) text += fmt::format(",{}", spread ? spread->deviation : std::nan(""));
    }
  }
  return text + "\n";
}

std::string json_text(const std::vector<SweptGroup>& groups) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const SweptGroup& swept : groups) {
    nlohmann::ordered_json entry;
    entry["group"] = swept.group->name;
    for (const Setting& setting : settings_of(*swept.group)) {
      auto& varied = entry["settings"][setting.key];
      varied["text"] = setting.text;
      if (!setting.quantity) continue;
      varied["value"] = std::stod(number_of(*setting.quantity));
      varied["unit"] = unit_name(setting.quantity->dimension);
    }
    auto& quantities = entry["quantities"] = nlohmann::ordered_json::object();
    for (const QuantitySpread& spread : swept.spreads) {
      if (spread.values.empty()) continue;
      auto& quantity = quantities[spread.name];
      quantity["mean"] = spread.mean;
      if (spread.values.size() > 1) quantity["standard_deviation"] = spread.deviation;
      quantity["members"] = spread.values.size();
      quantity["unit"] = spread.unit;
    }
    json.push_back(std::move(entry));
  }
  return json.dump(2) + "\n";
}

}  // namespace

std::vector<Setting> settings_of(const EnsembleGroup& group) {
  std::vector<Setting> settings;
  for (const std::string& setting : group.settings) {
    const std::size_t equals = setting.find('=');
    const std::string text = setting.substr(equals + 1);
    settings.push_back({setting.substr(0, equals), text, parse_quantity(text)});
  }
  return settings;
}

std::vector<const QuantitySpread*> all_quantities(const std::vector<SweptGroup>& groups) {
  std::vector<const QuantitySpread*> all;
  for (const SweptGroup& swept : groups)
    for (const QuantitySpread& spread : swept.spreads)
      if (!spread.values.empty() &&
          std::none_of(all.begin(), all.end(), [&](const QuantitySpread* known) { return known->name == spread.name; }))
        all.push_back(&spread);
  return all;
}

const QuantitySpread* find_quantity(const SweptGroup& swept, const std::string& name) {
  for (const QuantitySpread& spread : swept.spreads)
    if (spread.name == name && !spread.values.empty()) return &spread;
  return nullptr;
}

std::string mean_and_deviation(const QuantitySpread& spread) {
  if (spread.values.empty()) return "-";
  return spread.values.size() == 1 ? fmt::format("{:.6g}", spread.mean)
                                   : fmt::format("{:.6g} ± {:.3g}", spread.mean, spread.deviation);
}

std::string sweep_text(const std::vector<SweptGroup>& groups) {
  const auto quantities = all_quantities(groups);
  std::vector<std::string> names;
  std::size_t first = 0;
  for (const QuantitySpread* q : quantities) {
    names.push_back(q->unit == "1" ? q->name : name_with_unit(q->name, q->unit));
    first = std::max(first, width(names.back()));
  }
  struct Column {
    std::vector<std::string> cells;
    std::size_t width = 0;
  };
  std::vector<Column> columns;
  for (const SweptGroup& swept : groups) {
    Column column{.cells = {swept.group->name}};
    for (const QuantitySpread* q : quantities) {
      const QuantitySpread* spread = find_quantity(swept, q->name);
      column.cells.push_back(spread ? mean_and_deviation(*spread) : "-");
    }
    for (const std::string& cell : column.cells) column.width = std::max(column.width, width(cell));
    columns.push_back(std::move(column));
  }
  std::string text;
  for (std::size_t begin = 0, end; begin < columns.size(); begin = end) {
    std::size_t used = first;
    for (end = begin; end < columns.size() && (end == begin || used + 2 + columns[end].width <= line_width); ++end)
      used += 2 + columns[end].width;
    for (std::size_t row = 0; row <= names.size(); ++row) {
      const std::string name = row == 0 ? "" : names[row - 1];
      text += name + std::string(first - width(name), ' ');
      for (std::size_t c = begin; c < end; ++c) text += "  " + padded(columns[c].cells[row], columns[c].width);
      text += "\n";
    }
    if (end < columns.size()) text += "\n";
  }
  return text;
}

void write_sweep(const std::vector<SweptGroup>& groups, const std::filesystem::path& folder) {
  write_atomically(folder / "sweep.csv", csv_text(groups));
  write_atomically(folder / "sweep.json", json_text(groups));
}

void check_quantities(const std::vector<std::string>& asked, const std::vector<std::string>& known) {
  const std::vector<std::string_view> names(known.begin(), known.end());
  std::vector<Problem> problems;
  for (const std::string& name : asked)
    if (std::find(names.begin(), names.end(), name) == names.end())
      problems.push_back({.where = "--plot " + name,
                          .what = "no member has such a quantity",
                          .allowed = fmt::format("{}", fmt::join(names, ", ")),
                          .nearest = std::string(nearest(name, names))});
  if (!problems.empty()) throw InputError(problems);
}

}  // namespace talus::app

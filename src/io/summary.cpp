// SPDX-License-Identifier: Apache-2.0
#include "io/summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "io/json.hpp"

namespace talus {

namespace {

constexpr const char* not_a_number = "not a number";
constexpr const char* infinite = "infinite";
constexpr const char* minus_infinity = "minus infinity";

double value_of(const Json& entry) {
  if (!entry.at("value").is_null()) return entry.at("value").get<double>();
  const std::string reason = entry.at("reason");
  if (reason == infinite) return std::numeric_limits<double>::infinity();
  if (reason == minus_infinity) return -std::numeric_limits<double>::infinity();
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

const NamedValue* Summary::find(std::string_view name) const {
  const auto found =
      std::find_if(quantities.begin(), quantities.end(), [&](const NamedValue& s) { return s.name == name; });
  return found == quantities.end() ? nullptr : &*found;
}

void write_summary(const std::filesystem::path& path, const Summary& summary) {
  Json quantities = Json::object();
  for (const NamedValue& quantity : summary.quantities) {
    if (quantities.contains(quantity.name)) throw std::invalid_argument("summary: " + quantity.name + " stands twice");
    Json entry{{"value", quantity.value}, {"unit", quantity.unit}};  // a value that is not finite is written as null
    if (!std::isfinite(quantity.value))
      entry["reason"] = std::isnan(quantity.value) ? not_a_number : quantity.value > 0 ? infinite : minus_infinity;
    quantities[quantity.name] = std::move(entry);
  }
  Json regime = Json::array();
  for (const RegimeLine& line : summary.regime)
    regime.push_back(
        {{"quantity", line.quantity}, {"value", line.value}, {"meaning", line.meaning}, {"warning", line.warning}});
  Json key_results = Json::array();
  for (const Answer& answer : summary.answers) {
    key_results.push_back({{"title", answer.question}, {"value", answer.answer}});
    if (!answer.by_hand.empty()) key_results.back()["estimate"] = answer.by_hand;
  }
  write_json(path, {{"status", summary.status},
                    {"wall_seconds", summary.wall_seconds},
                    {"instruction_set", summary.instruction_set},
                    {"warnings", summary.warnings},
                    {"regime", regime},
                    {"key_results", key_results},
                    {"quantities", quantities}});
}

Summary read_summary(const std::filesystem::path& path) {
  return read_json(path, "a summary", [](const Json& json) {
    Summary summary{.status = json.at("status"),
                    .wall_seconds = json.at("wall_seconds"),
                    .instruction_set = json.value("instruction_set", ""),
                    .quantities = {},
                    .warnings = {},
                    .answers = {},
                    .regime = {}};
    for (const auto& [name, entry] : json.at("quantities").items())
      summary.quantities.push_back({name, entry.at("unit"), value_of(entry)});
    summary.warnings = json.value("warnings", std::vector<std::string>());
    for (const Json& line : json.value("regime", Json::array()))
      summary.regime.push_back(
          {line.at("quantity"), line.at("value"), line.at("meaning"), line.at("warning").get<bool>()});
    for (const Json& line : json.value("key_results", Json::array()))
      summary.answers.push_back({line.at("title"), line.at("value"), line.value("estimate", "")});
    return summary;
  });
}

}  // namespace talus

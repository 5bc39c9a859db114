// SPDX-License-Identifier: Apache-2.0
/// The rows of validation/niiya2020/reference.toml as far as the analysis needs them, read line by line: one "key =
/// value" a line, which the file keeps to.
#pragma once

#include <algorithm>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "analysis/comparison.hpp"

namespace talus::test {

inline std::vector<ComparisonRow> reference_rows() {
  std::ifstream file(TALUS_SOURCE_DIR "/validation/niiya2020/reference.toml");
  const std::map<std::string, From> from = {{"each", From::each},
                                            {"curves", From::curves},
                                            {"values", From::values},
                                            {"radii", From::variants},
                                            {"case", From::parameters}};
  const std::map<std::string, Statistic> statistic = {
      {"mean", Statistic::mean}, {"median", Statistic::median}, {"standard_deviation", Statistic::standard_deviation}};
  std::vector<ComparisonRow> rows;
  for (std::string line; std::getline(file, line);) {
    if (line == "[[row]]") rows.emplace_back();
    const std::size_t equals = line.find(" = ");
    if (rows.empty() || equals == std::string::npos) continue;
    const std::string key = line.substr(0, equals);
    std::string value = line.substr(equals + 3);
    auto number_after = [&](const std::string& name) {
      const std::string rest = value.substr(value.find(name + " = ") + name.size() + 3);
      return rest.starts_with('"') ? Window::end_of_run : std::stod(rest);
    };
    if (key == "window") {
      if (value.find("at = ") != std::string::npos)
        rows.back().window = {.at = number_after("at")};
      else
        rows.back().window = {.from = number_after("from"), .to = number_after("to")};
      continue;
    }
    std::erase(value, '"');
    if (key == "id") rows.back().id = value;
    if (key == "quantity") rows.back().quantity = value;
    if (key == "case") rows.back().case_name = value;
    if (key == "number") rows.back().number = std::stoi(value);
    if (key == "unit") rows.back().unit = value;
    if (key == "from") rows.back().from = from.at(value);
    if (key == "statistic") rows.back().statistic = statistic.at(value);
  }
  return rows;
}

}  // namespace talus::test

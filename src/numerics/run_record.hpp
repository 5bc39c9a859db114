// SPDX-License-Identifier: Apache-2.0
/// Series, numbers, key results and warnings of a run: what files keep of it and its validity report judges it by.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// Numbers of a whole system over time: one column per quantity, one row per step.
struct Series {
  std::vector<std::string> names;            ///< unique
  std::vector<std::string> units;            ///< SI, one per column; "1" for numbers
  std::vector<std::vector<double>> columns;  ///< all of the same length

  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
  bool has(std::string_view name) const;
  /// \throws std::out_of_range naming the column and those that are there
  std::span<const double> column(std::string_view name) const;
};

/// A number of a whole system: a column of a series, an entry of a summary.
struct NamedValue {
  std::string name;  ///< snake_case, unique within a series or summary
  std::string unit;  ///< SI ("m/s"), "deg" for angles, "1" for numbers
  double value;
};

/// An answer to a question that the user of a case has, in words and with units.
struct Answer {
  std::string question, answer;
  std::string by_hand = {};  ///< the analytical estimate, with its name; empty if there is none
};

/// A remark on whether a case or a run stays within what its laws assume.
struct RegimeLine {
  std::string quantity;  ///< names the warning: it stays
  std::string value;
  std::string meaning;
  bool warning = false;
};

struct RunRecord {
  Series series;                    ///< of all steps
  std::vector<NamedValue> summary;  ///< what the analysis made

  /// Largest value of a column from a time on, those that are none left out; nan if there is none, or no such column.
  double largest(std::string_view column, double from = -std::numeric_limits<double>::infinity()) const;
  /// A number of the summary; nan if it has none of that name.
  double value(std::string_view name) const;
};

/// A line of the validity report that leaves what its law assumes, under a permanent name.
struct Warning {
  std::string id;    ///< of the line's quantity, in small letters with hyphens: "particles-across-the-outlet"
  std::string text;  ///< "particles across the outlet = 5: fewer than 12 are few"
};

/// Of the lines that warn, in their order.
std::vector<Warning> warnings_of(const std::vector<RegimeLine>& lines);

/// "particles-across-the-outlet: particles across the outlet = 5: ..."
std::string to_string(const Warning& warning);

}  // namespace talus

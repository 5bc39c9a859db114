// SPDX-License-Identifier: Apache-2.0
/// Numbers of a whole system: what a series has a column for, and what a summary lists.
#pragma once

#include <string>

namespace talus {

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
  std::string quantity;  ///< names the warning (warning.hpp): it stays
  std::string value;
  std::string meaning;
  bool warning = false;
};

}  // namespace talus

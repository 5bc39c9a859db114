// SPDX-License-Identifier: Apache-2.0
/// summary.json: the numbers in which a run ended.
///
///     {"status": "done", "wall_seconds": 12.3, "instruction_set": "avx2",
///      "warnings": ["mach-number: Mach number = 0.4: ..."],
///      "regime": [{"quantity": "Mach number", "value": "0.4", "meaning": "...", "warning": true}, ...],
///      "key_results": [{"title": "Flow", "value": "has emptied after 2.3 s, 12 g (0.8 %) left", "estimate": "..."},
///      ...], "quantities": {"front_speed_max": {"value": 51.2, "unit": "1"}, ...}}
///
/// JSON has no numbers that are not finite: such a quantity has the value null and a "reason", one of "not a number",
/// "infinite" and "minus infinity". It is written rather than left out, so that a reader sees that it was asked for.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "numerics/named_value.hpp"

namespace talus {

struct Summary {
  std::string status;                       ///< "running", "done", "interrupted" or "failed"
  double wall_seconds = 0;                  ///< s
  std::string instruction_set = {};         ///< of the sum over pairs: the bits belong to it
  std::vector<NamedValue> quantities = {};  ///< names unique
  std::vector<std::string> warnings = {};   ///< where case or run leave what the laws assume, each after its name
  std::vector<Answer> answers = {};         ///< the key results, each beside its analytical estimate
  std::vector<RegimeLine> regime = {};      ///< the card of a run that has ended, those that warn too

  /// \returns null if there is none
  const NamedValue* find(std::string_view name) const;
};

/// \throws FileError with the system's reason; \throws std::invalid_argument if a name occurs twice
void write_summary(const std::filesystem::path& path, const Summary& summary);

/// What was written, not finite values too. \throws FileError
Summary read_summary(const std::filesystem::path& path);

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
#include "numerics/warning.hpp"

#include <cctype>

namespace talus {

namespace {

std::string id_of(const std::string& quantity) {
  std::string id;
  for (const char c : quantity) {
    if (std::isalnum(static_cast<unsigned char>(c)))
      id += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!id.empty() && id.back() != '-')
      id += '-';
  }
  while (!id.empty() && id.back() == '-') id.pop_back();
  return id;
}

}  // namespace

std::vector<Warning> warnings_of(const std::vector<RegimeLine>& lines) {
  std::vector<Warning> warnings;
  for (const RegimeLine& line : lines)
    if (line.warning)
      warnings.push_back({id_of(line.quantity), line.quantity + " = " + line.value + ": " + line.meaning});
  return warnings;
}

std::string to_string(const Warning& warning) {
  return warning.id + ": " + warning.text;
}

}  // namespace talus

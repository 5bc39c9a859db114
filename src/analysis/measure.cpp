// SPDX-License-Identifier: Apache-2.0
#include "analysis/measure.hpp"

namespace talus {

std::vector<MeasureText> all_measures() {
  std::vector<MeasureText> texts = texts_of_hopper_measures();
  for (const MeasureText& text : texts_of_avalanche_measures()) texts.push_back(text);
  return texts;
}

std::optional<MeasureText> find_measure(std::string_view name) {
  for (const MeasureText& text : all_measures())
    if (text.name == name) return text;
  return std::nullopt;
}

}  // namespace talus

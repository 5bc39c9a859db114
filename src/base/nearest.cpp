// SPDX-License-Identifier: Apache-2.0
#include "base/nearest.hpp"

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace talus {

namespace {

std::string folded(std::string_view word) {
  std::string text(word);
  for (char& c : text) c = c == '-' || c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

std::size_t edit_distance(std::string_view first, std::string_view second) {
  const std::string a = folded(first), b = folded(second);
  std::vector<std::size_t> before(b.size() + 1), previous(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(previous);
    previous.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({previous[j] + 1, row[j - 1] + 1, previous[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::optional<std::size_t> typos(std::string_view word, std::string_view candidate) {
  const std::size_t most = 1 + word.size() / 4;
  const bool far_shorter = candidate.size() + most < word.size();  // which would cost their product to find out
  if (far_shorter) return std::nullopt;
  const std::size_t distance = edit_distance(word, candidate);
  const bool begins = word.size() >= 3 && folded(candidate).starts_with(folded(word));
  if (begins) return std::min<std::size_t>(distance, 1);
  return distance <= most ? std::optional(distance) : std::nullopt;
}

std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates) {
  std::string_view best;
  std::optional<std::size_t> least;
  for (const std::string_view candidate : candidates)
    if (const auto count = typos(word, candidate); count && (!least || *count < *least))
      best = candidate, least = count;
  return best;
}

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
/// "Did you mean ...?": the nearest of several words.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace talus {

/// Insertions, deletions, substitutions and swaps of neighbours (optimal string alignment) that turn one word into the
/// other; large and small letters are the same, as are '-', '_' and ' '.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The edit distance, if `word` may be a slip of `candidate`; nothing if they are too far apart. Near is a quarter of
/// the letters and one more; the beginning of the candidate (three letters at least) counts as one slip.
std::optional<std::size_t> typos(std::string_view word, std::string_view candidate);

/// The candidate with the fewest typos; of equals, the first; empty if none is near.
std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
/// Text for people: on a terminal, and "Did you mean ...?". User input (titles, keys, names of files and columns) is
/// printed only by these functions, so that no control character in it can move the cursor, change colours or hide
/// earlier output.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace talus {

/// The control characters of a text that are not escaped.
enum class Controls { none, line_ends };

/// The text with its control characters (C0, DEL, C1), marks that turn the direction of writing, and bytes that are no
/// UTF-8 written as escapes: "\n", "\u001b", "\xff".
std::string printable(std::string_view text, Controls kept = Controls::none);

/// Prints to stdout; lines end where `format` or an argument ends them, other control characters are escaped.
template <class... Arguments>
void print(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  fmt::print(stdout, "{}", printable(fmt::format(format, std::forward<Arguments>(arguments)...), Controls::line_ends));
}

/// The same to stderr.
template <class... Arguments>
void print_error(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  fmt::print(stderr, "{}", printable(fmt::format(format, std::forward<Arguments>(arguments)...), Controls::line_ends));
}

/// Columns of the terminal behind stdout; 100 if it is none.
std::size_t terminal_width();

/// Without the blanks (space, tab, line ends) at both ends.
std::string_view trimmed(std::string_view text);

/// A text in lines of at most `width` columns, broken at blanks, each but the first behind `indent` blanks. A word
/// longer than a line is placed on a line of its own.
/// \param used columns of the first line that are taken already
std::string wrapped(std::string_view text, std::size_t width, std::size_t indent, std::size_t used);

/// Insertions, deletions, substitutions and swaps of neighbours (optimal string alignment) that turn one word into the
/// other; large and small letters are the same, as are '-', '_' and ' '.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The edit distance, if `word` may be a slip of `candidate`; nothing if they are too far apart. Near is a quarter of
/// the letters and one more; the beginning of the candidate (three letters at least) counts as one slip.
std::optional<std::size_t> typos(std::string_view word, std::string_view candidate);

/// The candidate with the fewest typos; of equals, the first; empty if none is near.
std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace talus

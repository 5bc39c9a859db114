// SPDX-License-Identifier: Apache-2.0
/// report.html: the page that web/report builds into one file, filled with data.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// What the page is filled with.
struct ReportContent {
  std::string title;                            ///< plain text
  std::string header;                           ///< JSON; refers to the blocks by number
  std::vector<std::string> blocks;              ///< base64
  std::vector<std::filesystem::path> pictures;  ///< PNG, shown where there is no WebGL
};

/// Whether this program holds the page: its build needs npm.
bool has_report_page();

/// What to install where it does not.
std::string without_report_page();

/// Writes the page, whole or not at all.
/// \throws FileError if this program has no page, if a picture cannot be read, or with the system's reason; also if
///         another file than a report of Talus is there
void write_report(const std::filesystem::path& path, const ReportContent& content);

// Numbers as a report carries them: base64 of a zlib stream, which a browser unpacks by
// DecompressionStream("deflate").

/// Values in frames, each rounded to the nearest of equally spaced levels: value = low + code (high - low)/(levels -
/// 1). The code `levels` is "no value". The stream holds the change of each code since the frame before, modulo 2^16:
/// the low bytes of all, then the high ones.
struct PackedFrames {
  double low = 0, high = 0;
  int levels = 0;
  std::string text;
};

/// \param values frame after frame, `per_frame` each; what is not finite has no value
/// \param levels 2 to 65535
/// \throws std::invalid_argument for other levels, or values that are no whole frames
PackedFrames pack_frames(std::span<const float> values, std::size_t per_frame, int levels);

/// In single precision: the first bytes of all values, then the second ones, ...; little endian.
std::string pack_numbers(std::span<const double> values);

/// RFC 4648, section 4.
std::string base64(std::string_view bytes);

}  // namespace talus

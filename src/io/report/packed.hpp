// SPDX-License-Identifier: Apache-2.0
/// Numbers as a report carries them: base64 of a zlib stream, which a browser unpacks by
/// DecompressionStream("deflate").
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace talus {

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

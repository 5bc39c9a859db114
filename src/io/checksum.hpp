// SPDX-License-Identifier: Apache-2.0
/// The checksum of Talus's files, crc32 (IEEE 802.3): it finds every single turned bit and every torn stretch of up to
/// 32 bits, and misses one in 2^32 of other changes. It is no protection against intent.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace talus {

/// \param before the checksum of what stands before these bytes
std::uint32_t checksum(std::string_view bytes, std::uint32_t before = 0);

/// Of a whole file. \throws FileError
std::uint32_t checksum_of_file(const std::filesystem::path& path);

}  // namespace talus

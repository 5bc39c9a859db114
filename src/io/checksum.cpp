// SPDX-License-Identifier: Apache-2.0
#include "io/checksum.hpp"

#include <zlib.h>

#include "io/atomic_file.hpp"

namespace talus {

std::uint32_t checksum(std::string_view bytes, std::uint32_t before) {
  return static_cast<std::uint32_t>(crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::uint32_t checksum_of_file(const std::filesystem::path& path) {
  return checksum(read_whole_file(path));
}

}  // namespace talus

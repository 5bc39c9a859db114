// SPDX-License-Identifier: Apache-2.0
#include "io/whole_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "base/error.hpp"

namespace talus {

namespace {

/// Writes and flushes to the disk. \returns 0 or the error number
int write_bytes(const std::string& name, std::string_view bytes) {
  const int file = ::open(name.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) return errno;
  int error = 0;
  while (!bytes.empty() && error == 0) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      error = errno;
    }
  }
  if (error == 0 && ::fsync(file) != 0) error = errno;
  if (::close(file) != 0 && error == 0) error = errno;
  return error;
}

}  // namespace

void write_whole_file(const std::filesystem::path& path, std::string_view bytes) {
  const std::string target = path.string();
  const std::string temporary = fmt::format("{}.{}.part", target, ::getpid());
  int error = write_bytes(temporary, bytes);
  if (error == 0 && std::rename(temporary.c_str(), target.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    throw FileError(target, fmt::format("write failed: {}", std::strerror(error)));
  }
}

}  // namespace talus

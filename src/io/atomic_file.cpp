// SPDX-License-Identifier: Apache-2.0
#include "io/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "base/error.hpp"
#include "io/descriptor.hpp"
#include "io/file_list.hpp"

namespace talus {

std::string system_reason(int error_number) {
  return std::generic_category().message(error_number);
}

namespace {

/// \throws FileError about `path`, whose content is in the file `temporary` until the end
void write_and_rename(const std::string& path, const std::string& temporary, std::string_view content, Flush flush) {
  Descriptor file(temporary, O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW, path);
  file.write(content);
  if (flush == Flush::now) file.sync();
  file.close();
  if (std::rename(temporary.c_str(), path.c_str()) != 0)
    throw FileError(path, "cannot rename into place: " + system_reason(errno));
}

}  // namespace

void write_atomically(const std::filesystem::path& path, std::string_view content, Flush flush) {
  const std::string temporary = path.string() + std::string(temporary_suffix);
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  claim_file(path);
  // Opened first, so that a folder that cannot be flushed is reported before any change.
  Descriptor folder_file(folder.string(), O_RDONLY | O_DIRECTORY, path.string());
  try {
    write_and_rename(path.string(), temporary, content, flush);
  } catch (const FileError&) {
    ::unlink(temporary.c_str());
    throw;
  }
  if (flush == Flush::now) folder_file.sync();
}

std::string read_whole_file(const std::filesystem::path& path) {
  Descriptor file(path.string(), O_RDONLY, path.string());
  return file.read();
}

}  // namespace talus

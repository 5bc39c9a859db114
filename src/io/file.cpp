// SPDX-License-Identifier: Apache-2.0
#include "io/file.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <system_error>

#include "base/error.hpp"
#include "io/file_list.hpp"

namespace talus {

Descriptor::Descriptor(const std::string& path, int flags, const std::string& reported)
    : reported_(reported.empty() ? path : reported) {
  do {
    number_ = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  } while (number_ < 0 && errno == EINTR);
  if (number_ < 0) fail("cannot open", errno);
}

Descriptor Descriptor::in_memory(std::string& path, const std::string& reported) {
  constexpr const char* memory = "/dev/shm";
  const bool has_memory = ::access(memory, W_OK) == 0;
  path = (has_memory ? std::filesystem::path(memory) : std::filesystem::temp_directory_path()) / "talus-XXXXXX";
  Descriptor file;
  file.reported_ = reported;
  file.number_ = ::mkostemp(path.data(), O_CLOEXEC);
  if (file.number_ < 0) file.fail("cannot be built in memory", errno);
  return file;
}

Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}

void Descriptor::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(number_, bytes.data(), bytes.size());
    if (written >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      fail("cannot write", errno);
    }
  }
}

void Descriptor::write_at(std::size_t place, std::string_view bytes) {
  if (::lseek(number_, static_cast<off_t>(place), SEEK_SET) < 0) fail("cannot write", errno);
  write(bytes);
}

void Descriptor::read_at(std::size_t place, char* to, std::size_t count) const {
  while (count > 0) {
    const ssize_t got = ::pread(number_, to, count, static_cast<off_t>(place));
    if (got > 0)
      place += static_cast<std::size_t>(got), to += got, count -= static_cast<std::size_t>(got);
    else if (got == 0 || errno != EINTR)
      fail("cannot read", got == 0 ? EIO : errno);
  }
}

std::size_t Descriptor::read_some(char* to, std::size_t most) {
  while (true) {
    const ssize_t got = ::read(number_, to, most);
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno != EINTR) fail("cannot read", errno);
  }
}

std::string Descriptor::read() {
  std::string content;
  std::array<char, 1 << 16> buffer;
  while (const std::size_t got = read_some(buffer.data(), buffer.size())) content.append(buffer.data(), got);
  return content;
}

void Descriptor::truncate(std::size_t size) {
  if (::ftruncate(number_, static_cast<off_t>(size)) != 0 || ::lseek(number_, static_cast<off_t>(size), SEEK_SET) < 0)
    fail("cannot truncate", errno);
}

void Descriptor::sync() {
  if (::fsync(number_) != 0 && errno != EINVAL) fail("cannot write", errno);
}

void Descriptor::close() {
  if (::close(std::exchange(number_, -1)) != 0 && errno != EINTR) fail("cannot write", errno);
}

void Descriptor::fail(const char* what, int error_number) const {
  throw FileError(reported_, std::string(what) + ": " + system_reason(error_number));
}

std::string system_reason(int error_number) {
  return std::generic_category().message(error_number);
}

namespace {

/// \throws FileError about `path`, whose content is in the file `temporary` until the end
void write_and_rename(const std::string& path, const std::string& temporary,
                      const std::function<void(Descriptor&)>& write, Flush flush) {
  Descriptor file(temporary, O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW, path);
  write(file);
  if (flush == Flush::now) file.sync();
  file.close();
  if (std::rename(temporary.c_str(), path.c_str()) != 0)
    throw FileError(path, "cannot rename into place: " + system_reason(errno));
}

}  // namespace

void write_atomically(const std::filesystem::path& path, std::string_view content, Flush flush) {
  write_atomically(
      path, [&](Descriptor& file) { file.write(content); }, flush);
}

void write_atomically(const std::filesystem::path& path, const std::function<void(Descriptor&)>& write, Flush flush) {
  const std::string temporary = path.string() + std::string(temporary_suffix);
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  claim_file(path);
  // Opened first, so that a folder that cannot be flushed is reported before any change.
  Descriptor folder_file(folder.string(), O_RDONLY | O_DIRECTORY, path.string());
  try {
    write_and_rename(path.string(), temporary, write, flush);
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

std::uint32_t checksum(std::string_view bytes, std::uint32_t before) {
  return static_cast<std::uint32_t>(crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::uint32_t checksum_of_file(const std::filesystem::path& path) {
  Descriptor file(path.string(), O_RDONLY, path.string());
  std::array<char, 1 << 16> buffer;
  std::uint32_t sum = 0;
  while (const std::size_t got = file.read_some(buffer.data(), buffer.size()))
    sum = checksum({buffer.data(), got}, sum);
  return sum;
}

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
#include "io/descriptor.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "base/error.hpp"
#include "io/atomic_file.hpp"

namespace talus {

Descriptor::Descriptor(const std::string& path, int flags, const std::string& reported)
    : reported_(reported.empty() ? path : reported) {
  do {
    number_ = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  } while (number_ < 0 && errno == EINTR);
  if (number_ < 0) fail("cannot open", errno);
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

std::string Descriptor::read() {
  std::string content;
  std::array<char, 1 << 16> buffer;
  while (true) {
    const ssize_t got = ::read(number_, buffer.data(), buffer.size());
    if (got == 0) return content;
    if (got > 0) {
      content.append(buffer.data(), static_cast<std::size_t>(got));
    } else if (errno != EINTR) {
      fail("cannot read", errno);
    }
  }
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

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
/// A file of the system whose every failure is a FileError with the system's reason.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace talus {

/// Owns a file descriptor; closed on destruction, without a word: close() where a failure matters.
class Descriptor {
 public:
  Descriptor() = default;
  /// \param flags of open(2); new files get the permissions that the umask leaves
  /// \param reported path that errors name; empty: `path`
  Descriptor(const std::string& path, int flags, const std::string& reported = {});
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept
      : number_(std::exchange(other.number_, -1)), reported_(std::move(other.reported_)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    std::swap(reported_, other.reported_);
    return *this;
  }

  int number() const { return number_; }
  void write(std::string_view bytes);
  std::string read();               ///< from here to the end
  void truncate(std::size_t size);  ///< truncates and continues there
  void sync();                      ///< to the disk; a file system that cannot flush a folder is let be
  void close();

 private:
  [[noreturn]] void fail(const char* what, int error_number) const;

  int number_ = -1;
  std::string reported_;
};

}  // namespace talus

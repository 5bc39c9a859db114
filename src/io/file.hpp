// SPDX-License-Identifier: Apache-2.0
/// Files of the system: every failure is a FileError with the system's reason.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
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
  /// A file in memory (tmpfs; where there is none, of the folder for temporary files), which takes none where nothing
  /// has been written. \param path its name, out: to be unlinked once it need not be opened again
  static Descriptor in_memory(std::string& path, const std::string& reported);
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
  void write_at(std::size_t place, std::string_view bytes);
  void read_at(std::size_t place, char* to, std::size_t count) const;  ///< \throws FileError if there are fewer
  std::size_t read_some(char* to, std::size_t most);  ///< the next bytes \returns how many; 0 at the end
  std::string read();                                 ///< from here to the end
  void truncate(std::size_t size);                    ///< truncates and continues there
  void sync();  ///< to the disk; a file system that cannot flush a folder is let be
  void close();

 private:
  [[noreturn]] void fail(const char* what, int error_number) const;

  int number_ = -1;
  std::string reported_;
};

// Whole files: written so that a reader, a kill or a full disk meets the old file or the new one, never a part.

/// Ending of the temporary name, in the same folder, under which a file is written. One that is left by a kill is
/// replaced by the next write of the same file, and removed by --overwrite.
inline constexpr std::string_view temporary_suffix = ".part";

/// Whether a file is on the disk when its writing returns, or when the system finds the time. Either way a kill of the
/// program meets the old file or the new one; a loss of power may meet neither, if it comes within seconds of `later`.
enum class Flush { now, later };

/// Writes `content` under a temporary name, flushes it to the disk, renames it to `path` and flushes the folder. The
/// folder must exist and have room for the new file next to the old one. A folder that keeps a list of what Talus wrote
/// (file_list.hpp) has it entered there. Symbolic links are not followed: one at `path` is replaced or, where such a
/// list is kept, refused; one under the temporary name is refused.
/// \param flush `later` is for what can be made again from other files
/// \throws FileError with the system's reason; the temporary is gone then and an older file at `path` is as it was
///         (only where flushing the folder fails, after the renaming, is it already the new one)
void write_atomically(const std::filesystem::path& path, std::string_view content, Flush flush = Flush::now);
/// The same with what a function writes to the file.
void write_atomically(const std::filesystem::path& path, const std::function<void(Descriptor& file)>& write,
                      Flush flush = Flush::now);

/// \throws FileError with the system's reason
std::string read_whole_file(const std::filesystem::path& path);

/// The text of an error number of the system: "No space left on device".
std::string system_reason(int error_number);

// The checksum of Talus's files, crc32 (IEEE 802.3): it finds every single turned bit and every torn stretch of up to
// 32 bits, and misses one in 2^32 of other changes. It is no protection against intent.

/// \param before the checksum of what stands before these bytes
std::uint32_t checksum(std::string_view bytes, std::uint32_t before = 0);

/// Of a whole file. \throws FileError
std::uint32_t checksum_of_file(const std::filesystem::path& path);

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
/// files.txt: which files of a folder Talus wrote. What it does not name is the user's: never removed, never replaced.
///
///     Talus wrote these files, and removes or replaces no others.
///     5f3a9c01 series.csv
///     0badf00d snapshots/particles_0000.vtkhdf
///
/// A name is entered, behind its own checksum (crc32), before its file is made, so that a kill leaves no file without
/// its entry. A line that is torn or has another checksum counts for nothing. Names are paths below the folder; links
/// are never followed from there.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace talus {

/// What to do with a folder that is there and not empty.
enum class Existing {
  refuse,
  resume,    ///< continue the run in it
  overwrite  ///< remove the files that its list says were written, and no others
};

class FileList {
 public:
  static constexpr std::string_view file_name = "files.txt";

  /// An empty list in place of any other. \throws FileError
  static FileList begin(const std::filesystem::path& folder);

  /// The list of a folder; nothing if there is none. \throws FileError if it cannot be read
  static std::optional<FileList> read(const std::filesystem::path& folder);

  bool holds(const std::string& name) const { return names_.contains(name); }

  /// Enters a name, on the disk when it returns. \throws FileError; the list is then as it was
  void add(const std::string& name);

  /// Removes the files with these names and what was left of writing them; regular files alone, none behind a link. The
  /// one that `last` names goes last. This list is then empty. \throws FileError
  void remove_files(std::string_view last);

 private:
  explicit FileList(std::filesystem::path folder) : folder_(std::move(folder)) {}
  std::filesystem::path path() const { return folder_ / file_name; }

  std::filesystem::path folder_;
  std::set<std::string> names_;
};

/// To be called before a file is made, replaced or appended to. Where the folder that it lies in, or one of the three
/// above, keeps a list (the nearest counts), the file is entered there.
/// \throws FileError if the way from that folder, or the file, is a symbolic link; if the file is there but not in the
///         list; if it cannot be entered
void claim_file(const std::filesystem::path& path);

/// Whether the folder of an ensemble, a reproduction or a path may be used; changes nothing. \param option that would
/// allow what is there; \param known what is there is from a version of Talus that kept no list
/// \throws InputError if it is not empty, and either `existing` is refuse or it has no list and is not known
void check_output(const std::filesystem::path& folder, Existing existing, std::string_view option, bool known = false);

/// The same, and makes it with its parents where it is not there; it keeps a list from now on. To overwrite removes
/// what the list names. \throws InputError as above, FileError
void begin_output(const std::filesystem::path& folder, Existing existing, std::string_view option, bool known = false);

/// Makes a folder, with its parents, to write into. \throws FileError if it is a symbolic link, or with the system's
/// reason
void make_folder(const std::filesystem::path& path);

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
#include "io/file_list.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/error.hpp"
#include "io/file.hpp"

namespace talus {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view title = "Talus wrote these files, and removes or replaces no others.\n";
constexpr int max_levels = 4;  // members of an ensemble: FOLDER/GROUP/pictures/NAME

std::string line_of(std::string_view name) {
  return fmt::format("{:08x} {}\n", checksum(name), name);
}

/// Whether a name is a path below a folder.
bool lies_below(const fs::path& name) {
  return !name.empty() && name.is_relative() &&
         std::none_of(name.begin(), name.end(), [](const fs::path& part) { return part.empty() || part == ".."; });
}

fs::file_type type_of(const fs::path& path) {
  std::error_code error;
  const fs::file_type type = fs::symlink_status(path, error).type();
  if (type == fs::file_type::none) throw FileError(path.string(), "cannot look for it: " + error.message());
  return type;
}

/// The first symbolic link on the way from a folder to what lies below it, that itself included.
std::optional<fs::path> link_on_the_way(fs::path folder, const fs::path& name) {
  for (const fs::path& part : name) {
    folder /= part;
    if (type_of(folder) == fs::file_type::symlink) return folder;
  }
  return std::nullopt;
}

void remove_file(const fs::path& folder, const std::string& name) {
  if (link_on_the_way(folder, name) || type_of(folder / name) != fs::file_type::regular) return;
  std::error_code error;
  fs::remove(folder / name, error);
  if (error) throw FileError((folder / name).string(), "cannot remove: " + error.message());
}

}  // namespace

FileList FileList::begin(const fs::path& folder) {
  const FileList list(folder);
  write_atomically(list.path(), title);
  return list;
}

std::optional<FileList> FileList::read(const fs::path& folder) {
  FileList list(folder);
  if (type_of(list.path()) != fs::file_type::regular) return std::nullopt;
  const std::string content = read_whole_file(list.path());
  if (!content.starts_with(title)) return std::nullopt;
  for (std::size_t begin = title.size(), end; (end = content.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const std::string line = content.substr(begin, end + 1 - begin);
    const std::string name = line.size() > 10 ? line.substr(9, line.size() - 10) : "";
    if (lies_below(name) && line == line_of(name)) list.names_.insert(name);
  }
  return list;
}

void FileList::add(const std::string& name) {
  if (!names_.insert(name).second) return;
  Descriptor file(path().string(), O_RDWR | O_NOFOLLOW);
  const std::string content = file.read();
  try {
    if (!content.ends_with('\n')) file.write("\n");
    file.write(line_of(name));
    file.sync();
  } catch (const FileError&) {
    file.truncate(content.size());
    throw;
  }
}

void FileList::remove_files(std::string_view last) {
  const auto remove = [&](const std::string& name) {
    remove_file(folder_, name + std::string(temporary_suffix));
    remove_file(folder_, name);
  };
  for (const std::string& name : names_)
    if (name != last) remove(name);
  if (holds(std::string(last))) remove(std::string(last));
  *this = begin(folder_);
}

void claim_file(const fs::path& path) {
  fs::path name = path.filename(), folder = path.parent_path();
  if (name == FileList::file_name) return;
  for (int level = 0; level < max_levels; ++level) {
    const fs::path here = folder.empty() ? fs::path(".") : folder;
    if (std::optional<FileList> list = FileList::read(here)) {
      if (const auto link = link_on_the_way(here, name))
        throw FileError(path.string(), link->string() + " is a symbolic link, through which nothing is written");
      if (!list->holds(name.string()) && type_of(path) != fs::file_type::not_found)
        throw FileError(path.string(), fmt::format("is there, and {} does not say that Talus wrote it: move it away",
                                                   (here / FileList::file_name).string()));
      return list->add(name.string());
    }
    if (folder.filename().empty() || folder.filename() == "." || folder.filename() == "..") return;
    name = folder.filename() / name;
    folder = folder.parent_path();
  }
}

void check_output(const fs::path& folder, Existing existing, std::string_view option, bool known) {
  const auto refuse = [&](std::string what, std::string allowed) {
    throw InputError({{.where = folder.string(), .what = std::move(what), .allowed = std::move(allowed)}});
  };
  std::error_code none;
  if (!fs::exists(folder, none) || (fs::is_directory(folder, none) && fs::is_empty(folder, none))) return;
  if (!fs::is_directory(folder, none)) refuse("is a file, not a folder", "another --out");
  const bool mine = known || FileList::read(folder);
  if (!mine)
    refuse(fmt::format("is not empty, and has no {} that says what Talus wrote there", FileList::file_name),
           "another --out");
  if (existing == Existing::refuse) refuse("is not empty", fmt::format("{}, or another --out", option));
}

void begin_output(const fs::path& folder, Existing existing, std::string_view option, bool known) {
  check_output(folder, existing, option, known);
  std::error_code error;
  const bool made = fs::create_directories(folder, error);
  if (error) throw FileError(folder.string(), "cannot make the folder: " + error.message());
  std::optional<FileList> list = FileList::read(folder);
  if (made || (!list && fs::is_empty(folder)))
    FileList::begin(folder);
  else if (list && existing == Existing::overwrite)
    list->remove_files({});
}

void make_folder(const fs::path& path) {
  if (type_of(path) == fs::file_type::symlink)
    throw FileError(path.string(), "is a symbolic link, through which nothing is written");
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw FileError(path.string(), "cannot make the folder: " + error.message());
}

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
#include "io/run_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <string>
#include <thread>
#include <utility>

#include "base/error.hpp"
#include "io/checkpoint.hpp"
#include "io/file.hpp"
#include "io/run_json.hpp"

namespace talus {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view snapshot_ending = ".vtkhdf";
constexpr std::string_view index_ending = ".hdf.series";

/// Files of a run other than its snapshots.
constexpr std::array<std::string_view, 7> file_names{
    "manifest.json", CheckpointFiles::names[0], CheckpointFiles::names[1], "series.csv", "summary.json", "report.html",
    "log.txt"};

constexpr std::array<std::string_view, 3> folder_names{"snapshots", "analysis", "pictures"};

[[noreturn]] void refuse(const fs::path& path, const std::string& what, const std::string& allowed = {}) {
  throw InputError({{.where = path.string(), .key = {}, .what = what, .allowed = allowed}});
}

/// \throws FileError with the system's reason in place of the library's exception
template <class Action>
auto at(const fs::path& path, const char* what, Action&& action) {
  try {
    return action();
  } catch (const fs::filesystem_error& error) {
    throw FileError(path.string(), fmt::format("{}: {}", what, error.code().message()));
  }
}

std::vector<std::string> names_in(const fs::path& folder) {
  return at(folder, "cannot read the folder", [&] {
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
      names.push_back(entry.path().filename().string());
    return names;
  });
}

/// The number in "particles_0012.vtkhdf".
std::optional<int> snapshot_number(std::string_view name, std::string_view kind) {
  if (!name.starts_with(kind) || !name.ends_with(snapshot_ending)) return {};
  name.remove_prefix(kind.size());
  name.remove_suffix(snapshot_ending.size());
  int number = 0;
  if (name.size() < 5 || name[0] != '_' || name[1] < '0' || name[1] > '9') return {};
  const auto [stop, error] = std::from_chars(name.data() + 1, name.data() + name.size(), number);
  if (error != std::errc{} || stop != name.data() + name.size()) return {};
  return number;
}

/// Why the manifest is none, nothing if it is one.
std::optional<std::string> fault_of_manifest(const RunFolder& folder) {
  if (!fs::exists(folder.manifest())) return "manifest.json missing";
  try {
    read_manifest(folder.manifest());
    return std::nullopt;
  } catch (const FileError& error) {
    return error.what();
  }
}

/// Whether the folder holds nothing but what a run leaves that is killed before its manifest is in place.
bool is_fresh(const RunFolder& folder) {
  const std::vector<std::string> names = names_in(folder.path());
  return std::all_of(names.begin(), names.end(), [&](std::string_view name) {
    if (name == "snapshots")
      return !fs::is_symlink(folder.snapshots()) && fs::is_directory(folder.snapshots()) &&
             names_in(folder.snapshots()).empty();
    if (name == FileList::file_name) return FileList::read(folder.path()).has_value();
    return name == "manifest.json.part" || name == "files.txt.part";
  });
}

/// \throws InputError with every link where a file or folder of a run would be
void refuse_links(const fs::path& folder) {
  std::vector<Problem> problems;
  const auto look_at = [&](const std::string& name) {
    if (fs::is_symlink(folder / name))
      problems.push_back({.where = (folder / name).string(),
                          .what = "is a symbolic link; within a run's folder none is followed",
                          .allowed = "files and folders of its own"});
  };
  for (const std::string_view name : file_names) {
    look_at(std::string(name));
    look_at(std::string(name) + std::string(temporary_suffix));
  }
  for (const std::string_view name : folder_names) look_at(std::string(name));
  look_at(std::string(FileList::file_name));
  if (!problems.empty()) throw InputError(problems);
}

/// Whether the folder may be overwritten. Changes nothing.
void check_overwritable(const RunFolder& folder, const std::optional<std::string>& fault) {
  const std::optional<FileList> list = FileList::read(folder.path());
  if (!list)
    refuse(folder.path(),
           fault
               ? fmt::format("is not a Talus run folder ({}); nothing is overwritten", *fault)
               : fmt::format("has no {} that says what Talus wrote there; nothing is overwritten", FileList::file_name),
           "--out for another folder");
  for (const std::string_view name : file_names)
    if (fs::exists(folder.path() / name) && !list->holds(std::string(name)))
      refuse(folder.path(),
             fmt::format("holds '{}', and {} does not say that Talus wrote it", name, FileList::file_name),
             "--out for another folder, or move it away");
}

/// A snapshot that the list does not name is somebody else's, or its line in the list is damaged: a run that went on
/// without it would leave it out of every table.
void check_snapshots_are_listed(const RunFolder& folder) {
  const std::optional<FileList> list = FileList::read(folder.path());
  if (!list || !fs::is_directory(folder.snapshots())) return;
  for (const std::string& name : names_in(folder.snapshots()))
    for (const std::string_view kind : {"particles", "air", "walls"})
      if (snapshot_number(name, kind) && !list->holds("snapshots/" + name))
        refuse(folder.snapshots() / name,
               fmt::format("is there, and {} does not say that Talus wrote it", FileList::file_name),
               "move it away; --overwrite to start again");
}

/// Whether the folder may be used. Changes nothing.
void check(const RunFolder& folder, Existing existing) {
  if (is_fresh(folder)) return;
  const std::optional<std::string> fault = fault_of_manifest(folder);
  if (existing == Existing::refuse)
    refuse(folder.path(), fault ? "is not empty" : "holds a run already",
           fault ? "--out for another folder"
                 : "--resume to go on with it, --overwrite to replace it, --out for another folder");
  refuse_links(folder.path());
  if (existing == Existing::overwrite) return check_overwritable(folder, fault);
  if (fault) refuse(folder.path(), fmt::format("holds no run to resume: {}", *fault));
  check_snapshots_are_listed(folder);
}

/// A list in a new folder, or in one whose run's files are removed first. A run of a version that kept none goes on
/// without.
void begin_list(const RunFolder& folder, Existing existing) {
  if (is_fresh(folder))
    FileList::begin(folder.path());
  else if (existing == Existing::overwrite)
    FileList::read(folder.path())->remove_files("manifest.json");
}

}  // namespace

RunFolder RunFolder::create(std::filesystem::path path, Existing existing) {
  RunFolder folder(std::move(path));
  return at(folder.path_, "cannot make the folder", [&] {
    const bool exists = fs::exists(folder.path_);
    if (exists && !fs::is_directory(folder.path_)) refuse(folder.path_, "is a file, not a folder");
    fs::create_directories(folder.path_);
    folder.lock(existing);
    check(folder, existing);
    begin_list(folder, existing);
    fs::remove(folder.stop());
    make_folder(folder.snapshots());
    return folder;
  });
}

std::filesystem::path RunFolder::snapshot(int number, std::string_view kind) const {
  return snapshots() / fmt::format("{}_{:04}{}", kind, number, snapshot_ending);
}

std::filesystem::path RunFolder::snapshot_index(std::string_view kind) const {
  return snapshots() / fmt::format("{}{}", kind, index_ending);
}

std::vector<int> RunFolder::snapshot_numbers(std::string_view kind) const {
  std::vector<int> numbers;
  if (!at(snapshots(), "cannot read the folder", [&] { return fs::exists(snapshots()); })) return numbers;
  const std::optional<FileList> list = FileList::read(path_);
  for (const std::string& name : names_in(snapshots()))
    if (const std::optional<int> number = snapshot_number(name, kind))
      if (!list || list->holds("snapshots/" + name)) numbers.push_back(*number);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

bool RunFolder::remove_snapshots(int first, std::string_view kind) const {
  if (!FileList::read(path_)) return false;
  bool any = false;
  for (const int number : snapshot_numbers(kind)) {
    if (number < first) continue;
    any = at(snapshot(number, kind), "cannot remove", [&] { return fs::remove(snapshot(number, kind)); }) || any;
  }
  return any;
}

void RunFolder::lock(Existing existing) {
  using namespace std::chrono_literals;
  lock_ = std::make_shared<Descriptor>(path_.string(), O_RDONLY | O_DIRECTORY);
  const auto patience = std::chrono::steady_clock::now() + (existing == Existing::resume ? 2s : 0s);
  // A file system without locks is used without them.
  while (::flock(lock_->number(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    if (std::chrono::steady_clock::now() >= patience)
      refuse(path_, "another run is writing into this folder", "--out for another folder");
    std::this_thread::sleep_for(20ms);
  }
}

}  // namespace talus

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
#include "io/atomic_file.hpp"
#include "io/checkpoint.hpp"
#include "io/manifest.hpp"

namespace talus {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 2> snapshot_kinds{"particles", "air"};
constexpr std::string_view snapshot_ending = ".vtkhdf";
constexpr std::string_view index_ending = ".hdf.series";

/// Files of a run beside its snapshots. The manifest is last, so that a removal that is cut short can be repeated.
constexpr std::array<std::string_view, 8> file_names{CheckpointFiles::names[0],
                                                     CheckpointFiles::names[1],
                                                     "series.csv",
                                                     "summary.json",
                                                     "report.html",
                                                     "log.txt",
                                                     "stop",
                                                     "manifest.json"};

/// Folders of what is made from a run, with the ending of their files: what is left of another case, whatever its name,
/// would be taken for this one's.
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> derived_files{
    {{"analysis", ".csv"}, {"pictures", ".png"}}};

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

std::string_view without_suffix(std::string_view name) {
  return name.ends_with(temporary_suffix) ? name.substr(0, name.size() - temporary_suffix.size()) : name;
}

bool is_snapshot_file(std::string_view name) {
  const std::string_view whole = without_suffix(name);
  return std::any_of(snapshot_kinds.begin(), snapshot_kinds.end(), [&](std::string_view kind) {
    return snapshot_number(whole, kind) || (whole.starts_with(kind) && whole.substr(kind.size()) == index_ending);
  });
}

bool is_run_file(std::string_view name) {
  return std::find(file_names.begin(), file_names.end(), without_suffix(name)) != file_names.end();
}

bool holds_manifest(const RunFolder& folder) {
  if (!fs::exists(folder.manifest())) return false;
  try {
    read_manifest(folder.manifest());
    return true;
  } catch (const FileError&) {
    return false;  // another program's
  }
}

/// Whether the folder holds nothing but what a run leaves that is killed before its manifest is in place.
bool is_fresh(const RunFolder& folder) {
  const std::vector<std::string> names = names_in(folder.path());
  return std::all_of(names.begin(), names.end(), [&](const std::string& name) {
    return name == folder.manifest().filename().string() + std::string(temporary_suffix) ||
           (name == folder.snapshots().filename() && names_in(folder.snapshots()).empty());
  });
}

/// Whether the folder may be used. Changes nothing.
void check(const RunFolder& folder, Existing existing) {
  if (is_fresh(folder)) return;
  const bool has_run = holds_manifest(folder);
  switch (existing) {
    case Existing::refuse:
      refuse(folder.path(), has_run ? "holds a run already" : "is not empty",
             has_run ? "--resume to go on with it, --overwrite to replace it, --out for another folder"
                     : "--out for another folder");
    case Existing::resume:
      if (!has_run) refuse(folder.path(), "holds no run to resume: no manifest.json from Talus");
      return;
    case Existing::overwrite:
      if (has_run) return;
      for (const std::string& name : names_in(folder.path()))
        if (is_run_file(name) || name == folder.snapshots().filename())
          refuse(folder.path(),
                 fmt::format("holds '{}', but no run of Talus (no manifest.json); nothing is overwritten", name),
                 "--out for another folder");
  }
}

}  // namespace

RunFolder RunFolder::create(std::filesystem::path path, Existing existing) {
  RunFolder folder(std::move(path));
  return at(folder.path_, "cannot make the folder", [&] {
    const bool exists = fs::exists(folder.path_);
    if (exists && !fs::is_directory(folder.path_)) refuse(folder.path_, "is a file, not a folder");
    if (!exists && existing == Existing::resume) refuse(folder.path_, "there is no such folder; nothing to resume");
    fs::create_directories(folder.path_);
    folder.lock(existing);
    check(folder, existing);
    if (existing == Existing::overwrite) folder.remove_run();
    fs::remove(folder.stop());
    fs::create_directories(folder.snapshots());
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
  for (const std::string& name : names_in(snapshots()))
    if (const std::optional<int> number = snapshot_number(name, kind)) numbers.push_back(*number);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

std::optional<int> RunFolder::latest_snapshot(std::string_view kind) const {
  const std::vector<int> numbers = snapshot_numbers(kind);
  return numbers.empty() ? std::nullopt : std::optional(numbers.back());
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

void RunFolder::remove_run() const {
  const auto remove = [](const fs::path& path) { at(path, "cannot remove", [&] { return fs::remove(path); }); };
  if (fs::is_directory(snapshots()))
    for (const std::string& name : names_in(snapshots()))
      if (is_snapshot_file(name)) remove(snapshots() / name);
  for (const auto& [folder, ending] : derived_files)
    if (fs::is_directory(path_ / folder))
      for (const std::string& name : names_in(path_ / folder))
        if (without_suffix(name).ends_with(ending)) remove(path_ / folder / name);
  for (const std::string_view name : file_names) {
    remove(path_ / (std::string(name) + std::string(temporary_suffix)));
    remove(path_ / name);
  }
}

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
/// Files that a case names.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "io/case_file.hpp"

namespace talus::app {

/// The path of a file that a case names: one that is not absolute starts at the folder of the case.
inline std::filesystem::path input_path(const CaseFile& file, const std::string& given) {
  const std::filesystem::path path = given;
  return path.is_absolute() ? path : std::filesystem::path(file.name()).parent_path() / path;
}

/// Calls read(), which reads a file that `key` names. That it cannot be opened is a problem of the case, as any other
/// value of a key that will not do: exit status 2, with the line of the key. What the file holds is read()'s to judge.
template <class Read>
void read_input(std::string key, std::vector<Problem>& problems, Read&& read) {
  try {
    std::forward<Read>(read)();
  } catch (const FileError& error) {
    problems.push_back({.key = std::move(key),
                        .what = error.what(),
                        .allowed = "a file that can be read, its path from the folder of the case on"});
  }
}

}  // namespace talus::app

// SPDX-License-Identifier: Apache-2.0
/// Options that several commands take: the case, --set, --out, --threads.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/case_file.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming)
class App;
}

namespace talus::app {

struct CaseOptions {
  std::string path;
  std::vector<std::string> settings;

  void add_to(CLI::App& command);
  /// \throws FileError, InputError as CaseFile
  CaseFile read() const;
};

/// Where the results of a case go without --out: results/NAME of the case.
std::filesystem::path default_results(const std::string& case_path);

/// Adds --out DIR; none given leaves `out` empty, an empty one is an error.
void add_out_option(CLI::App& command, std::string& out, const std::string& text);

/// Adds --threads N with the number of processors as default.
void add_threads_option(CLI::App& command, int& threads);

/// What a command was given, checked: --NAME, --NAME=VALUE, the places behind "--".
std::vector<std::string> words_of(const CLI::App& command);

}  // namespace talus::app

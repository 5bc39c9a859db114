// SPDX-License-Identifier: Apache-2.0
/// What talus picture and talus movie have in common on the command line.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/picture/artist.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the library has named it
class App;
}

namespace talus::app {

struct PictureOptions {
  std::vector<std::string> folders = {}, names = {};
  std::string color = "velocity", range = {}, out = {};
  PictureStyle style = {};

  void add_to(CLI::App& command);

  /// \throws FileError
  std::vector<RunFrames> read_runs() const;
  /// Names of the runs: those given, or of their folders. \throws InputError if there are others than runs
  std::vector<std::string> run_names() const;
  /// \param runs give the colours where none were asked for \throws InputError
  PictureStyle style_for(const std::vector<RunFrames>& runs) const;
};

/// "0.2" or "200 ms" in seconds. \throws InputError naming the option
double read_time(const std::string& text, const std::string& option);

/// The file to write. \throws InputError if none was given, it is a folder, or its ending is none of those allowed;
/// FileError if its folder is not there
std::filesystem::path read_out(const std::string& text, const std::vector<std::string>& endings);

}  // namespace talus::app

// SPDX-License-Identifier: Apache-2.0
// log.txt: what happened in a run, and when.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <utility>

#include "io/descriptor.hpp"

namespace talus::app {

/// A log that cannot be written does not end a run: the files of the numbers report a full disk themselves.
class RunLog {
 public:
  /// \param append after the lines of the run that is resumed
  RunLog(const std::filesystem::path& path, bool append);

  /// Adds a line, with the local time before it.
  template <class... Values>
  void write(fmt::format_string<Values...> format, Values&&... values) {
    write_line(fmt::format(format, std::forward<Values>(values)...));
  }

 private:
  void write_line(const std::string& text);

  std::optional<Descriptor> file_;  // none: it could not be opened
};

}  // namespace talus::app

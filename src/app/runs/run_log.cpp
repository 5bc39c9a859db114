// SPDX-License-Identifier: Apache-2.0
#include "app/runs/run_log.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>

#include <ctime>

#include "base/error.hpp"
#include "io/file_list.hpp"

namespace talus::app {

RunLog::RunLog(const std::filesystem::path& path, bool append) {
  try {
    claim_file(path);
    file_.emplace(path.string(), O_WRONLY | O_CREAT | O_NOFOLLOW | (append ? O_APPEND : O_TRUNC));
  } catch (const FileError&) {
  }
}

void RunLog::write_line(const std::string& text) {
  if (!file_) return;
  try {
    file_->write(fmt::format("{:%Y-%m-%d %H:%M:%S}  {}\n", fmt::localtime(std::time(nullptr)), text));
  } catch (const FileError&) {
  }
}

}  // namespace talus::app

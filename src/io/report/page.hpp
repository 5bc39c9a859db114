// SPDX-License-Identifier: Apache-2.0
/// report.html: the page that web/report builds into one file, filled with data.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace talus {

/// What the page is filled with.
struct ReportContent {
  std::string title;                            ///< plain text
  std::string header;                           ///< JSON; refers to the blocks by number
  std::vector<std::string> blocks;              ///< base64
  std::vector<std::filesystem::path> pictures;  ///< PNG, shown where there is no WebGL
};

/// Whether this program holds the page: its build needs npm.
bool has_report_page();

/// What to install where it does not.
std::string without_report_page();

/// Writes the page, whole or not at all.
/// \throws FileError if this program has no page, if a picture cannot be read, or with the system's reason; also if
///         another file than a report of Talus is there
void write_report(const std::filesystem::path& path, const ReportContent& content);

}  // namespace talus

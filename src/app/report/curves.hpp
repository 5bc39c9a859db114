// SPDX-License-Identifier: Apache-2.0
/// Tables against time as the plots of a report read them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "numerics/series.hpp"

namespace talus::app {

/// At most about `most` rows: where there are more, of every stretch of rows the least value of each column and its
/// largest, in the order in which they came; their times are the stretch's first and middle one.
Series thinned(const Series& table, std::size_t most);

/// Mean forces on the walls over a hundredth of the time, from the impulses in a run's series: columns time,
/// force_WALL_x ..., N. No columns where there are no walls.
Series forces_on_walls(const Series& series);

/// The files of a part of a run's folder with this ending, such as "analysis" and ".csv", sorted; where the folder
/// keeps a list of what Talus wrote, of those in it. \throws FileError
std::vector<std::filesystem::path> files_of_run(const std::filesystem::path& folder, const std::string& part,
                                                const std::string& ending);

/// Appends the columns as blocks of numbers and describes them, those without a number left out:
/// {"name", "rows", "of_rows", "columns": [{"name", "unit", "block"}...]}, the time first.
/// \param origin from which the time counts, in its unit
nlohmann::ordered_json pack_table(const std::string& name, const Series& table, double origin,
                                  std::vector<std::string>& blocks);

/// The tables of a run: those in analysis/ with the time first, the forces, the series.
/// \param origin of the series' time, s \throws FileError
nlohmann::ordered_json pack_tables(const std::filesystem::path& folder, const Series& series, double origin,
                                   std::vector<std::string>& blocks);

}  // namespace talus::app

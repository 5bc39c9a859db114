// SPDX-License-Identifier: Apache-2.0
/// The readers of Talus as functions of bytes: what users or broken disks may hand it. A reader that meets bad input
/// throws InputError or FileError, which these functions take; anything else that leaves them, and anything that the
/// sanitizers see, is a fault of the reader.
#pragma once

#include <array>
#include <string_view>

namespace talus::fuzz {

struct Target {
  std::string_view name;  ///< of its folder in corpus/ too
  void (*read)(std::string_view input);
};

/// A case as text to the parameters of both models, their checks and forecasts, and back to text.
void read_case(std::string_view text);
/// A whole case and one "KEY=VALUE" for --set.
void read_setting(std::string_view assignment);
/// A quantity with its unit, written out and read back.
void read_unit(std::string_view text);
/// CSV files of points, series and paths of a material point.
void read_points(std::string_view content);
void read_series_file(std::string_view content);
void read_path_file(std::string_view content);
/// An STL file, and the check of its triangles.
void read_stl_file(std::string_view content);
/// Particles of bed.file as CSV, and their check.
void read_bed_file(std::string_view content);

inline constexpr std::array<Target, 8> targets{{{"case", read_case},
                                                {"setting", read_setting},
                                                {"unit", read_unit},
                                                {"points", read_points},
                                                {"series", read_series_file},
                                                {"path", read_path_file},
                                                {"stl", read_stl_file},
                                                {"bed", read_bed_file}}};

}  // namespace talus::fuzz

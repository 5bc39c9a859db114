// SPDX-License-Identifier: Apache-2.0
/// A figure: particle pictures in a grid, drawn to a PNG.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "io/figure/particle_picture.hpp"

namespace talus::figure {

struct Figure {
  std::string title = {};
  std::vector<ParticlePicture> panels = {};  ///< row by row
  int columns = 0;                           ///< 0: as many as panels, at most two, or three from five panels on
  bool letters = true;                       ///< (a), (b), ... before the titles, if there are several panels
  std::optional<ColourBar> bar = {};         ///< one for all panels, right of them
  std::optional<ArrowKey> key = {};          ///< one for all panels, below the bar
  double width = 0;                          ///< units; 0: chosen by the number of columns
  double scale = 2;                          ///< pixels a unit
};

/// The figure as a PNG file's bytes; the height follows from the panels. Plots in a row have the same height, all the
/// same width. \throws std::invalid_argument if a panel's description makes no sense or there is none
std::string png(const Figure& figure);

/// The same, as pixels. \throws as png()
Pixels pixels(const Figure& figure);

/// Writes it whole or not at all. \throws FileError, and as png()
void write_png(const Figure& figure, const std::filesystem::path& path);

}  // namespace talus::figure

// SPDX-License-Identifier: Apache-2.0
/// A figure: panels of curves and particle pictures in a grid, drawn to a PNG.
///
///     using namespace talus::figure;
///     Chart speed{.x = {"*t̃*"}, .y = {"*ṽ*_{f}"},
///                 .series = {Line{.x = time, .y = mean, .spread = deviation, .label = "*a* = 5 mm"}}};
///     write_png({.panels = {speed}}, "front_speed.png");
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "io/figure/chart.hpp"
#include "io/figure/particle_picture.hpp"

namespace talus::figure {

using Panel = std::variant<Chart, ParticlePicture>;

struct Figure {
  std::string title = {};
  std::vector<Panel> panels = {};     ///< row by row
  int columns = 0;                    ///< 0: as many as panels, at most two, or three from five panels on
  std::vector<int> rows = {};         ///< columns of each row, where they differ, in place of `columns`
  bool letters = true;                ///< (a), (b), ... before the titles, if there are several panels
  std::optional<ColourBar> bar = {};  ///< one for all panels, right of them
  std::optional<ArrowKey> key = {};   ///< one for all panels, below the bar
  double width = 0;                   ///< units; 0: chosen by the number of columns
  double scale = 2;                   ///< pixels a unit
};

/// The figure as a PNG file's bytes; the height follows from the panels. Plots in a row have the same height, plots of
/// rows with the same number of columns the same width. \throws std::invalid_argument if a panel's description makes no
/// sense, there is none, or the rows do not hold the panels
std::string png(const Figure& figure);

/// The same, as pixels. \throws as png()
Pixels pixels(const Figure& figure);

/// Writes it whole or not at all. \throws FileError, and as png()
void write_png(const Figure& figure, const std::filesystem::path& path);

}  // namespace talus::figure

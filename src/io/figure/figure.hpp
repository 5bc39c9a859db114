// SPDX-License-Identifier: Apache-2.0
/// Figures: particle pictures in a grid, drawn to a PNG. Particles are discs with their true radii, the same scale in
/// both directions. A picture looks at columns that belong to others; they must live until it is drawn. Particles whose
/// position or radius is not finite are skipped.
#pragma once

#include <cairo/cairo.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/vector.hpp"
#include "io/figure/axes.hpp"
#include "io/figure/canvas.hpp"
#include "io/figure/view.hpp"
#include "numerics/geometry/domain.hpp"

namespace talus::figure {

/// What numbers are read in: the value of one unit in SI, and its name ("m", or "*a*" for the particle radius).
struct Unit {
  double value = 1;
  std::string name = {};
};

/// All particles alike.
struct Plain {
  Colour colour = rgb(0x7d8a99);
};

/// Coloured by a number each (SI), with a colour bar. Particles without a finite number are pale.
struct ByValue {
  std::span<const double> values = {};
  std::string label = {};
  Unit unit = {};
  std::optional<double> low = {}, high = {};  ///< in `unit`; left out: the range of the values
  bool bar = true;
};

/// An arrow for each particle, e.g. its velocity relative to the front, or for each of other positions.
struct Arrows {
  std::span<const Vector3> values = {};     ///< SI
  std::span<const Vector3> positions = {};  ///< where they begin, m; empty: at the particles
  Unit unit = {1, "m/s"};
  double length = 0;   ///< units of the page for one `unit`; 0: chosen so that nearly all are 16 or shorter
  double spacing = 6;  ///< at most one arrow in each square of this side, in units of the page; 0: all
  Colour colour = ink;
  bool key = true;  ///< an arrow of a round value right of the plot, below the colour bar
};

/// A straight line over the particles: a wall.
struct Segment {
  Vector3 from = {}, to = {};  ///< m
  Colour colour = ink;
};

/// The visible part, in metres along the view's directions right and up.
struct Window {
  double left = 0, right = 1, bottom = 0, top = 1;
};

struct ParticlePicture {
  std::string title = {};
  std::span<const Vector3> positions = {};  ///< m
  std::span<const double> radii = {};       ///< m
  View view = view_xy;
  std::variant<Plain, ByValue> colouring = Plain{};
  std::optional<Arrows> arrows = {};
  std::vector<Segment> segments = {};
  Unit length = {1, "m"};
  bool axes = true;       ///< numbered, where the view is along the axes; a scale bar otherwise
  bool scale_bar = true;  ///< where there are no axes
  bool slope = false;     ///< the slope as a line, in views from the side; as a plane with shadows, in oblique ones
  bool depth = false;     ///< nearer particles over farther ones, and the farther the paler
  std::optional<Window> window = {};  ///< left out: all particles
  std::optional<double> aspect = {};  ///< height over width of the plot; left out: the window's, within 0.2 to 1.3
};

/// \throws std::invalid_argument if the columns have different lengths, a unit is not positive, or a given window or
///         range of colours has no extent
void check(const ParticlePicture& picture);

/// The picture's window, or one with all particles and a little room; a unit square if there are none.
Window window_of(const ParticlePicture& picture);

/// Gives all pictures windows of the same size, each about its own particles (on its own slope, where that is drawn):
/// frames that follow the flow.
void share_scale(std::span<ParticlePicture> pictures);

/// The part of the plane z = 0 that an oblique picture with a slope shows: a little more than what lies under the
/// particles. Nothing in other pictures.
struct Ground {
  double x0 = 0, x1 = 0, y0 = 0, y1 = 0;  ///< m
  double step = 1;                        ///< m, between the lines of its grid; the sides are multiples of it
};
std::optional<Ground> ground_of(const ParticlePicture& picture);

/// Height over width that suits the picture; the plot of a long thin cloud stays high enough to read.
double aspect_of(const ParticlePicture& picture);

/// What axes, colour bar and key need around the plot.
Margins margins(cairo_t* context, const ParticlePicture& picture, const Rectangle& plot);

/// Draws into `plot`; the window is widened, not stretched, to its shape. Discs smaller than 0.35 units are drawn with
/// that radius.
void draw(cairo_t* context, const ParticlePicture& picture, const Rectangle& plot);

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

/// Particles of a continuum drawn as dots, as Yuu & Umekage (2011) draw theirs in Figure 4: dots about each particle,
/// normally distributed with a standard deviation of (2/3) h along each axis, those beyond 2 h drawn again. A dot
/// behind a wall or plate goes to its mirror image (choice; the paper does not say), so that there are none where there
/// are no grains. The same for the same identities. They are drawn once, 65,536 for all particles, of which each takes
/// some that follow each other. \param identity chooses these \param smoothing_length h, m; one entry per particle in
/// all columns
std::vector<Vector3> particle_dots(std::span<const Vector3> position, std::span<const double> smoothing_length,
                                   std::span<const std::int64_t> identity, const Domain& domain, int dots = 50);

}  // namespace talus::figure

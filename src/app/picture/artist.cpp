// SPDX-License-Identifier: Apache-2.0
#include "app/picture/artist.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/statistics.hpp"
#include "base/error.hpp"
#include "base/unit.hpp"
#include "io/figure/axes.hpp"

namespace talus::app {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double area_alone = 80000, area_of_many = 32000;  // of a plot, square units
constexpr double arrow = 15, between_arrows = 8;            // units
constexpr figure::Colour plain = figure::rgb(0x7d8a99);

/// SI value of one of a unit, and its dimension; "1" and nothing are numbers.
std::optional<Quantity> one_of(const std::string& unit) {
  return parse_quantity(unit.empty() || unit == "1" ? "1" : "1 " + unit);
}

figure::Unit display_unit(const std::string& asked, const std::string& field, const std::string& name) {
  if (asked.empty()) return {1, field == "1" ? "" : field};
  const auto wanted = one_of(asked), is = one_of(field);
  if (!wanted || !is || !(wanted->dimension == is->dimension))
    throw InputError({{.where = "--unit " + asked,
                       .what = wanted ? fmt::format("is no unit of {}", name) : std::string("is no unit"),
                       .allowed = field == "1" ? "none: it is a number" : "a unit like " + field}});
  return {wanted->value / is->value, asked};
}

/// As many digits as tell the snapshots of a run apart, two at least.
std::string title_of(double time, const std::vector<double>& times) {
  const double apart = times.size() < 2 ? 1 : (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(apart) - 0.01)), 2, 9);
  return fmt::format("*t* = {:.{}f} s", std::abs(time) < 0.5 * std::pow(10, -digits) ? 0.0 : time, digits);
}

std::string words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

}  // namespace

Artist::Artist(const std::vector<RunFrames>& runs, std::vector<std::string> names, PictureStyle style)
    : runs_(runs),
      names_(std::move(names)),
      style_(std::move(style)),
      windows_(runs.size(), {infinity, -infinity, infinity, -infinity}),
      low_(infinity),
      high_(-infinity) {}

figure::View Artist::view_of(const Scene& scene) const {
  const std::string_view name = style_.view.empty() ? scene.view : std::string_view(style_.view);
  if (name == "xy") return figure::view_xy;
  if (name == "xz") return figure::view_xz;
  if (name == "yz") return {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
  return figure::view_oblique(0.6, 0.45);
}

void Artist::look_at(std::size_t run, const Frame& frame) {
  if (!frame.values.empty()) {
    unit_ = display_unit(style_.unit, frame.unit, style_.shown.color);
    std::vector<double> values;
    std::copy_if(frame.values.begin(), frame.values.end(), std::back_inserter(values),
                 [](double value) { return std::isfinite(value); });
    if (!values.empty()) {
      low_ = std::min(low_, quantile(values, 0.01)), high_ = std::max(high_, quantile(values, 0.99));
    }
  }
  if (!frame.arrow_values.empty()) {
    std::vector<double> lengths;
    for (const Vector3& value : frame.arrow_values)
      if (std::isfinite(norm(value))) lengths.push_back(norm(value));
    if (!lengths.empty()) usual_arrow_ = std::max(usual_arrow_, quantile(lengths, 0.95));
    arrow_unit_ = frame.arrow_unit;
  }
  const Scene& scene = runs_[run].scene();
  const figure::ParticlePicture picture{.positions = frame.positions, .radii = frame.radii, .view = view_of(scene)};
  figure::Window w = window_of(picture);
  if (frame.positions.empty() && windows_[run].left < windows_[run].right) return;
  if (frame.positions.empty() && scene.box) w.bottom = w.top = scene.box->first.z;  // no particle is up to anywhere
  if (scene.box && picture.view.up.z == 1) {
    const auto& [low, high] = *scene.box;
    w.left = dot(picture.view.right, low), w.right = dot(picture.view.right, high);
    w.bottom = low.z, w.top = std::clamp(w.top, low.z + 0.02 * (w.right - w.left), high.z);
    const double room = 0.01 * (w.right - w.left);  // for the walls' lines
    w = {w.left - room, w.right + room, w.bottom - room, w.top + room};
  }
  figure::Window& all = windows_[run];
  all = {std::min(all.left, w.left), std::max(all.right, w.right), std::min(all.bottom, w.bottom),
         std::max(all.top, w.top)};
}

/// The same extent for all runs, each about its own middle, on its own ground.
figure::Window Artist::window(std::size_t run) const {
  double width = 0, height = 0;
  for (const figure::Window& w : windows_)
    width = std::max(width, w.right - w.left), height = std::max(height, w.top - w.bottom);
  const figure::Window& w = windows_[run];
  const double left = 0.5 * (w.left + w.right) - 0.5 * width;
  return {left, left + width, w.bottom, w.bottom + height};
}

double Artist::aspect() const {
  const figure::Window w = window(0);
  return std::clamp((w.top - w.bottom) / (w.right - w.left), 0.2, 2.5);
}

int Artist::panels_in_a_row() const {
  return std::clamp(static_cast<int>(std::lround(4 * aspect())), 1, 6);
}

figure::ParticlePicture Artist::picture(const Panel& panel, bool alone) const {
  const Scene& scene = runs_[panel.run].scene();
  const Frame& frame = *panel.frame;
  figure::ParticlePicture picture{.title = title_of(frame.time, runs_[panel.run].times()),
                                  .positions = frame.positions,
                                  .radii = frame.radii,
                                  .view = view_of(scene),
                                  .colouring = figure::Plain{plain},
                                  .window = window(panel.run)};
  const figure::Window& w = *picture.window;
  const double size = std::max(w.right - w.left, w.top - w.bottom);
  picture.length = size < 2 ? figure::Unit{1e-3, "mm"} : figure::Unit{1, "m"};
  picture.aspect = aspect();
  picture.slope = scene.slope && picture.view.toward.z < 0.999;
  picture.depth = figure::axis_of(picture.view.up).name == nullptr;
  picture.axes = alone;
  // Without particles, too, the picture has the colours and arrows of the others.
  const bool is_empty = frame.positions.empty() && low_ <= high_;
  if (!frame.values.empty() || is_empty) {
    double low = style_.range ? style_.range->first : low_ / unit_.value,
           high = style_.range ? style_.range->second : high_ / unit_.value;
    if (!(low < high)) low -= 0.5, high = low + 1;  // all alike
    picture.colouring = figure::ByValue{.values = frame.values, .unit = unit_, .low = low, .high = high, .bar = false};
  }
  if ((!frame.arrow_values.empty() || frame.positions.empty()) && usual_arrow_ > 0)
    picture.arrows = figure::Arrows{.values = frame.arrow_values,
                                    .positions = frame.arrow_positions,
                                    .unit = {1, arrow_unit_},
                                    .length = arrow / usual_arrow_,
                                    .spacing = between_arrows,
                                    .key = false};
  if (picture.view.up.z == 1 && picture.view.right.x == 1)
    for (const WallLine& wall : scene.walls)
      if (frame.time < wall.until) picture.segments.push_back({.from = wall.from, .to = wall.to});
  return picture;
}

figure::Figure Artist::figure(const std::vector<Panel>& panels, int columns) const {
  figure::Figure figure{.title = style_.title, .columns = columns, .letters = false};
  const bool alone = panels.size() == 1;
  for (std::size_t n = 0; n < panels.size(); ++n) {
    figure::ParticlePicture drawn = picture(panels[n], alone);
    drawn.scale_bar = n == 0;
    const bool first_of_run = n == 0 || panels[n].run != panels[n - 1].run;
    if (runs_.size() > 1 && first_of_run) drawn.title = names_[panels[n].run] + ", " + drawn.title;
    if (const auto* colours = std::get_if<figure::ByValue>(&drawn.colouring))
      figure.bar =
          figure::ColourBar{*colours->low, *colours->high, figure::axis_title(words(style_.shown.color), unit_.name)};
    if (drawn.arrows) {
      const double value = figure::nice_length(1.4 * usual_arrow_);
      figure.key =
          figure::ArrowKey{.label = fmt::format("{:g} {}", value, arrow_unit_), .length = value * drawn.arrows->length};
    }
    figure.panels.emplace_back(std::move(drawn));
  }
  const double plot = std::sqrt((alone ? area_alone : area_of_many) / aspect());
  const double bar = figure.bar || figure.key ? 62 : 0;
  figure.width = 16 + columns * (plot + 18) + (alone ? 45 : 0) + bar;
  if (style_.width > 0) figure.scale = style_.width / figure.width;
  return figure;
}

}  // namespace talus::app

// SPDX-License-Identifier: Apache-2.0
/// The layout: what stands around each plot is measured first, and what is left of the width is shared by the columns;
/// the heights follow from the shapes of the plots. The numbers on an
/// axis depend on its length, so that is repeated until nothing changes, at most ten times.
#include "io/figure/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "io/file.hpp"

namespace talus::figure {

namespace {

constexpr TextStyle figure_title_style{.size = 11, .bold = true}, letter_style{.size = 10, .bold = true},
    title_style{.size = 10};
constexpr double edge = 8, column_gap = 14, row_gap = 12, title_line = 15, min_width = 60;

std::size_t columns_of(const Figure& figure) {
  const std::size_t count = figure.panels.size();
  const std::size_t usual = count >= 5 ? 3 : 2;
  return std::min(count, figure.columns > 0 ? static_cast<std::size_t>(figure.columns) : usual);
}

class Layout {
 public:
  Layout(const Figure& figure, cairo_t* context) : figure_(figure), columns_(columns_of(figure)) {
    constexpr double widths[] = {480, 720, 860, 980};
    width_ = figure.width > 0 ? figure.width : widths[std::min(columns_, std::size_t{4}) - 1];
    const double width = width_ / static_cast<double>(columns_);
    plots_.assign(figure.panels.size(), {0, 0, width, 0.7 * width});
    for (int pass = 0; pass < 10; ++pass) {
      const std::vector<Rectangle> before = plots_;
      arrange(context);
      if (plots_ == before) break;
    }
  }

  double width() const { return width_; }
  double height() const { return height_; }
  const Rectangle& plot(std::size_t panel) const { return plots_[panel]; }

  /// What the colour bar of the figure stands right of.
  Rectangle panels() const {
    const double top = plots_.front().y, bottom = plots_.back().bottom();
    return {edge, top, width_ - 2 * edge - bar_, bottom - top};
  }

  /// "(a) title" above the plot.
  bool has_title(std::size_t panel) const { return lettered() || !figure_.panels[panel].title.empty(); }
  bool lettered() const { return figure_.letters && figure_.panels.size() > 1; }

 private:
  void arrange(cairo_t* context) {
    std::vector<Margins> sides(columns_), around(plots_.size());
    for (std::size_t i = 0; i < plots_.size(); ++i) {
      around[i] = margins(context, figure_.panels[i], plots_[i]);
      Margins& side = sides[i % columns_];
      side.left = std::max(side.left, around[i].left), side.right = std::max(side.right, around[i].right);
    }
    if (figure_.bar) bar_ = colour_bar_width(context, *figure_.bar, height_);
    double below = 0;  // the last row
    if (figure_.key) {
      const Margins key = arrow_key_margins(context, *figure_.key);
      bar_ = std::max(bar_, key.right), below = key.bottom;
    }
    double y = edge + (figure_.title.empty() ? 0 : 1.4 * title_line);
    double room = width_ - 2 * edge - bar_ - static_cast<double>(columns_ - 1) * column_gap;
    for (const Margins& side : sides) room -= side.left + side.right;
    const double plot_width = std::max(min_width, room / static_cast<double>(columns_));
    for (std::size_t first = 0; first < plots_.size(); first += columns_) {
      const std::size_t end = std::min(first + columns_, plots_.size());
      double top = 0, bottom = 0, aspect = 0;
      for (std::size_t i = first; i < end; ++i) {
        top = std::max(top, around[i].top + (has_title(i) ? title_line : 0));
        bottom = std::max(bottom, around[i].bottom);
        aspect = std::max(aspect, aspect_of(figure_.panels[i]));
      }
      y += top;
      double x = edge;
      for (std::size_t i = first; i < end; ++i) {
        const Margins& side = sides[i - first];
        x += side.left;
        plots_[i] = {x, y, plot_width, aspect * plot_width};
        x += plot_width + side.right + column_gap;
      }
      if (end == plots_.size()) bottom = std::max(bottom, below);
      y += aspect * plot_width + bottom + row_gap;
    }
    height_ = y - row_gap + edge;
  }

  const Figure& figure_;
  std::size_t columns_;
  double width_ = 0, height_ = 0, bar_ = 0;
  std::vector<Rectangle> plots_;
};

}  // namespace

namespace {

Canvas drawn(const Figure& figure) {
  if (figure.panels.empty()) throw std::invalid_argument("a figure without panels");
  const Canvas scratch(1, 1, 1);
  const Layout layout(figure, scratch.context());
  Canvas canvas(layout.width(), layout.height(), figure.scale);
  cairo_t* context = canvas.context();
  draw_text(context, figure.title, edge, edge + figure_title_style.size, figure_title_style);
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const Rectangle& plot = layout.plot(i);
    const ParticlePicture& panel = figure.panels[i];
    draw(context, panel, plot);
    if (!layout.has_title(i)) continue;
    const double top = plot.y - margins(context, panel, plot).top - 5;
    double x = plot.x;
    if (layout.lettered()) {
      const std::string letter = fmt::format("({:c})", static_cast<char>('a' + i % 26));
      draw_text(context, letter, x, top, letter_style);
      x += text_extent(context, letter, letter_style).width + 5;
    }
    draw_text(context, panel.title, x, top, title_style);
  }
  if (figure.bar) draw_colour_bar(context, *figure.bar, layout.panels());
  if (figure.key) draw_arrow_key(context, *figure.key, layout.panels(), arrow_key_margins(context, *figure.key).bottom);
  return canvas;
}

}  // namespace

std::string png(const Figure& figure) {
  return drawn(figure).png();
}

Pixels pixels(const Figure& figure) {
  return drawn(figure).pixels();
}

void write_png(const Figure& figure, const std::filesystem::path& path) {
  write_atomically(path, png(figure));
}

}  // namespace talus::figure

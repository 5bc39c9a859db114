// SPDX-License-Identifier: Apache-2.0
/// The layout: what stands around each plot is measured first, and what is left of the width is shared by the columns;
/// the heights follow from the shapes of the plots. The numbers on an axis depend on its length, so that is repeated
/// until nothing changes, at most ten times.
#include "io/figure/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "io/atomic_file.hpp"

namespace talus::figure {

namespace {

constexpr TextStyle figure_title_style{.size = 11, .bold = true}, letter_style{.size = 10, .bold = true},
    title_style{.size = 10};
constexpr double edge = 8, column_gap = 14, row_gap = 12, title_line = 15, least_width = 60;

double aspect_of(const Chart& chart) {
  return chart.aspect;
}

class Layout {
 public:
  Layout(const Figure& figure, cairo_t* context) : figure_(figure) {
    const auto count = static_cast<int>(figure.panels.size());
    columns_ = figure.columns > 0 ? std::min(figure.columns, count) : std::min(count, count >= 5 ? 3 : 2);
    rows_ = (count + columns_ - 1) / columns_;
    constexpr double widths[] = {480, 720, 860, 980};
    width_ = figure.width > 0 ? figure.width : widths[std::min(columns_, 4) - 1];
    plots_.assign(figure.panels.size(), {0, 0, width_ / columns_, 0.7 * width_ / columns_});
    for (int pass = 0; pass < 10; ++pass) {
      const std::vector<Rectangle> before = plots_;
      arrange(context);
      if (plots_ == before) break;
    }
  }

  double width() const { return width_; }
  double height() const { return height_; }
  const Rectangle& plot(std::size_t panel) const { return plots_[panel]; }

  /// "(a) title" above the plot.
  bool has_title(std::size_t panel) const {
    return lettered() || std::visit([](const auto& p) { return !p.title.empty(); }, figure_.panels[panel]);
  }
  bool lettered() const { return figure_.letters && figure_.panels.size() > 1; }

 private:
  void arrange(cairo_t* context) {
    std::vector<double> left(columns_), right(columns_), top(rows_), bottom(rows_), aspect(rows_);
    for (std::size_t i = 0; i < plots_.size(); ++i) {
      const std::size_t column = i % columns_, row = i / columns_;
      const Margins m = std::visit([&](const auto& p) { return margins(context, p, plots_[i]); }, figure_.panels[i]);
      left[column] = std::max(left[column], m.left), right[column] = std::max(right[column], m.right);
      top[row] = std::max(top[row], m.top + (has_title(i) ? title_line : 0));
      bottom[row] = std::max(bottom[row], m.bottom);
      aspect[row] = std::max(aspect[row], std::visit([](const auto& p) { return aspect_of(p); }, figure_.panels[i]));
    }
    double room = width_ - 2 * edge - (columns_ - 1) * column_gap;
    for (int c = 0; c < columns_; ++c) room -= left[c] + right[c];
    const double plot_width = std::max(least_width, room / columns_);
    double y = edge + (figure_.title.empty() ? 0 : 1.4 * title_line);
    for (int row = 0; row < rows_; ++row) {
      y += top[row];
      double x = edge;
      for (int column = 0; column < columns_; ++column) {
        x += left[column];
        const std::size_t panel = static_cast<std::size_t>(row * columns_ + column);
        if (panel < plots_.size()) plots_[panel] = {x, y, plot_width, aspect[row] * plot_width};
        x += plot_width + right[column] + column_gap;
      }
      y += aspect[row] * plot_width + bottom[row] + row_gap;
    }
    height_ = y - row_gap + edge;
  }

  const Figure& figure_;
  int columns_ = 1, rows_ = 1;
  double width_ = 0, height_ = 0;
  std::vector<Rectangle> plots_;
};

}  // namespace

std::string png(const Figure& figure) {
  if (figure.panels.empty()) throw std::invalid_argument("a figure without panels");
  const Canvas scratch(1, 1, 1);
  const Layout layout(figure, scratch.context());
  const Canvas canvas(layout.width(), layout.height(), figure.scale);
  cairo_t* context = canvas.context();
  draw_text(context, figure.title, edge, edge + figure_title_style.size, figure_title_style);
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const Rectangle& plot = layout.plot(i);
    std::visit(
        [&](const auto& panel) {
          draw(context, panel, plot);
          if (!layout.has_title(i)) return;
          const double top = plot.y - margins(context, panel, plot).top - 5;
          double x = plot.x;
          if (layout.lettered()) {
            const std::string letter = fmt::format("({:c})", static_cast<char>('a' + i % 26));
            draw_text(context, letter, x, top, letter_style);
            x += text_extent(context, letter, letter_style).width + 5;
          }
          draw_text(context, panel.title, x, top, title_style);
        },
        figure.panels[i]);
  }
  return canvas.png();
}

void write_png(const Figure& figure, const std::filesystem::path& path) {
  write_atomically(path, png(figure));
}

}  // namespace talus::figure

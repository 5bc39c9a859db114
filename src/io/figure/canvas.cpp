// SPDX-License-Identifier: Apache-2.0
#include "io/figure/canvas.hpp"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace talus::figure {

// Viridis stands here as 33 equally spaced colours, fitted by least squares so that straight lines between them follow
// the published table. Source: van der Walt & Smith, "mpl-colormaps" (2015).

namespace {

using Table = std::array<unsigned, 33>;

constexpr Table viridis_table = {
    0x440154, 0x470d60, 0x48186a, 0x482374, 0x472d7b, 0x453681, 0x424086, 0x3f4989, 0x3b528b, 0x375a8d, 0x33638d,
    0x2f6a8e, 0x2c728e, 0x297a8e, 0x26818e, 0x23898e, 0x21908d, 0x1f988b, 0x1e9f88, 0x21a685, 0x27ae80, 0x31b57b,
    0x3dbc74, 0x4cc26c, 0x5cc963, 0x6ece58, 0x81d44c, 0x96d840, 0xabdc32, 0xc0df24, 0xd5e219, 0xeae519, 0xfde725};

}  // namespace

Colour colour_at(double t) {
  t = t > 0.0 ? std::min(t, 1.0) : 0.0;
  const double level = t * static_cast<double>(viridis_table.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(level), viridis_table.size() - 2);
  return mix(rgb(viridis_table[below]), rgb(viridis_table[below + 1]), level - static_cast<double>(below));
}

Canvas::Canvas(double width, double height, double scale) {
  const double across = std::round(width * scale), down = std::round(height * scale);
  constexpr double most = 32767;  // cairo's coordinates have 16 bits before the point
  if (!(across >= 1 && across <= most && down >= 1 && down <= most)) {
    throw std::invalid_argument(fmt::format("a picture of {} x {} pixels; allowed: 1 to {}", across, down, most));
  }
  surface_.reset(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(across), static_cast<int>(down)));
  context_.reset(cairo_create(surface_.get()));
  cairo_scale(context(), scale, scale);
  cairo_set_source_rgb(context(), 1, 1, 1);
  cairo_paint(context());
  cairo_set_line_cap(context(), CAIRO_LINE_CAP_BUTT);
  cairo_set_line_join(context(), CAIRO_LINE_JOIN_ROUND);
}

/// Libpng's quick way, without filters: cairo's own takes five times as long (docs/performance.md).
std::string Canvas::png() const {
  const Pixels drawn = pixels();
  std::string rgb;
  rgb.reserve(3 * drawn.bytes.size() / 4);
  for (std::size_t n = 0; n < drawn.bytes.size(); n += 4)
    for (const std::size_t k : {2, 1, 0}) rgb += drawn.bytes[n + k];
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(drawn.width), image.height = static_cast<png_uint_32>(drawn.height);
  image.format = PNG_FORMAT_RGB;
  image.flags = PNG_IMAGE_FLAG_FAST;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, rgb.data(), 0, nullptr) == 0)
    throw std::runtime_error(fmt::format("writing a picture failed: {}", image.message));
  bytes.resize(size);
  return bytes;
}

Pixels Canvas::pixels() const {
  if (const cairo_status_t status = cairo_status(context()); status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(fmt::format("drawing a picture failed: {}", cairo_status_to_string(status)));
  cairo_surface_flush(surface_.get());
  Pixels pixels{.width = cairo_image_surface_get_width(surface_.get()),
                .height = cairo_image_surface_get_height(surface_.get())};
  const unsigned char* const data = cairo_image_surface_get_data(surface_.get());
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface_.get()));
  const auto count = static_cast<std::size_t>(pixels.width), rows = static_cast<std::size_t>(pixels.height);
  pixels.bytes.reserve(4 * count * rows);
  for (std::size_t y = 0; y < rows; ++y)
    for (std::size_t x = 0; x < count; ++x) {
      std::uint32_t pixel = 0;  // cairo's pixels are numbers of 32 bits in the machine's order of bytes
      std::memcpy(&pixel, data + y * stride + 4 * x, sizeof pixel);
      for (const int shift : {0, 8, 16}) pixels.bytes += static_cast<char>(pixel >> shift & 255u);
      pixels.bytes += '\0';
    }
  return pixels;
}

void set_colour(cairo_t* context, const Colour& colour) {
  cairo_set_source_rgba(context, colour.red, colour.green, colour.blue, colour.alpha);
}

void set_pen(cairo_t* context, const Colour& colour, double width) {
  set_colour(context, colour);
  cairo_set_line_width(context, width);
}

void fill_rectangle(cairo_t* context, const Rectangle& r, const Colour& colour) {
  set_colour(context, colour);
  cairo_rectangle(context, r.x, r.y, r.width, r.height);
  cairo_fill(context);
}

void stroke_line(cairo_t* context, double x0, double y0, double x1, double y1) {
  cairo_move_to(context, x0, y0);
  cairo_line_to(context, x1, y1);
  cairo_stroke(context);
}

void stroke_arrow(cairo_t* context, double x0, double y0, double x1, double y1, double head) {
  const double length = std::hypot(x1 - x0, y1 - y0);
  if (!(length > 0)) return;
  const double ux = (x1 - x0) / length, uy = (y1 - y0) / length;
  const double back = std::min(head, 0.7 * length), half = 0.38 * back;
  stroke_line(context, x0, y0, x1 - 0.8 * back * ux, y1 - 0.8 * back * uy);
  cairo_move_to(context, x1, y1);
  cairo_line_to(context, x1 - back * ux - half * uy, y1 - back * uy + half * ux);
  cairo_line_to(context, x1 - back * ux + half * uy, y1 - back * uy - half * ux);
  cairo_close_path(context);
  cairo_fill(context);
}

}  // namespace talus::figure

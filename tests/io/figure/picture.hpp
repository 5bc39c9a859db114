// SPDX-License-Identifier: Apache-2.0
/// Reads a PNG back with cairo, and compares colours: for the tests of the figures.
#pragma once

#include <cairo/cairo.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/figure/canvas.hpp"

namespace talus::figure {

inline void PrintTo(const Colour& c, std::ostream* out) {
  *out << "rgb(" << std::round(255 * c.red) << ", " << std::round(255 * c.green) << ", " << std::round(255 * c.blue)
       << ")";
}

struct Picture {
  int width = 0, height = 0;
  std::vector<Colour> pixels;

  const Colour& at(int x, int y) const { return pixels.at(static_cast<std::size_t>(y * width + x)); }

  /// Pixels within `tolerance` of the colour.
  int count(const Colour& colour, double tolerance = 0.01) const;
};

/// The largest difference of a component.
inline double difference(const Colour& a, const Colour& b) {
  return std::max({std::abs(a.red - b.red), std::abs(a.green - b.green), std::abs(a.blue - b.blue)});
}

inline int Picture::count(const Colour& colour, double tolerance) const {
  return static_cast<int>(std::count_if(pixels.begin(), pixels.end(),
                                        [&](const Colour& pixel) { return difference(pixel, colour) <= tolerance; }));
}

inline Picture decode(const std::string& png) {
  struct Source {
    const std::string* bytes;
    std::size_t next = 0;
  } source{&png};
  auto read = [](void* from, unsigned char* to, unsigned length) {
    auto& s = *static_cast<Source*>(from);
    if (s.next + length > s.bytes->size()) return CAIRO_STATUS_READ_ERROR;
    std::memcpy(to, s.bytes->data() + s.next, length);
    s.next += length;
    return CAIRO_STATUS_SUCCESS;
  };
  cairo_surface_t* surface = cairo_image_surface_create_from_png_stream(read, &source);
  if (cairo_surface_status(surface) != CAIRO_STATUS_SUCCESS) throw std::runtime_error("not a PNG");
  Picture picture{cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface), {}};
  const unsigned char* data = cairo_image_surface_get_data(surface);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      std::uint32_t pixel;
      std::memcpy(&pixel, data + y * cairo_image_surface_get_stride(surface) + 4 * x, 4);
      picture.pixels.push_back(rgb(pixel & 0xffffff));
    }
  }
  cairo_surface_destroy(surface);
  return picture;
}

/// What `draw` puts on a page of its own.
template <class Panel>
Picture drawn(const Panel& panel, const Rectangle& plot, double width, double height, double scale = 1) {
  const Canvas canvas(width, height, scale);
  draw(canvas.context(), panel, plot);
  return decode(canvas.png());
}

}  // namespace talus::figure

// SPDX-License-Identifier: Apache-2.0
#include "io/figure/particle_layers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <new>

namespace talus::figure {

namespace {

constexpr int subpixels = 8;  // at which a disc can stand within a pixel, each way
constexpr int samples = 16;   // of a pixel, each way

/// The share of a pixel that a disc covers, by samples. \param x, y of the disc's centre from the pixel's corner,
/// pixels
double covered(double x, double y, double radius) {
  int inside = 0;
  for (int j = 0; j < samples; ++j)
    for (int i = 0; i < samples; ++i) {
      const double dx = (i + 0.5) / samples - x, dy = (j + 0.5) / samples - y;
      inside += dx * dx + dy * dy < radius * radius;
    }
  return static_cast<double>(inside) / (samples * samples);
}

}  // namespace

Stipple::Stipple(cairo_t* context, double radius, const Colour& colour)
    : context_(context),
      colour_(colour),
      width_(cairo_image_surface_get_width(cairo_get_target(context))),
      height_(cairo_image_surface_get_height(cairo_get_target(context))),
      left_(width_),
      top_(height_),
      through_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 1.0F) {
  double across = 1, down = 0;
  cairo_user_to_device_distance(context, &across, &down);
  scale_ = across;
  const double pixels = radius * scale_;
  reach_ = static_cast<int>(std::ceil(pixels));
  for (int row = 0; row < subpixels; ++row)
    for (int column = 0; column < subpixels; ++column)
      for (int j = -reach_; j <= reach_; ++j)
        for (int i = -reach_; i <= reach_; ++i)
          shares_.push_back(static_cast<float>(
              1 - colour.alpha * covered((column + 0.5) / subpixels - i, (row + 0.5) / subpixels - j, pixels)));
}

void Stipple::add(double x, double y) {
  cairo_user_to_device(context_, &x, &y);
  const double left = std::floor(x), top = std::floor(y);
  if (!(left > -1e6 && left < 1e6 && top > -1e6 && top < 1e6)) return;
  const int column = static_cast<int>(left), row = static_cast<int>(top), side = 2 * reach_ + 1;
  const int subpixel = static_cast<int>((y - top) * subpixels) * subpixels + static_cast<int>((x - left) * subpixels);
  const float* share = shares_.data() + static_cast<std::ptrdiff_t>(subpixel) * side * side;
  left_ = std::min(left_, std::max(0, column - reach_)),
  right_ = std::max(right_, std::min(width_, column + reach_ + 1));
  top_ = std::min(top_, std::max(0, row - reach_)), bottom_ = std::max(bottom_, std::min(height_, row + reach_ + 1));
  for (int j = row - reach_; j <= row + reach_; ++j)
    for (int i = column - reach_; i <= column + reach_; ++i, ++share)
      if (i >= 0 && i < width_ && j >= 0 && j < height_)
        through_[static_cast<std::size_t>(j) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(i)] *=
            *share;
}

void Stipple::draw() {
  if (left_ >= right_ || top_ >= bottom_) return;
  const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> mask(
      cairo_image_surface_create(CAIRO_FORMAT_A8, right_ - left_, bottom_ - top_), cairo_surface_destroy);
  if (cairo_surface_status(mask.get()) != CAIRO_STATUS_SUCCESS) throw std::bad_alloc();
  cairo_surface_flush(mask.get());
  unsigned char* const data = cairo_image_surface_get_data(mask.get());
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(mask.get()));
  for (int row = top_; row < bottom_; ++row) {
    const float* const from = through_.data() + static_cast<std::ptrdiff_t>(row) * width_ + left_;
    unsigned char* const to = data + static_cast<std::size_t>(row - top_) * stride;
    for (int n = 0; n < right_ - left_; ++n) to[n] = static_cast<unsigned char>(255 * (1 - from[n]) + 0.5F);
  }
  cairo_surface_mark_dirty(mask.get());
  cairo_save(context_);
  cairo_identity_matrix(context_);
  cairo_set_source_rgb(context_, colour_.red, colour_.green, colour_.blue);
  cairo_mask_surface(context_, mask.get(), left_, top_);
  cairo_restore(context_);
}

}  // namespace talus::figure

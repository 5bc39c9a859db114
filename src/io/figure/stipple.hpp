// SPDX-License-Identifier: Apache-2.0
/// Hundreds of thousands of equal small discs of one colour that may be translucent, laid on each other: the dots that
/// stand for grains. Cairo takes 1.5 us for each; here a disc is a few additions to a mask, 0.05 us.
#pragma once

#include <cairo/cairo.h>

#include <vector>

#include "io/figure/colour.hpp"

namespace talus::figure {

/// Collects discs and draws them all at once. Of n discs that cover a pixel by c_1 ... c_n, the product of 1 - alpha
/// c_k lets what is below shine through, as if they were drawn one by one.
class Stipple {
 public:
  /// \param context an image's; its scale, not turned, and its clip are used
  /// \param radius of the discs, units of the page, > 0 \param colour with its alpha
  Stipple(cairo_t* context, double radius, const Colour& colour);

  /// A disc around a place of the page, in units; what lies beyond the page is cut off.
  void add(double x, double y);

  /// Draws what was added. \throws std::bad_alloc
  void draw();

 private:
  cairo_t* context_;
  Colour colour_;
  double scale_ = 1;                         // pixels a unit
  int width_, height_;                       // of the page, pixels
  int left_, right_ = 0, top_, bottom_ = 0;  // around the pixels that discs have reached
  int reach_ = 0;                            // of a disc from its centre's pixel
  std::vector<float> shares_;   // that a disc leaves uncovered of the pixels around it, for each place within a pixel
  std::vector<float> through_;  // of each pixel of the page
};

}  // namespace talus::figure

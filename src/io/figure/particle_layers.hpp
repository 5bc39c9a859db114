// SPDX-License-Identifier: Apache-2.0
/// The layers of a particle picture, from the back to the front: slope, discs, arrows, segments, scale bar. What is
/// drawn adds to the obstacles that the scale bar keeps clear of.
#pragma once

#include <cairo/cairo.h>

#include <optional>
#include <vector>

#include "io/figure/axes.hpp"
#include "io/figure/canvas.hpp"
#include "io/figure/figure.hpp"

namespace talus::figure {

/// From metres to the page.
struct Projection {
  View view;
  Window window;
  Rectangle plot;
  double scale = 1;  ///< units a metre

  Obstacle operator()(const Vector3& p) const {
    return {plot.x + (dot(view.right, p) - window.left) * scale,
            plot.bottom() - (dot(view.up, p) - window.bottom) * scale};
  }
};

/// The range of the values, where it is not given.
ColourBar bar_of(const ByValue& colouring);

/// Seen along the slope: its line, and the ground below. Seen from above it: the plane with a grid and the particles'
/// shadows, as in light along the normal.
void draw_slope(cairo_t* context, const ParticlePicture& picture, const Projection& projection);

void draw_discs(cairo_t* context, const ParticlePicture& picture, const Projection& projection,
                std::vector<Obstacle>& obstacles);

void draw_arrows(cairo_t* context, const ParticlePicture& picture, const Projection& projection,
                 std::vector<Obstacle>& obstacles);

/// An arrow of a round value; nothing if none is wanted, or no arrow has a finite length.
std::optional<ArrowKey> key_of(const ParticlePicture& picture);

void draw_segments(cairo_t* context, const ParticlePicture& picture, const Projection& projection,
                   std::vector<Obstacle>& obstacles);

void draw_scale_bar(cairo_t* context, const ParticlePicture& picture, const Projection& projection,
                    std::vector<Obstacle>& obstacles);

/// Hundreds of thousands of equal small discs of one colour that may be translucent, drawn all at once: the dots that
/// stand for grains. Cairo takes 1.5 us for each; here a disc is a few additions to a mask, 0.05 us. Of n discs that
/// cover a pixel by c_1 ... c_n, the product of 1 - alpha c_k lets what is below shine through, as if they were drawn
/// one by one.
class Stipple {
 public:
  /// \param context an image's; its scale, not turned, and its clip are used
  /// \param radius of the discs, units of the page, > 0 \param colour with its alpha
  Stipple(cairo_t* context, double radius, const Colour& colour);

  /// A disc around a position of the page, in units; what lies beyond the page is cut off.
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
  std::vector<float> shares_;  // that a disc leaves uncovered of the pixels around it, for each position within a pixel
  std::vector<float> through_;  // of each pixel of the page
};

}  // namespace talus::figure

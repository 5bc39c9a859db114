// SPDX-License-Identifier: Apache-2.0
/// The layers of a particle picture, from the back to the front: slope, discs, arrows, segments, scale bar. What is
/// drawn adds to the obstacles that legend and scale bar keep clear of.
#pragma once

#include <optional>
#include <vector>

#include "io/figure/legend.hpp"
#include "io/figure/particle_picture.hpp"

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

}  // namespace talus::figure

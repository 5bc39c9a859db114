// SPDX-License-Identifier: Apache-2.0
/// Colour maps: from a number in [0, 1] to a colour.
#pragma once

#include "io/figure/colour.hpp"

namespace talus::figure {

enum class ColourMap {
  viridis,    ///< sequential; equal steps look equal (van der Walt & Smith 2015; published as CC0)
  cividis,    ///< sequential; looks the same with red-green blindness (Nuñez, Anderton & Renslow 2018)
  grey,       ///< sequential, from white to dark: the paper's Figure 7a
  cool_warm,  ///< diverging about 0.5: blue, light grey, red (Moreland 2009)
};

/// The colour at `t`; outside [0, 1] that of the nearer end. Within 1.1/255 (viridis) and 3.9/255 (cividis) of the
/// published tables of 256 colours.
Colour colour_at(ColourMap map, double t);

}  // namespace talus::figure

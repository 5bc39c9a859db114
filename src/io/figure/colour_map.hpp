// SPDX-License-Identifier: Apache-2.0
/// The colour map of the pictures: from a number in [0, 1] to a colour.
#pragma once

#include "io/figure/colour.hpp"

namespace talus::figure {

/// Viridis, in which equal steps look equal (van der Walt & Smith 2015; published as CC0), at `t`; outside [0, 1] the
/// colour of the nearer end. Within 1.1/255 of the published table of 256 colours.
Colour colour_at(double t);

}  // namespace talus::figure

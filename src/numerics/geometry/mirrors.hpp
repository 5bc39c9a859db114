// SPDX-License-Identifier: Apache-2.0
/// An image seen in one mirror more.
#pragma once

#include "numerics/geometry/domain.hpp"

namespace talus {

/// What the mirror shows of an image: reflected, or shifted by a periodic face.
Image mirrored(Image image, const Mirror& mirror);

/// Whether two images show the same places of the x-z plane, to round-off. \param length of the box, m
bool same_map(const Image& a, const Image& b, double length);

}  // namespace talus

// SPDX-License-Identifier: Apache-2.0
/// An image seen in one mirror more.
#pragma once

#include "numerics/geometry/domain.hpp"

namespace talus {

/// What the mirror shows of an image: reflected, or shifted by a periodic face.
Image mirrored(Image image, const Mirror& mirror);

}  // namespace talus
